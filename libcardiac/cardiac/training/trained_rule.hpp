#pragma once

#include <memory>
#include <string>

#include <cardiac/core/heart_state.hpp>
#include <cardiac/model/ventricle.hpp>
#include <polyaffine/quadrature/moment_compression.hpp>

namespace cardiac {

/// Of the integration points of a reduced model those that are kept, with the factors on their weights.
struct TrainedRule {
  polyaffine::CompressedRule wall, cavity;
};

/// Trains the rule of a reduced model (polyaffine::CubatureTraining) on equilibria of the given heart that
/// span what a scene can ask: cavity pressure, active tension and stiffness vary, and with them factors on
/// the tension and stiffness of every AHA segment, weak and stiff segments among them. Integrals kept are the
/// generalised forces (viscous ones included) and the change of volume seen by each pressure, as Gauss points
/// of the mesh have them, and the cavity's volume with its gradient; all in the energy norm of the state.
/// Does not depend on regions, timing and circulation of the scene, so one rule serves all of them.
TrainedRule train_rule(const std::shared_ptr<const Anatomy>& anatomy, const Scene& scene);

/// What tells the rules of two scenes apart: the mesh and all that training reads. Fibres that are not the
/// scene's own rule are not part of it.
std::string rule_key(const Anatomy& anatomy, const Scene& scene);

/// The same from the cache (polyaffine::read_cache), trained and stored there if it is missing.
TrainedRule cached_rule(const std::shared_ptr<const Anatomy>& anatomy, const Scene& scene);

/// A discretisation with the points of a rule only.
Discretisation with_rule(const Discretisation& all_points, const TrainedRule& rule);

/// A rule that is off by more is not to be used, see rule_error.
inline constexpr double kTrustedRuleError = 0.02;

/// How far a trained rule is off in a state: the displacement (L2, over that of the state) by which one
/// Newton step answers what its forces lack of those of all points. `clock_ms` on the clock of the
/// contraction. Infinite where the tangent is singular.
double rule_error(const Ventricle& ventricle, const HeartState& state, double clock_ms);

}  // namespace cardiac
