#include "cardiac/heart/discretisation.hpp"

#include <algorithm>

#include <polyaffine/kinematics/lagrange.hpp>
#include <polyaffine/quadrature/cell_rule.hpp>

namespace cardiac {

using polyaffine::FrameFunctions;
using polyaffine::LagrangeBasis;
using polyaffine::Monomial;
using polyaffine::Vec3;

namespace {

// Degree of the Gauss points of the mesh from which the points of a reduced model are chosen.
constexpr int kCandidateDegree = 4;
// Polynomials kept exact in a cell, along u, ψ and the depth: fibres turn by 120° through the wall.
constexpr polyaffine::CellDegree kCellDegree{4, 4, 8};

std::vector<Monomial> monomials(const Protocol& protocol) {
  auto out = polyaffine::affine_monomials();
  for (const auto& name : *protocol.reduction.enrichment) {
    const Monomial m = polyaffine::parse_monomial(name);
    if (std::find(out.begin(), out.end(), m) == out.end()) out.push_back(m);
  }
  return out;
}

// Functions of every frame. Within a ring the tents interpolate linearly, so Σ_j C_j(ψ) (ψ − ψ_j) = 0: of the
// functions with a single factor c those of one frame depend on the others', and the last frame of each ring
// goes without.
std::vector<std::vector<Monomial>> independent(int num_frames, const std::vector<Monomial>& all) {
  std::vector<std::vector<Monomial>> out(num_frames, all);
  for (const int last : {5, 11, 15, 22})
    if (last < num_frames) std::erase_if(out[last], [](const Monomial& m) { return m[1] == 1; });
  return out;
}

// The same surface seen from the other side.
polyaffine::SurfacePoints turned(polyaffine::SurfacePoints points) {
  points.X_xi.swap(points.X_eta);
  return points;
}

// One block a segment instead of one a face: few functions are seen by many faces.
polyaffine::SurfacePoints by_segment(const polyaffine::SurfacePoints& points,
                                     const std::vector<int>& segment) {
  std::vector<int> order(points.tet.size());
  for (std::size_t q = 0; q < order.size(); ++q) order[q] = static_cast<int>(q);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return segment[points.tet[a]] < segment[points.tet[b]]; });
  polyaffine::SurfacePoints out;
  out.barycentric = points.barycentric(Eigen::all, order);
  out.weights = points.weights(order);
  out.X = points.X(Eigen::all, order);
  out.X_xi = points.X_xi(Eigen::all, order);
  out.X_eta = points.X_eta(Eigen::all, order);
  for (const int q : order) {
    const int t = points.tet[q];
    if (out.starts.empty() || segment[t] != segment[out.tet.back()])
      out.starts.push_back(static_cast<int>(out.tet.size()));
    out.tet.push_back(t);
  }
  out.starts.push_back(static_cast<int>(out.tet.size()));
  return out;
}

void add_surfaces(const Anatomy& anatomy, const Protocol& protocol, const LagrangeBasis& geometry, int degree,
                  Discretisation& out) {
  const auto points = [&](int label) { return geometry.surface_points(anatomy.mesh, {label}, degree); };
  if (protocol.circulation || protocol.cavities) out.cavity_points = turned(points(anatomy.labels.endo));
  if (protocol.boundary.epicardial_stiffness_kPa_per_mm > 0)
    out.epicardium_points = points(anatomy.labels.epi);
}

}  // namespace

Anatomy build_anatomy(polyaffine::TetMesh mesh, const Protocol& protocol) {
  Anatomy out;
  out.mesh = std::move(mesh);
  out.labels = {protocol.mesh.endo_label, protocol.mesh.epi_label, protocol.mesh.base_label};
  AnatomyOptions options;
  if (protocol.anatomy.long_axis) options.long_axis = Vec3(protocol.anatomy.long_axis->data());
  options.anterior = Vec3(protocol.anatomy.anterior_direction.data());
  out.coordinates = std::make_shared<VentricularCoordinates>(out.mesh, out.labels, options);
  out.segment = segment_tets(out.mesh, *out.coordinates);
  return out;
}

Discretisation reduced_discretisation(const Anatomy& anatomy, const Protocol& protocol) {
  Discretisation out;
  const auto layout = frame_layout(anatomy.mesh, *anatomy.coordinates,
                                   protocol.reduction.ring_positions.value_or(std::vector<double>{}));
  out.frames = std::make_shared<SegmentFrames>(anatomy.coordinates, layout, true);
  std::vector<FrameFunctions> functions;
  const auto own = independent(out.frames->num_frames(), monomials(protocol));
  for (int i = 0; i < out.frames->num_frames(); ++i) {
    FrameFunctions f{own[i], i != kAhaSegments - 1};
    if (i >= kAhaSegments) std::erase_if(f.monomials, [](const Monomial& m) { return m[0] == 0; });
    functions.push_back(f);
  }
  out.basis = std::make_shared<polyaffine::FrameBasis>(out.frames, functions);
  out.num_unknowns = 3 * out.basis->num_functions();
  out.fixed.assign(out.num_unknowns, 0);

  const LagrangeBasis& geometry = anatomy.coordinates->space();
  const polyaffine::WallPoints candidates = geometry.wall_points(kCandidateDegree);
  std::vector<int> cell;
  polyaffine::Points place(3, candidates.barycentric.cols());
  for (std::size_t q = 0; q < candidates.tet.size(); ++q) {
    const auto k = static_cast<Eigen::Index>(q);
    const CoordinateSample at = anatomy.coordinates->sample(candidates.tet[q], candidates.barycentric.col(k));
    const auto c = out.frames->cell(at.u, at.psi);
    cell.push_back(c.index);
    place.col(k) = Vec3(c.u, c.psi, at.t);
  }
  out.points = protocol.reduction.integration == protocol::Integration::gauss
                   ? polyaffine::group_cells(candidates, cell)
                   : polyaffine::compress_cells(candidates, cell, place, kCellDegree);
  add_surfaces(anatomy, protocol, geometry, 1, out);
  for (auto* points : {&out.cavity_points, &out.epicardium_points})
    if (!points->tet.empty()) *points = by_segment(*points, anatomy.segment);
  return out;
}

Discretisation full_discretisation(const Anatomy& anatomy, const Protocol& protocol) {
  Discretisation out;
  const int order = protocol.reduction.element_order;
  const auto basis = std::make_shared<LagrangeBasis>(
      anatomy.mesh, order,
      order == 2 ? polyaffine::smooth_midpoints(anatomy.mesh) : polyaffine::EdgeMidpoints());
  out.basis = basis;
  out.points = basis->wall_points(order == 1 ? 1 : 3);
  out.sparse = true;
  out.num_unknowns = 3 * basis->num_functions();
  out.fixed.assign(out.num_unknowns, 0);
  for (const int node : basis->surface_nodes(anatomy.mesh, {anatomy.labels.base}))
    for (int k = 0; k < 3; ++k) {
      out.fixed[3 * node + k] = 1;
      --out.num_unknowns;
    }
  add_surfaces(anatomy, protocol, *basis, order == 1 ? 1 : 4, out);
  return out;
}

polyaffine::PressureSpace pressure_space(const Anatomy& anatomy, const Discretisation& discretisation,
                                         const polyaffine::FieldTable& table, const Protocol& protocol) {
  const double kappa = protocol.tissue.bulk_modulus_kPa;
  if (!discretisation.frames) return polyaffine::block_pressure(table, kappa);

  using Space = protocol::PressureSpace;
  const auto& points = discretisation.points;
  const Space space = *protocol.reduction.pressure_space;
  if (space == Space::segment) {
    std::vector<int> region;
    for (std::size_t q = 0; q < points.tet.size(); ++q) region.push_back(anatomy.segment[points.tet[q]] - 1);
    return polyaffine::region_pressure(table, region, kAhaSegments, kappa);
  }
  std::vector<Monomial> functions{{0, 0, 0}, {0, 0, 1}};
  if (space != Space::segment_depth) functions.insert(functions.end(), {{1, 0, 0}, {0, 1, 0}});
  if (space == Space::segment_bilinear) functions.insert(functions.end(), {{1, 0, 1}, {0, 1, 1}});
  // Pressures need no boundary frames: the basal ones reach up to the base.
  const SegmentFrames weights(anatomy.coordinates, discretisation.frames->layout(), false);
  const polyaffine::Matrix values =
      polyaffine::frame_values(weights, independent(kAhaSegments, functions), points.tet, points.barycentric);
  return polyaffine::dense_pressure(table, values, kappa);
}

}  // namespace cardiac
