#include "polyaffine/kinematics/region_weights.hpp"

#include <Eigen/LU>
#include <cmath>
#include <string>
#include <utility>

#include <polyaffine/core/error.hpp>

namespace polyaffine {
namespace {

struct Bump {
  double value, slope;
};

Bump weight(double d, const RegionWeightOptions& options) {
  if (d >= options.support) return {0, 0};
  const double sigma = 1 / (1 + std::exp(options.sharpness * d));
  const double slope = -options.sharpness * sigma * (1 - sigma);
  if (d <= 0 || !std::isfinite(options.support)) return {sigma, slope};
  const double r = d / options.support, rest = 1 - r * r;
  return {sigma * rest * rest, slope * rest * rest - sigma * 4 * r * rest / options.support};
}

}  // namespace

RegionWeights::RegionWeights(const TetMesh& mesh, Matrix distances, const RegionWeightOptions& options)
    : mesh_(mesh), distances_(std::move(distances)), options_(options) {
  if (distances_.cols() != mesh.num_points() || distances_.rows() == 0)
    throw InputError("region weights: found distances for " + std::to_string(distances_.rows()) +
                     " regions at " + std::to_string(distances_.cols()) +
                     " vertices, expected at least one region and " + std::to_string(mesh.num_points()) +
                     " vertices");
  if (!distances_.allFinite()) throw InputError("region weights: found a distance that is not finite");
  if (!(options.sharpness > 0) || !(options.support > 0))
    throw InputError("region weights: found sharpness " + std::to_string(options.sharpness) +
                     " and support " + std::to_string(options.support) +
                     ", expected positive numbers without unit");
}

RegionWeightValues RegionWeights::evaluate(int tet, const Vec4& barycentric) const {
  const Eigen::Vector4i corner = mesh_.tets().col(tet);
  const Vec3 origin = mesh_.points().col(corner[0]);
  Mat3 edges;
  for (int k = 0; k < 3; ++k) edges.col(k) = mesh_.points().col(corner[k + 1]) - origin;
  const Mat3 to_gradient = edges.inverse().transpose();

  const int n = num_regions();
  RegionWeightValues result{Vector(n), Points(3, n)};
  for (int i = 0; i < n; ++i) {
    Vec4 d;
    for (int k = 0; k < 4; ++k) d[k] = distances_(i, corner[k]);
    const Bump w = weight(d.dot(barycentric), options_);
    result.values[i] = w.value;
    result.gradients.col(i) = w.slope * (to_gradient * (d.tail<3>().array() - d[0]).matrix());
  }
  const double sum = result.values.sum();
  if (!(sum > 0))
    throw ComputationError("region weights: no region reaches a point of tet " + std::to_string(tet) +
                           "; the regions leave a gap wider than the support");
  result.values /= sum;
  const Vec3 slope_of_sum = result.gradients.rowwise().sum();
  result.gradients = (result.gradients - slope_of_sum * result.values.transpose()) / sum;
  return result;
}

}  // namespace polyaffine
