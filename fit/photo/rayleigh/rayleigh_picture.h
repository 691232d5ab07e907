// A picture in rayleighs, with the error of each pixel.
#pragma once

#include <string>
#include <vector>

#include "fit/photo/rayleigh/count_picture.h"
#include "fit/photo/rayleigh/rayleigh_camera.h"
#include "sim/base/image.h"

namespace vegard::fit {

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
