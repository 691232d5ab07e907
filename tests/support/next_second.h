// The clock's next second, by which files show whether they hold the time of their making.
#pragma once

#include <chrono>
#include <ctime>
#include <thread>

namespace vegard::tests {

/// Returns as soon as the clock shows another second.
inline void await_next_second() {
  const std::time_t now = std::time(nullptr);
  while (std::time(nullptr) == now) std::this_thread::sleep_for(std::chrono::milliseconds(5));
}

}  // namespace vegard::tests
