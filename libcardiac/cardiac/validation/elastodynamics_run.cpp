#include "cardiac/validation/elastodynamics_run.hpp"

#include <chrono>

#include <cardiac/anatomy/heart_mesh.hpp>
#include <cardiac/core/units.hpp>
#include <cardiac/fibres/ellipsoid_fibres.hpp>
#include <cardiac/fibres/file_fibres.hpp>
#include <cardiac/fibres/helix.hpp>
#include <cardiac/model/ventricle.hpp>
#include <cardiac/run/statics.hpp>
#include <cardiac/scene/presets.hpp>
#include <cardiac/tissue/active_stress.hpp>
#include <cardiac/tissue/holzapfel_ogden.hpp>
#include <polyaffine/core/error.hpp>
#include <polyaffine/fields/laplace.hpp>
#include <polyaffine/kinematics/element_locator.hpp>
#include <polyaffine/linear/sparse_system.hpp>
#include <polyaffine/material/follower_pressure.hpp>
#include <polyaffine/material/viscosity.hpp>
#include <polyaffine/material/volumetric.hpp>
#include <polyaffine/mesh_io/read.hpp>
#include <polyaffine/solve/dae.hpp>

namespace cardiac {

using polyaffine::Mat3;
using polyaffine::Points;
using polyaffine::Vec3;
using polyaffine::Vector;

namespace {

constexpr double kMm_per_m = 1000;

// The ellipsoids of the left ventricle about z with the apex at −z; in the benchmark the long axis is x.
// Its base is the cone between the rings at these heights.
constexpr TruncatedEllipsoid kShape{25, 90, 35, 97, 26.47};
constexpr double kEpiBase_mm = 24.25;

// (x, y, z) of the benchmark to (y, z, x).
Mat3 to_z_axis() {
  return Mat3{{0, 1, 0}, {0, 0, 1}, {1, 0, 0}};
}

// The fibres of the left ventricle turn evenly with the depth of Laplace's equation, as in the benchmark. The
// sheets lie in the wall, their normal runs through it.
FibreFunction benchmark_fibres(const Anatomy& anatomy) {
  const polyaffine::LagrangeBasis& space = anatomy.coordinates->space();
  std::vector<polyaffine::NodeValue> values;
  for (const int n : space.surface_nodes(anatomy.mesh, {kEndocardium})) values.push_back({n, 0.0});
  for (const int n : space.surface_nodes(anatomy.mesh, {kEpicardium})) values.push_back({n, 1.0});
  return [depth = polyaffine::solve_laplace(space, values)](const VentricularCoordinates& coordinates,
                                                            const std::vector<int>& tet,
                                                            const Eigen::Matrix4Xd& barycentric) {
    const Mat3 turn = to_z_axis();
    FibreAxes out(9, barycentric.cols());
    for (Eigen::Index q = 0; q < out.cols(); ++q) {
      const int of = tet[static_cast<std::size_t>(q)];
      CoordinateSample at =
          ellipsoid_sample(kShape, turn * coordinates.space().position(of, barycentric.col(q)));
      at.t = coordinates.space().interpolate(depth, of, barycentric.col(q));
      const Mat3 axes = turn.transpose() * helix_axes(at, {60, -60});
      Mat3 turned;
      turned << axes.col(0), -axes.col(2), axes.col(1);
      out.col(q) = turned.reshaped();
    }
    return out;
  };
}

polyaffine::MeshData read(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file))
    throw polyaffine::InputError(file.string() +
                                 ": not found; expected the mesh of Aróstica et al. 2025 (--hearts DIR, the "
                                 "folder with data/arostica2025)");
  return polyaffine::read_mesh_data(file);
}

// The wall of full order as the benchmark has it: the volume is kept at every point, κ/4 (J² − 1 − 2 ln J).
// The mean of an element, as of this program's own full order, lets κ = 1000 kPa change more of it within.
std::shared_ptr<const polyaffine::FieldEnergy> benchmark_wall(const Anatomy& anatomy, const Scene& scene,
                                                              const Discretisation& d) {
  const FibreAxes fibres = fibres_at(anatomy, *scene.fibres, d.points.tet, d.points.barycentric);
  const scene::Tissue& tissue = scene.tissue;
  return std::make_shared<polyaffine::FieldEnergy>(
      polyaffine::deformation_table(*d.basis, d.points),
      std::vector<std::shared_ptr<const polyaffine::Law>>{
          std::make_shared<HolzapfelOgden>(HolzapfelOgdenParameters{}, fibres),
          std::make_shared<ActiveStress>(fibres),
          std::make_shared<polyaffine::LogarithmicVolumetric>(tissue.bulk_modulus_kPa),
          std::make_shared<polyaffine::KelvinVoigt>(tissue.viscosity_kPa_ms)});
}

// The switch of the fibres makes the tangent indefinite now and then: a shorter step, in which mass counts
// more, costs less than its factorisation.
std::unique_ptr<polyaffine::LinearSystem> definite_field(const polyaffine::System& system) {
  std::vector<const polyaffine::FieldTable*> tables;
  for (const auto& term : system.terms) term->add_tables(tables);
  return polyaffine::sparse_system(tables, system.fixed, true, system.held);
}

}  // namespace

std::shared_ptr<const Anatomy> elastodynamics_anatomy(const ElastodynamicsCase& problem,
                                                      const std::filesystem::path& folder) {
  HeartMeshOptions in_metres;
  in_metres.mm_per_unit = kMm_per_m;
  polyaffine::MeshData surface = read(folder / problem.surface);
  const HeartMesh heart = make_heart_mesh(read(folder / problem.mesh), &surface, in_metres);
  AnatomyOptions options;
  options.midpoints.emplace();  // straight elements, as those of the groups
  auto out = std::make_shared<Anatomy>(make_anatomy(heart.file.mesh, options));
  out->fibres = problem.two_ventricles
                    ? FileFibreFunction{std::make_shared<const FileFibres>(heart.file, problem.mesh)}
                    : benchmark_fibres(*out);
  return out;
}

std::shared_ptr<const Anatomy> structured_benchmark_ventricle(const StructuredCells& cells) {
  const polyaffine::TetMesh about_z = structured_ellipsoid(kShape, cells, kEpiBase_mm).mesh;
  const Mat3 back = to_z_axis().transpose();
  AnatomyOptions options;
  options.midpoints.emplace();
  polyaffine::TetMesh mesh(back * about_z.points(), about_z.tets(), {},
                           {about_z.boundary(), about_z.boundary_labels()});
  auto out = std::make_shared<Anatomy>(make_anatomy(std::move(mesh), options));
  out->fibres = benchmark_fibres(*out);
  return out;
}

Scene elastodynamics_scene(const ElastodynamicsCase& problem, const ElastodynamicsMethod& method) {
  Scene scene;
  scene.reduction.method = method.method;
  scene.reduction.preset = method.preset;
  scene.reduction.element_order = method.element_order;
  scene.tissue.law = scene::TissueLaw::holzapfel_ogden;
  scene.tissue.bulk_modulus_kPa = 1000;
  scene.tissue.viscosity_kPa_ms = 100;
  scene.tissue.density_mg_per_mm3 = 1;
  scene.fibres.emplace();
  scene.activation.emplace().onset_ms = 160;
  scene::Contraction& contraction = scene.contraction.emplace();
  contraction.contractility_kPa = 150;
  contraction.activation_duration_ms = 324;
  contraction.cross_fibre_fraction = 0;
  scene.cavities.emplace();
  scene::Boundary& boundary = scene.boundary;
  boundary.base = scene::Base::elastic;
  boundary.base_normal_stiffness_kPa_per_mm = boundary.base_inplane_stiffness_kPa_per_mm =
      problem.base_stiffness_kPa_per_mm;
  boundary.base_normal_damping_kPa_ms_per_mm = boundary.base_inplane_damping_kPa_ms_per_mm = 5;
  boundary.epicardial_stiffness_kPa_per_mm = 100;
  boundary.epicardial_damping_kPa_ms_per_mm = 5;
  scene.time.beat_ms = 1000;
  scene.time.duration_ms = method.end_ms;
  scene.time.relative_tolerance = method.relative_tolerance;
  scene.time.absolute_tolerance_mm = method.absolute_tolerance_mm;
  fill_presets(scene, true);
  return scene;
}

ElastodynamicsRun run_elastodynamics(const ElastodynamicsCase& problem,
                                     std::shared_ptr<const Anatomy> anatomy,
                                     const ElastodynamicsMethod& method,
                                     const std::function<void(double fraction)>& progress) {
  const auto start = std::chrono::steady_clock::now();
  Scene scene = elastodynamics_scene(problem, method);
  scene.heart = anatomy;
  Ventricle ventricle = assemble_ventricle(anatomy, scene, discretise(anatomy, scene, method.method));
  const bool full_order = method.method == scene::Method::fem;
  if (full_order) ventricle.wall = benchmark_wall(*anatomy, scene, ventricle.discretisation);
  polyaffine::System system = wall_system(ventricle, ventricle.tension(), scene.time.absolute_tolerance_mm);
  const Discretisation& d = ventricle.discretisation;
  for (std::size_t k = 0; k < problem.pressures.size(); ++k) {
    const auto curve = std::make_shared<const BenchmarkPressureCurve>(problem.pressures[k], method.end_ms);
    system.terms.push_back(polyaffine::load(
        std::make_shared<polyaffine::FieldEnergy>(
            polyaffine::surface_table(*d.basis, d.cavities[k].points, d.cavities[k].base_centre),
            std::vector<std::shared_ptr<const polyaffine::Law>>{
                std::make_shared<polyaffine::FollowerPressure>()}),
        [curve](double t) { return -curve->at(t); }));
  }
  add_states(ventricle, scene.time, system);
  if (full_order) system.linear = definite_field;

  ElastodynamicsRun out;
  out.tets = anatomy->mesh.num_tets();
  out.unknowns = d.num_unknowns;
  const polyaffine::ElementLocator locator(anatomy->coordinates->space());
  std::vector<int> tet;
  Eigen::Matrix4Xd barycentric(4, std::ssize(problem.points));
  for (const BenchmarkPoint& p : problem.points) {
    const auto at = locator.locate(p.position_mm);
    barycentric.col(std::ssize(tet)) = at.barycentric;
    tet.push_back(at.tet);
  }
  const polyaffine::DisplacementMap map(*d.basis, tet, barycentric);
  const auto samples = static_cast<Eigen::Index>(method.end_ms) + 1;
  out.times_ms = Vector::LinSpaced(samples, 0, method.end_ms);
  out.displacements.assign(problem.points.size(), Points::Zero(3, samples));
  out.volumes_mL = polyaffine::Matrix::Zero(std::ssize(ventricle.cavities), samples);
  Eigen::Index next = 0;
  const auto tell = [&](const Vector& y) {
    const Vector c = system.layout.field().of(y);
    const Points u = map.apply(c);
    for (Eigen::Index p = 0; p < u.cols(); ++p)
      out.displacements[static_cast<std::size_t>(p)].col(next) = u.col(p);
    out.volumes_mL.col(next) = ventricle.cavity_volumes(c) / mm3_per_mL;
    ++next;
  };

  const Vector rest = Vector::Zero(system.size());
  polyaffine::DaeIntegrator ida(system, dae_options(scene), 0, rest, rest);
  tell(rest);
  Vector at;
  while (ida.time() < method.end_ms * (1 - 1e-12)) {
    if (ida.step(method.end_ms) == polyaffine::DaeStatus::failed) {
      out.stop_reason = "stopped at " + std::to_string(ida.time()) + " ms: " + ida.failure();
      break;
    }
    while (next < samples && out.times_ms[next] <= ida.time() + 1e-9) {
      ida.interpolate(std::min(out.times_ms[next], ida.time()), at);
      tell(at);
    }
    if (progress) progress(ida.time() / method.end_ms);
  }
  out.times_ms.conservativeResize(next);
  for (Points& u : out.displacements) u.conservativeResize(3, next);
  out.volumes_mL.conservativeResize(Eigen::NoChange, next);
  const auto counters = ida.counters();
  out.steps = counters.steps;
  out.newton_iterations = counters.newton_iterations;
  out.factorisations = counters.factorisations;
  out.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return out;
}

}  // namespace cardiac
