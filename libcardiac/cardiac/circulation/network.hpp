#pragma once

#include <optional>
#include <string>
#include <vector>

#include <cardiac/circulation/chamber.hpp>
#include <cardiac/circulation/closed_loop_2022.hpp>
#include <cardiac/circulation/two_sided_loop.hpp>

namespace cardiac {

/// What holds blood at a pressure.
enum class CompartmentType {
  vessel,     ///< a compliance, V = C p
  chamber,    ///< an elastance that changes with the time
  ventricle,  ///< a cavity of the heart whose wall is computed
  pressure,   ///< a pressure that nothing changes: veins, air
  junction    ///< holds none: what flows in flows out
};

enum class CavityName { lv, rv };

/// A value over the time, straight between its samples; times ascend from 0 and the value repeats after the
/// last one.
struct TimeSeries {
  std::vector<double> times_ms, values;
  double at(double time_ms) const;
};

/// A compartment of a circulation; kPa, mm³, ms.
struct Compartment {
  std::string name;
  CompartmentType type = CompartmentType::vessel;
  double compliance_mm3_per_kPa = 0;  ///< of a vessel
  /// When the first beat begins: of a vessel, and what a ventricle is filled to. Of a pressure: always.
  double pressure_kPa = 0;
  CavityName cavity = CavityName::lv;  ///< of a ventricle
  Chamber chamber;
  double initial_volume_mm3 = 0;    ///< of a chamber
  std::optional<TimeSeries> curve;  ///< of a pressure that changes with the time, kPa
};

enum class ElementType {
  resistance,  ///< (R + B |q|) q + L q̇ = Δp
  valve,       ///< by its law; with an inertance, L q̇ = Δp − drop(q)
  pump         ///< (R + B |q|) q + L q̇ = Δp + head, or a flow that is given
};

/// What joins two compartments and lets blood flow between them; kPa, mm³, ms. Flow from the first to the
/// second is positive, and Δp the difference of their pressures.
struct Element {
  std::string name, from, to;
  ElementType type = ElementType::resistance;
  Valve valve;  ///< of all types resistance and stenosis, of a valve the rest
  double inertance_kPa_ms2_per_mm3 = 0;
  double initial_flow_mm3_per_ms = 0;  ///< of an inertance
  double head_kPa = 0;                 ///< of a pump: what it makes without flow
  std::optional<TimeSeries> curve;     ///< of a pump that gives a flow (mm³/ms) whatever the pressure
  /// A resistance behind a valve of the smooth law, taken as one with it, and the name of the pressure
  /// between them; empty: it has none.
  double series_kPa_ms_per_mm3 = 0;
  std::string between;
};

/// A circulation as compartments and the elements between them. What depends on the time repeats with
/// `period_ms`; zero: with the beat of the heart.
struct CirculationNetwork {
  std::vector<Compartment> compartments;
  std::vector<Element> elements;
  double period_ms = 0;
};

/// What is wrong with a compartment or an element: which (by number, from zero), and in words.
struct NetworkFault {
  bool of_element = false;
  std::size_t index = 0;
  std::string key;  ///< of the protocol, where one is to blame
  std::string text;
};

/// The first thing that keeps a network from being computed; none where nothing does: names that are empty,
/// not of letters, digits and underscores or not unique; ends that nothing has the name of; a vessel without
/// compliance; an element without resistance; a junction between inertances only or beside an arctan valve; a
/// ventricle without a valve to it and one from it, or twice; no ventricle or chamber to pump, parts that are
/// not connected.
std::optional<NetworkFault> fault_of(const CirculationNetwork& network);

/// The loops of this folder as networks, with the names of their tables; vessels begin at the states of the
/// loop behind the volumes, cavities at the filling pressures.
CirculationNetwork network_of(const LeftHeartLoop& loop, double capacitor_kPa);
CirculationNetwork network_of(const TwoSidedLoop& loop, const polyaffine::Vector& vessels_kPa,
                              const polyaffine::Vector& filling_kPa);
/// The closed loop of 2022 from a state of it; ventricles whose wall is computed are cavities, the others
/// chambers.
CirculationNetwork network_of(const ClosedLoop& loop, const ClosedLoopState& start, bool lv_is_cavity,
                              bool rv_is_cavity);

}  // namespace cardiac
