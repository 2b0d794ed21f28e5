#include <cardiac/report/haemodynamics_text.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include <cardiac/report/text.hpp>

namespace cardiac {
namespace {

std::string words_of(std::string name) {
  std::ranges::replace(name, '_', ' ');
  return name;
}

}  // namespace

std::vector<std::string> haemodynamics_lines(const VentricleSummary& v) {
  if (!v.haemodynamics) return {};
  const Haemodynamics& h = *v.haemodynamics;
  const std::string artery = v.name == "rv" ? "pulmonary artery" : "aorta";
  std::vector<std::string> lines{
      "output " + display_text(h.cardiac_output_L_per_min, 1) + " L/min, " + artery + " " +
      display_text(h.arterial_systolic_mmHg, 0) + "/" + display_text(h.arterial_diastolic_mmHg, 0) +
      " mmHg, mean " + display_text(h.arterial_mean_mmHg, 0) + " mmHg, stroke work " +
      display_text(h.stroke_work_mJ, 0) + " mJ, dP/dt " + display_text(h.dp_dt_max_mmHg_per_s, 0) + " and " +
      display_text(h.dp_dt_min_mmHg_per_s, 0) + " mmHg/s"};
  if (h.pressure_volume_area_mJ > 0)
    lines.push_back("pressure-volume area " + display_text(h.pressure_volume_area_mJ, 0) +
                    " mJ, arterial elastance " + display_text(h.arterial_elastance_mmHg_per_mL, 2) +
                    " mmHg/mL");
  constexpr double kNarrow_mmHg = 5;  // no healthy valve has such a gradient
  for (const ValveVolumes& valve : h.valves)
    if (valve.mean_gradient_mmHg > kNarrow_mmHg)
      lines.push_back(words_of(valve.name) + ": gradient " + display_text(valve.mean_gradient_mmHg, 0) +
                      " mmHg in the mean, " + display_text(valve.peak_gradient_mmHg, 0) + " mmHg at most");
  // A part of the stroke, and what one decimal of a millilitre shows.
  const double negligible_mL = std::max(0.01 * std::abs(v.sv_mL), 0.05);
  for (const ValveVolumes& valve : h.valves) {
    if (valve.regurgitant_mL <= negligible_mL) continue;
    lines.push_back(words_of(valve.name) + ": " + display_text(valve.regurgitant_mL, 1) + " mL of " +
                    display_text(valve.forward_mL, 1) + " mL come back (" +
                    display_text(valve.regurgitant_percent, 0) + " %)");
  }
  for (const auto& [phase, change] : {std::pair{"contraction", v.isovolumetric_contraction_change_mL},
                                      std::pair{"relaxation", v.isovolumetric_relaxation_change_mL}})
    if (std::abs(change) > negligible_mL)
      lines.push_back("flow past closed valves changes the volume by " + display_text(change, 1) +
                      " mL in isovolumetric " + phase);
  return lines;
}

std::vector<std::string> balance_lines(const BeatResult& result) {
  constexpr double kBalanced_percent = 1;
  std::vector<std::string> lines;
  for (const FlowBalance& b : result.balances)
    if (std::abs(b.error_percent) > kBalanced_percent)
      lines.push_back(words_of(b.name) + ": " + display_text(b.mean_inflow_mL_per_s, 1) + " mL/s flow in, " +
                      display_text(b.mean_outflow_mL_per_s, 1) + " mL/s out (" +
                      display_text(b.error_percent, 1) + " %): the beat does not repeat itself yet");
  return lines;
}

}  // namespace cardiac
