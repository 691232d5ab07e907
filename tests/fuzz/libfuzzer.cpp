// What libFuzzer has in the place of driver.cpp: its own mutations, mended as those there are, and no quiet.
#include <algorithm>
#include <cstring>

#include "sim/base/quiet_decoder.h"
#include "tests/fuzz/target.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned seed) {
  size = LLVMFuzzerMutate(data, size, most);
  if (seed % 2 != 0) return size;
  std::string input(reinterpret_cast<const char*>(data), size);
  vegard::tests::mend_after_mutation(input);
  std::memcpy(data, input.data(), std::min(input.size(), most));
  return std::min(input.size(), most);
}

// The sanitizers' reports are what one is here for.
vegard::sim::QuietDecoder::QuietDecoder() = default;
vegard::sim::QuietDecoder::~QuietDecoder() = default;
