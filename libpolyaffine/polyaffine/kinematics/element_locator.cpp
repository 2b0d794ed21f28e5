#include "polyaffine/kinematics/element_locator.hpp"

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>

#include <polyaffine/core/error.hpp>

namespace polyaffine {
namespace {

// Share of its size by which a box is widened: curved faces leave the hull of the nodes, points beyond the
// surface want the element next to them.
constexpr double kMargin = 0.15;
constexpr double kInside = -1e-10;

std::string text(const Vec3& x) {
  std::ostringstream out;
  out << "point (" << x.transpose() << ") mm to locate";
  return out.str();
}

}  // namespace

ElementLocator::ElementLocator(const LagrangeBasis& elements) : elements_(elements) {
  const Eigen::Index n = elements.elements().cols();
  const Points& nodes = elements.nodes();
  low_ = nodes.rowwise().minCoeff();
  const Vec3 extent = nodes.rowwise().maxCoeff() - low_;
  size_ = std::max(std::cbrt(extent.prod() / static_cast<double>(n)), 1e-9 * extent.maxCoeff());
  for (int d = 0; d < 3; ++d) count_[d] = 1 + static_cast<int>(extent[d] / size_);
  std::vector<std::vector<int>> cells(count_.prod());
  for (int e = 0; e < n; ++e) {
    const Points own = nodes(Eigen::all, elements.elements().col(e));
    Box box{own.rowwise().minCoeff(), own.rowwise().maxCoeff()};
    const Vec3 margin = Vec3::Constant(kMargin * (box.high - box.low).maxCoeff());
    box.low -= margin;
    box.high += margin;
    boxes_.push_back(box);
    const Eigen::Vector3i from = place(box.low), to = place(box.high);
    for (int k = from[2]; k <= to[2]; ++k)
      for (int j = from[1]; j <= to[1]; ++j)
        for (int i = from[0]; i <= to[0]; ++i) cells[cell({i, j, k})].push_back(e);
  }
  start_.push_back(0);
  for (const auto& own : cells) {
    held_.insert(held_.end(), own.begin(), own.end());
    start_.push_back(static_cast<int>(held_.size()));
  }
  all_.resize(n);
  std::iota(all_.begin(), all_.end(), 0);
}

Eigen::Vector3i ElementLocator::place(const Vec3& x) const {
  Eigen::Vector3i out;
  for (int d = 0; d < 3; ++d)
    out[d] = static_cast<int>(std::clamp((x[d] - low_[d]) / size_, 0.0, count_[d] - 1.0));
  return out;
}

// Newton's method from the middle of the element; tet −1 where it does not settle.
MeshPoint ElementLocator::invert(int element, const Vec3& x) const {
  MeshPoint out;
  for (int i = 0; i < 30; ++i) {
    const Vec3 step = elements_.jacobian(element, out.barycentric)
                          .partialPivLu()
                          .solve(x - elements_.position(element, out.barycentric));
    out.barycentric.tail<3>() += step;
    out.barycentric[0] -= step.sum();
    if (!(out.barycentric.cwiseAbs().maxCoeff() < 10)) return out;
    if (step.cwiseAbs().maxCoeff() > 1e-13) continue;
    out.tet = element;
    if (out.barycentric.minCoeff() < kInside) {
      Vec4 cut = out.barycentric.cwiseMax(0);
      cut /= cut.sum();
      out.distance = (x - elements_.position(element, cut)).norm();
    }
    return out;
  }
  return out;
}

MeshPoint ElementLocator::nearest(const Vec3& x, const int* first, const int* last) const {
  MeshPoint best;
  best.distance = std::numeric_limits<double>::infinity();
  for (const int* e = first; e != last; ++e) {
    const MeshPoint found = invert(*e, x);
    if (found.tet >= 0 && found.distance < best.distance) best = found;
    if (best.distance == 0) break;
  }
  return best;
}

MeshPoint ElementLocator::locate(const Vec3& x) const {
  if (!x.allFinite()) throw InputError(text(x) + ": expected finite coordinates");
  const int at = cell(place(x));
  std::vector<int> near;
  for (int k = start_[at]; k < start_[at + 1]; ++k) {
    const Box& box = boxes_[held_[k]];
    if ((x.array() >= box.low.array()).all() && (x.array() <= box.high.array()).all())
      near.push_back(held_[k]);
  }
  MeshPoint best = nearest(x, near.data(), near.data() + near.size());
  if (best.tet < 0) best = nearest(x, all_.data(), all_.data() + all_.size());
  if (best.tet < 0) throw ComputationError(text(x) + ": no element reaches it");
  return best;
}

}  // namespace polyaffine
