#pragma once

#include <polyaffine/kinematics/packed_block.hpp>

namespace polyaffine {

/// Stiffness Σ_q B_qᵀ A_q B_q of a block, (3·functions)², full storage, from the weighted tangents A of its
/// packs (both triangles; responses[p] of pack p). Products of tiles that stay in registers, of the
/// symmetric parts only the half that is needed.
void block_stiffness(const PackedBlock& block, const PackResponse* responses, Matrix& K);

/// Forces of many fields that differ by a factor at each point: row b is the force (3·functions numbers) of
/// values(b, q) S_q; `values` has a column for each point of the block. S comes weighted.
void block_force_rows(const PackedBlock& block, const Mat3Pack* S, const Matrix& values, Matrix& rows);

}  // namespace polyaffine
