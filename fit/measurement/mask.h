// A mask that leaves out of a photograph what is asked for: the stage that `vegard mask` runs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "fit/measurement/words.h"
#include "fit/photo/mask/circle.h"
#include "fit/photo/mask/faulty_pixels.h"
#include "fit/photo/mask/horizon.h"
#include "fit/photo/mask/mask_picture.h"
#include "fit/photo/mask/stars.h"
#include "fit/photo/photo.h"

namespace vegard::fit {

struct MaskRequest {
  std::vector<std::string> drawn;                   ///< files of masks
  std::vector<std::vector<PicturePoint>> polygons;  ///< of three corners or more
  bool finds_circle = false;                        ///< the fisheye's circle is looked for
  std::optional<Circle> circle;                     ///< or it is this one
  bool finds_skyline = false;                       ///< the skyline is looked for
  std::vector<PicturePoint> horizon;                ///< or it is the line through these points
  bool text = false, saturated = false, hot = false, stars = false;
  double circle_margin_px = 2.0, horizon_margin_px = 2.0;
  SaturationSettings saturation;
  HotPixelSettings hot_pixels;
  StarSettings star;

  bool empty() const;
};

struct Mask {
  std::string photo, decoding;
  std::vector<MaskPart> parts;
  std::vector<std::string> notes;       ///< the findings, a line each
  std::optional<CircleFound> circle;    ///< if it was looked for
  std::optional<HorizonFound> skyline;  ///< if it was looked for
  std::optional<Horizon> horizon;       ///< found or given
  PixelSet left_out;

  std::size_t used_px() const { return left_out.in.size() - left_out.count(); }
};

/// Throws Error(usage) for a part that is not found and a mask that leaves no pixel, Error(unreadable_input)
/// for a drawn file that is no mask. `tell` is told how far it is, not what was found.
Mask make_mask(const Photo& photo, const MaskRequest& request, const Tell& tell = {});

/// "circle: centre 192.0, 192.0, radius 180.1 px; ..." and "horizon: contrast 0.80 ...".
std::string words_of(const CircleFound& found);
std::string words_of(const HorizonFound& found);

/// The findings, and how much each part leaves out; with the colours of shown_mask_png() if `has_colours`.
void tell_mask(const Mask& mask, bool has_colours, const Tell& tell);

/// The same numbers.
nlohmann::ordered_json mask_json(const Mask& mask);

}  // namespace vegard::fit
