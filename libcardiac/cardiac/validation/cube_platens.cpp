#include "cardiac/validation/cube_platens.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <cardiac/report/csv_writer.hpp>
#include <polyaffine/core/error.hpp>
#include <polyaffine/core/single_thread.hpp>
#include <polyaffine/kinematics/region_frames.hpp>
#include <polyaffine/material/linear_elastic.hpp>
#include <polyaffine/material/neo_hookean.hpp>
#include <polyaffine/material/volumetric.hpp>
#include <polyaffine/quadrature/consistent_weights.hpp>
#include <polyaffine/solve/newton.hpp>
#include <polyaffine/system/field_term.hpp>
#include <polyaffine/system/sparse_field.hpp>

namespace cardiac {

using namespace polyaffine;

namespace {

using Laws = std::vector<std::shared_ptr<const Law>>;

constexpr double kApproach = 0.01;                                // mm: strains of 1e-5
constexpr double kForce = kCubePressure * kCubeSize * kCubeSize;  // mN

double bulk_modulus() {
  const Lame constants = lame(kCubeElasticity);
  return constants.lambda + 2 * constants.mu / 3;
}

QuadraturePoints centroids(const TetMesh& mesh) {
  return gauss_points(mesh, 1);
}

// Frames that vanish on the platens, and one that carries z/h.
class PlatenFrames : public FrameField {
 public:
  PlatenFrames(std::shared_ptr<const LagrangeBasis> geometry, RegionFrames inner)
      : geometry_(std::move(geometry)), inner_(std::move(inner)) {}
  int num_frames() const override { return inner_.num_frames() + 1; }
  FramesAtPoint sample(int tet, const Vec4& barycentric) const override {
    FramesAtPoint out = inner_.sample(tet, barycentric);
    const BasisSample at = geometry_->sample(tet, barycentric);
    FrameSample lift;
    lift.frame = inner_.num_frames();
    lift.weight = 1;
    lift.xi = geometry_->nodes()(Eigen::all, at.functions) * at.N / kCubeSize;
    lift.xi_gradient = Mat3::Identity() / kCubeSize;
    out.frames.push_back(lift);
    return out;
  }

 private:
  std::shared_ptr<const LagrangeBasis> geometry_;
  RegionFrames inner_;
};

PlatenSolution solve(const CubeScene& scene, std::shared_ptr<const Basis> basis,
                     const std::shared_ptr<const FieldEnergy>& energy, System system, double start_s) {
  PlatenSolution out;
  system.terms.push_back(solid(energy));
  const auto linear = system.make_linear();
  const double built = processor_seconds();
  out.setup_s = built - start_s;
  out.c = Vector::Zero(3 * basis->num_functions());
  const NewtonReport report = newton(system, 1, *linear, out.c);
  out.solve_s = processor_seconds() - built;
  out.newton_iterations = report.iterations;
  if (!report.converged()) throw ComputationError("cube between platens: " + to_string(report.reason));
  const QuadraturePoints at = centroids(scene.mesh);
  // Twice the energy is the force times the approach.
  const double force = 2 * energy->evaluate({out.c}).value / kApproach;
  out.thickness_change_mm = -kApproach * kForce / force;
  out.displacement = DisplacementMap(*basis, at.tet, at.barycentric).apply(out.c);
  out.integration_points = energy->table().num_points();
  out.basis = std::move(basis);
  return out;
}

PlatenSolution solve_full_order(const CubeScene& scene, std::shared_ptr<const LagrangeBasis> of, Laws laws,
                                bool mean_dilatation) {
  const double start = processor_seconds();
  const LagrangeBasis& basis = *of;
  const FieldTable table = deformation_table(basis, basis.wall_points(basis.order() == 1 ? 1 : 4));
  std::optional<PressureSpace> pressure;
  if (mean_dilatation) pressure = block_pressure(table, bulk_modulus());
  const auto energy = std::make_shared<const FieldEnergy>(table, std::move(laws), pressure);
  System system = field_system(table.num_unknowns());
  system.linear = sparse_field;
  system.fixed.assign(table.num_unknowns(), 0);
  system.prescribed = Vector::Zero(table.num_unknowns());
  for (const int node : basis.surface_nodes(scene.mesh, {kCubeBottom, kCubeTop})) {
    for (int k = 0; k < 3; ++k) system.fixed[3 * node + k] = 1;
    if (basis.nodes()(2, node) > kCubeSize / 2) system.prescribed[3 * node + 2] = -kApproach;
  }
  return solve(scene, std::move(of), energy, std::move(system), start);
}

}  // namespace

std::shared_ptr<const Basis> platen_basis(const CubeScene& scene, const CubePlacement& placement) {
  std::vector<ControlNode> nodes;
  for (int i = 0; i < placement.num_zones(); ++i) nodes.push_back({placement.nodes.col(i), Mat3::Identity()});
  const auto z = scene.quadratic->nodes().row(2).transpose().array() / kCubeSize;
  RegionFrames inner(scene.quadratic, placement.weights, std::move(nodes), placement.length(),
                     (4 * z * (1 - z)).matrix());
  std::vector<FrameFunctions> functions(placement.num_zones(), {affine_monomials()});
  functions.push_back({{{0, 0, 1}}});
  return std::make_shared<FrameBasis>(std::make_shared<PlatenFrames>(scene.quadratic, std::move(inner)),
                                      functions);
}

PlatenSolution solve_platens_linear(const CubeScene& scene) {
  return solve_full_order(scene, scene.linear, {std::make_shared<LinearElastic>(kCubeElasticity)}, false);
}

PlatenSolution solve_platens_quadratic(const CubeScene& scene) {
  return solve_full_order(scene, scene.quadratic,
                          {std::make_shared<IsochoricNeoHookean>(lame(kCubeElasticity).mu)}, true);
}

PlatenSolution solve_platens_reduced(const CubeScene& scene, const CubePlacement& placement) {
  const double start = processor_seconds();
  const QuadraturePoints& points = placement.integration.points;
  const auto basis = platen_basis(scene, placement);
  FieldTable table = deformation_table(*basis, placement.wall_points(points));
  const WeightConditions constraint =
      integration_constraint(table, boundary_integrals(*basis, scene.boundary(*scene.quadratic)));
  const WeightConditions moments = region_moments(scene.mesh, placement.zone, placement.num_zones(),
                                                  points.tet, positions(scene.mesh, points));
  ConsistentWeights found = consistent_weights(constraint, moments, points.weights);
  if (!found.met) throw ComputationError("cube between platens: no consistent weights for these points");
  table.weights = std::move(found.weights);
  const double mu = lame(kCubeElasticity).mu, local = 4 * mu;
  const PressureSpace pressure =
      region_pressure(table, placement.integration.control, placement.num_zones(), bulk_modulus() - local);
  const auto energy = std::make_shared<const FieldEnergy>(
      table, Laws{std::make_shared<IsochoricNeoHookean>(mu), std::make_shared<QuadraticVolumetric>(local)},
      pressure);
  System system = field_system(table.num_unknowns());
  system.fixed.assign(table.num_unknowns(), 0);
  std::fill(system.fixed.end() - 3, system.fixed.end(), 1);
  system.prescribed = Vector::Zero(table.num_unknowns());
  system.prescribed[table.num_unknowns() - 1] = -kApproach;
  return solve(scene, basis, energy, std::move(system), start);
}

double platen_error_percent(const CubeScene& scene, const PlatenSolution& truth, const Points& displacement) {
  const QuadraturePoints at = centroids(scene.mesh);
  const auto norm = [&](const Points& u) { return (u * at.weights.cwiseSqrt().asDiagonal()).norm(); };
  Points bulge = truth.displacement;
  bulge.row(2) += kApproach / kCubeSize * positions(scene.mesh, at).row(2);
  return 100 * norm(displacement - truth.displacement) / norm(bulge);
}

PlatenRow compare_platens(const CubeScene& scene, const PlatenSolution& truth, int zones, int points,
                          int placements) {
  std::mt19937_64 random(static_cast<unsigned>(zones));
  PlatenRow row{zones, points, 12 * zones, placements};
  for (int k = 0; k < placements; ++k) {
    const CubePlacement placement = place_cube(scene, zones, points, random);
    const PlatenSolution found = solve_platens_reduced(scene, placement);
    row.redraws += placement.redraws;
    row.thickness_error_percent +=
        100 * std::abs(found.thickness_change_mm / truth.thickness_change_mm - 1) / placements;
    row.displacement_error_percent += platen_error_percent(scene, truth, found.displacement) / placements;
  }
  return row;
}

std::string platens_csv(const std::vector<PlatenRow>& rows) {
  CsvWriter csv(
      "zones,points,unknowns,placements,redraws,thickness_error_percent,displacement_error_percent");
  for (const PlatenRow& r : rows) {
    csv << r.zones << r.points << r.unknowns << r.placements << r.redraws << r.thickness_error_percent
        << r.displacement_error_percent;
    csv.end_row();
  }
  return csv.text();
}

}  // namespace cardiac
