// Writes the mask as a file, and the photograph with the masked pixels in colours.
#pragma once

#include <string>
#include <vector>

#include "fit/photo/mask/pixel_set.h"
#include "fit/photo/photo.h"

namespace vegard::fit {

/// The pixels that one finder masks, and how they are shown.
struct MaskPart {
  std::string name;         ///< "stars"
  std::string colour_name;  ///< "yellow"
  unsigned char colour[3];  ///< red, green, blue
  PixelSet out;
};

/// Returns the union of the parts, in a set of this size.
PixelSet left_out(const std::vector<MaskPart>& parts, int width, int height);

/// Returns the bytes of an 8-bit grey PNG that is white where the photograph is used.
std::string mask_png(const PixelSet& left_out);

/// Returns the bytes of an 8-bit colour PNG: the photograph (brightened if it is dark), with each masked
/// pixel mixed in equal parts with the colour of the first part that has it.
std::string shown_mask_png(const Photo& photo, const std::vector<MaskPart>& parts);

}  // namespace vegard::fit
