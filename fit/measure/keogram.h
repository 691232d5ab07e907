// Keograms: one line of every picture of a night, side by side in time. Builds them and writes them as CSV
// and as an image.
#pragma once

#include <string>
#include <vector>

#include "fit/measure/keogram_line.h"
#include "fit/photo/photo.h"
#include "sim/base/image.h"
#include "sim/base/picture/image_io.h"

namespace vegard::fit {

/// The times at which pictures were taken.
struct PictureTimes {
  enum class Kind {
    utc,     ///< seconds since 1970-01-01T00:00:00Z
    clock,   ///< seconds on a clock that is not UTC
    number,  ///< unknown times; the numbers of the pictures, 0, 1, 2, …, instead
  };
  Kind kind = Kind::number;
  std::vector<double> seconds;  ///< one per picture
  std::string source;           ///< of the times, in words
};

struct KeogramColumn {
  double time = 0.0;  ///< as in PictureTimes::seconds
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
  std::string camera;                  ///< source of the directions; empty: positions are rows
  bool floating = false, srgb = true;  ///< the pictures' kind, as in Photo
  std::vector<KeogramColumn> columns;  ///< in the order of time

  int positions() const { return static_cast<int>(line.position.size()); }
};

/// Adds a picture, which must be later than the ones before. Throws sim::Error(unreadable_input) with its
/// name if its size or its decoding differs from theirs, and sim::Error(usage) if it is not later.
void add_picture(const Photo& photo, double time, Keogram& keogram);

/// Returns the keogram as CSV in the form of profile_csv(): comment lines, a line of column names, and a line
/// per picture and position.
std::string keogram_csv(const Keogram& keogram);

/// Returns an image with a column per picture, whatever the time between pictures, and a row per position.
/// Channels: R, G, B in linear light and sigma.R, sigma.G, sigma.B.
sim::Image keogram_image(const Keogram& keogram);

/// Returns the metadata of keogram_image(): times, positions and sources, as text.
sim::ImageAttributes keogram_attributes(const Keogram& keogram);

/// Formats a time of the keogram: "2015-10-07T08:23:51.743Z" for UTC, else a number.
std::string time_text(const Keogram& keogram, double time);

}  // namespace vegard::fit
