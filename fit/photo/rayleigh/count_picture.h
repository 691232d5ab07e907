// A picture in counts per second: its numbers less the dark level, divided by the flat field and the
// exposure.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fit/photo/rayleigh/rayleigh_camera.h"
#include "sim/base/image.h"

namespace vegard::fit {

struct CountPicture {
  sim::Image rate;              ///< one channel, counts s^-1; 0 for unusable pixels
  std::vector<float> variance;  ///< variance of the rate by the pixel's own noise, as far as that is known
  std::vector<char> usable;     ///< 0: saturated, blank, or where the flat field is below a hundredth
  double exposure_s = 0.0;
  bool is_noise_known = false;  ///< true if the filter has a gain: photon and read noise are known
};

/// Reads the picture with this name (fit/photo/frames/frame_name.h), from a file of numbers with one channel,
/// or with three of which the filter names one. The flat field is divided by its mean over the middle eleven
/// by eleven pixels. The noise is that of the photons (counts over the gain), of reading and of rounding.
/// Throws sim::Error(unreadable_input) for a picture that cannot be read, whose numbers are not counts (JPEG,
/// HEIC), whose exposure is not given, or whose dark picture or flat field has another size; (usage) for a
/// picture of three channels if the filter names none.
CountPicture count_picture(const std::string& picture, const RayleighFilter& filter,
                           std::optional<double> exposure_s = {});

}  // namespace vegard::fit
