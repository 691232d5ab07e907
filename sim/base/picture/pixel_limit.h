// The limit on the size of an image: a file of a few bytes cannot ask for all of the machine's memory.
#pragma once

#include <string>

namespace vegard::sim {

/// 268 million pixels: 4 GiB as three channels of floats with their flags.
constexpr long long max_pixels = 1LL << 28;

/// Along a side: libpng's limit; OpenCV's is 2^20.
constexpr long long longest_side_px = 1000000;

/// To be called with what a header promises, before anything is allocated. Throws Error(unreadable_input)
/// about the file `name` unless there are pixels, and no more than these.
void check_pixel_limit(long long width, long long height, const std::string& name);

}  // namespace vegard::sim
