#pragma once

#include <optional>
#include <string>

#include <cardiac/circulation/network.hpp>

namespace cardiac {

/// What the numbers of a file are in.
struct SvZeroDFactors {
  double kPa = kPa_per_mmHg, mm3 = mm3_per_mL, ms = ms_per_s;  ///< one unit of pressure, volume and time
};

/// The chambers of a file that a heart with walls stands for: by their names, or where none is given, those
/// called LV, lv or left_ventricle (and so on), or the ventricles of the closed-loop heart.
struct SvZeroDHeart {
  bool has_lv = false, has_rv = false;
  std::optional<std::string> lv, rv;
};

/// The network of a model of svZeroDSolver, told in JSON. Read are
///   vessels             BloodVessel (R, then C, then L) and BloodVesselCRL (C, then R and L), with stenosis
///   junctions           NORMAL_JUNCTION, internal_junction, BloodVesselJunction; by blocks or vessel ids
///   boundary_conditions RCR, RESISTANCE, PRESSURE, FLOW, ClosedLoopRCR
///   valves              ValveTanh, PiecewiseValve
///   chambers            ChamberElastanceInductor, LinearElastanceChamber (PiecewiseCosineChamber), with the
///                       activations half_cosine, piecewise_cosine, two_hill, wrapping_cosine and fourier
///   closed_loop_blocks  ClosedLoopHeartAndPulmonary
///   initial_condition   pressures, flows and volumes by name, pressure_all, flow_all
/// In a valve of the closed-loop heart, which is an inertance that lets nothing back, a closed valve here has
/// the resistance of 1000 mmHg·s/mL. Names with other signs than letters, digits and underscores get
/// underscores. Throws polyaffine::InputError with the file, the block and the key, what was found and what
/// was expected. Sources: svZeroDSolver's user guide; Sankaran et al. 2012 (closed-loop heart); Kerckhoffs et
/// al. 2007 (chamber with inductance); Pfaller et al. 2019 (tanh valve).
CirculationNetwork read_svzerod(const std::string& text, const std::string& source,
                                const SvZeroDFactors& factors = {}, const SvZeroDHeart& heart = {});

}  // namespace cardiac
