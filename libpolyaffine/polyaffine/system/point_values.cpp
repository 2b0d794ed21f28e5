#include "polyaffine/system/point_values.hpp"

#include <atomic>
#include <utility>

namespace polyaffine {
namespace {

struct Kept {
  double t;
  std::shared_ptr<const Vector> values;
};

}  // namespace

PointValues remembered(std::function<Vector(double t)> values) {
  const auto last = std::make_shared<std::atomic<std::shared_ptr<const Kept>>>();
  return [last, values = std::move(values)](double t) {
    std::shared_ptr<const Kept> kept = last->load();
    if (!kept || kept->t != t) {
      kept = std::make_shared<const Kept>(Kept{t, std::make_shared<const Vector>(values(t))});
      last->store(kept);
    }
    return kept->values;
  };
}

PointValues constant_values(Vector values) {
  return [shared = std::make_shared<const Vector>(std::move(values))](double) { return shared; };
}

PointValues ramp(Vector from, Vector to) {
  return remembered(
      [from = std::move(from), to = std::move(to)](double t) -> Vector { return (1 - t) * from + t * to; });
}

}  // namespace polyaffine
