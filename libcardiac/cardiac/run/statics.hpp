#pragma once

#include <string>

#include <cardiac/run/beat.hpp>
#include <polyaffine/solve/load_stepping.hpp>

/// What the static loadings of run_beats and run_prescribed share: how they are stopped and told.
namespace cardiac {

bool stop_wanted(const RunControl& control);

/// Why a loading stopped, in words; it has not converged.
std::string why_it_stopped(const polyaffine::LoadReport& report, const RunControl& control);

/// Warns in the path when the equilibrium of a load is not stable.
void warn_of_instability(const polyaffine::LoadReport& report, const std::string& load, HeartPath& path);

/// Highest order of BDF with inertia: beyond it the method is not stable for waves that little damps.
inline constexpr int kMaxOrderOfWaves = 2;

/// The integration that a scene asks for.
polyaffine::DaeOptions dae_options(const Scene& scene);

/// Time steps of `span_ms`, some ten times as many as one needs.
int most_steps(const scene::Time& time, double span_ms);

/// Why an integration with so many steps ends.
std::string too_many_steps(int steps, double last_step_ms);

}  // namespace cardiac
