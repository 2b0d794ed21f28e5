#pragma once

#include <memory>
#include <vector>

#include <polyaffine/kinematics/field_table.hpp>
#include <polyaffine/linear/linear_system.hpp>

namespace polyaffine {

/// Compressed columns with the pattern of the tables' blocks. CHOLMOD supernodal Cholesky, its symbolic
/// analysis kept; UMFPACK where K is indefinite (Davis 2004; Chen et al. 2008), at several times the time and
/// memory. With `definite_only` such a K counts as singular, so that a load path takes shorter steps instead.
/// Held directions as in dense_system.
std::unique_ptr<LinearSystem> sparse_system(const std::vector<const FieldTable*>& tables,
                                            const std::vector<char>& fixed = {}, bool definite_only = false,
                                            const HeldDirections& held = {});

}  // namespace polyaffine
