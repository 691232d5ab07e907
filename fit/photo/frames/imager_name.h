// Parses the file names of the imagers THEMIS, REGO and TREx: 20140310_0603_gill_themis19_full.pgm.gz is a
// minute of frames, 20211030_060500_149606_gill_rgb-04_320ms_burst.png one picture, at 06:05:00.149606 UTC.
#pragma once

#include <optional>
#include <string>

#include "sim/base/picture/picture_metadata.h"

namespace vegard::fit {

struct ImagerName {
  double begin_s = 0.0;  ///< since 1970, UTC
  double lasts_s = 0.0;  ///< an hour, a minute; 0 of one picture
  std::string utc;       ///< of one picture, when its exposure began
  std::string site, imager, mode;
  std::optional<double> exposure_s;
};

/// Of a file's name without its folder; nothing for any other name.
std::optional<ImagerName> imager_name(const std::string& file_name);

/// What such a picture's name says, and its file does not.
void add_imager_name(const std::string& file_name, sim::PictureMetadata& metadata);

/// "its name says 06:03, the frame itself ...", if the name and the header's time cannot both be right; empty
/// if they can, or one of them is not known. A minute's first frame may begin some seconds early or its last
/// end late.
std::string contradicted_time(const std::string& file_name, const sim::PictureMetadata& metadata);

}  // namespace vegard::fit
