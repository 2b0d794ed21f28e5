#include "cardiac/circulation/svzerod_chambers.hpp"

#include <cmath>

namespace cardiac {
namespace {

constexpr double kClosed = 1000 * resistance_per_mmHg_s_per_mL;  // a closed valve

void set_activity(const JsonPlace& values, const std::string& type, double ms_per_unit, double period_ms,
                  Chamber& chamber) {
  Elastance& e = chamber.elastance;
  const auto ms = [&](const char* key) { return values.at(key).number() * ms_per_unit; };
  if (type == "half_cosine") {
    e.onset_ms = ms("t_active");
    e.contraction_ms = e.relaxation_ms = ms("t_twitch") / 2;
  } else if (type == "piecewise_cosine") {
    e.onset_ms = ms("contract_start");
    e.contraction_ms = ms("contract_duration");
    e.relaxation_ms = ms("relax_duration");
    const double gap = ms("relax_start") - e.onset_ms - e.contraction_ms;
    if (std::abs(gap - period_ms * std::round(gap / period_ms)) > 1e-6 * period_ms)
      values.at("relax_start").fail(values.at("relax_start").written(), "the end of the contraction");
  } else if (type == "wrapping_cosine") {
    const double lasts = period_ms * values.at("Tsa").positive();
    e.onset_ms = period_ms - lasts + period_ms / values.at("tpwave").positive();
    e.contraction_ms = e.relaxation_ms = lasts / 2;
  } else if (type == "two_hill") {
    chamber.activity = Activity::two_hill;
    e.onset_ms = ms("t_shift");
    chamber.rise_ms = values.at("tau_1").positive() * ms_per_unit;
    chamber.fall_ms = values.at("tau_2").positive() * ms_per_unit;
    chamber.rise_exponent = values.at("m1").positive();
    chamber.fall_exponent = values.at("m2").positive();
    chamber.hill_scale = scale_of_hills(chamber, period_ms);
  } else {
    values.at("type").fail("\"" + type + "\"", "half_cosine, piecewise_cosine, two_hill or wrapping_cosine");
  }
}

}  // namespace

ChamberBlock chamber_of(const JsonPlace& block, const SvZeroDFactors& unit, double period_ms) {
  const std::string type = block.at("type").text();
  const JsonPlace values = block.at("values");
  const auto elastance = [&](const char* key) { return values.at(key).number() * unit.kPa / unit.mm3; };
  const auto volume = [&](const char* key) { return values.at(key).number() * unit.mm3; };
  ChamberBlock out{};
  Elastance& e = out.chamber.elastance;
  if (type == "ChamberElastanceInductor") {
    e.passive_kPa_per_mm3 = elastance("Emin");
    e.active_kPa_per_mm3 = elastance("Emax") - e.passive_kPa_per_mm3;
    e.unstressed_volume_mm3 = volume("Vrd");
    out.chamber.systolic_volume_change_mm3 = volume("Vrs") - volume("Vrd");
    out.inertance_kPa_ms2_per_mm3 =
        values.magnitude_or("Impedance", 0) * unit.kPa * unit.ms * unit.ms / unit.mm3;
  } else if (type == "LinearElastanceChamber" || type == "PiecewiseCosineChamber") {
    e.passive_kPa_per_mm3 = elastance("Epass");
    e.active_kPa_per_mm3 = elastance("Emax");
    e.unstressed_volume_mm3 = volume("Vrest");
  } else {
    block.at("type").fail("\"" + type + "\"",
                          "ChamberElastanceInductor, LinearElastanceChamber or PiecewiseCosineChamber");
  }
  const auto activation = block.find("activation_function");
  const std::string own = type == "ChamberElastanceInductor" ? "half_cosine" : "piecewise_cosine";
  set_activity(activation.value_or(values), activation ? activation->at("type").text() : own, unit.ms,
               period_ms, out.chamber);
  return out;
}

TimeSeries series_of(const JsonPlace& values, const char* key, double factor, double ms) {
  const std::vector<double> found = values.at(key).numbers();
  if (found.size() == 1) return {{0}, {found.front() * factor}};
  const std::vector<double> times = values.at("t").numbers();
  if (times.size() != found.size())
    values.at("t").fail(std::to_string(times.size()) + " times", std::to_string(found.size()));
  TimeSeries out;
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (i > 0 && !(times[i] > times[i - 1]))
      values.at("t").fail("times that do not ascend", "ascending ones");
    out.times_ms.push_back((times[i] - times.front()) * ms);
    out.values.push_back(found[i] * factor);
  }
  return out;
}

ClosedLoopHeart closed_loop_heart(const JsonPlace& parameters, const SvZeroDFactors& unit, double period_ms) {
  const auto number = [&](const std::string& key) { return parameters.at(key).magnitude(); };
  const double resistance = unit.kPa * unit.ms / unit.mm3, inertance = resistance * unit.ms,
               elastance = unit.kPa / unit.mm3;
  const auto atrium = [&](const std::string& side) {
    Chamber out;
    const double lasts = period_ms * number("Tsa");
    out.elastance = {.active_kPa_per_mm3 = number("Emax_" + side) * elastance,
                     .onset_ms = period_ms - lasts + period_ms / parameters.at("tpwave").positive(),
                     .contraction_ms = lasts / 2,
                     .relaxation_ms = lasts / 2,
                     .unstressed_volume_mm3 = number("Vaso_" + side) * unit.mm3};
    out.passive_kPa = number("Kxp_" + side) * unit.kPa;
    out.passive_per_mm3 = number("Kxv_" + side) / unit.mm3;
    return out;
  };
  const auto ventricle = [&](const std::string& scale, const std::string& unstressed) {
    Chamber out;
    out.activity = Activity::fourier;
    out.elastance = {.active_kPa_per_mm3 = number(scale) * elastance,
                     .unstressed_volume_mm3 = number(unstressed) * unit.mm3};
    return out;
  };
  const auto valve = [&](const char* name, const std::string& R, const std::string& L) {
    Element out;
    out.name = name;
    out.type = ElementType::valve;
    out.valve.resistance_kPa_ms_per_mm3 = number(R) * resistance;
    out.valve.leak_kPa_ms_per_mm3 = kClosed;
    out.inertance_kPa_ms2_per_mm3 = number(L) * inertance;
    return out;
  };
  return {{atrium("ra"), ventricle("Erv_s", "Vrv_u"), atrium("la"), ventricle("Elv_s", "Vlv_u")},
          {valve("tricuspid_valve", "Rra_v", "Lra_v"), valve("pulmonary_valve", "Rrv_a", "Lrv_a"),
           valve("mitral_valve", "Rla_v", "Lla_v"), valve("aortic_valve", "Rlv_ao", "Llv_a")},
          number("Cp") * unit.mm3 / unit.kPa,
          number("Rpd") * resistance,
          number("Cpa") * unit.mm3 / unit.kPa};
}

}  // namespace cardiac
