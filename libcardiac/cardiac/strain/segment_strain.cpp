#include "cardiac/strain/segment_strain.hpp"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>
#include <limits>

#include <cardiac/anatomy/segments.hpp>
#include <cardiac/fibres/helix.hpp>

namespace cardiac {

using polyaffine::Mat3;
using polyaffine::Matrix;
using polyaffine::Points;
using polyaffine::Vec3;

SegmentGauge::SegmentGauge(const VentricularCoordinates& coordinates, const polyaffine::WallPoints& points)
    : coordinates_(coordinates), X_(3, points.barycentric.cols()), weights_(points.weights) {
  for (Eigen::Index q = 0; q < X_.cols(); ++q) {
    X_.col(q) = coordinates.position(points.tet[q], points.barycentric.col(q));
    segment_.push_back(segment_at(coordinates, points.tet[q], points.barycentric.col(q), X_.col(q)));
    axes_.push_back(orthonormal_axes(coordinates.wall_sample(points.tet[q], points.barycentric.col(q))));
  }
}

std::vector<Mat3> SegmentGauge::reference_axes(const Matrix& F_ed) const {
  std::vector<Mat3> out;
  for (Eigen::Index q = 0; q < F_ed.cols(); ++q) {
    const Mat3 reference = F_ed.col(q).reshaped(3, 3);
    const Eigen::JacobiSVD<Mat3> svd(reference, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const Mat3 rotation = svd.matrixU() * svd.matrixV().transpose();
    out.emplace_back(reference.inverse() * rotation * axes_[q]);
  }
  return out;
}

std::vector<SegmentStrain> SegmentGauge::strain(const Matrix& F, const Matrix& F_ed) const {
  return strain(F, reference_axes(F_ed));
}

std::vector<SegmentStrain> SegmentGauge::strain(const Matrix& F,
                                                const std::vector<Mat3>& reference_axes) const {
  const int count = num_segments(coordinates_);
  std::vector<SegmentStrain> mean(count, SegmentStrain{0, 0, 0, 0, 0, 0, 0});
  std::vector<double> volume(count, 0.0);
  for (Eigen::Index q = 0; q < F.cols(); ++q) {
    const Mat3 relative = F.col(q).reshaped(3, 3) * reference_axes[q];
    const Mat3 C = relative.transpose() * relative;
    const double w = weights_[q];
    SegmentStrain& s = mean[segment_[q] - 1];
    volume[segment_[q] - 1] += w;
    s.longitudinal += w * (std::sqrt(C(0, 0)) - 1);
    s.circumferential += w * (std::sqrt(C(1, 1)) - 1);
    s.radial += w * (std::sqrt(C(2, 2)) - 1);
    s.shear_lc += w * 0.5 * C(0, 1);
    s.shear_lr += w * 0.5 * C(0, 2);
    s.shear_cr += w * 0.5 * C(1, 2);
    s.volume_ratio += w * std::abs(relative.determinant());
  }
  for (int k = 0; k < count; ++k)
    for (double* value : {&mean[k].longitudinal, &mean[k].circumferential, &mean[k].radial, &mean[k].shear_lc,
                          &mean[k].shear_lr, &mean[k].shear_cr, &mean[k].volume_ratio})
      *value /= volume[k];
  return mean;
}

std::vector<Mat3> SegmentGauge::green_lagrange(const Matrix& F) const {
  const int count = num_segments(coordinates_);
  std::vector<Mat3> mean(count, Mat3::Zero());
  std::vector<double> volume(count, 0.0);
  for (Eigen::Index q = 0; q < F.cols(); ++q) {
    const Mat3 in_axes = F.col(q).reshaped(3, 3) * axes_[q];
    mean[segment_[q] - 1] += weights_[q] / 2 * (in_axes.transpose() * in_axes - Mat3::Identity());
    volume[segment_[q] - 1] += weights_[q];
  }
  for (int k = 0; k < count; ++k) mean[k] /= volume[k];
  return mean;
}

std::vector<double> SegmentGauge::rotation_deg(const Points& x, const Points& x_ed) const {
  const int count = num_segments(coordinates_);
  std::vector<double> sum(count, 0.0), volume(count, 0.0);
  for (Eigen::Index q = 0; q < x.cols(); ++q) {
    const double turn = coordinates_.plain_angle(x.col(q)) - coordinates_.plain_angle(x_ed.col(q));
    sum[segment_[q] - 1] += weights_[q] * std::remainder(turn, 2 * polyaffine::kPi);
    volume[segment_[q] - 1] += weights_[q];
  }
  for (int k = 0; k < count; ++k) sum[k] *= 180 / polyaffine::kPi / volume[k];
  return sum;
}

namespace {

// Means of the segments from number first + 1 to last.
GlobalStrain mean_strain(const std::vector<SegmentStrain>& strain, const std::vector<double>& volumes,
                         std::size_t first, std::size_t last) {
  GlobalStrain out;
  double total = 0;
  for (std::size_t k = first; k < last; ++k) {
    total += volumes[k];
    out.gls_percent += 100 * volumes[k] * strain[k].longitudinal;
    out.gcs_percent += 100 * volumes[k] * strain[k].circumferential;
    out.grs_percent += 100 * volumes[k] * strain[k].radial;
  }
  for (double* mean : {&out.gls_percent, &out.gcs_percent, &out.grs_percent}) *mean /= total;
  return out;
}

}  // namespace

GlobalStrain global_strain(const std::vector<SegmentStrain>& strain, const std::vector<double>& rotation_deg,
                           const std::vector<double>& volumes) {
  GlobalStrain out = mean_strain(strain, volumes, 0, kAhaSegments);
  double apical = 0, apical_volume = 0, basal = 0, basal_volume = 0;
  for (std::size_t k = 0; k < kAhaSegments; ++k) {
    const int ring = aha_ring(static_cast<int>(k) + 1);
    if (ring == 1) {
      apical += volumes[k] * rotation_deg[k];
      apical_volume += volumes[k];
    } else if (ring == 3) {
      basal += volumes[k] * rotation_deg[k];
      basal_volume += volumes[k];
    }
  }
  out.twist_deg = apical / apical_volume - basal / basal_volume;
  return out;
}

GlobalStrain right_global_strain(const std::vector<SegmentStrain>& strain,
                                 const std::vector<double>& volumes) {
  GlobalStrain out = mean_strain(strain, volumes, kAhaSegments, kBothSegments);
  out.twist_deg = std::numeric_limits<double>::quiet_NaN();
  return out;
}

}  // namespace cardiac
