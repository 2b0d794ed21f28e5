#include "cardiac/model/volume_check.hpp"

#include <algorithm>
#include <iomanip>
#include <sstream>

#include <polyaffine/core/error.hpp>
#include <polyaffine/system/linearised.hpp>

namespace cardiac {
namespace {

using polyaffine::Vector;

constexpr double kSoft = 0.3, kStiff = 0.4999;

// The scene with an isotropic passive wall of this Poisson's ratio, a pressure in its cavities, and
// nothing else.
Scene passive(Scene scene, double poisson) {
  const bool isotropic = scene.tissue.law == scene::TissueLaw::saint_venant_kirchhoff;
  if (!isotropic) scene.tissue.law = scene::TissueLaw::neo_hookean;
  const double young = 2.98 * scene.tissue.mu_kPa;
  scene.tissue.mu_kPa = young / (2 * (1 + poisson));
  scene.tissue.bulk_modulus_kPa = young / (3 * (1 - 2 * poisson));
  scene.tissue.poisson_ratio = poisson;
  double& local = scene.reduction.local_bulk_modulus_kPa;
  local = std::min(local, 0.9 * young / (3 * (1 - 2 * kSoft)));
  scene.contraction.reset();
  scene.activation.reset();
  scene.fibres.reset();
  scene.regions.clear();
  return scene;
}

double compliance(const Ventricle& ventricle) {
  const polyaffine::System system = wall_system(ventricle);
  const auto linear = system.make_linear();
  const Vector rest = Vector::Zero(system.size());
  if (!polyaffine::Linearised(system, *linear).factorise({0, rest}, 0))
    throw polyaffine::ComputationError("volume check: the stiffness of the wall at rest is singular");
  double sum = 0;
  for (const Cavity& cavity : ventricle.cavities) {
    const Vector load = cavity.volume->evaluate({rest}).gradient;
    sum += load.dot(linear->solve(load).col(0));
  }
  return sum;
}

template <class Number>
std::string text(const Number& value) {
  std::ostringstream out;
  out << std::setprecision(3) << value;
  return out.str();
}

}  // namespace

VolumeCheck check_volume(const std::shared_ptr<const Anatomy>& anatomy, const Scene& scene) {
  if (scene.reduction.method != scene::Method::polyaffine)
    throw polyaffine::InputError(
        "reduction.method: found fem, expected polyaffine: the volume check is of reduced models");
  const Scene soft = passive(scene, kSoft), stiff = passive(scene, kStiff);
  const Discretisation discretisation = reduced_discretisation(*anatomy, soft);
  const Ventricle at_soft = assemble_ventricle(anatomy, soft, discretisation);
  const Ventricle at_stiff = assemble_ventricle(anatomy, stiff, discretisation);
  VolumeCheck out;
  out.displacements = discretisation.num_unknowns;
  out.compliance_ratio = compliance(at_stiff) / compliance(at_soft);
  if (out.compliance_ratio < kLockedRatio)
    out.warnings.push_back(
        "locking: near incompressibility the cavities are only " + text(out.compliance_ratio) +
        " times as compliant as at Poisson's ratio 0.3, expected at least " + text(kLockedRatio) +
        "; fewer pressures or a richer reduction.enrichment (tt first) free the wall");
  const auto& space = at_stiff.wall->pressure_space();
  if (!space) return out;
  out.inf_sup = polyaffine::inf_sup(at_stiff.wall->table(), *space);
  const auto& found = *out.inf_sup;
  if (found.spurious > 0)
    out.warnings.push_back(
        "unstable pressures: " + std::to_string(found.spurious) + " of " + std::to_string(found.pressures) +
        " are felt by no displacement; expected none, with fewer functions in reduction.pressure_space");
  else if (found.beta() < kUnstableInfSup)
    out.warnings.push_back(
        "unstable pressures: the inf-sup constant is " + text(found.beta()) + ", expected at least " +
        text(kUnstableInfSup) +
        ", with fewer functions in reduction.pressure_space or more in reduction.enrichment");
  return out;
}

}  // namespace cardiac
