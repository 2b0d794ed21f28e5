#include <algorithm>
#include <cmath>
#include <sstream>

#include <cardiac/validation/extreme_checks.hpp>

namespace cardiac {
namespace {

// A formula of order k steps by h with h^(k+1) ~ tolerance, and its error is h^k ~ tolerance^(k/(k+1)).
constexpr double order_in_tolerance(double k) {
  return k / (k + 1);
}

ExtremeOutcome beat(const ExtremeChecks& checks, double tolerance) {
  const auto setting = [](const std::string& key, double value) {
    std::ostringstream out;
    out << "time." << key << '=' << value;
    return out.str();
  };
  std::ostringstream name;
  name << "tolerances/" << tolerance;
  return checks.run(
      name.str(), checks.wall(), kExtremeBeat,
      {setting("relative_tolerance", tolerance), setting("absolute_tolerance_mm", 10 * tolerance),
       setting("absolute_tolerance_mmHg", 100 * tolerance)});
}

// Largest difference of the volume at the output times, over the stroke volume.
double difference(const HeartPath& path, const HeartPath& reference) {
  double out = path.outputs.size() == reference.outputs.size() ? 0 : HUGE_VAL;
  for (std::size_t k = 0; k < std::min(path.outputs.size(), reference.outputs.size()); ++k)
    out = std::max(out, std::abs(path.outputs[k].volumes_mm3[0] - reference.outputs[k].volumes_mm3[0]));
  return out / reference.stroke_volumes_mm3.back();
}

}  // namespace

void extreme_tolerances(ExtremeChecks& checks) {
  const std::vector<double> tolerances = checks.quick()
                                             ? std::vector<double>{1e-3, 1e-6}
                                             : std::vector<double>{1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7};
  const ExtremeOutcome reference = beat(checks, tolerances.back() / 10);
  double first = 0, last = 0;
  ExtremeOutcome finest;
  for (const double tolerance : tolerances) {
    finest = beat(checks, tolerance);
    last = reference.completed() && finest.completed() ? difference(finest.path, reference.path) : HUGE_VAL;
    if (first == 0) first = last;
    checks.expect(finest, "volume_error_over_stroke", "1", last,
                  {0, 0, 30 * tolerance, "against a tenth of the smallest tolerance"});
  }
  checks.expect(finest, "order_in_the_tolerance", "1",
                std::log(first / last) / std::log(tolerances.front() / tolerances.back()),
                {order_in_tolerance(5), order_in_tolerance(2), 1.5,
                 "error per step controlled, BDF of orders 2 to 5: Hairer, Nørsett and Wanner 1993, II.4"});
}

}  // namespace cardiac
