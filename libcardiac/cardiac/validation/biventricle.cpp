#include <cardiac/protocol/build_anatomy.hpp>
#include <cardiac/run/build_ventricle.hpp>
#include <cardiac/scene/loops.hpp>
#include <cardiac/validation/biventricle.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <tuple>

#include <cardiac/core/units.hpp>
#include <cardiac/run/errors.hpp>
#include <cardiac/run/simulate.hpp>
#include <polyaffine/core/error.hpp>
#include <polyaffine/solve/load_stepping.hpp>

namespace cardiac {
namespace {

using polyaffine::Vector;

constexpr double kEdge = 8, kQuickEdge = 9;  // mm; the right wall is 5 mm thick
constexpr auto kSameMesh = "quadratic elements on the same tets";

constexpr auto kHeart = R"(
[mesh]
shape = "human_biventricle"
[tissue]
law = "guccione"
C_kPa = 2.0
bf = 8.0
bt = 2.0
bfs = 20.0
[fibres]
endo_angle_deg = 70.0
epi_angle_deg = -70.0
[activation]
[contraction]
contractility_kPa = 155.0
cross_fibre_fraction = 0.3
)";

struct Load {
  std::string name;
  double left_mmHg, right_mmHg, tension_kPa;
};

struct Heart {
  const polyaffine::TetMesh& mesh;
  std::string tail;  // of the protocol: what loads the wall

  Protocol protocol(const std::vector<std::string>& settings) const {
    return parse_protocol(kHeart + tail, "biventricle", settings);
  }
  Ventricle build(const std::vector<std::string>& settings) const {
    const Protocol read = protocol(settings);
    return build_ventricle(std::make_shared<const Anatomy>(build_anatomy(mesh, read)), read,
                           read.reduction.method);
  }
};

Vector equilibrium(const Ventricle& ventricle, const Load& load, const std::string& method) {
  const auto points = ventricle.discretisation.points.weights.size();
  const WallLoad full{kPa_per_mmHg * Vector{{load.left_mmHg, load.right_mmHg}},
                      Vector::Constant(points, load.tension_kPa)};
  const polyaffine::System system = loaded_ventricle(ventricle, full);
  Vector c = Vector::Zero(ventricle.num_coefficients());
  const auto report = polyaffine::load_stepping(system, *system.make_linear(), c);
  if (!report.converged())
    throw polyaffine::ComputationError("biventricle, " + load.name + ", " + method + ": stopped at " +
                                       std::to_string(100 * report.reached) +
                                       " % of the load: " + polyaffine::to_string(report.last.reason));
  return c;
}

// Accepted errors in per cent, about 1.3 times what is reached: the reduced model is at its weakest here, and
// twice would hide a loss.
struct Bounds {
  double displacement, left_volume, right_volume;
};

struct Model {
  std::string name;
  std::vector<std::string> settings;
  Bounds filled, contracted;
};

const std::vector<Model>& models() {
  static const std::vector<Model> list{
      {"polyaffine fast", {"reduction.preset=fast"}, {15, 2, 8}, {16, 1, 3}},
      {"polyaffine accurate", {"reduction.preset=accurate"}, {10, 1, 6}, {12.5, 1, 3}},
      {"polyaffine fast, heart axes", {"reduction.axes=heart"}, {21, 3.6, 9}, {21, 1, 4}}};
  return list;
}

void against_full_order(const ValidationContext& context, const Heart& heart, std::vector<Check>& checks) {
  const std::vector<Load> loads{{"filled", 10, 5, 0}, {"contracted", 100, 25, 60}};
  const Ventricle full = heart.build({"reduction.method=fem"});
  for (const Load& load : loads) {
    context.progress("full order, " + load.name, 0.1);
    const Vector truth = equilibrium(full, load, "fem_p2");
    const Yardstick yardstick(full, truth);
    const double right = full.cavity_volume(truth, 1);
    for (const Model& model : models()) {
      context.progress(model.name + ", " + load.name, 0.4);
      const auto start = std::chrono::steady_clock::now();
      const Ventricle reduced = heart.build(model.settings);
      const Vector c = equilibrium(reduced, load, model.name);
      const ModelErrors errors = yardstick.errors(reduced, c);
      const double right_error = 100 * (reduced.cavity_volume(c, 1) / right - 1);
      const Bounds& bounds = load.tension_kPa > 0 ? model.contracted : model.filled;
      const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      const auto add = [&](const std::string& quantity, double value, double low, double high) {
        checks.push_back({"biventricle", model.name, load.name + "_" + quantity, "%", value, 0, low, high,
                          kSameMesh, seconds});
      };
      add("displacement_error_percent", errors.displacement_percent, 0, bounds.displacement);
      add("lv_volume_error_percent", errors.volume_percent, -bounds.left_volume, bounds.left_volume);
      add("rv_volume_error_percent", right_error, -bounds.right_volume, bounds.right_volume);
    }
  }
}

struct Stroke {
  double edv, esv;  // mL, largest and smallest volume
  double volume() const { return edv - esv; }
  double ef_percent() const { return 100 * volume() / edv; }
};

Stroke stroke(const HeartPath& path, int cavity) {
  const auto volume = [cavity](const HeartState& s) { return s.volumes_mm3[cavity]; };
  const auto [low, high] = std::ranges::minmax_element(path.steps, {}, volume);
  return {volume(*high) / mm3_per_mL, volume(*low) / mm3_per_mL};
}

HeartPath beats(const Heart& heart, const std::vector<std::string>& settings) {
  Protocol scene = heart.protocol(settings);
  scene.heart = std::make_shared<const Anatomy>(build_anatomy(heart.mesh, scene));
  HeartPath path = simulate(scene).path;
  if (!path.completed) throw polyaffine::ComputationError("biventricle, beat: " + path.stop_reason);
  return path;
}

void in_closed_loop(const ValidationContext& context, const Heart& heart, std::vector<Check>& checks) {
  const auto add = [&](const std::string& method, const std::string& quantity, const std::string& unit,
                       double value, double reference, double tolerance, const std::string& source) {
    checks.push_back({"biventricle", method, quantity, unit, value, reference, reference - tolerance,
                      reference + tolerance, source});
  };
  context.progress("beats in the closed loop", 0.6);
  const HeartPath path = beats(heart, {});
  const TwoSidedCirculation loop(two_sided_loop(*heart.protocol({}).circulation));
  const auto blood = [&loop](const HeartState& s) { return loop.blood_volume(s.circulation()); };
  const Stroke left = stroke(path, 0);
  const Stroke right = stroke(path, 1);
  add("polyaffine fast", "rv_over_lv_stroke", "1", right.volume() / left.volume(), 1, 0.004,
      "on the limit cycle both sides eject the same");
  add("polyaffine fast", "blood_change", "1", blood(path.steps.back()) / blood(path.steps.front()) - 1, 0,
      1e-8, "the loop is closed");
  if (context.quick) return;
  // One beat from the same filling: the limit cycle takes full order many minutes.
  context.progress("one beat in full order", 0.8);
  const HeartPath first = beats(heart, {"time.max_beats=1"});
  const HeartPath full = beats(heart, {"time.max_beats=1", "reduction.method=fem"});
  for (const auto& [name, cavity, tolerance] : {std::tuple{"lv", 0, 1.0}, {"rv", 1, 4.0}})
    add("polyaffine fast", std::string(name) + "_ef_percent_of_first_beat", "%",
        stroke(first, cavity).ef_percent(), stroke(full, cavity).ef_percent(), tolerance, kSameMesh);
}

}  // namespace

std::vector<Check> validate_biventricle(const ValidationContext& context) {
  std::vector<Check> checks;
  const polyaffine::TetMesh mesh =
      context.mesh_biventricle(human_biventricle(), context.quick ? kQuickEdge : kEdge);
  against_full_order(context, {mesh, "[cavities]\npressure_mmHg = 10\nright_pressure_mmHg = 5\n"}, checks);
  in_closed_loop(context,
                 {mesh, "[circulation]\n[time]\nlimit_cycle_tolerance_percent = 0.2\nmax_beats = 20\n"},
                 checks);
  return checks;
}

}  // namespace cardiac
