#include "cardiac/circulation/svzerod.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "cardiac/circulation/json_place.hpp"
#include "cardiac/circulation/network_graph.hpp"
#include "cardiac/circulation/svzerod_chambers.hpp"

namespace cardiac {
namespace {

using polyaffine::InputError;

constexpr double kSharp_kPa = 1e-6 * kPa_per_mmHg;  // smoothing of a valve that switches at once

// One model on its way from blocks to points, in the units of a scene.
class SvZeroDReader {
 public:
  SvZeroDReader(const JsonPlace& root, const SvZeroDFactors& factors, const SvZeroDHeart& heart)
      : root_(root), unit_(factors), heart_(heart) {}

  CirculationNetwork read() {
    period_ms_ = period();
    for (const JsonPlace& vessel : root_.list("vessels")) add_vessel(vessel);
    for (const JsonPlace& condition : root_.list("boundary_conditions")) add_condition(condition);
    for (const JsonPlace& chamber : root_.list("chambers")) add_chamber(chamber);
    for (const JsonPlace& junction : root_.list("junctions")) add_junction(junction);
    for (const JsonPlace& valve : root_.list("valves")) add_valve(valve);
    for (const JsonPlace& block : root_.list("closed_loop_blocks")) add_closed_loop(block);
    for (const auto& [vessel, condition, at_inlet] : conditions_of_vessels_) {
      if (!known_.contains(condition))
        throw InputError(root_.source() + ": vessels: \"" + vessel + "\": found the boundary condition \"" +
                         condition + "\", expected the name of one of boundary_conditions");
      if (at_inlet)
        graph_.join(outlet(condition), inlet(vessel));
      else
        graph_.join(outlet(vessel), inlet(condition));
    }
    check_heart();
    return graph_.network(root_.source(), period_ms_);
  }

 private:
  int inlet(const std::string& block) { return graph_.point(block + ":in"); }
  int outlet(const std::string& block) { return graph_.point(block + ":out"); }
  /// Of a block that the file describes.
  void expect(const std::string& block, const JsonPlace& where) const {
    if (!known_.contains(block)) where.fail("\"" + block + "\"", "the name of a block of this file");
  }

  double pressure(double value) const { return value * unit_.kPa; }
  double volume(double value) const { return value * unit_.mm3; }
  double time(double value) const { return value * unit_.ms; }
  double flow(double value) const { return value * unit_.mm3 / unit_.ms; }
  double resistance(double value) const { return value * unit_.kPa * unit_.ms / unit_.mm3; }
  double compliance(double value) const { return value * unit_.mm3 / unit_.kPa; }
  double inertance(double value) const { return value * unit_.kPa * unit_.ms * unit_.ms / unit_.mm3; }
  double stenosis(double value) const { return inertance(value) / unit_.mm3; }

  /// Initial value of a variable by its name or by how the name begins and ends.
  std::optional<double> initial(const std::string& begin, const std::string& end) const {
    const auto given = root_.find("initial_condition");
    if (!given) return {};
    for (const auto& [name, value] : given->entries())
      if (name.starts_with(begin) && name.ends_with(end) && name.size() >= begin.size() + end.size())
        return value.number();
    if (begin.starts_with("pressure") || begin.starts_with("P_c"))
      if (const auto all = given->find("pressure_all")) return all->number();
    if (begin.starts_with("flow"))
      if (const auto all = given->find("flow_all")) return all->number();
    return {};
  }
  double initial_pressure(const std::string& begin, const std::string& end) const {
    return pressure(initial(begin, end).value_or(0));
  }
  double initial_capacitor(const std::string& name) const {
    const auto own = initial("pressure_c:" + name, "");
    return own ? pressure(*own) : initial_pressure("P_c:", name);
  }
  double initial_flow(const std::string& begin, const std::string& end) const {
    return flow(initial(begin, end).value_or(0));
  }

  double period() const {
    std::vector<double> found;
    for (const JsonPlace& block : root_.list("closed_loop_blocks"))
      if (const auto value = block.find("cardiac_cycle_period")) found.push_back(time(value->positive()));
    if (const auto simulation = root_.find("simulation_parameters"))
      if (const auto value = simulation->find("cardiac_period")) found.push_back(time(value->positive()));
    for (const JsonPlace& condition : root_.list("boundary_conditions"))
      if (const auto values = condition.find("bc_values"))
        if (const auto times = values->find("t"); times && times->size() > 1)
          found.push_back(time(times->numbers().back() - times->numbers().front()));
    if (found.empty()) return 0;
    for (const double other : found)
      if (std::abs(other - found.front()) > 1e-6 * found.front())
        throw InputError(root_.source() + ": found periods of " + std::to_string(found.front()) + " and " +
                         std::to_string(other) + " ms, expected one");
    return found.front();
  }

  void add_store(int at, const std::string& name, double capacity, double pressure_kPa) {
    Compartment out;
    out.name = name;
    out.compliance_mm3_per_kPa = capacity;
    out.pressure_kPa = pressure_kPa;
    graph_.hold(at, std::move(out));
  }
  void add_given(int at, const std::string& name, double pressure_kPa,
                 std::optional<TimeSeries> curve = std::nullopt) {
    Compartment out;
    out.name = name;
    out.type = CompartmentType::pressure;
    out.pressure_kPa = pressure_kPa;
    out.curve = std::move(curve);
    graph_.hold(at, std::move(out));
  }
  /// A resistance between two points; without any, they are one.
  void add_pipe(const std::string& name, int from, int to, double R, double B, double L, double flow_begins) {
    if (R == 0 && B == 0 && L == 0) return graph_.join(from, to);
    Element out;
    out.name = name;
    out.valve.resistance_kPa_ms_per_mm3 = R;
    out.valve.stenosis_kPa_ms2_per_mm6 = B;
    out.inertance_kPa_ms2_per_mm3 = L;
    out.initial_flow_mm3_per_ms = flow_begins;
    graph_.connect(std::move(out), from, to);
  }

  void add_vessel(const JsonPlace& block) {
    const std::string name = block.at("vessel_name").text();
    known_.insert(name);
    if (const auto id = block.find("vessel_id")) vessel_ids_[id->whole()] = name;
    const JsonPlace type = block.at("zero_d_element_type"), values = block.at("zero_d_element_values");
    const double R = resistance(values.magnitude_or("R_poiseuille", 0)),
                 C = compliance(values.magnitude_or("C", 0)), L = inertance(values.magnitude_or("L", 0)),
                 B = stenosis(values.magnitude_or("stenosis_coefficient", 0));
    const double p = initial_pressure("pressure:", ":" + name), q = initial_flow("flow:", ":" + name),
                 out = initial_flow("flow:" + name + ":", "");
    const int begin = inlet(name), end = outlet(name);
    if (C == 0) {
      add_pipe(name, begin, end, R, B, L, out);
    } else if (type.text() == "BloodVesselCRL") {
      add_store(begin, name, C, p);
      add_pipe(name, begin, end, R, B, L, out);
    } else {
      const int middle = L == 0 ? end : graph_.point(name + ":C");
      add_pipe(L == 0 ? name : name + "_in", begin, middle, R, B, 0, 0);
      add_store(middle, name, C, p - (R + B * std::abs(q)) * q);
      if (L > 0) add_pipe(R == 0 && B == 0 ? name : name + "_out", middle, end, 0, 0, L, out);
    }
    if (type.text() != "BloodVessel" && type.text() != "BloodVesselCRL")
      type.fail("\"" + type.text() + "\"", "\"BloodVessel\" or \"BloodVesselCRL\"");
    const auto conditions = block.find("boundary_conditions");
    if (!conditions) return;
    if (const auto at = conditions->find("inlet")) conditions_of_vessels_.push_back({name, at->text(), true});
    if (const auto at = conditions->find("outlet"))
      conditions_of_vessels_.push_back({name, at->text(), false});
  }

  TimeSeries series(const JsonPlace& values, const char* key, double factor) const {
    return series_of(values, key, factor, unit_.ms);
  }

  void add_condition(const JsonPlace& block) {
    const std::string name = block.at("bc_name").text(), type = block.at("bc_type").text();
    const JsonPlace values = block.at("bc_values");
    known_.insert(name);
    const int begin = inlet(name), end = outlet(name);
    if (type == "RCR" || type == "ClosedLoopRCR") {
      const int middle = graph_.point(name + ":C");
      add_pipe(name + "_in", begin, middle, resistance(values.at("Rp").magnitude()), 0, 0, 0);
      add_store(middle, name, compliance(values.at("C").magnitude()), initial_capacitor(name));
      const double Rd = resistance(values.at("Rd").magnitude());
      if (type == "ClosedLoopRCR") {
        add_pipe(name + "_out", middle, end, Rd, 0, 0, 0);
        if (values.find("closed_loop_outlet") && values.at("closed_loop_outlet").flag())
          returns_.push_back(name);
        return;
      }
      const int behind = graph_.point(name + "_reference");
      add_pipe(name + "_out", middle, behind, Rd, 0, 0, 0);
      add_given(behind, name + "_reference", pressure(values.number_or("Pd", 0)));
    } else if (type == "RESISTANCE") {
      const int behind = graph_.point(name + "_reference");
      add_pipe(name, begin, behind, resistance(values.at("R").magnitude()), 0, 0, 0);
      const TimeSeries curve = series(values, "Pd", unit_.kPa);
      add_given(behind, name + "_reference", curve.values.front(), curve);
    } else if (type == "PRESSURE") {
      graph_.join(begin, end);
      const TimeSeries curve = series(values, "P", unit_.kPa);
      add_given(begin, name, curve.values.front(), curve);
    } else if (type == "FLOW") {
      graph_.join(begin, end);
      const bool at_inlet = std::ranges::any_of(root_.list("vessels"), [&](const JsonPlace& vessel) {
        const auto conditions = vessel.find("boundary_conditions");
        const auto at = conditions ? conditions->find("inlet") : std::nullopt;
        return at && at->text() == name;
      });
      Element pump;
      pump.name = name;
      pump.type = ElementType::pump;
      pump.curve = series(values, "Q", unit_.mm3 / unit_.ms);
      const int behind = graph_.point(name + "_reservoir");
      add_given(behind, name + "_reservoir", 0);
      graph_.connect(std::move(pump), at_inlet ? behind : begin, at_inlet ? begin : behind);
    } else {
      block.at("bc_type").fail("\"" + type + "\"", "RCR, RESISTANCE, PRESSURE, FLOW or ClosedLoopRCR");
    }
  }

  void hold_chamber(int at, const std::string& name, const Chamber& chamber, double begins_mm3) {
    Compartment out;
    out.name = name;
    out.type = CompartmentType::chamber;
    out.chamber = chamber;
    out.initial_volume_mm3 = begins_mm3;
    const auto stands_for = [&](const std::optional<std::string>& wanted, char side) {
      if (wanted) return *wanted == name;
      const std::string other = side == 'l' ? "left_ventricle" : "right_ventricle";
      std::string lower = name;
      std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return std::tolower(c); });
      return lower == std::string{side, 'v'} || lower == other;
    };
    const bool left = heart_.has_lv && stands_for(heart_.lv, 'l'),
               right = heart_.has_rv && stands_for(heart_.rv, 'r');
    if (left || right) {
      out.type = CompartmentType::ventricle;
      out.cavity = left ? CavityName::lv : CavityName::rv;
      out.pressure_kPa = pressure_in(chamber, period_ms_, 0, begins_mm3).pressure_kPa;
      (left ? found_lv_ : found_rv_) = true;
    }
    graph_.hold(at, std::move(out));
  }

  void add_chamber(const JsonPlace& block) {
    const std::string name = block.at("name").text();
    known_.insert(name);
    if (!(period_ms_ > 0))
      throw InputError(root_.source() +
                       ": found chambers without a period, expected simulation_parameters.cardiac_period");
    const auto [chamber, L] = chamber_of(block, unit_, period_ms_);
    hold_chamber(inlet(name), name, chamber, volume(initial("Vc:" + name, "").value_or(0)));
    add_pipe(name + "_impedance", inlet(name), outlet(name), 0, 0, L, initial_flow("flow:" + name + ":", ""));
  }

  std::vector<std::string> blocks_of(const JsonPlace& junction, const std::string& side) const {
    std::vector<std::string> out;
    if (const auto ids = junction.find(side + "_vessels")) {
      for (const double number : ids->numbers()) {
        const auto found = vessel_ids_.find(static_cast<int>(number));
        if (found == vessel_ids_.end()) ids->fail(std::to_string(static_cast<int>(number)), "a vessel_id");
        out.push_back(found->second);
      }
    } else {
      for (const JsonPlace& name : junction.list(side + "_blocks")) {
        expect_later_.emplace_back(name.text(), name.where());
        out.push_back(name.text());
      }
    }
    return out;
  }

  void add_junction(const JsonPlace& block) {
    const std::string name = block.at("junction_name").text(), type = block.at("junction_type").text();
    known_.insert(name);
    graph_.join(inlet(name), outlet(name));
    for (const std::string& from : blocks_of(block, "inlet")) graph_.join(inlet(name), outlet(from));
    const std::vector<std::string> to = blocks_of(block, "outlet");
    if (type == "NORMAL_JUNCTION" || type == "internal_junction") {
      for (const std::string& block_behind : to) graph_.join(inlet(name), inlet(block_behind));
      return;
    }
    if (type != "BloodVesselJunction")
      block.at("junction_type")
          .fail("\"" + type + "\"", "NORMAL_JUNCTION, internal_junction or BloodVesselJunction");
    const JsonPlace values = block.at("junction_values");
    const auto list = [&](const char* key) {
      std::vector<double> out(to.size(), 0);
      if (const auto found = values.find(key)) out = found->numbers();
      if (out.size() != to.size())
        values.at(key).fail(std::to_string(out.size()) + " numbers",
                            std::to_string(to.size()) + ", one an outlet");
      return out;
    };
    const auto R = list("R_poiseuille"), L = list("L"), B = list("stenosis_coefficient");
    for (std::size_t i = 0; i < to.size(); ++i)
      add_pipe(name + "_" + to[i], inlet(name), inlet(to[i]), resistance(R[i]), stenosis(B[i]),
               inertance(L[i]), initial_flow("flow:" + name + ":" + to[i], ""));
  }

  void add_valve(const JsonPlace& block) {
    const std::string name = block.at("name").text(), type = block.at("type").text();
    const JsonPlace values = block.at("params");
    known_.insert(name);
    Element out;
    out.name = name;
    out.type = ElementType::valve;
    out.valve.resistance_kPa_ms_per_mm3 = resistance(values.at("Rmin").positive());
    out.valve.leak_kPa_ms_per_mm3 = resistance(values.at("Rmax").positive());
    if (type == "ValveTanh") {
      out.valve.law = ValveLaw::tanh;
      out.valve.sharpness_per_kPa = values.at("Steepness").positive() / unit_.kPa;
    } else if (type == "PiecewiseValve") {
      out.valve.smoothing_kPa = kSharp_kPa;
    } else {
      block.at("type").fail("\"" + type + "\"", "ValveTanh or PiecewiseValve");
    }
    const std::string from = values.at("upstream_block").text(), to = values.at("downstream_block").text();
    expect(from, values.at("upstream_block"));
    expect(to, values.at("downstream_block"));
    graph_.connect(std::move(out), outlet(from), inlet(to));
  }

  void add_closed_loop(const JsonPlace& block) {
    const std::string type = block.at("closed_loop_type").text();
    if (type != "ClosedLoopHeartAndPulmonary")
      block.at("closed_loop_type").fail("\"" + type + "\"", "ClosedLoopHeartAndPulmonary");
    const ClosedLoopHeart heart = closed_loop_heart(block.at("parameters"), unit_, period_ms_);
    const std::array<const char*, 4> names{"right_atrium", "right_ventricle", "left_atrium",
                                           "left_ventricle"};
    const std::array<const char*, 4> states{"V_RA:", "V_RV:", "V_LA:", "V_LV:"};
    for (std::size_t i = 0; i < names.size(); ++i)
      hold_chamber(graph_.point(names[i]), names[i], heart.chambers[i],
                   volume(initial(states[i], "").value_or(0)));
    const int lungs = graph_.point("pulmonary_arteries"), aorta = graph_.point("aorta");
    add_store(lungs, "pulmonary_arteries", heart.lungs_mm3_per_kPa, initial_pressure("P_pul:", ""));
    add_store(aorta, "aorta", heart.aorta_mm3_per_kPa, initial_pressure("pressure:CLH:", ""));
    add_pipe("pulmonary_vessels", lungs, graph_.point("left_atrium"), heart.lungs_kPa_ms_per_mm3, 0, 0, 0);
    const std::array<int, 4> behind{graph_.point("right_ventricle"), lungs, graph_.point("left_ventricle"),
                                    aorta};
    const std::array<const char*, 4> flows{"Q_RA:", "Q_RV:", "Q_LA:", "Q_LV:"};
    for (std::size_t i = 0; i < names.size(); ++i) {
      Element valve = heart.valves[i];
      valve.initial_flow_mm3_per_ms = initial_flow(flows[i], "");
      graph_.connect(std::move(valve), graph_.point(names[i]), behind[i]);
    }
    for (const std::string& name : returns_) graph_.join(graph_.point("right_atrium"), outlet(name));
    for (const JsonPlace& name : block.list("outlet_blocks")) {
      expect(name.text(), name);
      graph_.join(aorta, inlet(name.text()));
    }
  }

  void check_heart() const {
    for (const auto& [name, where] : expect_later_)
      if (!known_.contains(name))
        throw InputError(where + ": found \"" + name + "\", expected the name of a block of this file");
    const auto check = [&](bool wanted, bool found, const std::optional<std::string>& name,
                           const char* side) {
      if (!wanted || found) return;
      throw InputError(
          root_.source() + ": found no chamber " +
          (name ? "\"" + *name + "\""
                : std::string(side) + "V or " + (*side == 'L' ? "left_ventricle" : "right_ventricle")) +
          " that the ventricle of the mesh stands for, expected one (circulation." +
          (*side == 'L' ? "lv" : "rv") + "_chamber)");
    };
    check(heart_.has_lv, found_lv_, heart_.lv, "L");
    check(heart_.has_rv, found_rv_, heart_.rv, "R");
  }

  struct ConditionOfVessel {
    std::string vessel, condition;
    bool at_inlet;
  };

  JsonPlace root_;
  SvZeroDFactors unit_;
  SvZeroDHeart heart_;
  double period_ms_ = 0;
  NetworkGraph graph_;
  std::set<std::string> known_;
  std::map<int, std::string> vessel_ids_;
  std::vector<ConditionOfVessel> conditions_of_vessels_;
  std::vector<std::string> returns_;  // conditions that lead back to the heart
  mutable std::vector<std::pair<std::string, std::string>> expect_later_;
  bool found_lv_ = false, found_rv_ = false;
};

}  // namespace

CirculationNetwork read_svzerod(const std::string& text, const std::string& source,
                                const SvZeroDFactors& factors, const SvZeroDHeart& heart) {
  const nlohmann::json json = parsed(text, source);
  return SvZeroDReader(JsonPlace(json, source, ""), factors, heart).read();
}

}  // namespace cardiac
