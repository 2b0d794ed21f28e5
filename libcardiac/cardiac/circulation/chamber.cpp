#include "cardiac/circulation/chamber.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace cardiac {
namespace {

struct Harmonic {
  double real, imaginary;
};

// Elastance of a ventricle by the phase of the heart period, Menon et al. 2023 (after Sankaran et al. 2012):
// Σ Re(c_n exp(2πi n t/T)).
constexpr std::array<Harmonic, 25> kElastance{{{0.283748803, 0},
                                               {0.031830626, -0.374299825},
                                               {-0.209472400, -0.018127770},
                                               {0.020520047, 0.073971113},
                                               {0.008316883, -0.047249597},
                                               {-0.041677660, 0.003212163},
                                               {0.000867323, 0.019441411},
                                               {-0.001675379, -0.005565534},
                                               {-0.011252277, 0.003401432},
                                               {-0.000414677, 0.008376795},
                                               {0.000253749, -0.000071880},
                                               {-0.002584966, 0.001566861},
                                               {0.000584752, 0.003143555},
                                               {0.000028502, -0.000024787},
                                               {0.000022961, -0.000007476},
                                               {0.000018735, -0.000001281},
                                               {0.000015573, 0.000001781},
                                               {0.000013133, 0.000003494},
                                               {0.000011199, 0.000004507},
                                               {0.000009634, 0.000005117},
                                               {0.000008343, 0.000005481},
                                               {0.000007265, 0.000005687},
                                               {0.000006354, 0.000005789},
                                               {0.000005575, 0.000005821},
                                               {0.000004903, 0.000005805}}};

double wrapped(double t, double period) {
  return t - period * std::floor(t / period);
}

double fourier(double phase) {
  double sum = 0;
  for (std::size_t n = 0; n < kElastance.size(); ++n) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(n) * phase;
    sum += kElastance[n].real * std::cos(angle) - kElastance[n].imaginary * std::sin(angle);
  }
  return sum;
}

double hills(const Chamber& c, double t) {
  const double rise = std::pow(t / c.rise_ms, c.rise_exponent),
               fall = std::pow(t / c.fall_ms, c.fall_exponent);
  return rise / (1 + rise) / (1 + fall);
}

}  // namespace

double activity_at(const Chamber& chamber, double period_ms, double time_ms) {
  const double t = wrapped(time_ms - chamber.elastance.onset_ms, period_ms);
  if (chamber.activity == Activity::fourier) return fourier(t / period_ms);
  if (chamber.activity == Activity::two_hill) return chamber.hill_scale * hills(chamber, t);
  Elastance unit = chamber.elastance;
  unit.active_kPa_per_mm3 = 1;
  unit.passive_kPa_per_mm3 = 0;
  return elastance_at(unit, period_ms, time_ms);
}

ChamberPressure pressure_in(const Chamber& chamber, double period_ms, double time_ms, double volume_mm3) {
  const double s = activity_at(chamber, period_ms, time_ms);
  const Elastance& e = chamber.elastance;
  const double stretched = volume_mm3 - (e.unstressed_volume_mm3 + s * chamber.systolic_volume_change_mm3);
  if (chamber.passive_kPa > 0) {
    const double exponential = chamber.passive_kPa * std::exp(chamber.passive_per_mm3 * stretched);
    return {s * e.active_kPa_per_mm3 * stretched + (1 - s) * (exponential - chamber.passive_kPa),
            s * e.active_kPa_per_mm3 + (1 - s) * chamber.passive_per_mm3 * exponential};
  }
  const double stiffness = e.passive_kPa_per_mm3 + s * e.active_kPa_per_mm3;
  return {stiffness * stretched, stiffness};
}

double scale_of_hills(const Chamber& chamber, double period_ms) {
  constexpr int kSamples = 20000;  // of a smooth function: the largest is within 1e-7
  double largest = 0;
  for (int i = 1; i < kSamples; ++i) largest = std::max(largest, hills(chamber, period_ms * i / kSamples));
  return 1 / largest;
}

}  // namespace cardiac
