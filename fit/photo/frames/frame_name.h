// Names of single frames in a file: "file.pgm.gz#12" by its number from 0,
// "file.pgm.gz#2014-03-10T06:05:33Z" by the time at which it was taken.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "fit/photo/frames/frame_file.h"
#include "sim/base/error.h"

namespace vegard::fit {

struct FrameName {
  std::string file;
  std::optional<int> number;
  std::optional<double> utc_s;  ///< seconds since 1970 (sim/base/utc_time.h)

  bool is_chosen() const { return number || utc_s; }
};

/// Parses a name. If a file with the whole name exists, the name means that file; and text after the last '#'
/// that is neither a number nor a time is part of the file's name.
FrameName frame_name(const std::string& name);

/// Returns the file's part of a name.
std::string file_of_frame(const std::string& name);

/// "file.pgm.gz#12"
std::string name_of_frame(const std::string& file, int number);

/// Returns the stem for names of files that are made from a picture: the picture's file name without folder
/// and extension, with the number of a frame in four digits: "file_0012".
std::string stem_of_picture(const std::string& name);

/// Returns the number of the frame whose beginning is nearest to a time (of two equally near ones the
/// earlier). The difference may be at most the median interval of the frames, or for a single frame its
/// exposure, or 1 s if that is unknown. Throws sim::Error(unreadable_input) if no frame is so near, or none
/// has a time.
int frame_at(const std::vector<FrameHead>& frames, double utc_s, const std::string& file);

/// "20 frames, 2014-03-10T06:03:00.031212Z to 2014-03-10T06:03:57.034815Z", as far as they have times.
std::string frames_text(const std::vector<FrameHead>& frames);

/// Returns the names of that many frames: "#0 to #19".
std::string numbers_text(std::size_t frames);

/// Returns sim::Error(usage), which asks the user to choose one of the frames.
sim::Error no_frame_chosen(const std::vector<FrameHead>& frames, const std::string& file);

}  // namespace vegard::fit
