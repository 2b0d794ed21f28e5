#pragma once

#include <cardiac/validation/check.hpp>

namespace cardiac {

/// The elastodynamics benchmark of Aróstica et al. 2025 (CMAME 435:117485): a left ventricle that contracts
/// (step 0A), one that contracts under pressure (step 1), and two ventricles, with inertia, viscosity, an
/// elastic base and a pericardium. Full order (quadratic elements): the largest displacements of points,
/// whole curves and the least volume of the cavity, within the ranges of the ten groups; beside it the
/// untrained reduced model, against full order. Quick: step 0A to its peak, full order on a coarse mesh of
/// the same ventricle. Writes CASE.csv and CASE.svg. Needs the benchmark's meshes
/// (ValidationContext::hearts): throws InputError naming the file that is absent when the case was asked for
/// by name, else it says so and checks nothing.
std::vector<Check> validate_elastodynamics(const ValidationContext& context);

}  // namespace cardiac
