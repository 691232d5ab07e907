#include "sim/base/parallel.h"

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#if defined(__SANITIZE_THREAD__)
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>
#endif

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
#if defined(__SANITIZE_THREAD__)
  // The thread sanitizer does not see how TBB's own threads, which it has not compiled, wait for each other,
  // and would report all that they share. The bodies are what it is to look at.
  std::atomic<std::size_t> next{0};
  std::exception_ptr thrown;
  std::mutex of_thrown;
  std::vector<std::thread> workers;
  for (int slot = 0; slot < threads; ++slot)
    workers.emplace_back([&, slot] {
      try {
        for (std::size_t i = next++; i < count; i = next++) body(i, slot);
      } catch (...) {
        next = count;
        const std::lock_guard<std::mutex> lock(of_thrown);
        if (!thrown) thrown = std::current_exception();
      }
    });
  for (std::thread& worker : workers) worker.join();
  if (thrown) std::rethrow_exception(thrown);
#else
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
#endif
}

}  // namespace vegard::sim
