// Large arrays of numbers that are written completely before they are read: films and planes of light.
#pragma once

#include <algorithm>
#include <cstddef>
#include <new>
#include <utility>
#include <vector>

namespace vegard::sim {

namespace large_memory {
/// Allocates memory. Throws std::bad_alloc. Large blocks use large pages if the system offers them on
/// request: to map a film in pages of 4 KiB takes about as long as to fill it with light.
void* allocate(std::size_t bytes);
void release(void* memory);

/// The same with every byte 0, directly from the system, which returns zeroed pages, so that they are not
/// zeroed twice.
void* allocate_zeroed(std::size_t bytes);
void release_zeroed(void* memory, std::size_t bytes);
}  // namespace large_memory

/// An allocator with which resize() leaves new numbers uninitialised, unlike in std::vector; assign() sets
/// them.
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

/// An array of numbers that are initially 0.
template <class T>
class LargeZeros {
 public:
  LargeZeros() = default;
  LargeZeros(LargeZeros&& other) noexcept
      : memory_(std::exchange(other.memory_, nullptr)), size_(std::exchange(other.size_, 0)) {}
  LargeZeros& operator=(LargeZeros&& other) noexcept {
    std::swap(memory_, other.memory_);
    std::swap(size_, other.size_);
    return *this;
  }
  ~LargeZeros() { large_memory::release_zeroed(memory_, size_ * sizeof(T)); }

  /// Makes the array `size` zeros.
  void reset(std::size_t size) {
    if (size == size_) {
      std::fill_n(data(), size_, T(0));
      return;
    }
    LargeZeros fresh;
    fresh.memory_ = large_memory::allocate_zeroed(size * sizeof(T));
    fresh.size_ = size;
    *this = std::move(fresh);
  }

  T* data() { return static_cast<T*>(memory_); }
  const T& operator[](std::size_t i) const { return static_cast<const T*>(memory_)[i]; }

 private:
  void* memory_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace vegard::sim
