#include "cardiac/anatomy/coordinates.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include <polyaffine/core/error.hpp>
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

Vec3 VentricularCoordinates::from_axis(const Vec3& X) const {
  const Vec3 d = X - base_centre_;
  return d - d.dot(axis_) * axis_;
}

void VentricularCoordinates::solve_transmural(const polyaffine::TetMesh& mesh, const SurfaceLabels& labels) {
  std::vector<polyaffine::NodeValue> values;
  for (const int n : space_->surface_nodes(mesh, {labels.endo})) values.push_back({n, 0.0});
  for (const int n : space_->surface_nodes(mesh, {labels.epi})) values.push_back({n, 1.0});
  const Vector harmonic = polyaffine::solve_laplace(*space_, values);
  const polyaffine::WallPoints points = space_->wall_points(3);
  t_ = polyaffine::solve_diffusion(
      *space_, points,
      [&](std::size_t q) {
        const auto s = space_->sample(points.tet[q], points.barycentric.col(static_cast<Eigen::Index>(q)));
        return polyaffine::DiffusionPoint{(s.gradient * harmonic(s.functions)).norm() * Mat3::Identity()};
      },
      values);
  Points X(3, points.barycentric.cols()), gradient(3, X.cols());
  for (Eigen::Index q = 0; q < X.cols(); ++q) {
    const auto s = space_->sample(points.tet[q], points.barycentric.col(q));
    X.col(q) = space_->nodes()(Eigen::all, s.functions) * s.N;
    gradient.col(q) = s.gradient * t_(s.functions);
  }
  radial_.emplace(X, gradient, points.weights, kRadialDegree);
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
        const auto s = space_->sample(points.tet[q], points.barycentric.col(k));
        const Vec3 d = from_axis(space_->nodes()(Eigen::all, s.functions) * s.N);
        const double r = d.norm();
        return polyaffine::DiffusionPoint{(s.gradient * t_(s.functions)).norm() / r * Mat3::Identity(), r,
                                          d / r};
      },
      values);

  rest_.resize(slope_.size());
  for (Eigen::Index n = 0; n < slope_.size(); ++n)
    rest_[n] = 1 - slope_[n] * from_axis(space_->nodes().col(n)).norm();
  for (const auto& [node, value] : values) rest_[node] = 0;
  double volume = 0, flux = 0;
  for (std::size_t q = 0; q < points.tet.size(); ++q) {
    const auto k = static_cast<Eigen::Index>(q);
    volume += points.weights[k];
    flux += points.weights[k] * sample(points.tet[q], points.barycentric.col(k)).grad_u.norm();
  }
  arc_length_ = volume / flux;
}

CoordinateSample VentricularCoordinates::sample(int tet, const Vec4& barycentric) const {
  const auto s = space_->sample(tet, barycentric);
  CoordinateSample out;
  out.t = s.N.dot(t_(s.functions));
  out.grad_t = s.gradient * t_(s.functions);

  const Vec3 X = space_->nodes()(Eigen::all, s.functions) * s.N;
  const Vec3 d = from_axis(X);
  const double r = std::max(d.norm(), 1e-6);
  const Vec3 away = d / r;
  out.psi = std::atan2(d.dot(septal_), d.dot(anterior_));
  out.grad_psi = -axis_.cross(away) / r;

  const double g = s.N.dot(slope_(s.functions));
  const double h = s.N.dot(rest_(s.functions));
  const Vec3 grad_rg = r * (s.gradient * slope_(s.functions)) + g * away;
  const double sum = r * g + h;
  out.u = r * g / sum;
  out.grad_u = (h * grad_rg - r * g * (s.gradient * rest_(s.functions))) / (sum * sum);

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
  const Vec3 d = X - base_centre_;
  return std::atan2(d.dot(septal_), d.dot(anterior_));
}

}  // namespace cardiac
