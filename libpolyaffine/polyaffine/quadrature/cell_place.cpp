#include "polyaffine/quadrature/cell_place.hpp"

#include <Eigen/LU>

namespace polyaffine {
namespace {

constexpr double kAccuracy = 1e-8;  // of a cell
constexpr double kOutside = 0.1;    // barycentric

// Distance to the wanted place in the directions that count; nothing outside its cell.
std::optional<Vector> missed(const PlaceOf& place_of, const CellPlace& wanted, Eigen::Index directions,
                             const MeshPoint& at) {
  const CellPlace found = place_of(at.tet, at.barycentric);
  if (found.cell != wanted.cell) return {};
  return Vector((found.place - wanted.place).head(directions));
}

std::optional<MeshPoint> newton(const PlaceOf& place_of, const CellPlace& wanted, MeshPoint at) {
  constexpr double kProbe = 1e-6;
  constexpr int kIterations = 8, kHalvings = 4;
  std::vector<Eigen::Index> corners;
  for (Eigen::Index k = 0; k < 4; ++k)
    if (at.barycentric[k] != 0) corners.push_back(k);
  const auto directions = std::ssize(corners) - 1;
  const auto moved = [&](const Vector& step) {
    MeshPoint out = at;
    for (Eigen::Index k = 0; k < directions; ++k) {
      out.barycentric[corners[k]] += step[k];
      out.barycentric[corners.back()] -= step[k];
    }
    return out;
  };
  auto miss = missed(place_of, wanted, directions, at);
  for (int iteration = 0; miss && miss->norm() > 1e-3 * kAccuracy && iteration < kIterations; ++iteration) {
    Matrix slope(directions, directions);
    for (Eigen::Index k = 0; k < directions; ++k) {
      const auto probe = missed(place_of, wanted, directions, moved(kProbe * Vector::Unit(directions, k)));
      if (!probe) return {};
      slope.col(k) = (*probe - *miss) / kProbe;
    }
    const Vector step = slope.partialPivLu().solve(-*miss);
    if (!step.allFinite()) return {};
    bool closer = false;
    for (double part = 1; !closer && part > std::pow(0.5, kHalvings); part /= 2) {
      const MeshPoint next = moved(part * step);
      if (next.barycentric.minCoeff() < -1) continue;
      const auto there = missed(place_of, wanted, directions, next);
      closer = there && there->norm() < miss->norm();
      if (!closer) continue;
      at = next;
      miss = there;
    }
    if (!closer) break;
  }
  if (!miss || !(miss->norm() <= kAccuracy)) return {};
  return at;
}

}  // namespace

std::optional<MeshPoint> find_place(const PlaceOf& place_of, const CellPlace& wanted,
                                    const std::vector<MeshPoint>& near) {
  std::optional<MeshPoint> best;
  for (const MeshPoint& start : near) {
    const auto found = newton(place_of, wanted, start);
    if (!found) continue;
    if (!best || found->barycentric.minCoeff() > best->barycentric.minCoeff()) best = found;
    if (best->barycentric.minCoeff() >= -1e-9) return best;
  }
  if (best && best->barycentric.minCoeff() < -kOutside) best.reset();
  return best;
}

}  // namespace polyaffine
