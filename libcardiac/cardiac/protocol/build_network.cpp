#include "cardiac/protocol/build_network.hpp"

#include <cmath>
#include <utility>

#include <cardiac/circulation/svzerod.hpp>
#include <cardiac/core/csv_reader.hpp>
#include <cardiac/protocol/key.hpp>
#include <cardiac/protocol/nearest_key.hpp>
#include <polyaffine/core/error.hpp>

namespace cardiac::protocol {
namespace {

Compartment compartment_of(const NetworkCompartment& c) {
  Compartment out;
  out.name = c.name;
  out.type = c.type;
  out.cavity = c.cavity;
  out.compliance_mm3_per_kPa = c.compliance_mm3_per_kPa;
  out.pressure_kPa = c.pressure_kPa;
  out.chamber.elastance = {c.active_kPa_per_mm3, c.passive_kPa_per_mm3, c.onset_ms,
                           c.contraction_ms,     c.relaxation_ms,       c.unstressed_mm3};
  out.initial_volume_mm3 = c.volume_mm3;
  return out;
}

Element element_of(const NetworkElement& e) {
  Element out;
  out.name = e.name;
  out.from = e.from;
  out.to = e.to;
  out.type = e.type;
  out.valve.resistance_kPa_ms_per_mm3 = e.resistance_kPa_ms_per_mm3;
  out.valve.stenosis_kPa_ms2_per_mm6 = e.stenosis_kPa_ms2_per_mm6;
  out.valve.smoothing_kPa = e.smoothing_kPa;
  out.valve.law = e.law;
  out.valve.sharpness_per_kPa = e.sharpness_per_kPa;
  if (e.leak_kPa_ms_per_mm3) out.valve.leak_kPa_ms_per_mm3 = *e.leak_kPa_ms_per_mm3;
  out.inertance_kPa_ms2_per_mm3 = e.inertance_kPa_ms2_per_mm3;
  out.initial_flow_mm3_per_ms = e.flow_mm3_per_ms;
  out.series_kPa_ms_per_mm3 = e.series_kPa_ms_per_mm3;
  out.between = e.between.value_or("");
  out.head_kPa = e.head_kPa;
  if (e.pump_flow_mm3_per_ms) out.curve = TimeSeries{{0}, {*e.pump_flow_mm3_per_ms}};
  return out;
}

// Units of pressure, volume and time.
SvZeroDFactors factors_of(SvZeroDUnits units) {
  switch (units) {
    case SvZeroDUnits::dyn_cm_s:
      return {1e-4, mm3_per_mL, ms_per_s};
    case SvZeroDUnits::Pa_m_s:
      return {1e-3, 1e9, ms_per_s};
    case SvZeroDUnits::mmHg_mL_s:
      break;
  }
  return {};
}

void read_model(Protocol& protocol, const Place& place) {
  Circulation& circulation = *protocol.circulation;
  const std::filesystem::path file = (protocol.directory / *circulation.svzerod_file).lexically_normal();
  const std::string key = "circulation.svzerod_file";
  if (!std::filesystem::is_regular_file(file))
    throw polyaffine::InputError(place(key) + ": " + key + ": no such file " + file.string() +
                                 "; expected a model of svZeroDSolver (.json), its path relative to the "
                                 "protocol file");
  SvZeroDHeart heart;
  heart.has_lv = true;
  heart.has_rv = protocol.anatomy.scheme == Scheme::aha29;
  heart.lv = circulation.lv_chamber;
  heart.rv = circulation.rv_chamber;
  CirculationNetwork network =
      read_svzerod(read_text(file), file.string(), factors_of(*circulation.svzerod_units), heart);
  const double beat = protocol.time.beat_ms;
  if (network.period_ms > 0 && std::abs(network.period_ms - beat) > 1e-4 * beat)
    throw polyaffine::InputError(
        file.string() + ": found a cardiac period of " + number_text(network.period_ms) +
        " ms, expected that of time.heart_rate_bpm, " + number_text(beat) +
        " ms; time.heart_rate_bpm = " + number_text(ms_per_min / network.period_ms) + " is that of the file");
  network.period_ms = beat;
  circulation.network = std::make_shared<const CirculationNetwork>(std::move(network));
}

}  // namespace

void build_network(Protocol& protocol, const Place& place) {
  if (protocol.circulation && protocol.circulation->loop == Loop::svzerod) return read_model(protocol, place);
  if (!protocol.circulation || protocol.circulation->loop != Loop::network) return;
  CirculationNetwork network;
  for (const NetworkCompartment& c : protocol.compartments) network.compartments.push_back(compartment_of(c));
  for (const NetworkElement& e : protocol.elements) network.elements.push_back(element_of(e));
  if (const auto fault = fault_of(network)) {
    const std::string table = fault->of_element ? "circulation.element" : "circulation.compartment";
    const std::string path =
        network.compartments.empty() ? "circulation.loop" : key_path(table, fault->index, fault->key);
    throw polyaffine::InputError(place(path) + ": " + path + ": " + fault->text);
  }
  protocol.circulation->network = std::make_shared<const CirculationNetwork>(std::move(network));
}

}  // namespace cardiac::protocol
