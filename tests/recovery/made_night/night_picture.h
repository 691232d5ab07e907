// A frame of a made night as a photograph, and what is true of it.
#pragma once

#include <string>

#include "tests/recovery/made_night/night.h"

namespace vegard::made_night {

/// What a filter is asked, answered by what was put into the picture.
struct FrameTruth {
  bool arc = false;       ///< an arc that stands out by a quarter of the sky, most of it not behind clouds
  bool aurora = false;    ///< any of it that does by 15 %
  bool cloud = false;     ///< hides 30 % of the sky or more, in the mean
  bool moon = false;      ///< in the picture, lit by 2 % or more after clouds
  bool twilight = false;  ///< is brighter than all the rest of the sky
  bool lamp = false;
  double contrast = 0.0;  ///< of the aurora
  double cover = 0.0;     ///< share of the sky that clouds hide

  /// As fit/sky_kind/frame_filter.h puts them in order.
  std::string sky() const;
};

struct NightPicture {
  std::string jpeg;  ///< the file's bytes: eight bits, sRGB, quality 92
  FrameTruth truth;
};

/// Rendered by the library; clouds, the Moon, a lamp and noise (photons, 8000 electrons at white, and 0.0015
/// of white for reading) are put upon it. A pure function of the night and the frame.
NightPicture night_picture(const Night& night, const NightFrame& frame);

}  // namespace vegard::made_night
