#pragma once

#include <string>

#include <polyaffine/core/error.hpp>

namespace polyaffine::testing {

/// The message of the InputError with which an action is refused; "no error" when it is not.
template <class Action>
std::string error_of(const Action& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace polyaffine::testing
