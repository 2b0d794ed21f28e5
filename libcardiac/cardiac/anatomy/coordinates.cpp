#include "cardiac/anatomy/coordinates.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include <polyaffine/core/error.hpp>
#include <polyaffine/core/monotone_cubic.hpp>
#include <polyaffine/geometry/laplace.hpp>
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

// Share of the wall thickness over which the radial direction is smoothed.
constexpr double kSmoothing = 0.3;

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

// The one open edge of the endocardium, which must run along the base.
std::vector<int> cavity_rim(const polyaffine::TetMesh& mesh, const SurfaceLabels& labels) {
  const auto loops = polyaffine::rim_loops(mesh.surface({labels.endo}));
  if (loops.size() != 1)
    throw InputError("open cavity: found " + std::to_string(loops.size()) +
                     " rims of the endocardium, expected one, at the base");
  const std::vector<int> base = mesh.surface_points({labels.base});
  for (const int p : loops.front())
    if (!std::binary_search(base.begin(), base.end(), p))
      throw InputError("open cavity: found the rim of the endocardium off the base at " +
                       text(mesh.points().col(p)) +
                       " mm, expected the endocardium to reach the base all round");
  return loops.front();
}

Vec3 mean_normal(const polyaffine::TetMesh& mesh, int label) {
  Vec3 sum = Vec3::Zero();
  const polyaffine::Triangles faces = mesh.surface({label});
  for (Eigen::Index f = 0; f < faces.cols(); ++f) {
    const Vec3 a = mesh.points().col(faces(0, f));
    sum += (mesh.points().col(faces(1, f)) - a).cross(mesh.points().col(faces(2, f)) - a);
  }
  return sum.normalized();
}

// Middle of a closed line by its length: vertices that crowd on one side do not draw it
// there.
Vec3 rim_centre(const polyaffine::TetMesh& mesh, const std::vector<int>& rim) {
  Vec3 sum = Vec3::Zero();
  double length = 0;
  for (std::size_t k = 0; k < rim.size(); ++k) {
    const Vec3 a = mesh.points().col(rim[k]);
    const Vec3 b = mesh.points().col(rim[(k + 1) % rim.size()]);
    sum += (b - a).norm() * (a + b) / 2;
    length += (b - a).norm();
  }
  return sum / length;
}

}  // namespace

VentricularCoordinates::VentricularCoordinates(const polyaffine::TetMesh& mesh, const SurfaceLabels& labels,
                                               const AnatomyOptions& options) {
  require_label(mesh, labels.endo, "endo");
  require_label(mesh, labels.epi, "epi");
  require_label(mesh, labels.base, "base");
  find_axis(mesh, labels, options);
  space_ = std::make_shared<polyaffine::LagrangeBasis>(
      mesh, 2, options.midpoints ? *options.midpoints : polyaffine::smooth_midpoints(mesh));
  solve_transmural(mesh, labels);
  solve_apicobasal(mesh, labels);
  build_axes();
}

void VentricularCoordinates::find_axis(const polyaffine::TetMesh& mesh, const SurfaceLabels& labels,
                                       const AnatomyOptions& options) {
  axis_ = options.long_axis ? options.long_axis->normalized() : mean_normal(mesh, labels.base);
  base_centre_ = rim_centre(mesh, cavity_rim(mesh, labels));
  for (const int p : mesh.surface_points({labels.endo}))
    cavity_length_ = std::max(cavity_length_, -axis_.dot(mesh.points().col(p) - base_centre_));

  const Vec3 across = options.anterior - options.anterior.dot(axis_) * axis_;
  if (!(across.norm() > 0.05 * options.anterior.norm()))  // about 3°: below it the direction says nothing
    throw InputError("anterior direction (anatomy.anterior_direction, --anterior): found " +
                     text(options.anterior) + ", parallel to the long axis " + text(axis_) +
                     ", expected a direction across it");
  anterior_ = across.normalized();
  septal_ = -axis_.cross(anterior_);
}

void VentricularCoordinates::solve_transmural(const polyaffine::TetMesh& mesh, const SurfaceLabels& labels) {
  std::vector<polyaffine::NodeValue> values;
  for (const int n : space_->surface_nodes(mesh, {labels.endo})) values.push_back({n, 0.0});
  for (const int n : space_->surface_nodes(mesh, {labels.epi})) values.push_back({n, 1.0});
  t_ = polyaffine::solve_laplace(*space_, values);
}

void VentricularCoordinates::solve_apicobasal(const polyaffine::TetMesh& mesh, const SurfaceLabels& labels) {
  // A singular line needs a core with nodes in it: half an edge about the axis, in the wall below the cavity.
  const double edge = std::cbrt(6 * std::sqrt(2.0) * mesh.volume() / mesh.num_tets());
  std::vector<polyaffine::NodeValue> values;
  for (double core = 0.5 * edge; values.empty(); core *= 1.2)
    for (int n = 0; n < space_->num_functions(); ++n) {
      const Vec3 d = space_->nodes().col(n) - base_centre_;
      const double height = d.dot(axis_);
      if (height < -0.9 * cavity_length_ && (d - height * axis_).norm() < core) values.push_back({n, 0.0});
    }
  for (const int n : space_->surface_nodes(mesh, {labels.base})) values.push_back({n, 1.0});
  const Vector raw = polyaffine::solve_laplace(*space_, values);

  constexpr int kLevels = 40;
  Vector volume = Vector::Zero(kLevels);
  Vector flux = Vector::Zero(kLevels);
  const polyaffine::WallPoints points = space_->wall_points(2);
  for (std::size_t q = 0; q < points.tet.size(); ++q) {
    const auto k = static_cast<Eigen::Index>(q);
    const auto s = space_->sample(points.tet[q], points.barycentric.col(k));
    const Vector nodal = raw(s.functions);
    const int level = std::clamp(static_cast<int>(kLevels * s.N.dot(nodal)), 0, kLevels - 1);
    volume[level] += points.weights[k];
    flux[level] += points.weights[k] * (s.gradient * nodal).norm();
  }
  std::vector<double> at{0.0}, length{0.0};
  for (int level = 0; level < kLevels; ++level) {
    if (flux[level] <= 0) continue;
    const double next = (level + 1.0) / kLevels;
    length.push_back(length.back() + (next - at.back()) * volume[level] / flux[level]);
    at.push_back(next);
  }
  arc_length_ = length.back();
  const polyaffine::MonotoneCubic arc(at, length);
  u_.resize(raw.size());
  for (Eigen::Index n = 0; n < raw.size(); ++n) u_[n] = std::clamp(arc(raw[n]).first / arc_length_, 0.0, 1.0);
}

void VentricularCoordinates::build_axes() {
  // ∂Q multiplies the displacement itself, so the noise of ∇t must go: smoothed over a share of the wall.
  const polyaffine::WallPoints points = space_->wall_points(4);
  Points radial(3, points.barycentric.cols());
  double thickness = 0;
  for (Eigen::Index q = 0; q < radial.cols(); ++q) {
    const auto s = space_->sample(points.tet[q], points.barycentric.col(q));
    const Vec3 gradient = s.gradient * t_(s.functions);
    radial.col(q) = gradient.normalized();
    thickness += points.weights[q] / gradient.norm();
  }
  thickness /= points.weights.sum();
  const Matrix smooth = polyaffine::smooth_projection(*space_, points, radial, kSmoothing * thickness);
  axes_.resize(9, smooth.cols());
  for (Eigen::Index n = 0; n < smooth.cols(); ++n) {
    const Vec3 e_r = smooth.col(n).normalized();
    Vec3 e_c = axis_.cross(e_r);
    if (e_c.norm() < 1e-6) e_c = septal_;  // on the axis itself no direction is distinguished
    e_c.normalize();
    axes_.col(n) << e_r.cross(e_c).normalized(), e_c, e_r;
  }
}

CoordinateSample VentricularCoordinates::sample(int tet, const Vec4& barycentric) const {
  const auto s = space_->sample(tet, barycentric);
  CoordinateSample out;
  out.u = s.N.dot(u_(s.functions));
  out.t = s.N.dot(t_(s.functions));
  out.grad_u = s.gradient * u_(s.functions);
  out.grad_t = s.gradient * t_(s.functions);
  const Matrix nodal = axes_(Eigen::all, s.functions);
  out.Q = (nodal * s.N).reshaped(3, 3);
  for (int J = 0; J < 3; ++J) out.dQ[J] = (nodal * s.gradient.row(J).transpose()).reshaped(3, 3);

  const Vec3 d = space_->nodes()(Eigen::all, s.functions) * s.N - base_centre_;
  const double x = d.dot(anterior_);
  const double y = d.dot(septal_);
  const double r2 = std::max(x * x + y * y, 1e-12);
  out.psi = std::atan2(y, x);
  out.grad_psi = (x * septal_ - y * anterior_) / r2;
  return out;
}

Vec3 VentricularCoordinates::position(int tet, const Vec4& barycentric) const {
  return space_->position(tet, barycentric);
}

double VentricularCoordinates::long_axis_height(const Vec3& X) const {
  return 1 + axis_.dot(X - base_centre_) / cavity_length_;
}

double VentricularCoordinates::angle(const Vec3& X) const {
  const Vec3 d = X - base_centre_;
  return std::atan2(d.dot(septal_), d.dot(anterior_));
}

}  // namespace cardiac
