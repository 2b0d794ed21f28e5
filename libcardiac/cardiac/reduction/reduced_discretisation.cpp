#include "cardiac/reduction/discretisation.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include <cardiac/fibres/helix.hpp>
#include <cardiac/reduction/axes_check.hpp>
#include <cardiac/reduction/biventricular_frames.hpp>
#include <cardiac/reduction/border_frames.hpp>
#include <cardiac/reduction/global_frame.hpp>
#include <cardiac/reduction/nested_space.hpp>
#include <cardiac/reduction/reduced_points.hpp>
#include <polyaffine/core/error.hpp>
#include <polyaffine/geometry/geodesic_regions.hpp>
#include <polyaffine/kinematics/region_frames.hpp>

namespace cardiac {

using polyaffine::FrameFunctions;
using polyaffine::LagrangeBasis;
using polyaffine::Monomial;
using polyaffine::Vec3;
using polyaffine::Vec4;
using polyaffine::Vector;

namespace {

std::vector<Monomial> monomials(const Scene& scene) {
  auto out = polyaffine::affine_monomials();
  for (const auto& name : *scene.reduction.enrichment) {
    const Monomial m = polyaffine::parse_monomial(name);
    if (std::find(out.begin(), out.end(), m) == out.end()) out.push_back(m);
  }
  return out;
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

int degree(const Monomial& m) {
  return m[0] + m[1] + m[2];
}

// The frame of the cap has Cartesian axes, in which longitudinal, circumferential and radial mean nothing:
// the functions of degree one at most and, where some have a higher one, all of degree two.
std::vector<Monomial> of_cap(const std::vector<Monomial>& functions) {
  std::vector<Monomial> out;
  for (const Monomial& m : functions)
    if (degree(m) <= 1) out.push_back(m);
  if (std::ranges::any_of(functions, [](const Monomial& m) { return degree(m) > 1; }))
    out.insert(out.end(), {{0, 0, 2}, {1, 0, 1}, {0, 1, 1}, {2, 0, 0}, {0, 2, 0}, {1, 1, 0}});
  return out;
}

// The functions of every frame and the axes of their coefficients: with heart_axes longitudinal,
// circumferential and radial, but Cartesian in the cap and in the right free wall. Those of the frames at a
// clamped base have a factor l, so that they vanish on the base and hold it; at a sliding one they are
// Cartesian, since one direction of their coefficients is held.
std::vector<FrameFunctions> tent_functions(const SegmentFrames& frames, const std::vector<Monomial>& all,
                                           bool heart_axes, scene::Base base) {
  const FrameLayout& layout = frames.layout();
  const auto* both = dynamic_cast<const BiventricularFrames*>(&frames);
  const auto is_right = [both](int frame) { return both != nullptr && both->is_right(frame); };
  const auto own = independent(frames, all);
  std::vector<FrameFunctions> out;
  for (int i = 0; i < frames.num_frames(); ++i) {
    const bool is_cap = i == layout.cap(), at_base = i >= layout.num_nodes();
    FrameFunctions functions{is_cap ? of_cap(own[i]) : own[i], heart_axes && !is_cap && !is_right(i)};
    if (at_base && base == scene::Base::sliding) functions.local_axes = false;
    if (at_base && base == scene::Base::clamped)
      std::erase_if(functions.monomials, [](const Monomial& m) { return m[0] == 0; });
    out.push_back(functions);
  }
  return out;
}

// Sliding: what does not vanish on the base does not move along its normal.
void hold_base(const Anatomy& anatomy, Discretisation& out) {
  const polyaffine::FrameBasis& basis = *out.frame_basis;
  const Vec3 normal = base_normal(anatomy);
  const int global = static_cast<int>(basis.frames().size()) - 1;
  const auto hold = [&](int frame) {
    for (const Monomial& m : basis.frames()[static_cast<std::size_t>(frame)].monomials)
      if (frame == global || m[0] == 0) out.held.push_back({basis.function(frame, m), normal});
  };
  for (int i = out.layout.num_nodes(); i < out.frames->num_frames(); ++i) hold(i);
  hold(global);
}

// Tent weights. Pressures do without the frames at the base, where nothing holds them; border functions are
// further frames with functions of the depth alone, in the same axes.
void add_tent_basis(const Anatomy& anatomy, const Scene& scene, Discretisation& out) {
  out.frames = tent_frames(anatomy.coordinates, out.layout, true);
  out.pressure_frames = tent_frames(anatomy.coordinates, out.layout, false);
  std::vector<std::string> told_with_the_result;
  const bool heart_axes = axes_of(anatomy, scene, told_with_the_result) == scene::Axes::heart;
  const scene::Base base = scene.boundary.base;
  auto functions = tent_functions(*out.frames, monomials(scene), heart_axes, base);
  std::shared_ptr<const polyaffine::FrameField> frames = out.frames;
  if (*scene.reduction.border_functions) {
    frames = std::make_shared<BorderFrames>(out.frames, segment_kinds(scene));
    functions.resize(frames->num_frames(), {{{0, 0, 0}, {0, 0, 1}, {0, 0, 2}}, heart_axes});
  }
  if (base != scene::Base::clamped) {
    frames = std::make_shared<GlobalFrame>(frames, anatomy.coordinates, out.layout.length);
    functions.push_back({{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, false});
    if (heart_axes) functions.back().monomials.push_back({0, 0, 0});
  }
  out.frame_basis = std::make_shared<polyaffine::FrameBasis>(frames, functions);
  if (base == scene::Base::sliding) hold_base(anatomy, out);
}

// Zero on the base, one below the basal ring, with a continuous slope; at the nodes of the geometry.
Vector clamp_factor(const VentricularCoordinates& coordinates, double basal_ring) {
  const Vector s = ((1 - coordinates.apicobasal().array()) / (1 - basal_ring)).min(1.0);
  return s.array() * (2 - s.array());
}

void add_sigmoid_basis(const Anatomy& anatomy, const Scene& scene, Discretisation& out) {
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
      mesh, distances, polyaffine::RegionWeightOptions{.sharpness = scene.reduction.sigmoid_slope});
  const std::shared_ptr<const LagrangeBasis> geometry(anatomy.coordinates, &anatomy.coordinates->space());
  const auto frames = std::make_shared<polyaffine::RegionFrames>(
      geometry, weights, nodes, out.layout.length,
      clamp_factor(*anatomy.coordinates, out.layout.rings.back().u));
  out.pressure_frames = std::make_shared<polyaffine::RegionFrames>(frames->without_clamp());
  out.frame_basis = std::make_shared<polyaffine::FrameBasis>(
      frames, std::vector<FrameFunctions>(n, {monomials(scene), false}));
}

}  // namespace

FrameLayout frame_layout_of(const Anatomy& anatomy, const Scene& scene) {
  const auto& reduction = scene.reduction;
  RingOptions options{reduction.ring_nodes, reduction.ring_positions.value_or(std::vector<double>{}),
                      reduction.ring_angles_deg.value_or(std::vector<double>{})};
  for (double& angle : options.angles) angle *= polyaffine::kPi / 180;
  return frame_layout(anatomy.mesh, *anatomy.coordinates, options);
}

Discretisation reduced_discretisation(const Anatomy& anatomy, const Scene& scene) {
  if (scene.reduction.preset == scene::Preset::tuned)
    throw polyaffine::InputError(
        "reduction.preset: found tuned, whose functions are learned in a run or by cardiac reduce, expected "
        "fast or "
        "accurate");
  Discretisation out;
  out.layout = frame_layout_of(anatomy, scene);
  out.region = region_tets(anatomy.mesh, *anatomy.coordinates, out.layout);
  const bool sigmoid = scene.reduction.weights == scene::Weights::sigmoid;
  (sigmoid ? add_sigmoid_basis : add_tent_basis)(anatomy, scene, out);
  out.basis = out.frame_basis;
  out.num_unknowns = 3 * out.basis->num_functions() - static_cast<int>(out.held.size());
  out.fixed.assign(out.num_unknowns, 0);

  add_reduced_points(anatomy, scene, out);
  return out;
}

polyaffine::PressureSpace pressure_space(const Discretisation& discretisation,
                                         const polyaffine::FieldTable& table, const Scene& scene) {
  const double kappa = scene.tissue.bulk_modulus_kPa;
  if (!discretisation.frame_basis) return polyaffine::block_pressure(table, kappa);
  if (discretisation.element_pressures) return element_pressure_space(discretisation, table, kappa);

  using Space = scene::PressureSpace;
  const auto& points = discretisation.points;
  const Space space = *scene.reduction.pressure_space;
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
