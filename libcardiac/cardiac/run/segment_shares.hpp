#pragma once

#include <cardiac/model/ventricle.hpp>

namespace cardiac {

/// The volume (mm³) that each integration point of a wall (column) stands for in each AHA segment (row). A
/// cell of a reduced model may lie in several segments, and so may what a point stands for: first what the
/// strain points about it stand for (strain_points, which end at the segments' borders), each shared out
/// among its eight nearest points by the inverse fourth power of the distance; then rows and columns are
/// scaled in turn until columns sum to the weights of the points, exactly, and rows to the volumes of the
/// segments (Deming and Stephan 1940).
polyaffine::Matrix segment_shares(const Anatomy& anatomy, const Discretisation& discretisation);

}  // namespace cardiac
