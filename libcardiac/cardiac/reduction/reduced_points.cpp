#include "cardiac/reduction/reduced_points.hpp"

#include <algorithm>
#include <array>
#include <numeric>

#include <cardiac/anatomy/segments.hpp>
#include <cardiac/reduction/candidate_cells.hpp>
#include <cardiac/reduction/candidate_points.hpp>
#include <cardiac/reduction/point_counts.hpp>
#include <polyaffine/quadrature/cell_gauss.hpp>

namespace cardiac {

using polyaffine::LagrangeBasis;
using polyaffine::SurfacePoints;
using polyaffine::WallPoints;

namespace {

// Points of strain weigh means and need no cut elements; a low degree does.
constexpr int kStrainDegree = 2;
// Gauss points of a cell of strain points, along and around the wall and through its depth, in which fibres
// turn by about 120°; and the polynomials kept exact in a cell that is no box.
constexpr polyaffine::CellCounts kStrainCounts{2, 2, 4};
constexpr polyaffine::CellDegree kStrainCellDegree{4, 4, 8};
// The same of a cell of the right wall, which is thin and part of one segment.
constexpr polyaffine::CellDegree kRightCellDegree{2, 2, 4};

std::vector<int> every_segment() {
  std::vector<int> out(kBothSegments);
  std::iota(out.begin(), out.end(), 0);
  return out;
}

// Segments that have cells of their own. Where training chooses among the points, every segment has: they
// have to serve any scar.
std::vector<int> kinds_of_points(const Scene& scene) {
  const bool trained = scene.reduction.integration == scene::Integration::trained;
  return trained ? every_segment() : segment_kinds(scene);
}

WallPoints subset(const WallPoints& points, const std::vector<int>& which) {
  WallPoints out{{}, points.barycentric(Eigen::all, which), points.weights(which), {}};
  for (const int p : which) out.tet.push_back(points.tet[p]);
  return out;
}

// The surfaces of a discretisation that have points and run along the wall: the base runs across it.
std::vector<SurfacePoints*> surfaces(Discretisation& d) {
  std::vector<SurfacePoints*> out;
  for (CavitySurface& cavity : d.cavities) out.push_back(&cavity.points);
  if (!d.epicardium_points.tet.empty()) out.push_back(&d.epicardium_points);
  return out;
}

// Gauss points of the cells between the kinks of tents, in place of the candidates on the surfaces.
void set_surface_points_of_tents(const SegmentCells& cells, const PointCounts& counts,
                                 const LagrangeBasis& geometry, Discretisation& out) {
  const auto counts_of = [&](int cell) {
    return cells.at_apex(cell) ? counts.surface_at_apex : counts.surface;
  };
  for (SurfacePoints* points : surfaces(out)) {
    const CandidateCells own = cells_of_tents(cells, points->tet, points->barycentric);
    *points = polyaffine::gauss_surface_cells(*points, own.cell, own.place.topRows<2>(), cells, counts_of,
                                              counts.exact[0], geometry);
  }
}

// Few points of the faces of the base, between the kinks around the wall.
void set_base_points(const SegmentCells& cells, const PointCounts& counts, Discretisation& out) {
  if (out.base_points.tet.empty()) return;
  const CandidateCells own = cells_of_tents(cells, out.base_points.tet, out.base_points.barycentric);
  out.base_points = polyaffine::compress_surface_cells(out.base_points, own.cell, own.place.bottomRows<2>(),
                                                       counts.exact[0]);
}

WallPoints wall_points_of_tents(const SegmentCells& cells, const PointCounts& counts,
                                const WallPoints& candidates, bool all_points) {
  const CandidateCells own = cells_of_tents(cells, candidates.tet, candidates.barycentric);
  if (all_points) return polyaffine::group_cells(candidates, own.cell);
  const auto counts_of = [&](int cell) { return cells.at_apex(cell) ? counts.wall_at_apex : counts.wall; };
  return polyaffine::gauss_cells(candidates, own.cell, own.place, cells, counts_of, counts.exact);
}

// Few points of the elements of every region: regions between sigmoid weights are no boxes.
void set_surface_points_of_regions(const VentricularCoordinates& heart, const PointCounts& counts,
                                   Discretisation& out) {
  for (SurfacePoints* points : surfaces(out)) {
    const CandidateCells own = cells_of_regions(heart, out, points->tet, points->barycentric);
    *points = polyaffine::compress_surface_cells(*points, own.cell, own.place.topRows<2>(), counts.exact[0]);
  }
}

WallPoints wall_points_of_regions(const VentricularCoordinates& heart, const Discretisation& d,
                                  const polyaffine::CellDegree& exact, const WallPoints& candidates,
                                  bool all_points) {
  const CandidateCells own = cells_of_regions(heart, d, candidates.tet, candidates.barycentric);
  if (all_points) return polyaffine::group_cells(candidates, own.cell);
  return polyaffine::compress_cells(candidates, own.cell, own.place, exact);
}

}  // namespace

std::vector<int> segment_kinds(const Scene& scene) {
  using Factors = std::array<double, 3>;
  std::vector<Factors> found{{1, 1, 0}};
  std::vector<int> out(kBothSegments, 0);
  for (const auto& region : scene.regions) {
    Factors factors{region.stiffness_factor, 1, 0};
    if (scene.contraction)
      factors = {region.stiffness_factor, region.tension_factor, region.activation_delay_ms};
    const auto place = std::find(found.begin(), found.end(), factors) - found.begin();
    if (place == std::ssize(found)) found.push_back(factors);
    for (const int s : region.segments) out[s - 1] = static_cast<int>(place);
  }
  return out;
}

void add_reduced_points(const Anatomy& anatomy, const Scene& scene, Discretisation& out) {
  const VentricularCoordinates& heart = *anatomy.coordinates;
  const bool all_points = scene.reduction.integration == scene::Integration::gauss;
  const bool sigmoid = out.frames == nullptr;
  const PointCounts counts = point_counts(*out.frame_basis, out.layout, sigmoid);
  if (sigmoid) {
    const CandidatePoints candidates = plain_candidates(heart.space());
    out.points = wall_points_of_regions(heart, out, counts.exact, candidates.wall, all_points);
    add_surface_points(anatomy, scene, heart.space(), candidates.face, out);
    set_surface_points_of_regions(heart, counts, out);
  } else {
    const SegmentCells cells(out.frames, kinds_of_points(scene));
    const CandidatePoints candidates = split_candidates(heart, cells);
    out.points = wall_points_of_tents(cells, counts, candidates.wall, all_points);
    add_surface_points(anatomy, scene, heart.space(), candidates.face, out);
    set_surface_points_of_tents(cells, counts, heart.space(), out);
    set_base_points(cells, counts, out);
  }
}

WallPoints strain_points(const Anatomy& anatomy, const Discretisation& d) {
  if (d.element_pressures) return anatomy.coordinates->space().wall_points(1);
  if (!d.frames) return d.points;
  const VentricularCoordinates& heart = *anatomy.coordinates;
  const SegmentCells cells(d.frames, every_segment());
  const WallPoints candidates = heart.space().wall_points(kStrainDegree);
  std::vector<int> left, right;
  for (std::size_t q = 0; q < candidates.tet.size(); ++q)
    (anatomy.segment[candidates.tet[q]] > kAhaSegments ? right : left).push_back(static_cast<int>(q));
  const WallPoints left_wall = subset(candidates, left);
  const CandidateCells of_left = cells_of_tents(cells, left_wall.tet, left_wall.barycentric);
  WallPoints out = polyaffine::gauss_cells(
      left_wall, of_left.cell, of_left.place, cells, [](int) { return kStrainCounts; }, kStrainCellDegree);
  if (right.empty()) return out;
  const WallPoints right_wall = subset(candidates, right);
  CandidateCells of_right = cells_of_tents(cells, right_wall.tet, right_wall.barycentric);
  for (std::size_t q = 0; q < right.size(); ++q)
    of_right.cell[q] = of_right.cell[q] * kBothSegments + anatomy.segment[right_wall.tet[q]] - 1;
  append(polyaffine::compress_cells(right_wall, of_right.cell, of_right.place, kRightCellDegree), out);
  return out;
}

}  // namespace cardiac
