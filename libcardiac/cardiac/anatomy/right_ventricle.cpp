#include "cardiac/anatomy/right_ventricle.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include <polyaffine/core/error.hpp>
#include <polyaffine/fields/laplace.hpp>
#include <polyaffine/mesh/surface.hpp>

namespace cardiac {

using polyaffine::InputError;
using polyaffine::kPi;
using polyaffine::LagrangeBasis;
using polyaffine::NodeValue;
using polyaffine::Vec3;
using polyaffine::Vec4;
using polyaffine::Vector;

namespace {

// The borders of the right free wall are averaged above this share of the cavity's height: below it the wall
// closes to the apex, where angles about the axis mean little.
constexpr double kArcFrom = 0.2;
// Values of w between which one ventricle gives way to the other: w only comes close to 0 and 1 in the wall.
constexpr double kLeftEnd = 0.1, kRightEnd = 0.9;
// The bottom of a cavity is its surface below this share of its height, and what is lowest depends on the
// axis that is looked for: a few rounds settle both.
constexpr double kBottom = 0.1;
constexpr int kAxisRounds = 5;
// Distances from the axis are taken as this at least, mm: the directions about it end there.
constexpr double kAxisRadius = 1e-6;

void prescribe(std::vector<NodeValue>& values, const std::vector<int>& nodes, double value) {
  for (const int n : nodes) values.push_back({n, value});
}

}  // namespace

Arc arc_of(const std::vector<double>& angle, const std::vector<double>& weight, double whole) {
  double sum = 0, sine = 0, cosine = 0;
  for (std::size_t k = 0; k < angle.size(); ++k) {
    sum += weight[k];
    sine += weight[k] * std::sin(angle[k]);
    cosine += weight[k] * std::cos(angle[k]);
  }
  return {std::atan2(sine, cosine), kPi * sum / whole};
}

// Begins with the point of the surface that is farthest from the rim.
CavityAxis cavity_axis(const polyaffine::TetMesh& mesh, int label, const Vec3& rim) {
  const polyaffine::Triangles faces = mesh.surface({label});
  const Vector areas = polyaffine::triangle_areas(mesh.points(), faces);
  const auto middle = [&](Eigen::Index f) {
    return Vec3(mesh.points()(Eigen::all, faces.col(f)).rowwise().mean());
  };
  CavityAxis out{Vec3::Zero(), rim};
  for (const int p : mesh.surface_points({label}))
    if ((mesh.points().col(p) - rim).norm() > (out.bottom - rim).norm()) out.bottom = mesh.points().col(p);
  for (int iteration = 0; iteration < kAxisRounds; ++iteration) {
    out.direction = (rim - out.bottom).normalized();
    double lowest = 0;
    for (Eigen::Index f = 0; f < faces.cols(); ++f)
      lowest = std::min(lowest, out.direction.dot(middle(f) - rim));
    Vec3 sum = Vec3::Zero();
    double area = 0;
    for (Eigen::Index f = 0; f < faces.cols(); ++f) {
      if (out.direction.dot(middle(f) - rim) > (1 - kBottom) * lowest) continue;
      sum += areas[f] * middle(f);
      area += areas[f];
    }
    out.bottom = sum / area;
  }
  out.direction = (rim - out.bottom).normalized();
  return out;
}

Vec3 rim_centre(const polyaffine::TetMesh& mesh, int label, int base_label) {
  const auto loops = polyaffine::rim_loops(mesh.surface({label}));
  if (loops.empty())
    throw InputError("closed cavity: the endocardium with the label " + std::to_string(label) +
                     " has no rim, expected one at the base");
  const std::vector<int> base = mesh.surface_points({base_label});
  Vec3 sum = Vec3::Zero();
  double length = 0;
  for (const auto& rim : loops)
    for (std::size_t k = 0; k < rim.size(); ++k) {
      const Vec3 a = mesh.points().col(rim[k]);
      const Vec3 b = mesh.points().col(rim[(k + 1) % rim.size()]);
      if (!std::binary_search(base.begin(), base.end(), rim[k]))
        throw InputError("open cavity: found the rim of the endocardium with the label " +
                         std::to_string(label) + " off the base, expected it to reach the base all round");
      sum += (b - a).norm() * (a + b) / 2;
      length += (b - a).norm();
    }
  return sum / length;
}

RightVentricularCoordinates::RightVentricularCoordinates(const polyaffine::TetMesh& mesh,
                                                         const SurfaceLabels& labels,
                                                         std::shared_ptr<const LagrangeBasis> space)
    : space_(std::move(space)) {
  const auto left = space_->surface_nodes(mesh, {labels.endo});
  const auto right = space_->surface_nodes(mesh, {*labels.rv_endo});
  const auto epi = space_->surface_nodes(mesh, {labels.epi});
  std::vector<NodeValue> for_v, for_q, for_t0, for_t;
  for (auto* values : {&for_v, &for_q, &for_t0}) prescribe(*values, left, 0);
  for (auto* values : {&for_v, &for_t0}) prescribe(*values, right, 1);
  for (auto* values : {&for_q, &for_t0, &for_t}) prescribe(*values, epi, 1);
  prescribe(for_t, right, 0);
  const polyaffine::DiffusionProblem laplace = polyaffine::laplace_problem(*space_);
  const Vector v = laplace.solve(for_v);
  const Vector q = laplace.solve(for_q);
  left_depth_ = laplace.solve(for_t0);
  w_ = q + v - left_depth_;
  septal_ = v - q;
  t_ = laplace.solve(for_t);
}

bool RightVentricularCoordinates::is_whole() const {
  if (!space_) return false;
  const Eigen::Index n = space_->num_functions();
  return w_.size() == n && septal_.size() == n && left_depth_.size() == n && t_.size() == n;
}

void RightVentricularCoordinates::settle(const polyaffine::TetMesh& mesh, const SurfaceLabels& labels,
                                         const Vec3& axis, const Vec3& anterior) {
  axis_ = axis;
  base_centre_ = rim_centre(mesh, *labels.rv_endo, labels.base);
  long_axis_ = cavity_axis(mesh, *labels.rv_endo, base_centre_).direction;
  anterior_ = (anterior - anterior.dot(long_axis_) * long_axis_).normalized();
  outward_ = -long_axis_.cross(anterior_);
  for (const int p : mesh.surface_points({*labels.rv_endo}))
    length_ = std::max(length_, -axis_.dot(mesh.points().col(p) - base_centre_));

  std::vector<double> angle, weight;
  for (int t = 0; t < mesh.num_tets(); ++t) {
    const Vec4 centre = Vec4::Constant(0.25);
    const double h = height(mesh.tet_centroid(t));
    if (h < kArcFrom || h > 1 || border(t, centre).w < 0.5) continue;
    const Sample at = sample(t, centre);
    angle.push_back(at.psi);
    weight.push_back(mesh.tet_volume(t) * std::abs(at.grad_psi.dot(at.grad_t.cross(axis_ / length_))));
  }
  const Arc arc = arc_of(angle, weight, 2 * kPi * (1 - kArcFrom));
  middle_ = arc.middle;
  half_angle_ = arc.half_width;
}

RightVentricularCoordinates::Border RightVentricularCoordinates::border(int tet,
                                                                        const Vec4& barycentric) const {
  const auto s = space_->element_sample(tet, barycentric);
  Border out;
  out.w = s.value(w_);
  const double x = std::clamp((out.w - kLeftEnd) / (kRightEnd - kLeftEnd), 0.0, 1.0);
  out.share = x * x * (3 - 2 * x);
  out.share_gradient = 6 * x * (1 - x) / (kRightEnd - kLeftEnd) * s.slope(w_);
  return out;
}

double RightVentricularCoordinates::septal(int tet, const Vec4& barycentric) const {
  return space_->interpolate(septal_, tet, barycentric);
}

Vec3 RightVentricularCoordinates::from_axis(const Vec3& X) const {
  const Vec3 d = X - base_centre_;
  return d - d.dot(long_axis_) * long_axis_;
}

RightVentricularCoordinates::Sample RightVentricularCoordinates::sample(int tet,
                                                                        const Vec4& barycentric) const {
  const auto s = space_->element_sample(tet, barycentric);
  Sample out;
  out.t = s.value(t_);
  out.grad_t = s.slope(t_);
  const Vec3 d = from_axis(s.value(space_->nodes()));
  const double r = std::max(d.norm(), kAxisRadius);
  const double angle = std::atan2(d.dot(outward_), d.dot(anterior_));
  out.psi = std::remainder(angle - middle_, 2 * kPi) / half_angle_;
  out.grad_psi = -long_axis_.cross(d) / (r * r * half_angle_);
  return out;
}

double RightVentricularCoordinates::height(const Vec3& X) const {
  return 1 + axis_.dot(X - base_centre_) / length_;
}

}  // namespace cardiac
