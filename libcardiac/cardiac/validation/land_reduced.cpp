#include <cardiac/protocol/build_anatomy.hpp>
#include <cardiac/run/build_ventricle.hpp>
#include <cardiac/validation/land_reduced.hpp>

#include <chrono>

#include <cardiac/anatomy/exact_midpoints.hpp>
#include <cardiac/core/units.hpp>
#include <cardiac/fibres/ellipsoid_fibres.hpp>
#include <cardiac/model/ventricle.hpp>
#include <polyaffine/core/error.hpp>
#include <polyaffine/core/single_thread.hpp>
#include <polyaffine/kinematics/element_locator.hpp>
#include <polyaffine/solve/load_stepping.hpp>

namespace cardiac {
namespace {

using polyaffine::Vec3;
using polyaffine::Vector;

constexpr auto kPassive = R"(
[mesh]
shape = "land_ellipsoid"
[tissue]
law = "guccione"
C_kPa = 10.0
bf = 1.0
bt = 1.0
bfs = 1.0
bulk_modulus_kPa = 1e4
viscosity_kPa_ms = 0.0
[fibres]
[cavities]
pressure_mmHg = 75.0
)";

// Pressure and tension are those of the load below; the protocol says that there are such.
constexpr auto kContracting = R"(
[mesh]
shape = "land_ellipsoid"
[tissue]
law = "guccione"
C_kPa = 2.0
bf = 8.0
bt = 2.0
bfs = 4.0
bulk_modulus_kPa = 2e3
viscosity_kPa_ms = 0.0
[fibres]
endo_angle_deg = 90.0
epi_angle_deg = -90.0
[activation]
mode = "uniform"
[contraction]
cross_fibre_fraction = 0.0
[cavities]
pressure_mmHg = 112.5
)";

}  // namespace

LandSolution solve_land_reduced(const polyaffine::TetMesh& mesh, bool contracting,
                                const std::vector<std::string>& settings) {
  const polyaffine::SingleThread one;
  const auto start = std::chrono::steady_clock::now();
  const double cpu = polyaffine::processor_seconds();
  const TruncatedEllipsoid shape = land_ellipsoid();
  const Protocol protocol = parse_protocol(contracting ? kContracting : kPassive, "land", settings);
  const auto fibres = [shape](const VentricularCoordinates& coordinates, const std::vector<int>& tet,
                              const Eigen::Matrix4Xd& barycentric) {
    return ellipsoid_fibres(shape, {90, -90}, coordinates.space().positions(tet, barycentric));
  };
  const auto anatomy = std::make_shared<const Anatomy>(
      build_anatomy(mesh, protocol, {.midpoints = exact_midpoints(shape, mesh), .fibres = fibres}));
  const Ventricle ventricle = build_ventricle(anatomy, protocol, protocol::Method::polyaffine);
  WallLoad load{Vector{{contracting ? 15.0 : 10.0}}};
  if (contracting) load.tension = Vector::Constant(ventricle.discretisation.points.weights.size(), 60.0);
  const polyaffine::System system = loaded_ventricle(ventricle, load);
  Vector c = Vector::Zero(ventricle.num_coefficients());
  const auto report = polyaffine::load_stepping(system, *system.make_linear(), c);
  if (!report.converged())
    throw polyaffine::ComputationError("land, reduced: stopped at " + std::to_string(100 * report.reached) +
                                       " % of the load: " + polyaffine::to_string(report.last.reason));
  const polyaffine::ElementLocator locator(anatomy->coordinates->space());
  const auto deformed_z = [&](const Vec3& X) {
    const polyaffine::MeshPoint at = locator.locate(X);
    const polyaffine::DisplacementMap map(*ventricle.discretisation.basis, {at.tet}, at.barycentric);
    return X.z() + map.apply(c)(2, 0);
  };
  LandSolution out;
  out.tets = mesh.num_tets();
  out.unknowns = ventricle.discretisation.num_unknowns;
  out.load_steps = report.steps;
  out.newton_iterations = report.iterations;
  out.values = {deformed_z({0, 0, -shape.endo_long_mm}), deformed_z({0, 0, -shape.epi_long_mm}),
                ventricle.cavity_volume(c)};
  out.cpu_s = polyaffine::processor_seconds() - cpu;
  out.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return out;
}

}  // namespace cardiac
