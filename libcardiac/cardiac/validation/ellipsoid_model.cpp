#include "cardiac/validation/ellipsoid_model.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <cmath>

#include <cardiac/anatomy/exact_midpoints.hpp>
#include <cardiac/protocol/build_anatomy.hpp>
#include <cardiac/run/build_ventricle.hpp>
#include <cardiac/run/errors.hpp>
#include <polyaffine/kinematics/element_locator.hpp>
#include <polyaffine/linear/projection.hpp>
#include <polyaffine/material/signed_volume.hpp>
#include <polyaffine/material/springs.hpp>
#include <polyaffine/solve/load_stepping.hpp>
#include <polyaffine/system/support.hpp>

namespace cardiac {

using polyaffine::FieldEnergy;
using polyaffine::MeshPoint;
using polyaffine::Vector;

namespace {

constexpr double kForce_mN = 1e6;  // 1000 N

// μ = E / (2 (1 + ν)), κ = E / (3 (1 − 2ν)), of κ about three μ at every point.
constexpr auto kProtocol = R"(
[mesh]
shape = "land_ellipsoid"
[reduction]
local_bulk_modulus_kPa = 1e6
[tissue]
law = "neo_hookean"
mu_kPa = 335570.4697986577
bulk_modulus_kPa = 16666666.666666666
[cavities]
pressure_mmHg = 1
)";

std::vector<MeshPoint> places(const polyaffine::SurfacePoints& points) {
  std::vector<MeshPoint> out;
  for (std::size_t q = 0; q < points.tet.size(); ++q)
    out.push_back({points.tet[q], points.barycentric.col(static_cast<Eigen::Index>(q))});
  return out;
}

Vector areas(const polyaffine::SurfacePoints& points) {
  Vector out(points.X.cols());
  for (Eigen::Index q = 0; q < out.size(); ++q)
    out[q] = points.weights[q] * Vec3(points.X_xi.col(q)).cross(Vec3(points.X_eta.col(q))).norm();
  return out;
}

polyaffine::SurfacePoints base_points(const Anatomy& anatomy) {
  return anatomy.coordinates->space().surface_points(anatomy.mesh, {anatomy.labels.base}, 4);
}

// The base frames with the functions of the ring below them.
std::shared_ptr<const polyaffine::FrameBasis> free_base(const Discretisation& d) {
  const auto& basis = *d.frame_basis;
  const FrameRing& last = d.layout.rings.back();
  std::vector<polyaffine::FrameFunctions> functions = basis.frames();
  for (int j = 0; j < last.nodes; ++j) functions[d.layout.num_nodes() + j] = functions[last.first_frame + j];
  return std::make_shared<polyaffine::FrameBasis>(d.frames, functions);
}

std::shared_ptr<const polyaffine::Projection> fixed_base(const Anatomy& anatomy,
                                                         const polyaffine::Basis& basis) {
  const auto& space = anatomy.coordinates->space();
  const auto on_base = space.surface_nodes(anatomy.mesh, {anatomy.labels.base});
  const Eigen::Matrix4Xd nodes = space.node_barycentric();
  std::vector<int> tet;
  std::vector<polyaffine::Vec4> at;
  std::vector<char> seen(space.nodes().cols(), 0);
  for (Eigen::Index t = 0; t < space.elements().cols(); ++t)
    for (Eigen::Index k = 0; k < space.elements().rows(); ++k) {
      const int node = space.elements()(k, t);
      if (seen[node] || !std::binary_search(on_base.begin(), on_base.end(), node)) continue;
      seen[node] = 1;
      tet.push_back(static_cast<int>(t));
      at.push_back(nodes.col(k));
    }
  const auto n = static_cast<Eigen::Index>(at.size());
  const Eigen::Matrix4Xd barycentric = Eigen::Map<const Eigen::Matrix4Xd>(at.front().data(), 4, n);
  return std::make_shared<polyaffine::Projection>(polyaffine::project(
      polyaffine::displacement_constraints(basis, tet, barycentric, Points::Zero(3, n)), 1e-10));
}

}  // namespace

EllipsoidProblem::EllipsoidProblem(const polyaffine::TetMesh& mesh) {
  ExactGeometry exact;
  exact.midpoints = exact_midpoints(land_ellipsoid(), mesh);
  anatomy_ = std::make_shared<const Anatomy>(build_anatomy(mesh, protocol({}), exact));
  pressure_ = kForce_mN /
              areas(anatomy_->coordinates->space().surface_points(mesh, {anatomy_->labels.endo}, 4)).sum();
}

Protocol EllipsoidProblem::protocol(const std::vector<std::string>& settings) const {
  return parse_protocol(kProtocol, "truncated ellipsoid", settings);
}

EllipsoidProblem::Solution EllipsoidProblem::solve(
    Ventricle ventricle, const std::shared_ptr<const polyaffine::Projection>& projection,
    int repetitions) const {
  Solution out{std::move(ventricle), {}, 0, true};
  polyaffine::System system = loaded_ventricle(out.ventricle, {Vector{{pressure_}}});
  if (projection) {
    system.fixed.clear();
    system.projection = projection;
  }
  const auto linear = system.make_linear();
  std::vector<double> times;
  for (int k = 0; k < repetitions; ++k) {
    const auto start = std::chrono::steady_clock::now();
    out.c = Vector::Zero(out.ventricle.num_coefficients());
    out.converged = polyaffine::newton(system, 1, *linear, out.c).converged() && out.converged;
    times.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  std::sort(times.begin(), times.end());
  out.solve_s = times[times.size() / 2];
  return out;
}

EllipsoidProblem::Solution EllipsoidProblem::solve(const std::vector<std::string>& settings,
                                                   int repetitions) const {
  const Protocol p = protocol(settings);
  return solve(build_ventricle(anatomy_, p, p.reduction.method), nullptr, repetitions);
}

EllipsoidProblem::Solution EllipsoidProblem::solve_held(const std::vector<std::string>& settings,
                                                        double stiffness) const {
  const Protocol p = protocol(settings);
  Ventricle v = build_ventricle(anatomy_, p, p.reduction.method);
  auto& d = v.discretisation;
  d.frame_basis = free_base(d);
  d.basis = d.frame_basis;
  d.num_unknowns = 3 * d.basis->num_functions();
  d.fixed.assign(d.num_unknowns, 0);
  BuildCount built;
  v.wall = build_wall(*anatomy_, p, d, {}, built);
  v.cavities = {cavity_of(*d.basis, d.cavities.front())};
  if (stiffness <= 0) {
    const auto held = fixed_base(*anatomy_, *d.basis);
    return solve(std::move(v), held, 1);
  }
  polyaffine::SurfacePoints base = base_points(*anatomy_);
  base.weights = areas(base);
  v.supports.push_back(std::make_shared<polyaffine::Support>(
      polyaffine::displacement_table(*d.basis, base),
      polyaffine::SupportParameters{.stiffness_kPa_per_mm = stiffness}));
  return solve(std::move(v), nullptr, 1);
}

Points EllipsoidProblem::Solution::displacement(const std::vector<MeshPoint>& at) const {
  return wall_state(*ventricle.discretisation.basis, c, at).u;
}

std::vector<MeshPoint> EllipsoidProblem::locate(const Points& X) const {
  const polyaffine::ElementLocator locator(anatomy_->coordinates->space());
  std::vector<MeshPoint> out;
  for (Eigen::Index q = 0; q < X.cols(); ++q) out.push_back(locator.locate(X.col(q)));
  return out;
}

double EllipsoidProblem::base_slope(const Solution& solution) const {
  const auto points = base_points(*anatomy_);
  const auto F = wall_state(*solution.ventricle.discretisation.basis, solution.c, places(points)).F;
  const Vector area = areas(points);
  double sum = 0;
  for (Eigen::Index q = 0; q < F.cols(); ++q) sum += area[q] * (F.col(q).tail<3>() - Vec3::UnitZ()).norm();
  return sum / area.sum();
}

double EllipsoidProblem::base_motion(const Solution& solution) const {
  return solution.displacement(places(base_points(*anatomy_))).colwise().norm().maxCoeff();
}

Points outer_meridian(int n) {
  const TruncatedEllipsoid shape = land_ellipsoid();
  const double top = std::asin(shape.base_z_mm / shape.epi_long_mm);
  Points X = Points::Zero(3, n);
  for (int k = 0; k < n; ++k) {
    const double angle = -polyaffine::kPi / 2 + (top + polyaffine::kPi / 2) * k / (n - 1);
    X(0, k) = shape.epi_short_mm * std::cos(angle);
    X(2, k) = shape.epi_long_mm * std::sin(angle);
  }
  return X;
}

Vector normal_part(const Points& X, const Points& u) {
  const TruncatedEllipsoid shape = land_ellipsoid();
  const double a = shape.epi_short_mm * shape.epi_short_mm, c = shape.epi_long_mm * shape.epi_long_mm;
  Vector out(X.cols());
  for (Eigen::Index q = 0; q < X.cols(); ++q)
    out[q] = u.col(q).dot(Vec3(X(0, q) / a, X(1, q) / a, X(2, q) / c).normalized());
  return out;
}

}  // namespace cardiac
