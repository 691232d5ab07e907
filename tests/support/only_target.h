// One instruction set at a time, of those that vector code is compiled for.
#pragma once

#include <cstdint>

#include <hwy/highway.h>

namespace vegard::tests {

/// Dispatch goes to one instruction set while this lives.
class Only {
 public:
  explicit Only(std::int64_t target) { choose(target); }
  ~Only() { choose(0); }
  Only(const Only&) = delete;
  Only& operator=(const Only&) = delete;

 private:
  static void choose(std::int64_t target) {
    hwy::SetSupportedTargetsForTest(target);
    // Highway asks again only after this.
    hwy::GetChosenTarget().DeInit();
  }
};

}  // namespace vegard::tests
