// Frames in files of arrays (sim/base/array): HDF5 (TREx, a minute of colour frames), MATLAB files, NASA's
// CDF (THEMIS and REGO, an hour of frames).
//
// The images are the largest array with two to four dimensions; in a file of TREx, "data/images"; or several
// arrays of the same shape whose names differ by a number at the end, "frame1", "frame2". The times are an
// array with one element for each frame: ISO texts, the times of CDF, seconds since 1970, or MATLAB's days.
// The frames' metadata (ImagerWords) are the attributes of the file, of "metadata/file" and of
// "metadata/frame/frameN".
//
// Unsigned integers of up to 16 bits become a PGM or PPM, all other numbers a FITS file of floats.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "fit/photo/frames/frame_store.h"
#include "fit/photo/frames/imager_words.h"
#include "sim/base/array/array_file.h"

namespace vegard::fit {

/// The arrays that hold the images, and which of their dimensions are rows, columns, colours and frames.
struct ImageStack {
  /// Indices of the arrays in the file: one, or one for each frame, in the frames' order.
  std::vector<std::size_t> arrays;
  std::size_t frames = 1;
  long long width_px = 0, height_px = 0;
  int channels = 1;
  /// -1: there is no such dimension.
  int frame_axis = -1, row_axis = 0, column_axis = 1, channel_axis = -1;
};

/// Finds the images in a file. Four dimensions include the three colours: as the third dimension, with the
/// frames as the fourth; or as the last, with the frames as the first. Of three dimensions, the first or the
/// last is that of the frames if its length is that of an array of times; without times, a last dimension of
/// length 3 is that of the colours, otherwise the shorter of the first and the last is that of the frames.
/// (MATLAB's arrays have MATLAB's order of dimensions.) Throws sim::Error(unreadable_input) if there are no
/// images, several arrays of the same size, or more frames or pixels than the limits of frame_store.h allow.
/// `wanted`: the name of the array that is meant, whole or what stands behind its last '/'; empty: by the
/// rules above.
ImageStack find_images(const sim::ArrayFile& file, const std::string& wanted = {});

std::unique_ptr<FrameStore> array_frames(std::unique_ptr<sim::ArrayFile> file,
                                         const std::string& wanted = {});

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
