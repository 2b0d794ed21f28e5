#pragma once

#include <string>
#include <vector>

#include <cardiac/core/beat_result.hpp>

namespace cardiac {

/// The circulation of a ventricle in words, one line a fact: output and pressures; pressure–volume area and
/// arterial elastance; a valve's gradient above 5 mmHg; what leaks back through a valve and what a leak
/// changes in isovolumetric phases, both only where it is more than 1 % of the stroke volume. Empty without a
/// whole beat.
std::vector<std::string> haemodynamics_lines(const VentricleSummary& ventricle);

/// The compliances of the circulation that hold more than 1 % of what flows in, in words.
std::vector<std::string> balance_lines(const BeatResult& result);

}  // namespace cardiac
