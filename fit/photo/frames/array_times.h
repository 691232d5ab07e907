// The times of the images in a file of arrays, from an array with one time for each image.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "fit/photo/frames/imager_words.h"
#include "sim/base/array/array_file.h"

namespace vegard::fit {

/// True if an array other than `images` may hold the times of `frames` frames: it has as many texts or
/// numbers, and its name or its type indicates times.
bool has_times(const sim::ArrayFile& file, std::size_t images, std::uint64_t frames);

/// Returns the time of each frame; empty if no array has them. It reads texts ("2021-10-30 06:05:00.149606
/// UTC"), NASA's CDF_EPOCH (milliseconds since the year 0) and TT2000 (nanoseconds of terrestrial time, with
/// the leap seconds until 2017), seconds since 1970 and MATLAB's days since the year 0. The last two are
/// distinguished by their magnitude; other numbers are not times. Throws as ArrayFile does.
std::vector<std::optional<ImagerTime>> array_times(sim::ArrayFile& file, std::size_t images,
                                                   std::size_t frames);

/// Convert to seconds since 1970 in UTC, without leap seconds. None for times outside of the years 1900 to
/// 2200.
std::optional<double> cdf_epoch_seconds(double milliseconds);
std::optional<double> tt2000_seconds(std::int64_t nanoseconds);

}  // namespace vegard::fit
