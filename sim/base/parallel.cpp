#include "sim/base/parallel.h"

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

namespace vegard::sim {

int thread_count(int requested) {
  // An arena of more threads than there are cores gets no more workers and makes TBB warn on standard error.
  const int cores = std::max(1, tbb::info::default_concurrency());
  if (requested <= 0) requested = std::max(1, tbb::this_task_arena::max_concurrency());
  return std::min(requested, cores);
}

void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t, int)>& body) {
  threads = thread_count(threads);
  if (threads == 1 || count <= 1) {
    for (std::size_t i = 0; i < count; ++i) body(i, 0);
    return;
  }
  tbb::task_arena arena(threads);
  arena.execute([&] {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, count, 1),
        [&](const tbb::blocked_range<std::size_t>& range) {
          const int slot = tbb::this_task_arena::current_thread_index();
          for (std::size_t i = range.begin(); i != range.end(); ++i) body(i, slot);
        },
        tbb::simple_partitioner());
  });
}

}  // namespace vegard::sim
