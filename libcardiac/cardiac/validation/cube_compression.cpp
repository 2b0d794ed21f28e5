#include "cardiac/validation/cube_compression.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include <polyaffine/core/error.hpp>
#include <polyaffine/core/single_thread.hpp>
#include <polyaffine/kinematics/gmls_basis.hpp>
#include <polyaffine/kinematics/resultant_table.hpp>
#include <polyaffine/linear/projection.hpp>
#include <polyaffine/linear/sparse_system.hpp>
#include <polyaffine/material/linear_elastic.hpp>
#include <polyaffine/material/springs.hpp>
#include <polyaffine/quadrature/consistent_weights.hpp>
#include <polyaffine/quadrature/elastons.hpp>
#include <polyaffine/solve/newton.hpp>
#include <polyaffine/system/field_term.hpp>

namespace cardiac {

using namespace polyaffine;

namespace {

using Laws = std::vector<std::shared_ptr<const Law>>;

// Value at the centre of the face and differences from one side to the other of the least-squares plane.
Vec3 fit_plane(const SurfacePoints& face, const Points& u) {
  Mat3 normal = Mat3::Zero();
  Vec3 rhs = Vec3::Zero();
  for (Eigen::Index q = 0; q < u.cols(); ++q) {
    const Vec3 p(1, face.X(0, q) / kCubeSize - 0.5, face.X(1, q) / kCubeSize - 0.5);
    const double area = face.weights[q] * Vec3(face.X_xi.col(q)).cross(Vec3(face.X_eta.col(q))).norm();
    normal += area * p * p.transpose();
    rhs += area * u(2, q) * p;
  }
  return normal.ldlt().solve(rhs);
}

CubeThickness thickness(const SurfacePoints& bottom, const Points& u_bottom, const SurfacePoints& top,
                        const Points& u_top) {
  const Vec3 plane = fit_plane(top, u_top) - fit_plane(bottom, u_bottom);
  return {plane[0], plane[1], plane[2]};
}

std::vector<FieldTable> load_tables(const Basis& basis, const SurfacePoints& bottom,
                                    const SurfacePoints& top) {
  return {resultant_table(displacement_table(basis, bottom)),
          resultant_table(displacement_table(basis, top))};
}

System compression(const FieldTable& wall, const std::vector<FieldTable>& loads) {
  System out = field_system(wall.num_unknowns());
  out.terms.push_back(
      solid(std::make_shared<FieldEnergy>(wall, Laws{std::make_shared<LinearElastic>(kCubeElasticity)})));
  for (const int side : {0, 1}) {
    const Vec3 traction(0, 0, side == 0 ? kCubePressure : -kCubePressure);
    out.terms.push_back(
        load(std::make_shared<FieldEnergy>(loads[side], Laws{std::make_shared<DeadTraction>(traction)})));
  }
  return out;
}

// Three corners and the directions held there: statically determinate, so that they carry no force.
struct Support {
  Vec3 corner;
  std::vector<int> directions;
};

std::array<Support, 3> supports() {
  return {{{Vec3::Zero(), {0, 1, 2}}, {kCubeSize * Vec3::UnitX(), {1, 2}}, {kCubeSize * Vec3::UnitY(), {2}}}};
}

Projection hold(const TetMesh& mesh, const Basis& basis) {
  LinearConstraints constraints{Matrix(6, 3 * basis.num_functions()), Vector::Zero(6)};
  Eigen::Index row = 0;
  for (const auto& [corner, directions] : supports()) {
    const MeshPoint at = locate(mesh, corner);
    const LinearConstraints all =
        displacement_constraints(basis, {at.tet}, at.barycentric, Points::Zero(3, 1));
    for (const int k : directions) constraints.C.row(row++) = all.C.row(k);
  }
  return project(constraints);
}

std::vector<char> hold_nodes(const LagrangeBasis& basis) {
  std::vector<char> fixed(3 * basis.num_functions(), 0);
  for (const auto& [corner, directions] : supports()) {
    Eigen::Index node = 0;
    (basis.nodes().colwise() - corner).colwise().squaredNorm().minCoeff(&node);
    for (const int k : directions) fixed[3 * node + k] = 1;
  }
  return fixed;
}

// Newton's method from rest on a new system; `seconds` becomes its processor time where that is less.
std::unique_ptr<LinearSystem> solve_from_rest(const System& system, Vector& c, double& seconds) {
  const double start = processor_seconds();
  c.setZero();
  std::unique_ptr<LinearSystem> linear = system.make_linear();
  const NewtonReport report = newton(system, 1, *linear, c);
  seconds = std::min(seconds, processor_seconds() - start);
  if (!report.converged()) throw ComputationError("cube: " + to_string(report.reason));
  return linear;
}

std::shared_ptr<const Basis> make_basis(const CubeScene& scene, const CubePlacement& placement,
                                        CubeKinematics kinematics) {
  if (kinematics == CubeKinematics::blending) return blending_basis(scene, placement);
  return std::make_shared<GmlsBasis>(scene.mesh, placement.weights, placement.nodes, placement.length());
}

}  // namespace

double CubeThickness::tilt() const {
  return (std::abs(slope_x) + std::abs(slope_y)) / 2;
}

CubeThickness operator-(const CubeThickness& a, const CubeThickness& b) {
  return {a.change - b.change, a.slope_x - b.slope_x, a.slope_y - b.slope_y};
}

double exact_thickness_change() {
  return -kCubePressure / kCubeElasticity.young * kCubeSize;
}

CubeSolution solve_cube_fem(const CubeScene& scene, int repeats) {
  const LagrangeBasis& basis = *scene.linear;
  const SurfacePoints bottom = scene.face(basis, kCubeBottom), top = scene.face(basis, kCubeTop);
  const FieldTable table = deformation_table(basis, basis.wall_points(1));
  System system = compression(table, load_tables(basis, bottom, top));
  system.fixed = hold_nodes(basis);
  system.linear = [&table](const System& of) { return sparse_system({&table}, of.fixed); };
  Vector c = Vector::Zero(table.num_unknowns());
  CubeSolution out{{}, std::numeric_limits<double>::infinity()};
  for (int k = 0; k < repeats; ++k) solve_from_rest(system, c, out.solve_s);
  out.thickness = thickness(bottom, DisplacementMap(basis, bottom.tet, bottom.barycentric).apply(c), top,
                            DisplacementMap(basis, top.tet, top.barycentric).apply(c));
  return out;
}

CubeReduction::CubeReduction(const CubeScene& scene, const CubePlacement& placement, const CubeMethod& method)
    : bottom_(scene.face(*scene.linear, kCubeBottom)), top_(scene.face(*scene.linear, kCubeTop)) {
  double start = processor_seconds();
  const auto basis = make_basis(scene, placement, method.kinematics);
  const QuadraturePoints points = elaston_points(scene.mesh, placement.integration, method.elaston_order);
  table_ = deformation_table(*basis, placement.wall_points(points));
  loads_ = load_tables(*basis, bottom_, top_);
  supports_ = std::make_shared<const Projection>(hold(scene.mesh, *basis));
  bottom_map_.emplace(*basis, bottom_.tet, bottom_.barycentric);
  top_map_.emplace(*basis, top_.tet, top_.barycentric);
  setup_s_ = processor_seconds() - start;

  start = processor_seconds();
  const WeightConditions constraint =
      integration_constraint(table_, boundary_integrals(*basis, scene.boundary(*scene.linear)));
  const WeightConditions moments = region_moments(scene.mesh, placement.zone, placement.num_zones(),
                                                  points.tet, positions(scene.mesh, points));
  ConsistentWeights found = consistent_weights(constraint, moments, points.weights);
  consistent_ = std::move(found.weights);
  is_consistent_ = found.met;
  keeps_moments_ = found.moments;
  correction_s_ = processor_seconds() - start;
  defect_ = constraint.A * points.weights - constraint.b;
  relative_defect_ = defect_.norm() / constraint.scale[0];
}

System CubeReduction::system(CubeWeights weights) const {
  FieldTable table = table_;
  if (weights == CubeWeights::consistent) table.weights = consistent_;
  System out = compression(table, loads_);
  out.projection = supports_;
  return out;
}

CubeThickness CubeReduction::measure(const Vector& c) const {
  return thickness(bottom_, bottom_map_->apply(c), top_, top_map_->apply(c));
}

CubeSolution CubeReduction::solve(CubeWeights weights, int repeats) const {
  const System of = system(weights);
  Vector c = Vector::Zero(table_.num_unknowns());
  CubeSolution out{{}, std::numeric_limits<double>::infinity()};
  for (int k = 0; k < repeats; ++k) solve_from_rest(of, c, out.solve_s);
  out.thickness = measure(c);
  return out;
}

CubeThickness CubeReduction::defect_response() const {
  const System of = system(CubeWeights::volumes);
  Vector c = Vector::Zero(table_.num_unknowns());
  double seconds = 0;
  const auto linear = solve_from_rest(of, c, seconds);
  const Mat3 stress = Vec3(0, 0, -kCubePressure).asDiagonal();
  const Vector spurious = (stress * defect_.reshaped(3, defect_.size() / 3)).reshaped();
  return measure(-linear->solve(spurious));
}

}  // namespace cardiac
