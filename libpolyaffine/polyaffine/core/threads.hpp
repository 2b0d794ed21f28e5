#pragma once

namespace polyaffine {

/// Lets the loops of parallel_for run on the threads of TBB, as many as it takes there to be processors. Does
/// nothing where another backend has been set. May be called again and from any thread; results do not depend
/// on it. Part of polyaffine::sparse.
void use_threads();

}  // namespace polyaffine
