#pragma once

namespace polyaffine {

/// Calls work(k, context) once for each k from `begin` to `end` − 1, in any order and on any threads, and
/// returns when all calls have.
using ParallelBackend = void (*)(int begin, int end, void (*work)(int k, const void* context),
                                 const void* context);

/// What parallel_for uses from now on, in the whole process; null: the calling thread alone, which is also
/// the start. Not to be called while a loop runs.
void set_parallel_backend(ParallelBackend backend);
ParallelBackend parallel_backend();

/// Calls work(k) for begin ≤ k < end. The calls must not depend on each other's order; where the backend runs
/// them on several threads they must be safe side by side.
template <class Work>
void parallel_for(int begin, int end, const Work& work) {
  if (const ParallelBackend backend = parallel_backend()) {
    backend(
        begin, end, [](int k, const void* context) { (*static_cast<const Work*>(context))(k); }, &work);
    return;
  }
  for (int k = begin; k < end; ++k) work(k);
}

}  // namespace polyaffine
