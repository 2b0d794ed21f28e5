#include "cardiac/validation/ellipsoid_measure.hpp"

#include <cmath>

#include <cardiac/validation/oscillation.hpp>

namespace cardiac {

using polyaffine::Points;
using polyaffine::Vector;

namespace {

constexpr int kMeridian = 241, kTrend = 4, kDegree = 2;

}  // namespace

EllipsoidMeasure::EllipsoidMeasure(const EllipsoidProblem& problem, const EllipsoidProblem& fine,
                                   const EllipsoidProblem::Solution& reference)
    : meridian_(outer_meridian(kMeridian)), on_meridian_(problem.locate(meridian_)) {
  const auto& space = problem.anatomy().coordinates->space();
  const auto points = space.wall_points(kDegree);
  weights_ = points.weights;
  for (std::size_t q = 0; q < points.tet.size(); ++q)
    at_.push_back({points.tet[q], points.barycentric.col(static_cast<Eigen::Index>(q))});
  u_ = reference.displacement(fine.locate(space.positions(points.tet, points.barycentric)));
  profile_ = reference.displacement(fine.locate(meridian_));
  apicobasal_.resize(kMeridian);
  for (int k = 0; k < kMeridian; ++k)
    apicobasal_[k] =
        problem.anatomy().coordinates->sample(on_meridian_[k].tet, on_meridian_[k].barycentric).u;
}

double EllipsoidMeasure::error_percent(const EllipsoidProblem::Solution& s) const {
  const Vector difference = (s.displacement(at_) - u_).colwise().squaredNorm();
  const Vector size = u_.colwise().squaredNorm();
  return 100 * std::sqrt(weights_.dot(difference) / weights_.dot(size));
}

double EllipsoidMeasure::bump_percent(const Points& profile, double spacing) const {
  std::vector<int> inside;
  for (int k = 0; k < kMeridian; ++k)
    if (apicobasal_[k] >= spacing && apicobasal_[k] <= 1 - spacing / 2) inside.push_back(k);
  const Vector exact = normal_part(meridian_, profile_)(inside);
  const Vector found = normal_part(meridian_, profile)(inside);
  return 100 * oscillation(apicobasal_(inside), found - exact, spacing, kTrend) / exact.cwiseAbs().mean();
}

double EllipsoidMeasure::basal_displacement(const Points& profile, double low) const {
  std::vector<int> inside;
  for (int k = 0; k < kMeridian; ++k)
    if (apicobasal_[k] >= low) inside.push_back(k);
  return normal_part(meridian_, profile)(inside).mean();
}

}  // namespace cardiac
