#pragma once

#include <cardiac/validation/check.hpp>

namespace cardiac {

/// A tuned model of a human left ventricle under 30 protocols that it was not learned for, drawn with a seed:
/// tension (60 to 120 %) and stiffness (70 to 150 %) of each segment, heart rate, preload and afterload. The
/// errors of displacement against full order at end diastole and end systole, and those that the model tells
/// of itself over these. Quick: 4 protocols on a coarse mesh.
std::vector<Check> validate_tuned(const ValidationContext& context);

}  // namespace cardiac
