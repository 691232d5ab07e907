// A picture in rayleighs, with the error of each pixel.
#pragma once

#include <string>
#include <vector>

#include "fit/photo/rayleigh/count_picture.h"
#include "fit/photo/rayleigh/rayleigh_camera.h"
#include "sim/base/image.h"

namespace vegard::fit {

struct RayleighPicture {
  /// Channels "rayleigh.5577" and "error.5577" by the filter's line: light below the air, and the standard
  /// uncertainty of a pixel by itself, that of its noise and of the dark level. NaN where nothing is known.
  sim::Image image;
  /// Relative, common to all pixels: of the factor and the flat field.
  double scale_error = 0.0;
  double least = 0.0, median = 0.0, most = 0.0;  ///< of the rayleighs
  std::size_t unknown = 0;                       ///< pixels
};

/// The filter has a factor.
RayleighPicture rayleigh_picture(const CountPicture& counts, const RayleighFilter& filter);

/// FITS of two planes, rayleighs and their error, with the scale's in a keyword.
std::string encode_rayleigh_fits(const RayleighPicture& picture, const RayleighFilter& filter,
                                 const RayleighCamera& camera, const std::string& photo, double exposure_s,
                                 const std::string& name);

/// EXR of the two channels.
std::string encode_rayleigh_exr(const RayleighPicture& picture, const RayleighFilter& filter,
                                const RayleighCamera& camera, const std::string& photo, double exposure_s,
                                const std::string& name);

}  // namespace vegard::fit
