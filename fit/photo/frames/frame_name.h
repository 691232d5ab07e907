// Names of single frames in a file: "file.pgm.gz#12" by its number from 0,
// "file.pgm.gz#2014-03-10T06:05:33Z" by the time at which it was taken.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "fit/photo/frames/frame_file.h"

namespace vegard::fit {

struct FrameName {
  std::string file;
  std::optional<int> number;
  std::optional<double> utc_s;  ///< seconds since 1970 (sim/base/utc_time.h)

  bool is_chosen() const { return number || utc_s; }
};

/// A file of the whole name goes before a frame of another, and what does not look like a number or a time
/// behind the last '#' is part of the file's name.
FrameName frame_name(const std::string& name);

/// The file's part of it.
std::string file_of_frame(const std::string& name);

/// "file.pgm.gz#12"
std::string name_of_frame(const std::string& file, int number);

/// For what is made of a picture: the file's name without its folder and ending, and of a frame its number
/// with four digits: "file_0012".
std::string stem_of_picture(const std::string& name);

/// Which of the frames begins nearest to that time, of two as near the earlier one. It is none if it is
/// further away than frames usually are from each other (the median), of a single one than its exposure, or 1
/// s. Throws sim::Error(unreadable_input) if there is none, or if no frame has a time.
int frame_at(const std::vector<FrameHead>& frames, double utc_s, const std::string& file);

/// "20 frames, 2014-03-10T06:03:00.031212Z to 2014-03-10T06:03:57.034815Z", as far as they have times.
std::string frames_text(const std::vector<FrameHead>& frames);

/// "#0 to #19", how so many frames are called.
std::string numbers_text(std::size_t frames);

/// Throws sim::Error(usage): one of several is to be chosen.
[[noreturn]] void refuse_without_frame(const std::vector<FrameHead>& frames, const std::string& file);

}  // namespace vegard::fit
