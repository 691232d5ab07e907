// Parallel loops whose results do not depend on the number of threads.
#pragma once

#include <cstddef>
#include <functional>

namespace vegard::sim {

/// Returns the number of threads for a request of 0 (= all cores) or more: never more than there are cores,
/// so that no memory per thread is wasted.
int thread_count(int requested);

/// Calls body(i, slot) for every i in [0, count), on up to n = thread_count(threads) threads. `slot` in [0,
/// n) is never used by two calls at once. The order of the calls is undefined: reductions must not depend on
/// it (integer sums), or values must be stored per i and reduced afterwards in the order of i.
void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t i, int slot)>& body);

}  // namespace vegard::sim
