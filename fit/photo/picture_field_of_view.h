// Computes a picture's field of view from its metadata.
//
// A pinhole's focal length in pixels, f, follows from the first of these that is known:
// (1) the equivalent focal length F35, which "gives the same angle on 35 mm film": f = F35 D / 43.267 mm,
// with D the picture's diagonal in pixels and 43.267 mm that of the 36 mm x 24 mm frame. The makers'
// guideline (CIPA DCG-001) compares diagonals; some makers compare widths instead, which is the same for
// pictures of 3:2 and differs by 4 % for 4:3. (2) The lens's focal length and the sensor's pixels per mm,
// scaled to the picture's width. (3) The lens's focal length F and the crop factor c of the camera's body
// (camera_bodies.h): F35 = F c; for pictures of 3:2 or 4:3 only.
//
// Rotating a picture changes neither f nor D: the field of view is across the upright picture's width,
// 2 atan(width / 2 f). A picture whose shape differs from the one that EXIF gives for the camera has been
// cropped: its field of view is unknown, and none is returned.
#pragma once

#include <optional>
#include <string>

#include "sim/base/picture/picture_metadata.h"

namespace vegard::fit {

struct PictureFieldOfView {
  std::optional<double> hfov_deg;  ///< across the upright picture
  std::optional<double> focal_px;
  std::string source;                  ///< "EXIF FocalLengthIn35mmFilm 27 mm, by the diagonal"
  std::optional<double> rounding_deg;  ///< error of hfov by half a millimetre, to which F35 is rounded
  std::string why_not;                 ///< why there is no field of view, in words
};

/// Returns the field of view of a picture whose metadata have its size.
PictureFieldOfView picture_field_of_view(const sim::PictureMetadata& metadata);

/// Returns 2 atan(width / 2 f) in degrees.
double hfov_of_focal_deg(double focal_px, double width_px);

/// Inverse of hfov_of_focal_deg().
double focal_of_hfov_px(double hfov_deg, double width_px);

/// Returns F35 D / 43.267 mm.
double focal_of_35mm_px(double equivalent_mm, double width_px, double height_px);

}  // namespace vegard::fit
