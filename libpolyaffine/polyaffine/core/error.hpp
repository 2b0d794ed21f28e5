#pragma once

#include <stdexcept>
#include <string>

namespace polyaffine {

/// What the user gave is wrong. The message names the file, line or key, what was found, what was expected
/// and the unit; the program prints it and ends with status 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A computation could not be carried out although its input is well formed; status 1.
class ComputationError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace polyaffine
