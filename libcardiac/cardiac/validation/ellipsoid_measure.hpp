#pragma once

#include <vector>

#include <cardiac/validation/ellipsoid_model.hpp>

namespace cardiac {

/// What is measured of solutions on one mesh of the truncated ellipsoid, against a reference on a finer mesh.
class EllipsoidMeasure {
 public:
  EllipsoidMeasure(const EllipsoidProblem& problem, const EllipsoidProblem& fine,
                   const EllipsoidProblem::Solution& reference);

  const polyaffine::Points& meridian() const { return meridian_; }  ///< points of the outer meridian, mm
  const polyaffine::Points& profile() const { return profile_; }  ///< displacement of the reference there, mm
  polyaffine::Points profile(const EllipsoidProblem::Solution& s) const {
    return s.displacement(on_meridian_);
  }

  /// Relative L2 error of the displacement in the wall.
  double error_percent(const EllipsoidProblem::Solution& s) const;
  /// Wave with the spacing of the rings (in u) in the error of the normal displacement between the first and
  /// the last ring beside a smooth trend (see oscillation), over the mean normal displacement there.
  double bump_percent(const polyaffine::Points& profile, double spacing) const;
  /// Mean normal displacement of the outer surface from u = low to the base, mm.
  double basal_displacement(const polyaffine::Points& profile, double low) const;

 private:
  polyaffine::Points meridian_, profile_, u_;
  std::vector<polyaffine::MeshPoint> on_meridian_, at_;
  polyaffine::Vector weights_, apicobasal_;
};

}  // namespace cardiac
