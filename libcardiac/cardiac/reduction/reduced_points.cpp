#include "cardiac/reduction/reduced_points.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include <cardiac/anatomy/right_ventricle.hpp>
#include <cardiac/anatomy/segments.hpp>
#include <cardiac/reduction/segment_cells.hpp>
#include <polyaffine/quadrature/cell_gauss.hpp>
#include <polyaffine/rules/split_rule.hpp>

namespace cardiac {

using polyaffine::LagrangeBasis;
using polyaffine::Monomial;
using polyaffine::Points;
using polyaffine::SurfacePoints;
using polyaffine::Vec3;
using polyaffine::Vec4;
using polyaffine::WallPoints;

namespace {

// Degree of the Gauss points of the mesh from which the points of a reduced model are chosen. Elements that
// the border of a cell crosses are cut in parts, up to so many times, with points of the second degree each:
// else the cells' volumes and, more so, the areas that a pressure pushes on are wrong by parts of elements.
constexpr int kCandidateDegree = 4, kPartDegree = 2, kWallCuts = 1, kSurfaceCuts = 2;
// The same for points of strain, which weigh means and need no cut elements.
constexpr int kStrainDegree = 2;
// Corners are asked for their cell this share of the way to the middle of the element: one that only touches
// a border is not crossed by it, and rounding does not decide.
constexpr double kDrawnIn = 1e-3;
// Gauss points of a cell of strain points, along the wall and through its depth, in which fibres turn by
// 120°.
constexpr int kStrainAlong = 2, kStrainDepth = 4;
// Polynomials kept exact in a cell that is no box, through its depth, where fibres turn, and in the cells of
// strain points.
constexpr int kDepthDegree = 8;
constexpr polyaffine::CellDegree kStrainCellDegree{4, 4, kDepthDegree};

// Cell of each candidate point and its place in the cell, each coordinate 0 to 1.
struct Cells {
  std::vector<int> cell;
  Points place;
};

template <class Candidates>
Cells tent_cells(const SegmentCells& cells, const Candidates& candidates) {
  Cells out{{}, Points(3, candidates.barycentric.cols())};
  for (Eigen::Index q = 0; q < out.place.cols(); ++q) {
    const auto at = cells(candidates.tet[q], candidates.barycentric.col(q));
    out.cell.push_back(at.cell);
    out.place.col(q) = at.place;
  }
  return out;
}

struct CandidatePoints {
  WallPoints wall;
  FaceRule face;
};

// Corners (columns, barycentric in a tet) in an order that belongs to the heart, not to the file: along a
// line oblique to its axes.
template <class Corners>
Corners in_order_of_heart(const VentricularCoordinates& heart, int tet, const Corners& corners) {
  const Vec3 along = heart.axis() + 0.618 * heart.anterior() + 0.382 * heart.axis().cross(heart.anterior());
  std::vector<std::pair<double, Eigen::Index>> order;
  for (Eigen::Index k = 0; k < corners.cols(); ++k)
    order.emplace_back(along.dot(heart.position(tet, corners.col(k))), k);
  std::ranges::sort(order);
  Corners out = corners;
  for (std::size_t k = 0; k < order.size(); ++k)
    out.col(static_cast<Eigen::Index>(k)) = corners.col(order[k].second);
  return out;
}

// Points that see the cells of the tents as they are, not to the nearest element.
CandidatePoints tent_candidates(const VentricularCoordinates& heart, const SegmentCells& cells) {
  const auto crossed = [&cells](int tet, const auto& corners) {
    const auto cell = [&](Eigen::Index k) {
      const Vec4 inside = (1 - kDrawnIn) * corners.col(k) + kDrawnIn * corners.rowwise().mean();
      return cells(tet, inside).cell;
    };
    const int first = cell(0);
    for (Eigen::Index k = 1; k < corners.cols(); ++k)
      if (cell(k) != first) return true;
    return false;
  };
  CandidatePoints out;
  out.wall = heart.space().wall_points([&, whole = polyaffine::tet_rule(kCandidateDegree),
                                        part = polyaffine::tet_rule(kPartDegree)](int tet) {
    const Eigen::Matrix4d order = in_order_of_heart(heart, tet, Eigen::Matrix4d::Identity().eval());
    polyaffine::TetRule rule = polyaffine::split_rule(
        whole, part, [&](const Eigen::Matrix4d& corners) { return crossed(tet, (order * corners).eval()); },
        kWallCuts);
    rule.barycentric = (order * rule.barycentric).eval();
    return rule;
  });
  out.face = [crossed, &heart, whole = polyaffine::triangle_rule(kCandidateDegree),
              part = polyaffine::triangle_rule(kPartDegree)](int tet,
                                                             const LagrangeBasis::FaceCorners& face) {
    const LagrangeBasis::FaceCorners in_order = in_order_of_heart(heart, tet, face);
    const polyaffine::Mat3 order = face.transpose() * in_order;  // corners of a face are unit vectors
    polyaffine::TriangleRule rule = polyaffine::split_rule(
        whole, part,
        [&](const polyaffine::Mat3& corners) { return crossed(tet, (in_order * corners).eval()); },
        kSurfaceCuts);
    rule.barycentric = (order * rule.barycentric).eval();
    return rule;
  };
  return out;
}

// The regions themselves; in the cap, where angles mean little, the place across the axis.
Cells region_cells(const Anatomy& anatomy, const Discretisation& d, const WallPoints& candidates) {
  const VentricularCoordinates& coordinates = *anatomy.coordinates;
  std::vector<double> centre(d.layout.num_nodes(), 0.0);
  for (const FrameRing& ring : d.layout.rings)
    for (int j = 0; j < ring.nodes; ++j) centre[ring.first_frame + j] = ring.node_angle(j);
  Cells out{{}, Points(3, candidates.barycentric.cols())};
  Points low = Points::Constant(3, d.layout.num_nodes(), HUGE_VAL);
  Points high = -low;
  for (Eigen::Index q = 0; q < out.place.cols(); ++q) {
    const int tet = candidates.tet[q];
    const int region = d.region[tet];
    const CoordinateSample at = coordinates.sample(tet, candidates.barycentric.col(q));
    const double from_centre = std::remainder(at.psi - centre[region], 2 * polyaffine::kPi);
    const Vec3 X = coordinates.position(tet, candidates.barycentric.col(q)) - coordinates.base_centre();
    out.cell.push_back(region);
    if (region > d.layout.cap()) {
      const auto right = coordinates.right()->sample(tet, candidates.barycentric.col(q));
      out.place.col(q) = Vec3(at.u, right.psi, right.t);
    } else
      out.place.col(q) = region == d.layout.cap()
                             ? Vec3(X.dot(coordinates.anterior()),
                                    X.dot(coordinates.axis().cross(coordinates.anterior())), at.t)
                             : Vec3(at.u, from_centre, at.t);
    low.col(region) = low.col(region).cwiseMin(out.place.col(q));
    high.col(region) = high.col(region).cwiseMax(out.place.col(q));
  }
  for (Eigen::Index q = 0; q < out.place.cols(); ++q) {
    const int k = out.cell[q];
    out.place.col(q) = (out.place.col(q) - low.col(k)).cwiseQuotient(high.col(k) - low.col(k));
  }
  return out;
}

// Highest power of the frames' functions along, around and through the wall, whatever the axes of their
// coefficients; at least 1. That of the cap, of degree two at most, has cells of its own (wall_at_apex).
std::array<int, 3> degrees(const polyaffine::FrameBasis& basis, int cap) {
  std::array<int, 3> out{1, 1, 1};
  for (std::size_t i = 0; i < basis.frames().size(); ++i) {
    if (static_cast<int>(i) == cap) continue;
    for (const Monomial& m : basis.frames()[i].monomials)
      for (int k = 0; k < 3; ++k) out[k] = std::max(out[k], m[k]);
  }
  return out;
}

// Gauss points of cells: of the wall by what its functions can do, in its cells at the axis, where it bends
// most, as many each way; of surfaces, whose error no other point makes up for, one more where the wall can
// bend within a cell. More rings than AHA's lessen the error along the wall and with it what the points may
// add: one more through the depth, where cells stay as they are, and on surfaces. And the polynomials kept
// exact in a cell that is no box (on a surface: their total degree): squares of the functions times a linear
// weight, and two degrees more along the wall for sigmoid weights, which bend.
struct Counts {
  polyaffine::CellCounts wall, wall_at_apex, surface, surface_at_apex;
  polyaffine::CellDegree exact;
};
Counts counts_for(const std::array<int, 3>& degree, bool more_rings, bool sigmoid) {
  const int depth = std::max(more_rings ? 4 : 3, degree[2] + 1);
  const bool bent = degree[0] > 1 || degree[1] > 1;
  const int along = 2 * std::max(degree[0], degree[1]) + (sigmoid ? 4 : 2);
  const int surface = bent || more_rings ? 3 : 2, surface_at_apex = bent ? depth + 1 : depth;
  return {{degree[0] + 1, degree[1] + 1, depth},
          {depth, depth, depth},
          {surface, surface, 1},
          {surface_at_apex, surface_at_apex, 1},
          {along, along, std::max(kDepthDegree, 2 * degree[2] + 2)}};
}

}  // namespace

std::vector<int> segment_kinds(const Protocol& protocol) {
  using Factors = std::array<double, 3>;
  std::vector<Factors> found{{1, 1, 0}};
  std::vector<int> out(kBothSegments, 0);
  for (const auto& region : protocol.regions) {
    Factors factors{region.stiffness_factor, 1, 0};
    if (protocol.contraction)
      factors = {region.stiffness_factor, region.tension_factor, region.activation_delay_ms};
    const auto place = std::find(found.begin(), found.end(), factors) - found.begin();
    if (place == std::ssize(found)) found.push_back(factors);
    for (const int s : region.segments) out[s - 1] = static_cast<int>(place);
  }
  return out;
}

namespace {

std::vector<int> every_segment() {
  std::vector<int> out(kBothSegments);
  std::iota(out.begin(), out.end(), 0);
  return out;
}

// Points from which training chooses are there for every segment: they have to serve any scar.
std::vector<int> kinds_of_points(const Protocol& protocol) {
  const bool trained = protocol.reduction.integration == protocol::Integration::trained;
  return trained ? every_segment() : segment_kinds(protocol);
}

WallPoints subset(const WallPoints& points, const std::vector<int>& which) {
  WallPoints out{{}, points.barycentric(Eigen::all, which), points.weights(which), {}};
  for (const int p : which) out.tet.push_back(points.tet[p]);
  return out;
}

// The surfaces that have points.
std::vector<SurfacePoints*> surfaces_of(Discretisation& d) {
  std::vector<SurfacePoints*> out;
  for (CavitySurface& cavity : d.cavities) out.push_back(&cavity.points);
  if (!d.epicardium_points.tet.empty()) out.push_back(&d.epicardium_points);
  return out;
}

}  // namespace

void add_reduced_points(const Anatomy& anatomy, const Protocol& protocol, Discretisation& out) {
  const VentricularCoordinates& heart = *anatomy.coordinates;
  const LagrangeBasis& geometry = heart.space();
  const bool all_points = protocol.reduction.integration == protocol::Integration::gauss;
  const Counts counts = counts_for(degrees(*out.frame_basis, out.layout.cap()),
                                   std::ssize(out.layout.rings) > kAhaRings, !out.frames);
  if (!out.frames) {  // sigmoid weights: regions are no boxes
    const WallPoints candidates = geometry.wall_points(kCandidateDegree);
    const Cells cells = region_cells(anatomy, out, candidates);
    out.points = all_points ? polyaffine::group_cells(candidates, cells.cell)
                            : polyaffine::compress_cells(candidates, cells.cell, cells.place, counts.exact);
    add_surface_points(
        anatomy, protocol, geometry,
        [rule = polyaffine::triangle_rule(kCandidateDegree)](int, const LagrangeBasis::FaceCorners&) {
          return rule;
        },
        out);
    for (SurfacePoints* points : surfaces_of(out)) {
      const Cells own = region_cells(
          anatomy, out, WallPoints{points->tet, points->barycentric, points->weights, points->starts});
      *points =
          polyaffine::compress_surface_cells(*points, own.cell, own.place.topRows<2>(), counts.exact[0]);
    }
    return;
  }

  const SegmentCells cells(out.frames, kinds_of_points(protocol));
  const CandidatePoints candidates = tent_candidates(heart, cells);
  const Cells wall = tent_cells(cells, candidates.wall);
  const auto wall_counts = [&](int cell) { return cells.at_apex(cell) ? counts.wall_at_apex : counts.wall; };
  out.points = all_points ? polyaffine::group_cells(candidates.wall, wall.cell)
                          : polyaffine::gauss_cells(candidates.wall, wall.cell, wall.place, cells,
                                                    wall_counts, counts.exact);
  add_surface_points(anatomy, protocol, geometry, candidates.face, out);
  const auto surface_counts = [&](int cell) {
    return cells.at_apex(cell) ? counts.surface_at_apex : counts.surface;
  };
  for (SurfacePoints* points : surfaces_of(out)) {
    const Cells own = tent_cells(cells, *points);
    *points = polyaffine::gauss_surface_cells(*points, own.cell, own.place.topRows<2>(), cells,
                                              surface_counts, counts.exact[0], geometry);
  }
}

polyaffine::WallPoints strain_points(const Anatomy& anatomy, const Discretisation& d) {
  if (!d.frames) return d.points;
  const SegmentCells cells(d.frames, every_segment());
  const WallPoints candidates = anatomy.coordinates->space().wall_points(kStrainDegree);
  std::vector<int> left, right;
  for (std::size_t q = 0; q < candidates.tet.size(); ++q)
    (anatomy.segment[candidates.tet[q]] > kAhaSegments ? right : left).push_back(static_cast<int>(q));
  const WallPoints left_wall = subset(candidates, left);
  const Cells of_left = tent_cells(cells, left_wall);
  const auto counts = [](int) { return polyaffine::CellCounts{kStrainAlong, kStrainAlong, kStrainDepth}; };
  WallPoints out =
      polyaffine::gauss_cells(left_wall, of_left.cell, of_left.place, cells, counts, kStrainCellDegree);
  if (right.empty()) return out;
  const WallPoints right_wall = subset(candidates, right);
  const Cells of_right = region_cells(anatomy, d, right_wall);
  append(polyaffine::compress_cells(right_wall, of_right.cell, of_right.place, kStrainCellDegree), out);
  return out;
}

}  // namespace cardiac
