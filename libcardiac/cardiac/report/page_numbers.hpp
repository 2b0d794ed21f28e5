#pragma once

#include <string>

#include <cardiac/core/beat_result.hpp>

namespace cardiac {

/// The headline numbers of the page as HTML: volumes and pressures of every ventricle, global strain with
/// what kind of mean it is, and both beside what is published of healthy adults, with the sources. Without a
/// beat the numbers of the loading, beside nothing.
std::string numbers_section(const BeatResult& result);

}  // namespace cardiac
