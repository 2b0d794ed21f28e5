#include "cardiac/reduction/axes_check.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include <cardiac/anatomy/right_ventricle.hpp>
#include <cardiac/scene/presets.hpp>

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

namespace {

// Misfit of the radial axes, degrees, up to which a left ventricle is as smooth as the drawn ones (0.6
// to 1.0), and from which muscles stand into the cavity.
constexpr double kDrawn_deg = 1.2, kMuscles_deg = 10;

struct Found {
  const char *heart, *fast, *accurate;  // displacement off full order at the worse of filling and systole, %
};

Found found_on(bool two_ventricles, double misfit_deg) {
  if (two_ventricles) return {"two ventricles", "7 to 12", "5 to 10"};
  if (misfit_deg > kMuscles_deg) return {"a wall with muscles that stand into the cavity", "17", "15"};
  if (misfit_deg > kTurningAxes_deg) return {"an irregular left ventricle", "9", "6"};
  return {"an imaged left ventricle", "5", "3"};
}

}  // namespace

std::string moving_base_warning(const Scene& scene) {
  if (scene.boundary.base == scene::Base::clamped) return "";
  return "boundary.base: where the base moves, a reduced model tells volumes and strain as it does "
         "otherwise, "
         "but where the heart lies as a whole may be a third of its displacement off full order; "
         "--verify tells it of this heart";
}

std::string untrained_warning(const Anatomy& anatomy, const Scene& scene) {
  if (is_tuned(scene)) return "";
  const bool two = anatomy.coordinates->right() != nullptr;
  const double misfit = two ? 0 : radial_misfit_deg(anatomy);
  if (!two && misfit <= kDrawn_deg) return "";
  const Found found = found_on(two, misfit);
  const bool fast = scene.reduction.preset == scene::Preset::fast;
  return std::string("reduction.preset: ") + (fast ? "fast" : "accurate") +
         " is not trained on this heart; on " + found.heart + " it was " +
         (fast ? found.fast : found.accurate) +
         " % of displacement off full order. --verify tells it of this heart; preset \"tuned\" (cardiac "
         "reduce) builds a model for it once";
}

}  // namespace cardiac
