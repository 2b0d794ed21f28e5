#pragma once

#include <cardiac/run/beat.hpp>

namespace cardiac {

/// Builds what `plan(scene)` says, from a mesh in mm. Throws InputError as the discretisation does,
/// check_size included.
Ventricle build_ventricle(std::shared_ptr<const Anatomy> anatomy, const Scene& scene, scene::Method method,
                          const RunControl& control = {});

/// The larger rule_error at end diastole and end systole of a path (without circulation: at its end).
double rule_error(const Ventricle& ventricle, const Scene& scene, const HeartPath& path);

/// Why a path by a trained rule is not to be used, in words: the run stopped, or rule_error is above
/// kTrustedRuleError. Empty where it is to be used, and for a model without a trained rule.
std::string distrust(const Ventricle& ventricle, const Scene& scene, const HeartPath& path);

}  // namespace cardiac
