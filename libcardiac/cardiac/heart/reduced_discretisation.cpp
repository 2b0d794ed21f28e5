#include "cardiac/heart/discretisation.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include <cardiac/anatomy/biventricular_frames.hpp>
#include <cardiac/fibres/helix.hpp>
#include <polyaffine/geometry/geodesic_regions.hpp>
#include <polyaffine/kinematics/region_frames.hpp>
#include <polyaffine/quadrature/cell_rule.hpp>
#include <polyaffine/quadrature/split_rule.hpp>

namespace cardiac {

using polyaffine::FrameFunctions;
using polyaffine::LagrangeBasis;
using polyaffine::Monomial;
using polyaffine::Points;
using polyaffine::Vec3;
using polyaffine::Vec4;
using polyaffine::Vector;
using polyaffine::WallPoints;

namespace {

// Degree of the Gauss points of the mesh from which the points of a reduced model are chosen. Elements that
// the border of a cell crosses are cut in parts, up to so many times, with points of the second degree each:
// else the cells' volumes and, more so, the areas that a pressure pushes on are wrong by parts of elements.
constexpr int kCandidateDegree = 4, kPartDegree = 2, kWallCuts = 1, kSurfaceCuts = 2;
// Corners are asked for their cell this share of the way to the middle of the element: one that only touches
// a border is not crossed by it, and rounding does not decide.
constexpr double kDrawnIn = 1e-3;
// Polynomials kept exact in a cell, along u, ψ and the depth: fibres turn by 120° through the wall. The
// second one where functions are quadratic along the wall.
constexpr polyaffine::CellDegree kCellDegree{4, 4, 8}, kBentCellDegree{6, 6, 8};
// Total degree in u and ψ of the polynomials kept exact in a cell of a surface.
constexpr int kSurfaceDegree = 4;

std::vector<Monomial> monomials(const Protocol& protocol) {
  auto out = polyaffine::affine_monomials();
  for (const auto& name : *protocol.reduction.enrichment) {
    const Monomial m = polyaffine::parse_monomial(name);
    if (std::find(out.begin(), out.end(), m) == out.end()) out.push_back(m);
  }
  return out;
}

polyaffine::CellDegree cell_degree(const std::vector<Monomial>& functions) {
  const bool bent =
      std::any_of(functions.begin(), functions.end(), [](const Monomial& m) { return m[0] + m[1] > 1; });
  return bent ? kBentCellDegree : kCellDegree;
}

// Functions of every frame. Within a ring the tents interpolate linearly, so Σ_j C_j(ψ) (ψ − ψ_j) = 0: of the
// functions with a single factor c those of one frame depend on the others', and the last frame of each ring,
// that of the base frames included, goes without.
std::vector<std::vector<Monomial>> independent(const SegmentFrames& frames,
                                               const std::vector<Monomial>& all) {
  std::vector<std::vector<Monomial>> out(frames.num_frames(), all);
  const auto thin = [&](int last) { std::erase_if(out[last], [](const Monomial& m) { return m[1] == 1; }); };
  for (const FrameRing& ring : frames.layout().rings) thin(ring.first_frame + ring.nodes - 1);
  if (frames.base_frames()) thin(frames.layout().num_nodes() + frames.layout().rings.back().nodes - 1);
  return out;
}

// Cell of each candidate point and its place in the cell, each coordinate 0 to 1.
struct Cells {
  std::vector<int> cell;
  Points place;
};

// The tents are smooth in the cells between their kinks.
Cells tent_cells(const SegmentFrames& frames, const WallPoints& candidates) {
  Cells out{{}, Points(3, candidates.barycentric.cols())};
  for (Eigen::Index q = 0; q < out.place.cols(); ++q) {
    const auto c = frames.point_cell(candidates.tet[q], candidates.barycentric.col(q));
    out.cell.push_back(c.index);
    out.place.col(q) = c.place;
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
CandidatePoints tent_candidates(const VentricularCoordinates& heart, const SegmentFrames& frames) {
  const auto crossed = [&frames](int tet, const auto& corners) {
    const auto cell = [&](Eigen::Index k) {
      const Vec4 inside = (1 - kDrawnIn) * corners.col(k) + kDrawnIn * corners.rowwise().mean();
      return frames.point_cell(tet, inside).index;
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

// Few points a cell of the surface instead of those of every face.
polyaffine::SurfacePoints compressed(const Anatomy& anatomy, const Discretisation& discretisation,
                                     const polyaffine::SurfacePoints& points) {
  const WallPoints places{points.tet, points.barycentric, points.weights, points.starts};
  const Cells cells = discretisation.frames ? tent_cells(*discretisation.frames, places)
                                            : region_cells(anatomy, discretisation, places);
  return polyaffine::compress_surface_cells(points, cells.cell, cells.place.topRows<2>(), kSurfaceDegree);
}

// Tent weights, with boundary frames at the base that carry only functions with a factor l.
void add_tent_basis(const Anatomy& anatomy, const Protocol& protocol, Discretisation& out) {
  const auto frames = [&](bool base_frames) -> std::shared_ptr<const SegmentFrames> {
    if (anatomy.coordinates->right())
      return std::make_shared<BiventricularFrames>(anatomy.coordinates, out.layout, base_frames);
    return std::make_shared<SegmentFrames>(anatomy.coordinates, out.layout, base_frames);
  };
  out.frames = frames(true);
  out.pressure_frames = frames(false);
  const auto* both = dynamic_cast<const BiventricularFrames*>(out.frames.get());
  const bool heart_axes = protocol.reduction.axes == protocol::Axes::heart;
  std::vector<FrameFunctions> functions;
  const auto own = independent(*out.frames, monomials(protocol));
  for (int i = 0; i < out.frames->num_frames(); ++i) {
    FrameFunctions f{own[i], heart_axes && i != out.layout.cap() && !(both && both->is_right(i))};
    if (i >= out.layout.num_nodes()) std::erase_if(f.monomials, [](const Monomial& m) { return m[0] == 0; });
    functions.push_back(f);
  }
  out.frame_basis = std::make_shared<polyaffine::FrameBasis>(out.frames, functions);
}

// Zero on the base, one below the basal ring, with a continuous slope; at the nodes of the geometry.
Vector clamp_factor(const VentricularCoordinates& coordinates, double basal_ring) {
  const Vector s = ((1 - coordinates.apicobasal().array()) / (1 - basal_ring)).min(1.0);
  return s.array() * (2 - s.array());
}

void add_sigmoid_basis(const Anatomy& anatomy, const Protocol& protocol, Discretisation& out) {
  const polyaffine::TetMesh& mesh = anatomy.mesh;
  const int n = out.layout.num_nodes();
  const polyaffine::Matrix distances =
      polyaffine::normalised_border_distances(polyaffine::EikonalSolver(mesh), out.region, n);
  std::vector<polyaffine::ControlNode> nodes(n);
  for (int i = 0; i < n; ++i) {
    Eigen::Index deepest = 0;
    distances.row(i).minCoeff(&deepest);
    Eigen::Index corner = 0, tet = 0;
    (mesh.tets().array() == static_cast<int>(deepest)).maxCoeff(&corner, &tet);
    const CoordinateSample at = anatomy.coordinates->wall_sample(static_cast<int>(tet), Vec4::Unit(corner));
    nodes[i] = {mesh.points().col(deepest), orthonormal_axes(at)};
  }
  const auto weights = std::make_shared<polyaffine::RegionWeights>(
      mesh, distances, polyaffine::RegionWeightOptions{.sharpness = protocol.reduction.sigmoid_slope});
  const std::shared_ptr<const LagrangeBasis> geometry(anatomy.coordinates, &anatomy.coordinates->space());
  const auto frames = std::make_shared<polyaffine::RegionFrames>(
      geometry, weights, nodes, out.layout.length,
      clamp_factor(*anatomy.coordinates, out.layout.rings.back().u));
  out.pressure_frames = std::make_shared<polyaffine::RegionFrames>(frames->without_clamp());
  out.frame_basis = std::make_shared<polyaffine::FrameBasis>(
      frames, std::vector<FrameFunctions>(n, {monomials(protocol), false}));
}

}  // namespace

FrameLayout protocol_layout(const Anatomy& anatomy, const Protocol& protocol) {
  const auto& reduction = protocol.reduction;
  RingOptions options{reduction.ring_nodes, reduction.ring_positions.value_or(std::vector<double>{}),
                      reduction.ring_angles_deg.value_or(std::vector<double>{})};
  for (double& angle : options.angles) angle *= polyaffine::kPi / 180;
  return frame_layout(anatomy.mesh, *anatomy.coordinates, options);
}

Discretisation reduced_discretisation(const Anatomy& anatomy, const Protocol& protocol) {
  Discretisation out;
  out.layout = protocol_layout(anatomy, protocol);
  out.region = region_tets(anatomy.mesh, *anatomy.coordinates, out.layout);
  const bool sigmoid = protocol.reduction.weights == protocol::Weights::sigmoid;
  (sigmoid ? add_sigmoid_basis : add_tent_basis)(anatomy, protocol, out);
  out.basis = out.frame_basis;
  out.num_unknowns = 3 * out.basis->num_functions();
  out.fixed.assign(out.num_unknowns, 0);

  const LagrangeBasis& geometry = anatomy.coordinates->space();
  const CandidatePoints from =
      sigmoid ? CandidatePoints{geometry.wall_points(kCandidateDegree),
                                [rule = polyaffine::triangle_rule(kCandidateDegree)](
                                    int, const LagrangeBasis::FaceCorners&) { return rule; }}
              : tent_candidates(*anatomy.coordinates, *out.frames);
  const WallPoints& candidates = from.wall;
  const Cells cells = sigmoid ? region_cells(anatomy, out, candidates) : tent_cells(*out.frames, candidates);
  out.points =
      protocol.reduction.integration == protocol::Integration::gauss
          ? polyaffine::group_cells(candidates, cells.cell)
          : polyaffine::compress_cells(candidates, cells.cell, cells.place, cell_degree(monomials(protocol)));
  add_surface_points(anatomy, protocol, geometry, from.face, out);
  for (auto* points : {&out.cavity_points, &out.right_cavity_points, &out.epicardium_points})
    if (!points->tet.empty()) *points = compressed(anatomy, out, *points);
  return out;
}

polyaffine::PressureSpace pressure_space(const Discretisation& discretisation,
                                         const polyaffine::FieldTable& table, const Protocol& protocol) {
  const double kappa = protocol.tissue.bulk_modulus_kPa;
  if (!discretisation.frame_basis) return polyaffine::block_pressure(table, kappa);

  using Space = protocol::PressureSpace;
  const auto& points = discretisation.points;
  const Space space = *protocol.reduction.pressure_space;
  if (space == Space::segment) {
    std::vector<int> region;
    for (const int t : points.tet) region.push_back(discretisation.region[t]);
    return polyaffine::region_pressure(table, region, discretisation.layout.num_nodes(), kappa);
  }
  std::vector<Monomial> functions{{0, 0, 0}, {0, 0, 1}};
  if (space != Space::segment_depth) functions.insert(functions.end(), {{1, 0, 0}, {0, 1, 0}});
  if (space == Space::segment_bilinear) functions.insert(functions.end(), {{1, 0, 1}, {0, 1, 1}});
  const auto& frames = *discretisation.pressure_frames;
  const auto* tents = dynamic_cast<const SegmentFrames*>(&frames);
  const auto own = tents ? independent(*tents, functions) : std::vector(frames.num_frames(), functions);
  const polyaffine::Matrix values = polyaffine::frame_values(frames, own, points.tet, points.barycentric);
  return polyaffine::dense_pressure(table, values, kappa);
}

}  // namespace cardiac
