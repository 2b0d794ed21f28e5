#pragma once

#include <polyaffine/kinematics/field_table.hpp>

namespace polyaffine {

/// The same integral as a table of one point of weight 1, for laws that are linear in the field (dead loads):
/// base Σ_q w_q M⁰_q, rows Σ_q w_q row_a. A load on a whole face then costs as much as one point. Throws
/// std::invalid_argument when a function has local axes.
FieldTable resultant_table(const FieldTable& table);

}  // namespace polyaffine
