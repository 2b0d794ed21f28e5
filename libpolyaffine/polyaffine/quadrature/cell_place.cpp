#include "polyaffine/quadrature/cell_place.hpp"

#include <Eigen/LU>

namespace polyaffine {
namespace {

// A place is found when it is missed by this share of a cell; Newton's method goes on to kSettled of it,
// where the quadratic convergence of one more step ends, so that the point does not depend on where it began.
constexpr double kAccuracy = 1e-8, kSettled = 1e-3;
// Barycentric coordinates by which a point may lie outside of its element: rounding; the bend of an element
// at the surface, past which no element lies; and while Newton's method is on its way.
constexpr double kRounding = 1e-9, kOutside = 0.1, kFarOutside = 1;
// Barycentric step of the difference quotients, about the root of the rounding error.
constexpr double kProbe = 1e-6;
constexpr int kIterations = 8, kHalvings = 4;

// Distance to the wanted place in the directions that count; nothing outside its cell.
std::optional<Vector> missed(const PlaceOf& place_of, const CellPlace& wanted, Eigen::Index directions,
                             const MeshPoint& at) {
  const CellPlace found = place_of(at.tet, at.barycentric);
  if (found.cell != wanted.cell) return {};
  return Vector((found.place - wanted.place).head(directions));
}

// A point of an element that moves in the directions of its own barycentric coordinates; those that are zero
// at the start stay so, which keeps a point of a face on the face.
class MovingPoint {
 public:
  explicit MovingPoint(const MeshPoint& start) : at_(start) {
    for (Eigen::Index k = 0; k < 4; ++k)
      if (start.barycentric[k] != 0) corners_.push_back(k);
  }
  Eigen::Index directions() const { return std::ssize(corners_) - 1; }
  const MeshPoint& at() const { return at_; }
  void go_to(const MeshPoint& next) { at_ = next; }
  MeshPoint moved(const Vector& step) const {
    MeshPoint out = at_;
    for (Eigen::Index k = 0; k < directions(); ++k) {
      out.barycentric[corners_[k]] += step[k];
      out.barycentric[corners_.back()] -= step[k];
    }
    return out;
  }

 private:
  MeshPoint at_;
  std::vector<Eigen::Index> corners_;
};

// Derivatives of the place by the directions of the point, as difference quotients; nothing where a probe
// leaves the cell.
std::optional<Matrix> slope_at(const PlaceOf& place_of, const CellPlace& wanted, const MovingPoint& point,
                               const Vector& miss) {
  const Eigen::Index n = point.directions();
  Matrix slope(n, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto probe = missed(place_of, wanted, n, point.moved(kProbe * Vector::Unit(n, k)));
    if (!probe) return {};
    slope.col(k) = (*probe - miss) / kProbe;
  }
  return slope;
}

// Newton's method in the element of a point, with steps halved until they come closer.
std::optional<MeshPoint> newton(const PlaceOf& place_of, const CellPlace& wanted, const MeshPoint& start) {
  MovingPoint point(start);
  auto miss = missed(place_of, wanted, point.directions(), start);
  for (int iteration = 0; miss && miss->norm() > kSettled * kAccuracy && iteration < kIterations;
       ++iteration) {
    const auto slope = slope_at(place_of, wanted, point, *miss);
    if (!slope) return {};
    const Vector step = slope->partialPivLu().solve(-*miss);
    if (!step.allFinite()) return {};
    bool closer = false;
    for (double part = 1; !closer && part > std::pow(0.5, kHalvings); part /= 2) {
      const MeshPoint next = point.moved(part * step);
      if (next.barycentric.minCoeff() < -kFarOutside) continue;
      const auto there = missed(place_of, wanted, point.directions(), next);
      closer = there && there->norm() < miss->norm();
      if (!closer) continue;
      point.go_to(next);
      miss = there;
    }
    if (!closer) break;
  }
  if (!miss || !(miss->norm() <= kAccuracy)) return {};
  return point.at();
}

}  // namespace

std::optional<MeshPoint> find_place(const PlaceOf& place_of, const CellPlace& wanted,
                                    const std::vector<MeshPoint>& near) {
  std::optional<MeshPoint> best;
  for (const MeshPoint& start : near) {
    const auto found = newton(place_of, wanted, start);
    if (!found) continue;
    if (!best || found->barycentric.minCoeff() > best->barycentric.minCoeff()) best = found;
    if (best->barycentric.minCoeff() >= -kRounding) return best;
  }
  if (best && best->barycentric.minCoeff() < -kOutside) best.reset();
  return best;
}

}  // namespace polyaffine
