#include <cardiac/validation/tuned.hpp>

#include <algorithm>
#include <chrono>
#include <memory>
#include <random>
#include <sstream>

#include <cardiac/anatomy/structured_ellipsoid.hpp>
#include <cardiac/protocol/build_anatomy.hpp>
#include <cardiac/report/csv_writer.hpp>
#include <cardiac/run/simulate.hpp>
#include <cardiac/run/tuned_model.hpp>
#include <cardiac/run/verification.hpp>
#include <polyaffine/core/atomic_file.hpp>
#include <polyaffine/core/error.hpp>

namespace cardiac {
namespace {

constexpr auto kHeart = R"(
[mesh]
shape = "human_lv"
[reduction]
preset = "tuned"
[tissue]
law = "guccione"
[fibres]
endo_angle_deg = 70.0
epi_angle_deg = -70.0
[activation]
[contraction]
[circulation]
)";

constexpr double kEdge = 4.5;  // mm; the wall is about a centimetre thick
constexpr StructuredCells kQuickCells{6, 12, 1};
constexpr double kMostOff = 5;  // times the accuracy
constexpr int kProtocols = 30, kQuickProtocols = 4, kSegments = 17;

std::vector<std::string> draw(unsigned seed) {
  std::mt19937_64 random(seed);
  const auto uniform = [&random](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  std::vector<std::string> out;
  const auto set = [&](const std::string& key, double low, double high) {
    std::ostringstream text;
    text << key << '=' << uniform(low, high);
    out.push_back(text.str());
  };
  set("time.heart_rate_bpm", 55, 100);
  set("circulation.filling_pressure_mmHg", 7, 13);
  set("circulation.peripheral_resistance_mmHg_s_per_mL", 0.75, 1.4);
  std::ostringstream regions;
  for (int s = 1; s <= kSegments; ++s)
    regions << (s == 1 ? "" : ", ") << "{segments=[" << s << "], tension_factor=" << uniform(0.6, 1.2)
            << ", stiffness_factor=" << uniform(0.7, 1.5) << "}";
  out.push_back("region=[" + regions.str() + "]");
  return out;
}

Protocol protocol_of(const std::shared_ptr<const Anatomy>& heart, std::vector<std::string> settings,
                     bool quick) {
  if (quick) settings.emplace_back("reduction.accuracy_percent=3");
  Protocol out = parse_protocol(kHeart, "tuned", settings);
  out.heart = heart;
  return out;
}

// The true errors and those that the model told, % of displacement.
struct Errors {
  double truth, told;
};

// Whether a run says that its model is off at an instant.
bool warned(const BeatResult& result, const std::string& instant) {
  return std::ranges::any_of(result.warnings, [&](const std::string& text) {
    return text.starts_with("at " + instant + " the tuned model is about");
  });
}

}  // namespace

std::vector<Check> validate_tuned(const ValidationContext& context) {
  const auto start = std::chrono::steady_clock::now();
  const polyaffine::TetMesh mesh = context.quick ? structured_ellipsoid(human_lv(), kQuickCells).mesh
                                                 : context.mesh_ellipsoid(human_lv(), kEdge);
  const auto heart =
      std::make_shared<const Anatomy>(build_anatomy(mesh, protocol_of(nullptr, {}, context.quick)));
  const Protocol learned = protocol_of(heart, {}, context.quick);
  RunControl control;
  control.progress = [&](const std::string& what, double fraction) {
    context.progress(what, 0.4 * fraction);
  };
  const auto model = tuned_model(heart, learned, control);

  const int count = context.quick ? kQuickProtocols : kProtocols;
  std::vector<Errors> all;
  int unwarned = 0;
  CsvWriter csv("protocol,instant,error_percent,told_percent");
  for (int k = 0; k < count; ++k) {
    context.progress("protocol " + std::to_string(k + 1), 0.4 + 0.6 * k / count);
    Protocol protocol = protocol_of(heart, draw(static_cast<unsigned>(k) + 1), context.quick);
    protocol.tuned = model;
    const Outcome outcome = simulate(protocol);
    if (!outcome.path.completed)
      throw polyaffine::ComputationError("tuned, protocol " + std::to_string(k + 1) + ": " +
                                         outcome.path.stop_reason);
    const auto truth = verify_path(outcome.model, protocol, outcome.path);
    const auto& told = outcome.result.estimated_errors;
    for (std::size_t i = 0; i < truth.size() && i < told.size(); ++i) {
      all.push_back({truth[i].displacement_error_percent, told[i].displacement_percent});
      csv << k + 1 << truth[i].instant << all.back().truth << all.back().told;
      csv.end_row();
      const double allowed = kMostOff * protocol.reduction.accuracy_percent;
      unwarned += all.back().truth > allowed && !warned(outcome.result, truth[i].instant);
    }
  }
  polyaffine::write_atomically(context.out / "tuned.csv", csv.text());

  std::vector<double> truths, shares;
  for (const Errors& e : all) {
    truths.push_back(e.truth);
    shares.push_back(e.told / e.truth);
  }
  std::ranges::sort(truths);
  std::ranges::sort(shares);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const std::string method = "tuned, " + std::to_string(model->rounds.back().unknowns) + " unknowns, " +
                             std::to_string(model->rounds.back().points) + " points";
  std::vector<Check> checks;
  const auto add = [&](const std::string& quantity, const std::string& unit, double value, double reference,
                       double low, double high, const std::string& source) {
    checks.push_back({"tuned", method, quantity, unit, value, reference, low, high, source, seconds});
  };
  // What is asked of a model of 1 %: half of all within 1.5, none beyond 5.
  const double asked = learned.reduction.accuracy_percent;
  const std::string full = "quadratic elements on the same tets, end diastole and end systole";
  add("median_error_percent", "%", truths[truths.size() / 2], 0, 0, 1.5 * asked, full);
  add("largest_error_percent", "%", truths.back(), 0, 0, kMostOff * asked, full);
  add("far_off_without_warning", "1", unwarned, 0, 0, 0, full);
  add("least_told_over_true", "1", shares.front(), 1, 0.5, 2, full);
  add("largest_told_over_true", "1", shares.back(), 1, 0.5, 2, full);
  return checks;
}

}  // namespace cardiac
