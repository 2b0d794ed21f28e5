#pragma once

#include <vector>

#include <cardiac/anatomy/control_nodes.hpp>
#include <cardiac/heart/beat_result.hpp>
#include <polyaffine/kinematics/frame_basis.hpp>

namespace cardiac {

/// The affine map of each segment's frame (the regions of the layout being the AHA segments), from its own
/// four coefficients c_1, c_l, c_c, c_t at the control node q with axes R: t = Rᵀ u(q) and A = Rᵀ (I + ∂u/∂X)
/// R of the frame's map u(X) = Q(X) (c_1 + Σ_m c_m ξ_m(X)) (Q = I for a frame with Cartesian coefficients).
/// It is an invertible linear map of the coefficients.
///
/// Of the circumferential coefficients of a ring only differences move the wall (see SegmentFrames); they are
/// shown with the mean zero, as the mean derivative around a closed ring is.
std::vector<SegmentFrame> affine_parameters(const polyaffine::FrameBasis& basis,
                                            const std::vector<ControlNode>& nodes,
                                            const polyaffine::Vector& c);

/// The inverse: coefficients whose affine part has these parameters; enrichment and base functions are taken
/// from `rest`.
polyaffine::Vector affine_coefficients(const polyaffine::FrameBasis& basis,
                                       const std::vector<ControlNode>& nodes,
                                       const std::vector<SegmentFrame>& frames,
                                       const polyaffine::Vector& rest);

/// The affine map about each control node that fits points of a segment best (least squares, weights w): for
/// models without a frame for each segment. X and x are 3 × points.
std::vector<SegmentFrame> fit_affine(const std::vector<ControlNode>& nodes, const std::vector<int>& segment,
                                     const polyaffine::Points& X, const polyaffine::Points& x,
                                     const polyaffine::Vector& weights);

}  // namespace cardiac
