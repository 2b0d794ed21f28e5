#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include <cardiac/anatomy/coordinates.hpp>
#include <cardiac/anatomy/right_ventricle.hpp>
#include <polyaffine/fields/laplace.hpp>

// The fields of VentricularCoordinates that are solved for: depth, radial direction, apicobasal coordinate.

namespace cardiac {

using polyaffine::DiffusionPoint;
using polyaffine::Mat3;
using polyaffine::Points;
using polyaffine::Vec3;
using polyaffine::Vec4;
using polyaffine::Vector;

namespace {

// Degree of the polynomial whose direction is the radial axis: it follows the shape of a ventricle and stays
// smooth between the elements.
constexpr int kRadialDegree = 5;
// In the right free wall the depth of the left one is nearly constant, and conducting by |∇t| would leave the
// equations singular there. |∇t| counts as this share of the left wall's mean at least.
constexpr double kOffWall = 0.1;
// Degrees of the Gauss points for the conductivities |∇t| (quadratic elements) and |∇t| |∇ψ|.
constexpr int kDepthDegree = 3, kApicobasalDegree = 4;

}  // namespace

// The depth: from the harmonic one t', then evenly along the way through the wall, ∇·(|∇t'| ∇t) = 0; and the
// radial axis, the direction of the polynomial closest to ∇t in the left wall.
void VentricularCoordinates::solve_transmural(const polyaffine::TetMesh& mesh, const SurfaceLabels& labels) {
  std::vector<polyaffine::NodeValue> values;
  for (const int n : space_->surface_nodes(mesh, {labels.endo})) values.push_back({n, 0.0});
  for (const int n : space_->surface_nodes(mesh, {labels.epi})) values.push_back({n, 1.0});
  if (right_)
    for (const int n : space_->surface_nodes(mesh, {*labels.rv_endo})) values.push_back({n, 1.0});
  const Vector harmonic = right_ ? right_->left_depth() : polyaffine::solve_laplace(*space_, values);
  const polyaffine::WallPoints points = space_->wall_points(kDepthDegree);
  Vector steepness(points.weights.size());
  Vector left = points.weights;  // zero beyond the left wall and the septum
  for (Eigen::Index q = 0; q < steepness.size(); ++q) {
    const auto s = space_->element_sample(points.tet[q], points.barycentric.col(q));
    steepness[q] = s.slope(harmonic).norm();
    if (right_ && s.value(right_->transventricular()) > 0.5) left[q] = 0;
  }
  if (right_) least_steepness_ = kOffWall * left.dot(steepness) / left.sum();
  const auto diffusion = [&](std::size_t q) {
    const double conductivity = std::max(steepness[static_cast<Eigen::Index>(q)], least_steepness_);
    return DiffusionPoint{conductivity * Mat3::Identity()};
  };
  t_ = polyaffine::solve_diffusion(*space_, points, diffusion, values);
  fit_radial(points, left);
}

void VentricularCoordinates::fit_radial(const polyaffine::WallPoints& points, const Vector& weights) {
  std::vector<Eigen::Index> inside;
  for (Eigen::Index q = 0; q < weights.size(); ++q)
    if (weights[q] > 0) inside.push_back(q);
  Points X(3, std::ssize(inside)), gradient(3, X.cols());
  for (Eigen::Index k = 0; k < X.cols(); ++k) {
    const auto s = space_->element_sample(points.tet[inside[k]], points.barycentric.col(inside[k]));
    X.col(k) = s.value(space_->nodes());
    gradient.col(k) = s.slope(t_);
  }
  radial_.emplace(X, gradient, weights(inside), kRadialDegree);
}

// The apicobasal coordinate u = r g / (r g + h), which is 0 on the long axis and 1 on the base. g (slope_)
// solves ∇·(|∇ψ| |∇t| ∇(r g)) = 0 with r g = 1 on the base; h (rest_) is what is missing to 1, 0 on the base.
void VentricularCoordinates::solve_apicobasal(const polyaffine::TetMesh& mesh, const SurfaceLabels& labels) {
  std::vector<polyaffine::NodeValue> values;
  for (const int n : space_->surface_nodes(mesh, {labels.base}))
    values.push_back({n, 1 / from_axis(space_->nodes().col(n)).norm()});
  const polyaffine::WallPoints points = space_->wall_points(kApicobasalDegree);
  const auto diffusion = [&](std::size_t q) {
    const auto k = static_cast<Eigen::Index>(q);
    const auto s = space_->element_sample(points.tet[q], points.barycentric.col(k));
    const Vec3 d = from_axis(s.value(space_->nodes()));
    const double r = d.norm();
    const double steepness = std::max(s.slope(t_).norm(), least_steepness_);
    return DiffusionPoint{steepness / r * Mat3::Identity(), r, d / r};
  };
  slope_ = polyaffine::solve_diffusion(*space_, points, diffusion, values);

  rest_.resize(slope_.size());
  for (Eigen::Index n = 0; n < slope_.size(); ++n)
    rest_[n] = 1 - slope_[n] * from_axis(space_->nodes().col(n)).norm();
  for (const auto& [node, value] : values) rest_[node] = 0;
  measure_arc_length(mesh);
}

// u rises from 0 to 1 over the arc length, which therefore is the inverse of the left wall's mean |∇u|.
void VentricularCoordinates::measure_arc_length(const polyaffine::TetMesh& mesh) {
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

}  // namespace cardiac
