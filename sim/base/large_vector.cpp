#include "sim/base/large_vector.h"

#include <cstdlib>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace vegard::sim::large_memory {

void* allocate(std::size_t bytes) {
  constexpr std::size_t kPage = std::size_t{1} << 21;
  if (bytes < kPage) {
    void* memory = std::malloc(bytes > 0 ? bytes : 1);
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
  }
  const std::size_t whole = (bytes + kPage - 1) / kPage * kPage;
  if (whole < bytes) throw std::bad_alloc();
  void* memory = std::aligned_alloc(kPage, whole);
  if (memory == nullptr) throw std::bad_alloc();
#ifdef __linux__
  madvise(memory, whole, MADV_HUGEPAGE);  // a wish: where it is not granted, the pages are small
#endif
  return memory;
}

void release(void* memory) { std::free(memory); }

}  // namespace vegard::sim::large_memory
