// Large arrays of numbers that are written from end to end: films and planes of light.
#pragma once

#include <cstddef>
#include <new>
#include <utility>
#include <vector>

namespace vegard::sim {

namespace large_memory {
/// Throws std::bad_alloc. Large blocks lie in large pages where the system has them on request: to hand out a
/// film in pages of 4 KiB takes about as long as to fill it with light.
void* allocate(std::size_t bytes);
void release(void* memory);
}  // namespace large_memory

/// resize() leaves new numbers as they are in memory, unlike a plain vector's; assign() fills them.
template <class T>
struct LargeAllocator {
  using value_type = T;
  LargeAllocator() = default;
  template <class U>
  LargeAllocator(const LargeAllocator<U>&) {}  // NOLINT: allocators convert

  T* allocate(std::size_t count) { return static_cast<T*>(large_memory::allocate(count * sizeof(T))); }
  void deallocate(T* memory, std::size_t) { large_memory::release(memory); }
  template <class U>
  void construct(U* at) {
    ::new (static_cast<void*>(at)) U;
  }
  template <class U, class... From>
  void construct(U* at, From&&... from) {
    ::new (static_cast<void*>(at)) U(std::forward<From>(from)...);
  }
  template <class U>
  bool operator==(const LargeAllocator<U>&) const {
    return true;
  }
  template <class U>
  bool operator!=(const LargeAllocator<U>&) const {
    return false;
  }
};

template <class T>
using LargeVector = std::vector<T, LargeAllocator<T>>;

}  // namespace vegard::sim
