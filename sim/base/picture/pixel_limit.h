// Limits of the size of an image, so that a file of a few bytes cannot use all of the machine's memory.
#pragma once

#include <string>

namespace vegard::sim {

/// 268 million pixels: 4 GiB as three channels of floats with their flags.
constexpr long long max_pixels = 1LL << 28;

/// Longest side: libpng's limit; OpenCV's is 2^20.
constexpr long long longest_side_px = 1000000;

/// Checks the size in a header; call it before anything is allocated. Throws Error(unreadable_input) about
/// the file `name` if there are no pixels or if the size is beyond the limits.
void check_pixel_limit(long long width, long long height, const std::string& name);

}  // namespace vegard::sim
