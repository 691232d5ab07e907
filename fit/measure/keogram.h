// A keogram: one line of every picture of a night, side by side in time.
#pragma once

#include <string>
#include <vector>

#include "fit/measure/keogram_line.h"
#include "fit/photo/photo.h"
#include "sim/base/image.h"
#include "sim/base/picture/image_io.h"

namespace vegard::fit {

/// When pictures were taken.
struct PictureTimes {
  enum class Kind {
    utc,     ///< seconds since 1970-01-01T00:00:00Z
    clock,   ///< seconds on a clock of somebody's own
    number,  ///< not known: 0, 1, 2, …
  };
  Kind kind = Kind::number;
  std::vector<double> seconds;  ///< one per picture
  std::string source;           ///< where they come from, in words
};

struct KeogramColumn {
  double time = 0.0;  ///< in the units of PictureTimes
  std::string file_name, sha256;
  std::vector<double> mean, standard_error;  ///< [position * 3 + channel], NaN as in fit/measure/profile.h
  std::vector<int> count;
};

struct Keogram {
  KeogramLine line;
  PictureTimes::Kind time_kind = PictureTimes::Kind::number;
  std::string time_source;
  int picture_width_px = 0, picture_height_px = 0;  ///< of every picture
  std::string decoding;                             ///< of every picture
  std::string mask_name, mask_sha256;
  std::string camera;                  ///< whose directions; empty: of rows
  bool floating = false, srgb = true;  ///< the pictures' kind, as in Photo
  std::vector<KeogramColumn> columns;  ///< in the order of time

  int positions() const { return static_cast<int>(line.position.size()); }
};

/// One more picture, later than the ones before. Throws sim::Error(unreadable_input) that names it if its
/// size or its decoding is another, and sim::Error(usage) if it has no later time.
void add_picture(const Photo& photo, double time, Keogram& keogram);

/// Comment lines, a line of names, and a line per picture and place, as profile_csv() has them.
std::string keogram_csv(const Keogram& keogram);

/// A column per picture, whatever the time between them, and a row per place: R, G, B in linear light and
/// sigma.R, sigma.G, sigma.B.
sim::Image keogram_image(const Keogram& keogram);

/// What belongs beside that image: times, positions and sources, as text.
sim::ImageAttributes keogram_attributes(const Keogram& keogram);

/// "2015-10-07T08:23:51.743Z" or a number.
std::string time_text(const Keogram& keogram, double time);

}  // namespace vegard::fit
