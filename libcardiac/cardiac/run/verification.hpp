#pragma once

#include <cardiac/run/result.hpp>

namespace cardiac {

/// Solves full order at end diastole and end systole of a reduced path, under the same pressure and tension,
/// from a tuned model's state by Newton's method, otherwise raised from zero and followed from one to the
/// other, and compares: relative L2 difference of the displacement over the
/// wall (zero where nothing moves in full order), cavity volume (of two ventricles the one that is further
/// off), largest difference of a normal segment strain (Lagrangian against the model's own end diastole).
/// Differences are reduced against full order. `progress` is told each iteration, an instant counting as a
/// half; it may throw. Throws ComputationError when the full-order problem has no equilibrium.
std::vector<VerificationInstant> verify_path(const Ventricle& reduced, const Scene& scene,
                                             const HeartPath& path, const Progress& progress = {});

}  // namespace cardiac
