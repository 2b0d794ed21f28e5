#pragma once

#include <polyaffine/system/system.hpp>

namespace polyaffine {

/// For System::linear: a sparse_system with the pattern of the functions that the terms couple.
std::unique_ptr<LinearSystem> sparse_field(const System& system);

}  // namespace polyaffine
