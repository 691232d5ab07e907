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

#ifdef __linux__
void* allocate_zeroed(std::size_t bytes) {
  if (bytes == 0) return nullptr;
  void* memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  madvise(memory, bytes, MADV_HUGEPAGE);
  return memory;
}

void release_zeroed(void* memory, std::size_t bytes) {
  if (memory != nullptr) munmap(memory, bytes);
}
#else
void* allocate_zeroed(std::size_t bytes) {
  if (bytes == 0) return nullptr;
  void* memory = std::calloc(bytes, 1);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

void release_zeroed(void* memory, std::size_t) { std::free(memory); }
#endif

}  // namespace vegard::sim::large_memory
