// The mask as a file, and the photograph with what it leaves out in colours.
#pragma once

#include <string>
#include <vector>

#include "fit/photo/mask/pixel_set.h"
#include "fit/photo/photo.h"

namespace vegard::fit {

/// What one finder leaves out, and how it is shown.
struct MaskPart {
  std::string name;         ///< "stars"
  std::string colour_name;  ///< "yellow"
  unsigned char colour[3];  ///< red, green, blue
  PixelSet out;
};

/// The union of the parts, of this size.
PixelSet left_out(const std::vector<MaskPart>& parts, int width, int height);

/// The bytes of an 8-bit grey PNG: white where the photograph is used.
std::string mask_png(const PixelSet& left_out);

/// The bytes of an 8-bit colour PNG: the photograph (brightened if it is dark), half of each pixel that is
/// left out replaced by the colour of the first part that has it.
std::string shown_mask_png(const Photo& photo, const std::vector<MaskPart>& parts);

}  // namespace vegard::fit
