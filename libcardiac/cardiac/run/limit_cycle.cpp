#include "cardiac/run/limit_cycle.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <functional>

namespace cardiac {

using polyaffine::Matrix;
using polyaffine::Vector;

namespace {

constexpr double kFurthest = 50;        // differences of two beats that an estimate may lie away
constexpr double kLargestChange = 0.5;  // of a pressure, in an estimate
constexpr double kNoiseShare = 0.01;    // of the largest singular value
constexpr double kUnexplained = 10;     // what counts a difference that the beats so far do not explain
constexpr int kNoiseBeats = 3;
constexpr int kFewVessels = 3;
constexpr int kSpareBeats = 3;  // among which those that differ most are chosen

// A beat's residual in parts of the pressures.
Vector residual(const CycleBeat& beat, int volumes) {
  const auto count = beat.start.size() - volumes;
  return (beat.end - beat.start).tail(count).cwiseQuotient(beat.end.tail(count).cwiseAbs());
}

// As many earlier beats as there are pressures: of the latest, those that began furthest from the last one,
// so that noise counts least; the first beat, which begins with a wall at rest, only where there is no other.
template <class Scaled>
std::vector<const CycleBeat*> chosen(const std::vector<CycleBeat>& beats, int volumes, const Scaled& scaled) {
  const CycleBeat& last = beats.back();
  const auto count = last.start.size() - volumes, n = std::ssize(beats) - 1;
  std::vector<const CycleBeat*> out;
  for (auto k = std::max<std::ptrdiff_t>(n - count - kSpareBeats, n > count ? 1 : 0); k < n; ++k)
    out.push_back(&beats[static_cast<std::size_t>(k)]);
  std::ranges::stable_sort(out, std::greater<>(),
                           [&](const CycleBeat* beat) { return scaled(last.start - beat->start).norm(); });
  if (std::ssize(out) > count) out.resize(static_cast<std::size_t>(count));
  return out;
}

}  // namespace

CycleEstimate estimate_limit_cycle(const std::vector<CycleBeat>& beats, int volumes) {
  const CycleBeat& last = beats.back();
  const auto count = last.start.size() - volumes;
  if (count == 0) return {Vector(), 0, false};
  const Vector size = last.end.tail(count).cwiseAbs();
  const auto scaled = [&](const Vector& x) { return Vector(x.tail(count).cwiseQuotient(size)); };
  const Vector g = scaled(last.end - last.start);
  CycleEstimate out{last.end.tail(count), 100 * kFurthest * g.cwiseAbs().maxCoeff(), false};
  const std::vector<const CycleBeat*> earlier = chosen(beats, volumes, scaled);
  if (earlier.empty()) return out;
  const auto depth = std::ssize(earlier);

  Matrix dg(count, depth), dF(count, depth);
  for (std::ptrdiff_t j = 0; j < depth; ++j) {
    dg.col(j) = g - scaled(earlier[j]->end - earlier[j]->start);
    dF.col(j) = scaled(last.end - earlier[j]->end);
  }
  Eigen::JacobiSVD<Matrix> svd(dg, Eigen::ComputeThinU | Eigen::ComputeThinV);
  svd.setThreshold(kNoiseShare);
  const Vector theta = svd.solve(g);
  const Vector limit = scaled(last.end) - dF * theta;
  const Vector away = limit - scaled(last.start);
  if (!limit.allFinite() || limit.minCoeff() <= 0 || away.norm() > kFurthest * g.norm() ||
      (limit - scaled(last.end)).cwiseAbs().maxCoeff() > kLargestChange)
    return out;
  double stroke = last.stroke_mm3;
  Vector volume = last.end.head(volumes);
  for (std::ptrdiff_t j = 0; j < depth; ++j) {
    stroke -= theta[j] * (last.stroke_mm3 - earlier[j]->stroke_mm3);
    volume -= theta[j] * (last.end - earlier[j]->end).head(volumes);
  }
  const double of_stroke = std::max(std::abs(stroke - last.stroke_mm3),
                                    (volume - last.start.head(volumes)).cwiseAbs().maxCoeff()) /
                           std::abs(last.stroke_mm3);
  out.pressures_kPa = limit.cwiseProduct(size);
  const double unexplained = kUnexplained * (g - dg * theta).cwiseAbs().maxCoeff();
  out.distance_percent = 100 * (std::max(away.cwiseAbs().maxCoeff(), of_stroke) + unexplained);
  out.extrapolated = true;
  return out;
}

bool is_noise(const std::vector<CycleBeat>& beats, int volumes) {
  const auto count = std::ssize(beats);
  const auto vessels = beats.front().start.size() - volumes;
  if (vessels == 0 || count <= kNoiseBeats + std::max<std::ptrdiff_t>(1, vessels - kFewVessels)) return false;
  double before = INFINITY, lately = INFINITY;
  bool turns = false;
  for (std::ptrdiff_t n = 0; n < count; ++n) {
    const Vector g = residual(beats[n], volumes);
    double& least = n < count - kNoiseBeats ? before : lately;
    least = std::min(least, g.cwiseAbs().maxCoeff());
    if (n >= count - kNoiseBeats && g.dot(residual(beats[n - 1], volumes)) < 0) turns = true;
  }
  return turns && lately > before / 2;
}

}  // namespace cardiac
