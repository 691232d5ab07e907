// Finds in a photograph the parts that the options of vegard mask request.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fit/photo/mask/horizon.h"
#include "fit/photo/mask/hot_pixels.h"
#include "fit/photo/mask/mask_picture.h"
#include "fit/photo/mask/saturated.h"
#include "fit/photo/mask/stars.h"
#include "fit/photo/photo.h"

namespace vegard::apps {

struct MaskRequest {
  std::vector<std::string> drawn;                  ///< files of masks
  std::vector<std::vector<std::string>> polygons;  ///< points as words "x,y"
  std::string circle;                              ///< "auto", "x,y,radius", or empty
  std::vector<std::string> horizon;                ///< "auto", words "x,y", or none
  bool text = false, saturated = false, hot = false, stars = false;
  double circle_margin_px = 2.0, horizon_margin_px = 2.0;
  fit::SaturationSettings saturation;
  fit::HotPixelSettings hot_pixels;
  fit::StarSettings star;

  bool empty() const;
};

struct MaskParts {
  std::vector<fit::MaskPart> parts;
  std::vector<std::string> notes;  ///< the findings, a line each
  std::optional<fit::Horizon> horizon;
};

/// Finds the parts. Throws Error(usage) for a part that cannot be read or found, Error(unreadable_input) for
/// a file that is not a mask.
MaskParts mask_parts(const fit::Photo& photo, const MaskRequest& request);

}  // namespace vegard::apps
