#include "cardiac/run/statics.hpp"

#include <algorithm>
#include <cmath>

namespace cardiac {

bool stop_wanted(const RunControl& control) {
  return control.stop_reason && !control.stop_reason().empty();
}

std::string why_it_stopped(const polyaffine::LoadReport& report, const RunControl& control) {
  if (report.reason == polyaffine::StopReason::interrupted) return control.stop_reason();
  if (report.reached == 0 && report.last.reason == polyaffine::StopReason::singular_tangent)
    return "the functions of the model are not independent (two control nodes in one place?), or a part of "
           "the wall is held by nothing";
  return "no equilibrium was found beyond it (" + polyaffine::to_string(report.last.reason) +
         "): a limit load, buckling, or a load too large for the tissue";
}

void warn_of_instability(const polyaffine::LoadReport& report, const std::string& load, HeartPath& path) {
  if (!report.unstable_from) return;
  path.warnings.push_back("from " + std::to_string(100 * *report.unstable_from) + " % of the " + load +
                          " on the equilibrium is no minimum of the energy: the wall may buckle, and there "
                          "may be other solutions");
}

polyaffine::DaeOptions dae_options(const Scene& scene) {
  polyaffine::DaeOptions out{.relative_tolerance = scene.time.relative_tolerance,
                             .max_step = scene.time.max_step_ms};
  if (scene.tissue.density_mg_per_mm3 > 0) out.max_order = kMaxOrderOfWaves;
  return out;
}

int most_steps(const scene::Time& time, double span_ms) {
  return std::max(2000, static_cast<int>(10 * std::ceil(span_ms / time.max_step_ms)));
}

std::string too_many_steps(int steps, double last_step_ms) {
  return std::to_string(steps) + " time steps in one beat; the last was " + std::to_string(last_step_ms) +
         " ms; a softer tissue, more viscosity or larger tolerances (time.*) let it go on";
}

}  // namespace cardiac
