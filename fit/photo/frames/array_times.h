// The times of the images in a file of arrays: an array of the file that has one time for each.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "fit/photo/frames/imager_words.h"
#include "sim/base/array/array_file.h"

namespace vegard::fit {

/// Whether an array that is not the images may hold the times of so many frames: it has as many texts or
/// numbers, and its name or its kind says that they are times.
bool has_times(const sim::ArrayFile& file, std::size_t images, std::uint64_t frames);

/// Of each frame; empty where no array has them. Read are texts ("2021-10-30 06:05:00.149606 UTC"), NASA's
/// CDF_EPOCH (milliseconds since the year 0) and TT2000 (nanoseconds of terrestrial time, with the leap
/// seconds until 2017), seconds since 1970 and MATLAB's days since the year 0; the last two are distinguished
/// from each other by their size, and anything else is taken for no time. Throws as ArrayFile does.
std::vector<std::optional<ImagerTime>> array_times(sim::ArrayFile& file, std::size_t images,
                                                   std::size_t frames);

/// Seconds since 1970 in UTC, without leap seconds. Nothing for what lies outside of the years 1900 to 2200.
std::optional<double> cdf_epoch_seconds(double milliseconds);
std::optional<double> tt2000_seconds(std::int64_t nanoseconds);

}  // namespace vegard::fit
