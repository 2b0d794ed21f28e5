#include <cardiac/bench/model.hpp>
#include <cardiac/protocol/build_anatomy.hpp>
#include <cardiac/run/build_ventricle.hpp>
#include <cardiac/run/tuning_plan.hpp>
#include <cardiac/scene/presets.hpp>

#include <Eigen/Geometry>
#include <algorithm>

#include <cardiac/fibres/ellipsoid_fibres.hpp>
#include <cardiac/protocol/names.hpp>
#include <polyaffine/core/single_thread.hpp>
#include <polyaffine/solve/load_stepping.hpp>

namespace cardiac {
namespace {

WallLoad wall_load(const SceneLoad& load, const Points& X) {
  WallLoad out{polyaffine::Vector{{load.pressure_kPa}}};
  if (!load.tension_kPa) return out;
  out.tension.resize(X.cols());
  for (Eigen::Index q = 0; q < X.cols(); ++q) out.tension[q] = load.tension_kPa(X.col(q));
  return out;
}

// Fibres of the ellipsoid, carried along where the wall is another: f and n × s turn with it.
FibreAxes wall_fibres(const BenchScene& scene, const HelixAngles& angles, Points X) {
  if (!scene.to_wall) return ellipsoid_fibres(scene.shape, angles, X);
  constexpr double kStep = 1e-5;  // mm
  for (Eigen::Index q = 0; q < X.cols(); ++q) X.col(q) = scene.to_ellipsoid(X.col(q));
  FibreAxes axes = ellipsoid_fibres(scene.shape, angles, X);
  for (Eigen::Index q = 0; q < X.cols(); ++q) {
    polyaffine::Mat3 gradient;
    for (int k = 0; k < 3; ++k) {
      const Vec3 step = kStep * Vec3::Unit(k), at = X.col(q);
      gradient.col(k) = (scene.to_wall(at + step) - scene.to_wall(at - step)) / (2 * kStep);
    }
    const Vec3 f = (gradient * axes.col(q).head<3>()).normalized(), s = gradient * axes.col(q).segment<3>(3);
    const Vec3 n = f.cross(s).normalized();
    axes.col(q) << f, n.cross(f), n;
  }
  return axes;
}

// The tuned model of a scene whose loads rise together. A tension that varies from place to place is learned
// by its value on the axis.
std::shared_ptr<const TunedModel> learned(const std::shared_ptr<const Anatomy>& anatomy,
                                          const Protocol& protocol, const SceneLoad& end) {
  TrainingLoad load;
  load.pressures_kPa = polyaffine::Vector{{end.pressure_kPa}};
  const Ventricle plain = build_ventricle(anatomy, protocol, protocol::Method::fem);
  if (plain.contraction) {
    const auto& curve = plain.contraction->curve;
    load.clock_ms = curve.contraction_end_ms() + plain.contraction->delay_ms[0];
    load.level = end.tension_kPa(Vec3::Zero()) / curve.peak_tension();
  }
  TuningControl control;
  control.accuracy_percent = protocol.reduction.accuracy_percent;
  control.budget_s = protocol.reduction.budget_s;
  return std::make_shared<const TunedModel>(tune(anatomy, protocol, tuning_plan(load, plain), control));
}

// Solves are repeated until they took this long together, at most so often.
constexpr double kLongEnough_s = 0.5;
constexpr int kRepeats = 5;

// The same for all methods; errors of the discretisations are above 10⁻³.
polyaffine::LoadOptions load_options() {
  polyaffine::LoadOptions options;
  options.first_step = 0.25;
  options.path_slack = 1000;
  options.newton.tolerance = 1e-6;
  options.newton.defect_tolerance = options.newton.tolerance;
  return options;
}

}  // namespace

BenchModel::BenchModel(const BenchScene& scene, const CurvedMesh& mesh,
                       const std::vector<std::string>& settings) {
  const double start = polyaffine::processor_seconds();
  Protocol protocol = parse_protocol(scene.protocol, "scene " + scene.name, settings);
  reduction_ = protocol.reduction;
  ExactGeometry exact;
  exact.midpoints = mesh.midpoints;
  if (protocol.fibres)
    exact.fibres = [scene,
                    angles = HelixAngles{protocol.fibres->endo_angle_deg, protocol.fibres->epi_angle_deg,
                                         protocol.fibres->sheet_angle_deg}](
                       const VentricularCoordinates& coordinates, const std::vector<int>& tet,
                       const Eigen::Matrix4Xd& barycentric) {
      return wall_fibres(scene, angles, coordinates.space().positions(tet, barycentric));
    };
  const auto anatomy = std::make_shared<const Anatomy>(build_anatomy(mesh.mesh, protocol, exact));
  if (is_tuned(protocol)) protocol.tuned = learned(anatomy, protocol, scene.path.front());
  ventricle_ = build_ventricle(anatomy, protocol, protocol.reduction.method);
  const auto& points = ventricle_.discretisation.points;
  const Points X = anatomy->coordinates->space().positions(points.tet, points.barycentric);
  for (const SceneLoad& load : scene.path) path_.push_back(wall_load(load, X));
  linear_ = loaded_ventricle(ventricle_, path_.front()).make_linear();
  setup_s_ = polyaffine::processor_seconds() - start;
}

std::string BenchModel::preset() const {
  return reduced() ? protocol::name_of(reduction_.preset) : "";
}

std::string BenchModel::integration() const {
  return reduced() ? protocol::name_of(reduction_.integration) : "";
}

int BenchModel::control_nodes() const {
  return reduced() ? ventricle_.discretisation.layout.num_nodes() : 0;
}

double BenchModel::cavity_at_rest() const {
  return ventricle_.cavity_volume(polyaffine::Vector::Zero(ventricle_.num_coefficients()));
}

BenchModel::Solution BenchModel::solve() const {
  return solve(ventricle_, path_, *linear_);
}

BenchModel::Solution BenchModel::solve(const Ventricle& ventricle, const std::vector<WallLoad>& path,
                                       polyaffine::LinearSystem& linear) {
  const double start = polyaffine::processor_seconds();
  Solution out;
  out.c = polyaffine::Vector::Zero(ventricle.num_coefficients());
  WallLoad from{polyaffine::Vector::Zero(path.front().pressures_kPa.size()),
                polyaffine::Vector::Zero(path.front().tension.size())};
  for (const WallLoad& to : path) {
    const auto report =
        polyaffine::load_stepping(loaded_ventricle(ventricle, from, to), linear, out.c, load_options());
    out.reached += report.reached;
    out.load_steps += report.steps;
    out.newton_iterations += report.iterations;
    out.converged = report.converged();
    if (!out.converged) break;
    from = to;
  }
  out.solve_s = polyaffine::processor_seconds() - start;
  return out;
}

BenchModel::Solution BenchModel::timed(const std::function<Solution()>& solve) {
  Solution out = solve();
  std::vector<double> times{out.solve_s};
  double total = out.solve_s;
  while (total < kLongEnough_s && times.size() < kRepeats) {
    times.push_back(solve().solve_s);
    total += times.back();
  }
  std::nth_element(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2), times.end());
  out.solve_s = times[times.size() / 2];
  return out;
}

}  // namespace cardiac
