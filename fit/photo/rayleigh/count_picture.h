// Pictures in counts per second (their numbers less the dark level, divided by the flat field and the
// exposure) and in rayleighs, with the error of each pixel.
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

struct RayleighPicture {
  /// Channels "rayleigh.5577" and "error.5577", named by the filter's line: the light below the air, and the
  /// standard uncertainty of the pixel by its noise and the dark level. NaN for unusable pixels.
  sim::Image image;
  /// Relative standard uncertainty by the factor and the flat field, common to all pixels.
  double scale_error = 0.0;
  double least = 0.0, median = 0.0, most = 0.0;  ///< values of the rayleighs
  std::size_t unknown = 0;                       ///< number of unusable pixels
};

/// Converts counts to rayleighs; the filter must have a factor.
RayleighPicture rayleigh_picture(const CountPicture& counts, const RayleighFilter& filter);

/// Returns the bytes of a FITS file with two planes, rayleighs and their error, and scale_error in a keyword.
std::string encode_rayleigh_fits(const RayleighPicture& picture, const RayleighFilter& filter,
                                 const RayleighCamera& camera, const std::string& photo, double exposure_s,
                                 const std::string& name);

/// Returns the bytes of an EXR with the two channels.
std::string encode_rayleigh_exr(const RayleighPicture& picture, const RayleighFilter& filter,
                                const RayleighCamera& camera, const std::string& photo, double exposure_s,
                                const std::string& name);

}  // namespace vegard::fit
