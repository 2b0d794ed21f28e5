#include "polyaffine/kinematics/gmls_basis.hpp"

#include <string>
#include <utility>

#include <polyaffine/core/error.hpp>
#include <polyaffine/geometry/locate.hpp>

namespace polyaffine {

GmlsBasis::GmlsBasis(const TetMesh& mesh, std::shared_ptr<const RegionWeights> weights, Points nodes,
                     double length)
    : mesh_(mesh), weights_(std::move(weights)), nodes_(std::move(nodes)), length_(length) {
  if (nodes_.cols() != weights_->num_regions() || !(length_ > 0))
    throw InputError("GMLS: found " + std::to_string(nodes_.cols()) + " nodes and length " +
                     std::to_string(length_) + " mm, expected " + std::to_string(weights_->num_regions()) +
                     " nodes, one a region, and a positive length");
}

BasisSample GmlsBasis::sample(int tet, const Vec4& barycentric) const {
  const RegionWeightValues phi = weights_->evaluate(tet, barycentric);
  std::vector<int> present;
  for (int i = 0; i < weights_->num_regions(); ++i)
    if (phi.values[i] != 0) present.push_back(i);
  GmlsValues at = gmls_functions(position(mesh_, tet, barycentric), nodes_(Eigen::all, present),
                                 phi.values(present), phi.gradients(Eigen::all, present), length_);
  BasisSample out;
  for (const int i : present)
    for (int m = 0; m < 4; ++m) out.functions.push_back(4 * i + m);
  out.N = std::move(at.values);
  out.gradient = std::move(at.gradients);
  return out;
}

}  // namespace polyaffine
