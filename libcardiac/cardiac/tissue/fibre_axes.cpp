#include <string>

#include <cardiac/tissue/fibre_axes.hpp>
#include <polyaffine/core/types.hpp>
#include <polyaffine/material/parameters.hpp>

namespace cardiac {

void require_orthonormal(const FibreAxes& axes) {
  for (Eigen::Index i = 0; i < axes.cols(); ++i) {
    const polyaffine::Mat3 R = axes.col(i).reshaped(3, 3);
    const double error = (R.transpose() * R - polyaffine::Mat3::Identity()).cwiseAbs().maxCoeff();
    polyaffine::require(error < 1e-6,
                        "fibre axes of point " + std::to_string(i) + ", largest entry of |RtR - I|", error,
                        "orthonormal f, s, n (below 1e-6, dimensionless)");
  }
}

FibrePacks::FibrePacks(const FibreAxes& axes) : size_(axes.cols()), rows_(size_ + polyaffine::kLanes, 9) {
  require_orthonormal(axes);
  rows_.topRows(size_) = axes.transpose();
  rows_.bottomRows(polyaffine::kLanes).rowwise() = polyaffine::Mat3::Identity().reshaped().transpose();
}

}  // namespace cardiac
