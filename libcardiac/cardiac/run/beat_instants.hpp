#pragma once

#include <cardiac/model/beat_system.hpp>
#include <cardiac/run/beat.hpp>

namespace cardiac {

/// Finds the instants of a beat (HeartPath::instants) and its circulation (HeartPath::circulation) on the
/// dense output of the integrator: signs are compared at the quarters of every step and their changes found
/// by bisection, so that no instant is tied to a time step.
class BeatInstants {
 public:
  /// Of the beat that begins at begin_ms with y; contraction begins at `onset_ms` of the beat.
  BeatInstants(const BeatSystem& system, double begin_ms, double onset_ms, const polyaffine::Vector& y,
               HeartPath& path);
  /// To be called after each step of the integrator, the beginning of which was `from_ms`.
  void follow(const polyaffine::DaeIntegrator& ida, double from_ms);

 private:
  void sample(double t, const polyaffine::Vector& y);

  const BeatSystem& system_;
  double begin_ms_, onset_ms_;
  HeartPath& path_;
  polyaffine::Matrix before_;  // what changes its sign, of each cavity, at the last sample
};

/// When within the beat the first point that contracts begins to, ms.
double contraction_onset_ms(const ContractionField& contraction);

}  // namespace cardiac
