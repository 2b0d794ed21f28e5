#pragma once

#include <nvector/nvector_serial.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>

#include <memory>
#include <type_traits>

#include <polyaffine/core/types.hpp>

/// What the integrators of SUNDIALS have in common; for the sources of this folder only.
namespace polyaffine::sundials {

/// Owns a SUNContext. It must outlive everything that was made with it.
class Context {
 public:
  /// Throws ComputationError when SUNDIALS gives none.
  Context();
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  operator SUNContext() const { return handle_; }  // NOLINT(google-explicit-constructor)

 private:
  SUNContext handle_ = nullptr;
};

/// A handle of SUNDIALS together with the function that frees it.
template <class Handle, auto free_function>
struct Free {
  void operator()(Handle handle) const { free_function(handle); }
};
template <class Handle, auto free_function>
using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Free<Handle, free_function>>;

using NVector = Owned<N_Vector, N_VDestroy>;
using Matrix = Owned<SUNMatrix, SUNMatDestroy>;
using LinearSolver = Owned<SUNLinearSolver, SUNLinSolFree>;

/// A vector of SUNDIALS with these values.
NVector make_vector(const Vector& from, const Context& context);

/// The numbers of a vector of SUNDIALS; they live as long as it.
inline Eigen::Map<const Vector> view(N_Vector v) {
  return {N_VGetArrayPointer(v), N_VGetLength(v)};
}
inline Eigen::Map<Vector> values(N_Vector v) {
  return {N_VGetArrayPointer(v), N_VGetLength(v)};
}

/// Throws ComputationError, naming the call, when its result tells of a failure (flag < 0).
void check(int flag, const char* call);

/// Handler of error messages that prints none: failures are told by what the calls return.
void silence(int code, const char* module, const char* function, char* message, void* user);

}  // namespace polyaffine::sundials
