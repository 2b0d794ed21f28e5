#include "cardiac/run/unload.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>
#include <utility>

#include <cardiac/activation/activation.hpp>
#include <cardiac/core/units.hpp>
#include <cardiac/fibres/moved_anatomy.hpp>
#include <cardiac/reduction/axes_check.hpp>
#include <cardiac/run/inflation.hpp>
#include <cardiac/run/statics.hpp>
#include <cardiac/scene/presets.hpp>
#include <polyaffine/core/error.hpp>
#include <polyaffine/core/stopwatch.hpp>
#include <polyaffine/mesh/tet_gradients.hpp>
#include <polyaffine/solve/anderson.hpp>

namespace cardiac {

using polyaffine::ComputationError;
using polyaffine::Points;
using polyaffine::TetMesh;
using polyaffine::Vector;

namespace {

constexpr double kThinnest = 0.15;  // of its volume in the image, that every tet keeps
constexpr double kSmallestStep = 0.02;
constexpr double kWide = 1.6;       // of the volume in the image: no shape is followed further
constexpr double kOff = 0.15;       // log of the volume over that in the image, beyond which shapes are mixed
constexpr int kStalled = 3;         // inflations without a nearer shape, where the nearest one will do
constexpr std::size_t kMemory = 5;  // of Anderson's acceleration
constexpr double kFilling_mmHg = 30;  // to which the filling is told
constexpr int kFillingSteps = 12;

/// The scene whose passive wall is inflated.
Scene passive_scene(const Scene& scene) {
  Scene out = scene;
  out.imaged.reset();
  std::vector<std::string> told_with_the_result;
  out.reduction.axes = axes_of(*scene.heart, scene, told_with_the_result);
  fill_presets(out, out.reduction.axes == scene::Axes::cartesian);
  if (is_tuned(scene)) {
    out.reduction.method = scene::Method::fem;
    out.tuned = nullptr;
  }
  if (out.reduction.integration == scene::Integration::trained)
    out.reduction.integration = scene::Integration::cells;
  if (out.activation) out.activation->mode = scene::ActivationMode::uniform;
  if (!out.circulation && !out.cavities) out.cavities.emplace();
  return out;
}

Vector image_pressures(const Scene& scene) {
  const bool two = scene.heart->labels.rv_endo.has_value();
  Vector out(two ? 2 : 1);
  out[0] = scene.imaged->pressure_kPa;
  if (two) out[1] = scene.imaged->right_pressure_kPa;
  return out;
}

std::string number(double value) {
  std::ostringstream out;
  out.precision(3);
  out << value;
  return out.str();
}

double largest(const Points& way) {
  return way.colwise().norm().maxCoeff();
}

double root_mean_square(const Points& way) {
  return way.norm() / std::sqrt(static_cast<double>(way.cols()));
}

/// The search for the stress-free shape.
class Search {
 public:
  Search(const Scene& scene, Inflation& inflation, const RunControl& control)
      : heart_(scene.heart),
        inflation_(inflation),
        control_(control),
        pressure_mmHg_(image_pressures(scene).maxCoeff() / kPa_per_mmHg) {
    const Points& x = image();
    extent_ = (x.rowwise().maxCoeff() - x.rowwise().minCoeff()).norm();
  }

  void run() {
    shape_ = start();
    int since_best = 0;
    while (count_ < kMostInflations) {
      const auto heart = std::make_shared<const Anatomy>(moved_anatomy(*heart_, shape_));
      const Inflated at = inflate(heart, inflation_.loaded_sum(imaged_mm3));
      const Points off = image() - at.points;
      ++since_best;
      if (at.whole() && largest(off) < distance_mm) {
        best = heart;
        best_at = at;
        distance_mm = largest(off);
        mean_distance_mm = root_mean_square(off);
        since_best = 0;
      }
      if (distance_mm <= kUnloaded * extent_) return;
      if (distance_mm <= kNotQuite * extent_ && since_best >= kStalled) return;
      shape_ = next(at, off);
    }
  }

  /// Where none was found that will do.
  void refuse_failure(double pressure_mmHg) const {
    if (best && distance_mm <= kNotUnloaded * extent_) return;
    std::string text = "mesh.pressure_mmHg: found " + number(pressure_mmHg) +
                       " mmHg, under which no stress-free shape of the mesh was found in " +
                       std::to_string(count_) + " inflations: ";
    if (best) text += "the nearest one comes out " + number(distance_mm) + " mm off";
    if (!best) text += "none bore the pressure" + (why_.empty() ? "" : " (" + why_ + ")");
    throw ComputationError(text + "; expected a smaller pressure or a stiffer wall ([tissue], [[region]])");
  }
  bool is_far() const { return distance_mm > kNotQuite * extent_; }
  int count() const { return count_; }

  std::shared_ptr<const Anatomy> best;  // null: none has borne the pressure
  Inflated best_at;
  double distance_mm = std::numeric_limits<double>::infinity(), mean_distance_mm = 0;
  Vector imaged_mm3;

 private:
  const Points& image() const { return heart_->mesh.points(); }

  Inflated inflate(const std::shared_ptr<const Anatomy>& shape, double volume_mm3) {
    if (control_.progress)
      control_.progress("unloading: inflation " + std::to_string(count_ + 1),
                        static_cast<double>(count_) / kMostInflations);
    // Of the imaged shape as far as Klotz et al. have it fill from V₀ = V (0.6 − 0.006 p), else far enough.
    const double wide = volume_mm3 > 0 ? kWide : 1.4 + 0.006 * pressure_mmHg_;
    Inflated out = inflation_.inflate(shape, wide, volume_mm3);
    ++count_;
    if (stop_wanted(control_)) throw ComputationError("unloading: " + control_.stop_reason());
    if (!out.why.empty()) why_ = out.why;
    return out;
  }

  // A way from a shape, shortened until no tet of the image shrinks too far.
  Points along(const Points& from, const Points& way) const {
    double share = 1;
    while (share > kSmallestStep &&
           polyaffine::least_volume_ratio(heart_->mesh, from + share * way) < kThinnest)
      share /= 2;
    if (share <= kSmallestStep) return from;
    return from + share * way;
  }

  // The image moved back by its own inflation.
  Points start() {
    const Inflated first = inflate(heart_, 0);
    imaged_mm3 = first.free_mm3;
    const auto F = polyaffine::vertex_gradients(heart_->mesh, first.points);
    Points way = image() - first.points;
    for (Eigen::Index p = 0; p < way.cols(); ++p) {
      const polyaffine::Mat3 back = F[static_cast<std::size_t>(p)].inverse();
      way.col(p) = back.lazyProduct(way.col(p)).eval();
    }
    return along(image(), way);
  }

  // The next shape to inflate after one that came out off the image.
  Points next(const Inflated& at, const Points& off) {
    const double ratio = std::log(inflation_.loaded_sum(at.loaded_mm3) / inflation_.loaded_sum(imaged_mm3));
    const double size = at.whole() ? ratio : std::max(ratio, std::log(kWide));
    (size > 0 ? large_ : small_) = {size, shape_};
    Vector step = off.reshaped();
    if (at.whole())
      step = anderson_.step(shape_.reshaped(), step);
    else
      anderson_.forget();
    if (std::abs(size) > kOff && small_ && large_) {
      const double share = std::clamp(small_->first / (small_->first - large_->first), 0.2, 0.8);
      const Points way = large_->second - small_->second;
      return along(small_->second, share * way);
    }
    return along(shape_, step.reshaped(3, shape_.cols()));
  }

  std::shared_ptr<const Anatomy> heart_;
  Inflation& inflation_;
  const RunControl& control_;
  double pressure_mmHg_, extent_ = 0;
  Points shape_;
  polyaffine::Anderson anderson_{kMemory};
  std::optional<std::pair<double, Points>> small_, large_;  // log of volume over image, and the shape
  int count_ = 0;
  std::string why_;
};

std::vector<UnloadedCavity> cavities_of(const Search& search, const Vector& pressures_kPa,
                                        const std::vector<std::pair<double, Vector>>& filling) {
  std::vector<UnloadedCavity> out;
  for (Eigen::Index k = 0; k < pressures_kPa.size(); ++k) {
    UnloadedCavity& cavity = out.emplace_back();
    cavity.name = k == 0 ? "lv" : "rv";
    cavity.pressure_mmHg = pressures_kPa[k] / kPa_per_mmHg;
    cavity.imaged_mL = search.imaged_mm3[k] / mm3_per_mL;
    cavity.unloaded_mL = search.best_at.free_mm3[k] / mm3_per_mL;
    cavity.reloaded_mL = search.best_at.loaded_mm3[k] / mm3_per_mL;
    for (const auto& [share, volumes] : filling) {
      cavity.pressures_mmHg.push_back(share * cavity.pressure_mmHg);
      cavity.volumes_mL.push_back(volumes[k] / mm3_per_mL);
    }
  }
  return out;
}

}  // namespace

Unloading unload(const Scene& scene, const RunControl& control) {
  Unloading out;
  {
    const polyaffine::Stopwatch watch(out.result.wall_time_s);
    const Scene passive = passive_scene(scene);
    const Vector pressures = image_pressures(scene);
    if (pressures.maxCoeff() <= 0)
      throw polyaffine::InputError(
          "mesh.pressure_mmHg: found 0 mmHg in every cavity of the mesh, expected a pressure above 0 mmHg "
          "to unload");
    const double most_mmHg = pressures.maxCoeff() / kPa_per_mmHg;
    Inflation inflation(passive, pressures, control);
    Search search(scene, inflation, control);
    search.run();
    search.refuse_failure(most_mmHg);
    out.heart = search.best;
    const auto filling = inflation.fill(out.heart, std::max(1.0, kFilling_mmHg / most_mmHg), kFillingSteps);
    out.result.method = passive.reduction.method == scene::Method::fem ? "fem" : "polyaffine";
    out.result.inflations = search.count();
    out.result.distance_mm = search.distance_mm;
    out.result.mean_distance_mm = search.mean_distance_mm;
    out.result.longest_way_mm = largest(out.heart->mesh.points() - scene.heart->mesh.points());
    out.result.cavities = cavities_of(search, pressures, filling);
    if (search.is_far())
      out.warnings.push_back("mesh.pressure_mmHg: the shape reloaded from the stress-free one is up to " +
                             number(search.distance_mm) + " mm off the mesh (root mean square " +
                             number(search.mean_distance_mm) + " mm) after " +
                             std::to_string(search.count()) + " inflations");
    if (pressures.size() == 2 && pressures[1] == 0)
      out.warnings.emplace_back(
          "mesh.right_pressure_mmHg: 0 mmHg in the right cavity of the imaged heart; if it was loaded, its "
          "stress-free shape comes out too large");
  }
  return out;
}

Scene unloaded_scene(const Scene& scene, std::shared_ptr<const Anatomy> heart) {
  const TetMesh& image = scene.heart->mesh;
  const Points& free = heart->mesh.points();
  Scene out = scene;
  std::vector<std::string> told_with_the_result;
  out.reduction.axes = axes_of(*scene.heart, scene, told_with_the_result);
  if (out.activation) {
    for (scene::Vector3& X : out.activation->sites_mm) {
      const polyaffine::Vec3 at(X.data());
      const polyaffine::Vec3 moved = at + way_of_nearest(image, free, at);
      X = {moved.x(), moved.y(), moved.z()};
    }
    if (out.activation->map)
      out.activation->map = std::make_shared<const ActivationMap>(
          ActivationMap{free, mapped_times(image, *out.activation->map)});
  }
  out.imaged.reset();
  out.heart = std::move(heart);
  return out;
}

}  // namespace cardiac
