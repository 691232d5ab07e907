// Computes a picture's field of view from its metadata.
//
// A pinhole's focal length in pixels, f, follows from one of three things. Of a focal length F35 that "gives
// the same angle on 35 mm film": f = F35 D / 43.267 mm, D the picture's diagonal in pixels and 43.267 mm that
// of the 36 mm x 24 mm frame; the diagonal is what the makers' guideline (CIPA DCG-001) compares, the
// picture's width what some makers use instead, which is the same for pictures of 3:2 and differs by 4 % for
// 4:3. Else of the lens's own focal length and the sensor's pixels per mm, scaled to the picture's width.
// Else of the lens's own focal length F and the crop factor c of the camera's body (camera_bodies.h): F35 = F
// c; that only of a picture of 3:2 or 4:3.
//
// Turning a picture changes neither f nor D: the field of view is across the upright picture's width, 2
// atan(width / 2 f). A picture of another shape than EXIF says the camera's was has been cut: how much of the
// angle is left is not known then, and none is given.
#pragma once

#include <optional>
#include <string>

#include "sim/base/picture/picture_metadata.h"

namespace vegard::fit {

struct PictureFieldOfView {
  std::optional<double> hfov_deg;  ///< across the upright picture
  std::optional<double> focal_px;
  std::string source;                  ///< "EXIF FocalLengthIn35mmFilm 27 mm, by the diagonal"
  std::optional<double> rounding_deg;  ///< half a millimetre of a 35 mm equivalent, in degrees of hfov
  std::string why_not;                 ///< in words, if there is none
};

/// Of a picture whose size is known.
PictureFieldOfView picture_field_of_view(const sim::PictureMetadata& metadata);

/// 2 atan(width / 2 f) in degrees.
double hfov_of_focal_deg(double focal_px, double width_px);

/// The other way round.
double focal_of_hfov_px(double hfov_deg, double width_px);

/// F35 D / 43.267 mm.
double focal_of_35mm_px(double equivalent_mm, double width_px, double height_px);

}  // namespace vegard::fit
