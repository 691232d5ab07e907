// A picture in counts per second: its numbers less the dark level, over the flat field and the exposure.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fit/photo/rayleigh/rayleigh_camera.h"
#include "sim/base/image.h"

namespace vegard::fit {

struct CountPicture {
  sim::Image rate;              ///< one channel, counts s^-1; 0 where nothing is known
  std::vector<float> variance;  ///< of it by the pixel's own noise, as far as that is known
  std::vector<char> usable;     ///< 0: full, blank, or where the flat field is below a hundredth
  double exposure_s = 0.0;
  bool is_noise_known = false;  ///< the photons' and the reading's: the filter has a gain
};

/// Of a picture's name (fit/photo/frames/frame_name.h), of a file of numbers of one channel or of three, one
/// of which the filter names; the flat field is divided by its mean over the middle eleven by eleven pixels.
/// The noise is that of the photons (counts over the gain), the reading and the rounding. Throws
/// sim::Error(unreadable_input) for a picture that cannot be read, whose numbers are no counts (JPEG, HEIC),
/// of an exposure that is not given, or whose dark picture or flat field has another size; (usage) for
/// colours of which none is named.
CountPicture count_picture(const std::string& picture, const RayleighFilter& filter,
                           std::optional<double> exposure_s = {});

}  // namespace vegard::fit
