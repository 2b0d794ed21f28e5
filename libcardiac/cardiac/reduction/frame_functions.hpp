#pragma once

#include <vector>

#include <cardiac/core/beat_result.hpp>
#include <cardiac/reduction/discretisation.hpp>

namespace cardiac {

/// The functions of a reduced model in the order of its unknowns: function k has the unknowns 3k, 3k + 1 and
/// 3k + 2, its coefficient c_k (mm) in
///   u(X) = Σ_k c_k N_k(X), or Q(X) Σ_k c_k N_k(X) for functions in local axes, N_k = φ(X) m(ξ(X)),
/// with the weight φ of its frame, a product m of the frame's coordinates ξ = (l, c, t) and the axes Q of the
/// point. Frames that are segments are called like them; others by ring (1 is the lowest) and node, those on
/// the base and on borders between unlike segments by number, the Cartesian one of a heart whose base moves
/// "whole heart". Empty for full order.
std::vector<FrameFunction> frame_functions(const Discretisation& discretisation);

}  // namespace cardiac
