/// A loop over independent pieces of work on all cores that the program may use.
#pragma once

#include <functional>

namespace fpi {

/// OMP_NUM_THREADS where it is set, as numerical libraries understand it; else the cores of this process.
int n_threads();

/// From now on loops run on `n` ≥ 1 threads.
void use_threads(int n);

/// Calls work(0) … work(n − 1), each once, in any order and possibly at the same time; returns when all are
/// done. `work` must not throw. A loop begun inside another, or while another runs, runs on its own thread.
void parallel_for(int n, const std::function<void(int)>& work);

}  // namespace fpi
