#include "cardiac/reduction/axes_check.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include <cardiac/anatomy/right_ventricle.hpp>

namespace cardiac {

double radial_misfit_deg(const Anatomy& anatomy) {
  const VentricularCoordinates& heart = *anatomy.coordinates;
  const auto points = heart.space().wall_points(2);
  double volume = 0, squares = 0;
  for (std::size_t q = 0; q < points.tet.size(); ++q) {
    const auto k = static_cast<Eigen::Index>(q);
    if (heart.right() != nullptr && heart.right()->border(points.tet[q], points.barycentric.col(k)).w > 0.5)
      continue;
    const CoordinateSample at = heart.sample(points.tet[q], points.barycentric.col(k));
    const double cosine = at.Q.col(2).dot(at.grad_t.normalized());
    volume += points.weights[k];
    squares += points.weights[k] * std::pow(std::acos(std::clamp(cosine, -1.0, 1.0)), 2);
  }
  return std::sqrt(squares / volume) * 180 / polyaffine::kPi;
}

scene::Axes axes_of(const Anatomy& anatomy, const Scene& scene, std::vector<std::string>& warnings) {
  using scene::Axes;
  const Axes asked = scene.reduction.axes;
  if (asked == Axes::cartesian) return asked;
  if (asked == Axes::automatic && anatomy.coordinates->right() != nullptr) return Axes::cartesian;
  const double misfit = radial_misfit_deg(anatomy);
  if (misfit <= kTurningAxes_deg) return Axes::heart;
  std::ostringstream text;
  text << "reduction.axes: the wall is no smooth shell (papillary muscles, trabeculae, a rough surface?): "
          "smooth radial axes are off the way through it by "
       << std::setprecision(2) << misfit << " degrees (root mean square), expected at most "
       << kTurningAxes_deg << "; "
       << (asked == Axes::heart
               ? "heart axes are kept as asked for, but cartesian ones follow full order better"
               : "Cartesian axes are taken");
  warnings.push_back(text.str());
  return asked == Axes::heart ? Axes::heart : Axes::cartesian;
}

}  // namespace cardiac
