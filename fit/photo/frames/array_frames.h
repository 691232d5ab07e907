// Images in files of arrays (sim/base/array): HDF5 as TREx writes a minute of colour frames, MATLAB's files,
// NASA's CDF as THEMIS and REGO publish an hour.
//
// The images are the array with the most numbers of those with two to four dimensions; in a file of the
// imagers' own, "data/images"; or several of one shape that are distinguished by a number at the end of their
// names, "frame1", "frame2". Times stand in an array with one for each frame: texts as ISO writes them, the
// clocks of CDF, seconds since 1970, or MATLAB's days. Words are the attributes of the file, of
// "metadata/file" and of "metadata/frame/frameN".
//
// Integers of up to 16 bits without a sign become a PGM or PPM, all else FITS of floats.
#pragma once

#include <memory>
#include <vector>

#include "fit/photo/frames/frame_store.h"
#include "sim/base/array/array_file.h"

namespace vegard::fit {

/// Which array is the images, and which of its dimensions are rows, columns, colours and frames.
struct ImageStack {
  /// Their indices in the file: one, or one for each frame, in their order.
  std::vector<std::size_t> arrays;
  std::size_t frames = 1;
  long long width_px = 0, height_px = 0;
  int channels = 1;
  /// -1: there is no such dimension.
  int frame_axis = -1, row_axis = 0, column_axis = 1, channel_axis = -1;
};

/// Of four dimensions one is of the three colours: the third with frames behind it, or the last with frames
/// before all. Of three, the first or last that has as many as a times' array is that of frames; without
/// times, a length of 3 at the end is of colours, else frames lie along the shorter of the first and the
/// last. (MATLAB's arrays are taken in MATLAB's order of dimensions.) Throws sim::Error(unreadable_input) if
/// there are no images, several that are as large, or more than the limits of frame_file.h.
ImageStack find_images(const sim::ArrayFile& file);

std::unique_ptr<FrameStore> array_frames(std::unique_ptr<sim::ArrayFile> file);

}  // namespace vegard::fit
