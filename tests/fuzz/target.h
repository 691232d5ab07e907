// What a fuzz target is: a function that takes any bytes, and what to begin with.
//
// A target returns for every input. What it must not do, whatever the bytes: end the process, throw, go on
// for ever, or take more memory than its driver allows. It calls std::abort() where a promise is broken.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace vegard::tests {

/// Sound inputs to begin with. `source`: the folder of the project, for what is there anyway.
std::vector<std::string> fuzz_seeds(const std::string& source);

/// Pieces that are worth putting in: keys of TOML, tags of TIFF.
std::vector<std::string> fuzz_dictionary();

/// Mends what would otherwise hide all that lies behind it: the checksums of a PNG.
void mend_after_mutation(std::string& input);

}  // namespace vegard::tests
