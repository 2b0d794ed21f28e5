#include <cardiac/validation/land_model.hpp>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <string>

#include <cardiac/anatomy/exact_midpoints.hpp>
#include <cardiac/fibres/ellipsoid_fibres.hpp>
#include <cardiac/tissue/active_stress.hpp>
#include <cardiac/tissue/guccione.hpp>
#include <polyaffine/core/error.hpp>
#include <polyaffine/core/single_thread.hpp>
#include <polyaffine/kinematics/element_locator.hpp>
#include <polyaffine/linear/sparse_system.hpp>
#include <polyaffine/material/follower_pressure.hpp>
#include <polyaffine/material/signed_volume.hpp>
#include <polyaffine/material/volumetric.hpp>
#include <polyaffine/solve/load_stepping.hpp>
#include <polyaffine/system/field_term.hpp>

namespace cardiac {
namespace {

using namespace polyaffine;
using Laws = std::vector<std::shared_ptr<const Law>>;

constexpr double kLocalBulk = 4;  // of C
constexpr double kPenalty = 1e6;  // of C, of the augmented Lagrangian

// A wall of quadratic tets under a pressure on one of its surfaces, with another one held.
struct Model {
  Model(const TetMesh& solid, const EdgeMidpoints& midpoints)
      : mesh(solid), basis(solid, 2, midpoints), points(basis.wall_points(3)) {}

  // Guccione's law with constants C and bf, bt, bfs; tension_kPa of all points, for a law that needs it.
  void set_wall(const GuccioneParameters& parameters, const FibreAxes& fibres, double tension_kPa) {
    FieldTable table = deformation_table(basis, points);
    Laws laws{std::make_shared<Guccione>(parameters, fibres),
              std::make_shared<QuadraticVolumetric>(kLocalBulk * parameters.C_kPa)};
    if (tension_kPa > 0) laws.push_back(std::make_shared<ActiveStress>(fibres));
    const PressureSpace pressures = block_pressure(table, kPenalty * parameters.C_kPa, true);
    wall = std::make_shared<FieldEnergy>(std::move(table), std::move(laws), pressures);
    system = field_system(wall->table().num_unknowns());
    const Vector none = Vector::Zero(points.weights.size());
    system.terms.push_back(
        solid(wall, tension_kPa > 0 ? ramp(none, none.array() + tension_kPa) : PointValues()));
  }

  void press(std::shared_ptr<const FieldEnergy> energy, double scale) {
    surface = std::move(energy);
    system.terms.push_back(load(surface, [scale](double t) { return t * scale; }));
  }

  void hold(int label) {
    system.fixed.assign(wall->table().num_unknowns(), 0);
    for (const int node : basis.surface_nodes(mesh, {label}))
      for (int k = 0; k < 3; ++k) system.fixed[3 * node + k] = 1;
  }

  LandSolution solve(const std::string& name) {
    const auto linear = sparse_system({&wall->table(), &surface->table()}, system.fixed, true);
    LoadOptions options;
    options.largest_step = 0.1;  // the factors of one step then serve most of the next
    options.newton.tolerance = 1e-6;
    options.newton.defect_tolerance = 1e-7;
    options.newton.contraction = 0.25;
    options.path_slack = 3e4;  // on the way there 3 % of the forces: only the last state counts
    c = Vector::Zero(wall->table().num_unknowns());
    const LoadReport report = load_stepping(system, *linear, c, options);
    if (!report.converged())
      throw ComputationError(name + ": stopped at " + std::to_string(100 * report.reached) +
                             " % of the load: " + to_string(report.last.reason));
    LandSolution out;
    out.tets = mesh.num_tets();
    out.unknowns = static_cast<int>(c.size() - std::count(system.fixed.begin(), system.fixed.end(), 1));
    out.load_steps = report.steps;
    out.newton_iterations = report.iterations;
    const double rest = wall_volume(Vector::Zero(c.size()));
    out.wall_volume_change = wall_volume(c) / rest - 1;
    return out;
  }

  // ∮ x · n da / 3 over the whole boundary; of degree four on quadratic triangles, so that the rule is exact.
  double wall_volume(const Vector& at) const {
    std::vector<int> labels = mesh.boundary_labels();
    std::ranges::sort(labels);
    labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
    const SurfacePoints boundary = basis.surface_points(mesh, labels, 4);
    return FieldEnergy(surface_table(basis, boundary, Vec3::Zero()),
                       Laws{std::make_shared<SignedVolume>(1.0 / 3)})
        .evaluate({at})
        .value;
  }

  Vec3 deformed(const Vec3& X) const {
    const MeshPoint at = ElementLocator(basis).locate(X);
    return X + DisplacementMap(basis, {at.tet}, at.barycentric).apply(c).col(0);
  }

  const TetMesh& mesh;
  LagrangeBasis basis;
  WallPoints points;
  std::shared_ptr<const FieldEnergy> wall, surface;
  System system;
  Vector c;
};

// Runs `solve` on one thread, for which the bounds on the processor time are meant, and sets the times of its
// solution.
template <class Solve>
LandSolution timed(const Solve& solve) {
  const SingleThread one;
  const auto wall = std::chrono::steady_clock::now();
  const std::clock_t cpu = std::clock();
  LandSolution out = solve();
  out.cpu_s = static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC;
  out.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count();
  return out;
}

}  // namespace

LandSolution solve_land_beam(const TetMesh& mesh) {
  return timed([&] {
    constexpr int kClamped = 1, kPressed = 5;
    Model model(mesh, {});
    const auto n = static_cast<Eigen::Index>(model.points.tet.size());
    model.set_wall({2, 8, 2, 4, false}, Mat3::Identity().reshaped().replicate(1, n), 0);
    const SurfacePoints pressed = model.basis.surface_points(mesh, {kPressed}, 4);
    // X_ξ × X_η points out of the beam, against the pressure
    model.press(std::make_shared<FieldEnergy>(surface_table(model.basis, pressed, Vec3::Zero()),
                                              Laws{std::make_shared<FollowerPressure>()}),
                0.004);
    model.hold(kClamped);
    LandSolution out = model.solve("land1");
    out.values = {model.deformed({10, 0.5, 1}).z()};
    return out;
  });
}

LandSolution solve_land_ellipsoid(const TetMesh& mesh, bool contracting) {
  return timed([&] {
    const TruncatedEllipsoid shape = land_ellipsoid();
    Model model(mesh, exact_midpoints(shape, mesh));
    const Points X = model.basis.positions(model.points.tet, model.points.barycentric);
    const FibreAxes fibres = ellipsoid_fibres(shape, {90, -90}, X);
    if (contracting)
      model.set_wall({2, 8, 2, 4, false}, fibres, 60);
    else
      model.set_wall({10, 1, 1, 1, false}, fibres, 0);
    SurfacePoints endocardium = model.basis.surface_points(mesh, {kEndocardium}, 4);
    endocardium.X_xi.swap(endocardium.X_eta);  // out of the cavity
    model.press(
        std::make_shared<FieldEnergy>(surface_table(model.basis, endocardium, {0, 0, shape.base_z_mm}),
                                      Laws{std::make_shared<SignedVolume>(1.0 / 3)}),
        contracting ? -15 : -10);
    model.hold(kBase);
    LandSolution out = model.solve(contracting ? "land3" : "land2");
    out.values = {model.deformed({0, 0, -shape.endo_long_mm}).z(),
                  model.deformed({0, 0, -shape.epi_long_mm}).z(), model.surface->evaluate({model.c}).value};
    return out;
  });
}

}  // namespace cardiac
