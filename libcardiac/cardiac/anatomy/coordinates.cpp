#include "cardiac/anatomy/coordinates.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include <cardiac/anatomy/right_ventricle.hpp>
#include <polyaffine/core/error.hpp>
#include <polyaffine/fields/laplace.hpp>
#include <polyaffine/mesh/surface.hpp>

namespace cardiac {

using polyaffine::InputError;
using polyaffine::Mat3;
using polyaffine::Matrix;
using polyaffine::Points;
using polyaffine::Vec3;
using polyaffine::Vec4;
using polyaffine::Vector;

namespace {

// Of the polynomial whose direction is the radial one.
constexpr int kRadialDegree = 5;

// A unit vector v/|v| with its derivatives, column J by X_J.
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

std::string text(const Vec3& v) {
  std::ostringstream out;
  out << '(' << v.x() << ", " << v.y() << ", " << v.z() << ')';
  return out.str();
}

// Of the mean depth gradient of the left wall: what the even depth and the arc length get where the wall is
// not the left one.
constexpr double kOffWall = 0.1;
// Of the length of the cavity: nearer to the long axis a point says nothing about directions across it.
constexpr double kOnAxis = 0.05;
// Rotational coordinate of the anterior insertion of the right ventricle: between segments 1 and 2.
constexpr double kInsertion = polyaffine::kPi / 6;

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

void VentricularCoordinates::orient_by(const AnatomyOptions& options) {
  const auto across = [&](const Vec3& point, const char* name) {
    const Vec3 d = from_axis(point);
    if (!(d.norm() > kOnAxis * cavity_length_))
      throw InputError(std::string(name) + ": found " + text(point) + " mm, on the long axis " + text(axis_) +
                       ", expected a point in the wall");
    return Vec3(d.normalized());
  };
  if (options.septum_point) {
    orient(axis_.cross(across(*options.septum_point, "septum point (anatomy.septum_point, --septum-point)")));
  } else if (options.rv_insertion_point) {
    const Vec3 d = across(*options.rv_insertion_point,
                          "insertion point (anatomy.rv_insertion_point, --rv-insertion-point)");
    orient(std::cos(kInsertion) * d + std::sin(kInsertion) * axis_.cross(d));
  } else {
    orient(options.anterior.value_or(Vec3::UnitY()));
    anterior_assumed_ = !options.anterior;
  }
}

void VentricularCoordinates::orient(const Vec3& anterior) {
  const Vec3 across = anterior - anterior.dot(axis_) * axis_;
  if (!(across.norm() > 0.05 * anterior.norm()))  // about 3°: below it the direction says nothing
    throw InputError("anterior direction (anatomy.anterior_direction, --anterior): found " + text(anterior) +
                     ", parallel to the long axis " + text(axis_) + ", expected a direction across it");
  anterior_ = across.normalized();
  septal_ = -axis_.cross(anterior_);
}

void VentricularCoordinates::find_insertions(const polyaffine::TetMesh& mesh) {
  orient(axis_.unitOrthogonal());
  std::vector<double> angle, weight;
  double whole = 0;
  for (int t = 0; t < mesh.num_tets(); ++t) {
    const Vec4 centre = Vec4::Constant(0.25);
    const Vec3 X = mesh.tet_centroid(t);
    const double h = long_axis_height(X);
    if (h < 1.0 / 3 || h > 1 || right_->border(t, centre).w > 0.5) continue;
    const auto s = space_->element_sample(t, centre);
    const Vec3 d = from_axis(X);
    const double share =
        mesh.tet_volume(t) * std::abs(axis_.cross(d).dot(axis_.cross(s.slope(t_)))) / d.squaredNorm();
    whole += share;
    if (right_->septal(t, centre) <= 0) continue;
    angle.push_back(plain_angle(X));
    weight.push_back(share);
  }
  const Arc septum = arc_of(angle, weight, whole);
  const double half = septum.half_width;
  if (!(half > 0 && half < 0.9 * polyaffine::kPi))
    throw InputError("septum: found " + std::to_string(2 * half * 180 / polyaffine::kPi) +
                     " degrees of the left ventricle between the two endocardia, expected more than 0 and "
                     "less than 324");
  orient(axis_.cross(std::cos(septum.middle) * anterior_ + std::sin(septum.middle) * septal_));

  const double quarter = (polyaffine::kPi - half) / 2;
  std::vector<double> from, to;
  for (int turn = -2; turn <= 1; ++turn)
    for (int k = 0; k < 6; ++k) {  // anterior insertion, middle of the septum, inferior insertion, the rest
      const double at = k < 3 ? (k - 1) * half : half + (k - 2) * quarter;
      from.push_back(polyaffine::kPi / 2 + at + turn * 2 * polyaffine::kPi);
      to.push_back(polyaffine::kPi / 6 + k * polyaffine::kPi / 3 + turn * 2 * polyaffine::kPi);
    }
  stretch_.emplace(from, to);
}

Vec3 VentricularCoordinates::from_axis(const Vec3& X) const {
  const Vec3 d = X - base_centre_;
  return d - d.dot(axis_) * axis_;
}

void VentricularCoordinates::solve_transmural(const polyaffine::TetMesh& mesh, const SurfaceLabels& labels) {
  std::vector<polyaffine::NodeValue> values;
  for (const int n : space_->surface_nodes(mesh, {labels.endo})) values.push_back({n, 0.0});
  for (const int n : space_->surface_nodes(mesh, {labels.epi})) values.push_back({n, 1.0});
  if (right_)
    for (const int n : space_->surface_nodes(mesh, {*labels.rv_endo})) values.push_back({n, 1.0});
  const Vector harmonic = right_ ? right_->left_depth() : polyaffine::solve_laplace(*space_, values);
  const polyaffine::WallPoints points = space_->wall_points(3);
  Vector steepness(points.weights.size());
  Vector left = points.weights;  // zero beyond the left wall and the septum
  for (Eigen::Index q = 0; q < steepness.size(); ++q) {
    const auto s = space_->element_sample(points.tet[q], points.barycentric.col(q));
    steepness[q] = s.slope(harmonic).norm();
    if (right_ && s.value(right_->transventricular()) > 0.5) left[q] = 0;
  }
  if (right_) least_steepness_ = kOffWall * left.dot(steepness) / left.sum();
  t_ = polyaffine::solve_diffusion(
      *space_, points,
      [&](std::size_t q) {
        return polyaffine::DiffusionPoint{
            std::max(steepness[static_cast<Eigen::Index>(q)], least_steepness_) * Mat3::Identity()};
      },
      values);
  Points X(3, points.barycentric.cols()), gradient(3, X.cols());
  for (Eigen::Index q = 0; q < X.cols(); ++q) {
    const auto s = space_->element_sample(points.tet[q], points.barycentric.col(q));
    X.col(q) = s.value(space_->nodes());
    gradient.col(q) = s.slope(t_);
  }
  std::vector<Eigen::Index> inside;
  for (Eigen::Index q = 0; q < left.size(); ++q)
    if (left[q] > 0) inside.push_back(q);
  radial_.emplace(X(Eigen::all, inside), gradient(Eigen::all, inside), left(inside), kRadialDegree);
}

void VentricularCoordinates::solve_apicobasal(const polyaffine::TetMesh& mesh, const SurfaceLabels& labels) {
  std::vector<polyaffine::NodeValue> values;
  for (const int n : space_->surface_nodes(mesh, {labels.base}))
    values.push_back({n, 1 / from_axis(space_->nodes().col(n)).norm()});
  const polyaffine::WallPoints points = space_->wall_points(4);
  slope_ = polyaffine::solve_diffusion(
      *space_, points,
      [&](std::size_t q) {
        const auto k = static_cast<Eigen::Index>(q);
        const auto s = space_->element_sample(points.tet[q], points.barycentric.col(k));
        const Vec3 d = from_axis(s.value(space_->nodes()));
        const double r = d.norm();
        const double steepness = std::max(s.slope(t_).norm(), least_steepness_);
        return polyaffine::DiffusionPoint{steepness / r * Mat3::Identity(), r, d / r};
      },
      values);

  rest_.resize(slope_.size());
  for (Eigen::Index n = 0; n < slope_.size(); ++n)
    rest_[n] = 1 - slope_[n] * from_axis(space_->nodes().col(n)).norm();
  for (const auto& [node, value] : values) rest_[node] = 0;
  double volume = 0, flux = 0;
  for (int t = 0; t < mesh.num_tets(); ++t) {
    const CoordinateSample at = sample(t, Vec4::Constant(0.25));
    if (at.w > 0.5) continue;
    const double share = mesh.tet_volume(t);
    volume += share;
    flux += share * at.grad_u.norm();
  }
  arc_length_ = volume / flux;
}

CoordinateSample VentricularCoordinates::sample(int tet, const Vec4& barycentric) const {
  const auto s = space_->element_sample(tet, barycentric);
  CoordinateSample out;
  out.t = s.value(t_);
  out.grad_t = s.slope(t_);

  const Vec3 X = s.value(space_->nodes());
  const Vec3 d = from_axis(X);
  const double r = std::max(d.norm(), 1e-6);
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
  const double sum = r * g + h;
  out.u = r * g / sum;
  out.grad_u = (h * grad_rg - r * g * s.slope(rest_)) / (sum * sum);

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
  return out;
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
  return long_axis_height(X) < 1.0 / 3 ? plain_angle(X) : angle(X);
}

}  // namespace cardiac
