// Parses the file names of the imagers THEMIS, REGO and TREx: 20140310_0603_gill_themis19_full.pgm.gz has a
// minute of frames, 20211030_060500_149606_gill_rgb-04_320ms_burst.png is one picture, at 06:05:00.149606
// UTC.
#pragma once

#include <optional>
#include <string>

#include "sim/base/picture/picture_metadata.h"

namespace vegard::fit {

struct ImagerName {
  double begin_s = 0.0;  ///< since 1970, UTC
  double lasts_s = 0.0;  ///< an hour or a minute; 0 for one picture
  std::string utc;       ///< beginning of the exposure, for one picture
  std::string site, imager, mode;
  std::optional<double> exposure_s;
};

/// Parses a file's name without its folder; none for a name of another form.
std::optional<ImagerName> imager_name(const std::string& file_name);

/// Adds to the metadata what the name says and the metadata lack; nothing if the name is of another form.
void add_imager_name(const std::string& file_name, sim::PictureMetadata& metadata);

/// Returns "its name says 06:03, the frame itself ..." if the times of the name and of the header contradict
/// each other; empty if they do not, or if one of them is unknown. The first frame of a minute may begin, and
/// the last end, some seconds outside of it.
std::string contradicted_time(const std::string& file_name, const sim::PictureMetadata& metadata);

}  // namespace vegard::fit
