#include "cardiac/anatomy/coordinates.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>

#include <cardiac/anatomy/right_ventricle.hpp>
#include <polyaffine/core/error.hpp>

namespace cardiac {

using polyaffine::InputError;
using polyaffine::Mat3;
using polyaffine::Matrix;
using polyaffine::Vec3;
using polyaffine::Vec4;
using polyaffine::Vector;

namespace {

// Distances from the long axis are taken as this at least, mm: the directions about the axis end there.
constexpr double kAxisRadius = 1e-6;
// The apical third of the long axis, in which AHA counts four sectors.
constexpr double kApicalThird = 1.0 / 3;

// The unit vector e = v/|v| and its gradient ∂e/∂X_J (column J), from that of v: (1 − e eᵀ) ∇v / |v|.
struct Direction {
  Vec3 value;
  Mat3 gradient;
};
Direction direction(const Vec3& v, const Mat3& gradient) {
  const double length = v.norm();
  const Vec3 unit = v / length;
  return {unit, (gradient - unit * (unit.transpose() * gradient)) / length};
}

void require_label(const polyaffine::TetMesh& mesh, int label, const char* name) {
  const std::set<int> labels(mesh.boundary_labels().begin(), mesh.boundary_labels().end());
  if (labels.contains(label)) return;
  std::string found;
  for (const int l : labels)
    found += (found.empty() ? "" : ", ") +
             (l == polyaffine::TetMesh::kUnlabelled ? std::string("none") : std::to_string(l));
  throw InputError(std::string("mesh: found no boundary triangle with the label ") + std::to_string(label) +
                   " of the surface \"" + name + "\" (labels found: " + found + "), expected one; " + name +
                   "_label must be a label of the mesh");
}

}  // namespace

VentricularCoordinates::VentricularCoordinates(const polyaffine::TetMesh& mesh, const SurfaceLabels& labels,
                                               const AnatomyOptions& options) {
  require_label(mesh, labels.endo, "endo");
  require_label(mesh, labels.epi, "epi");
  require_label(mesh, labels.base, "base");
  if (labels.rv_endo) require_label(mesh, *labels.rv_endo, "rv_endo");
  long_axis_ = find_long_axis(mesh, labels, options.long_axis, options.mitral_point);
  axis_ = long_axis_.direction;
  base_centre_ = long_axis_.base_centre;
  for (const int p : mesh.surface_points({labels.endo}))
    cavity_length_ = std::max(cavity_length_, -axis_.dot(mesh.points().col(p) - base_centre_));
  space_ = std::make_shared<polyaffine::LagrangeBasis>(
      mesh, 2, options.midpoints ? *options.midpoints : polyaffine::smooth_midpoints(mesh));
  if (labels.rv_endo) right_ = std::make_shared<RightVentricularCoordinates>(mesh, labels, space_);
  solve_transmural(mesh, labels);
  if (right_)
    find_insertions(mesh);
  else
    orient_by(options);
  solve_apicobasal(mesh, labels);
  if (right_) right_->settle(mesh, labels, axis_, anterior_);
}

bool VentricularCoordinates::is_whole() const {
  if (!space_ || !radial_ || radial_->num_components() != 3) return false;
  const Eigen::Index n = space_->num_functions();
  return space_->order() == 2 && t_.size() == n && slope_.size() == n && rest_.size() == n &&
         (!right_ || right_->transventricular().size() == n);
}

Vec3 VentricularCoordinates::from_axis(const Vec3& X) const {
  const Vec3 d = X - base_centre_;
  return d - d.dot(axis_) * axis_;
}

CoordinateSample VentricularCoordinates::sample(int tet, const Vec4& barycentric) const {
  const auto s = space_->element_sample(tet, barycentric);
  CoordinateSample out;
  out.t = s.value(t_);
  out.grad_t = s.slope(t_);

  const Vec3 X = s.value(space_->nodes());
  const Vec3 d = from_axis(X);
  const double r = std::max(d.norm(), kAxisRadius);
  const Vec3 away = d / r;
  out.psi = std::atan2(d.dot(septal_), d.dot(anterior_));
  out.grad_psi = -axis_.cross(away) / r;
  if (stretch_) {
    const auto [psi, slope] = (*stretch_)(out.psi);
    out.psi = std::remainder(psi, 2 * polyaffine::kPi);
    out.grad_psi *= slope;
  }
  if (right_) out.w = s.value(right_->transventricular());

  const double g = s.value(slope_);
  const double h = s.value(rest_);
  const Vec3 grad_rg = r * s.slope(slope_) + g * away;
  const double rg = r * g;
  const double sum = rg + h;
  out.u = rg / sum;
  out.grad_u = (h * grad_rg - rg * s.slope(rest_)) / (sum * sum);

  set_axes(X, away, r, out);
  return out;
}

// In the words of `sample`, so that rounding is the same.
CoordinatePlace VentricularCoordinates::place(int tet, const Vec4& barycentric) const {
  CoordinatePlace out;
  out.t = space_->interpolate(t_, tet, barycentric);
  const Vec3 d = from_axis(space_->position(tet, barycentric));
  const double r = std::max(d.norm(), kAxisRadius);
  out.psi = std::atan2(d.dot(septal_), d.dot(anterior_));
  if (stretch_) out.psi = std::remainder((*stretch_)(out.psi).first, 2 * polyaffine::kPi);
  const double rg = r * space_->interpolate(slope_, tet, barycentric);
  const double sum = rg + space_->interpolate(rest_, tet, barycentric);
  out.u = rg / sum;
  return out;
}

// e_r is the direction of the radial polynomial, e_c that of rotation, a × e_away, made perpendicular to it,
// and e_l = e_r × e_c; the derivatives follow by the product rule.
void VentricularCoordinates::set_axes(const Vec3& X, const Vec3& away, double r,
                                      CoordinateSample& out) const {
  const auto radial = radial_->sample(X);
  const Direction e_r = direction(radial.value, radial.gradient);
  const Vec3 round = axis_.cross(away);
  const Mat3 round_gradient = -away * round.transpose() / r;
  const Direction e_c =
      direction(round - round.dot(e_r.value) * e_r.value,
                round_gradient - round.dot(e_r.value) * e_r.gradient -
                    e_r.value * (round.transpose() * e_r.gradient + e_r.value.transpose() * round_gradient));
  out.Q << e_r.value.cross(e_c.value), e_c.value, e_r.value;
  for (int J = 0; J < 3; ++J) {
    const Vec3 dr = e_r.gradient.col(J);
    const Vec3 dc = e_c.gradient.col(J);
    out.dQ[J] << dr.cross(e_c.value) + e_r.value.cross(dc), dc, dr;
  }
}

CoordinateSample VentricularCoordinates::wall_sample(int tet, const Vec4& barycentric) const {
  return right_ && right_->border(tet, barycentric).w > 0.5 ? right_sample(tet, barycentric)
                                                            : sample(tet, barycentric);
}

CoordinateSample VentricularCoordinates::right_sample(int tet, const Vec4& barycentric) const {
  CoordinateSample out = sample(tet, barycentric);
  const auto right = right_->sample(tet, barycentric);
  out.t = right.t;
  out.grad_t = right.grad_t;
  const Vec3 e_r = right.grad_t.normalized();
  const Vec3 e_l = (out.grad_u - out.grad_u.dot(e_r) * e_r).normalized();
  out.Q << e_l, e_l.cross(e_r), e_r;
  out.dQ.fill(Mat3::Zero());
  return out;
}

Vector VentricularCoordinates::apicobasal() const {
  Vector u(slope_.size());
  for (Eigen::Index n = 0; n < u.size(); ++n) {
    const double rg = slope_[n] * from_axis(space_->nodes().col(n)).norm();
    u[n] = rg / (rg + rest_[n]);
  }
  return u;
}

Matrix VentricularCoordinates::axes() const {
  Matrix out(9, t_.size());
  const Eigen::Matrix4Xd corners = space_->node_barycentric();
  for (Eigen::Index t = 0; t < space_->elements().cols(); ++t)
    for (Eigen::Index k = 0; k < corners.cols(); ++k)
      out.col(space_->elements()(k, t)) = sample(static_cast<int>(t), corners.col(k)).Q.reshaped();
  return out;
}

Vec3 VentricularCoordinates::position(int tet, const Vec4& barycentric) const {
  return space_->position(tet, barycentric);
}

double VentricularCoordinates::long_axis_height(const Vec3& X) const {
  return 1 + axis_.dot(X - base_centre_) / cavity_length_;
}

double VentricularCoordinates::angle(const Vec3& X) const {
  const double plain = plain_angle(X);
  return stretch_ ? std::remainder((*stretch_)(plain).first, 2 * polyaffine::kPi) : plain;
}

double VentricularCoordinates::plain_angle(const Vec3& X) const {
  const Vec3 d = X - base_centre_;
  return std::atan2(d.dot(septal_), d.dot(anterior_));
}

double VentricularCoordinates::sector_angle(const Vec3& X) const {
  return long_axis_height(X) < kApicalThird ? plain_angle(X) : angle(X);
}

}  // namespace cardiac
