#include "polyaffine/solve/sundials_support.hpp"

#include <string>

#include <polyaffine/core/error.hpp>

namespace polyaffine::sundials {

Context::Context() {
  check(SUNContext_Create(nullptr, &handle_), "SUNContext_Create");
}

Context::~Context() {
  SUNContext_Free(&handle_);
}

NVector make_vector(const Vector& from, const Context& context) {
  NVector out(N_VNew_Serial(from.size(), context));
  if (!out) throw ComputationError("time integration: no memory for a vector");
  values(out.get()) = from;
  return out;
}

void check(int flag, const char* call) {
  if (flag < 0)
    throw ComputationError(std::string("time integration: ") + call + " failed (SUNDIALS code " +
                           std::to_string(flag) + ")");
}

void silence(int, const char*, const char*, char*, void*) {}

}  // namespace polyaffine::sundials
