#include <cardiac/run/errors.hpp>

#include <algorithm>
#include <cmath>

#include <cardiac/anatomy/segments.hpp>

namespace cardiac {

using polyaffine::Mat3;
using polyaffine::MeshPoint;
using polyaffine::Points;
using polyaffine::Vec3;
using polyaffine::Vector;

namespace {

// Gauss points of this degree hold the errors to far below a per cent of themselves.
constexpr int kDegree = 2;

std::vector<MeshPoint> own_places(const polyaffine::WallPoints& points) {
  std::vector<MeshPoint> out;
  for (std::size_t q = 0; q < points.tet.size(); ++q)
    out.push_back({points.tet[q], points.barycentric.col(static_cast<Eigen::Index>(q))});
  return out;
}

double cavity_at_rest(const Ventricle& ventricle) {
  return ventricle.cavity_volume(Vector::Zero(ventricle.num_coefficients()));
}

}  // namespace

const polyaffine::LagrangeBasis& material_elements(const Ventricle& ventricle) {
  const auto* own = dynamic_cast<const polyaffine::LagrangeBasis*>(ventricle.discretisation.basis.get());
  return own ? *own : ventricle.anatomy->coordinates->space();
}

WallState wall_state(const polyaffine::Basis& basis, const Vector& c, const std::vector<MeshPoint>& at) {
  const auto n = static_cast<Eigen::Index>(at.size());
  WallState out{Points(3, n), polyaffine::Matrix(9, n)};
  for (Eigen::Index q = 0; q < n; ++q) {
    const auto sample = basis.sample(at[q].tet, at[q].barycentric);
    Vec3 plain = Vec3::Zero(), local = Vec3::Zero();
    Mat3 plain_gradient = Mat3::Zero(), local_gradient = Mat3::Zero();
    for (std::size_t k = 0; k < sample.functions.size(); ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      const Vec3 ca = c.segment<3>(3 * sample.functions[k]);
      const bool in_axes = basis.in_local_axes(sample.functions[k]);
      (in_axes ? local : plain) += sample.N[i] * ca;
      (in_axes ? local_gradient : plain_gradient) += ca * sample.gradient.col(i).transpose();
    }
    for (const auto& modes : sample.modes) {
      const Vec3 ca = c.segment<3>(3 * modes.function);
      plain += modes.value * ca;
      plain_gradient += (modes.gradient * ca).reshaped(3, 3);
    }
    Mat3 F = Mat3::Identity() + plain_gradient + sample.Q * local_gradient;
    for (int J = 0; J < 3; ++J) F.col(J) += sample.dQ[J] * local;
    out.u.col(q) = plain + sample.Q * local;
    out.F.col(q) = F.reshaped();
  }
  return out;
}

Yardstick::Yardstick(const Ventricle& reference, const Vector& c)
    : points_(material_elements(reference).wall_points(kDegree)),
      gauge_(*reference.anatomy->coordinates, points_),
      state_(wall_state(*reference.discretisation.basis, c, own_places(points_))),
      strain_(gauge_.green_lagrange(state_.F)),
      cavity_at_rest_(cavity_at_rest(reference)),
      cavity_(reference.cavity_volume(c)) {
  if (reference.cavities.size() > 1) right_cavity_ = reference.cavity_volume(c, 1);
}

ModelErrors Yardstick::errors(const Ventricle& model, const Vector& c) const {
  const polyaffine::ElementLocator locator(material_elements(model));
  std::vector<MeshPoint> at;
  for (Eigen::Index q = 0; q < positions().cols(); ++q) at.push_back(locator.locate(positions().col(q)));
  ModelErrors out =
      errors(wall_state(*model.discretisation.basis, c, at), cavity_at_rest(model), model.cavity_volume(c));
  if (right_cavity_ > 0) out.rv_volume_percent = 100 * (model.cavity_volume(c, 1) / right_cavity_ - 1);
  return out;
}

ModelErrors Yardstick::errors(const WallState& state, double at_rest, double cavity) const {
  ModelErrors out;
  const Vector difference = (state.u - state_.u).colwise().squaredNorm();
  const Vector size = state_.u.colwise().squaredNorm();
  out.displacement_percent = 100 * std::sqrt(points_.weights.dot(difference) / points_.weights.dot(size));
  out.volume_percent = 100 * (cavity / cavity_ - 1);
  out.compliance_ratio = (cavity - at_rest) / (cavity_ - cavity_at_rest_);
  const std::vector<Mat3> strain = gauge_.green_lagrange(state.F);
  if (static_cast<int>(strain.size()) > kAhaSegments) out.right_strain = 0;
  for (int s = 1; s <= static_cast<int>(strain.size()); ++s) {
    double& worst = s == kAhaSegments  ? out.apex_strain
                    : s > kAhaSegments ? out.right_strain
                                       : out.max_segment_strain;
    worst = std::max(worst, (strain[s - 1] - strain_[s - 1]).diagonal().cwiseAbs().maxCoeff());
  }
  return out;
}

}  // namespace cardiac
