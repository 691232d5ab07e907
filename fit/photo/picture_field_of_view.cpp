#include "fit/photo/picture_field_of_view.h"

#include <algorithm>
#include <cmath>

#include "fit/photo/camera_bodies.h"
#include "sim/base/file/number_text.h"
#include "sim/base/number/constants.h"

namespace vegard::fit {
namespace {

constexpr double kFilmWidthMm = 36.0, kFilmHeightMm = 24.0;

/// Longer side over shorter.
double shape(double a, double b) { return std::max(a, b) / std::min(a, b); }

bool is_cut(const sim::PictureMetadata& metadata) {
  constexpr double kTolerance = 0.01;  // a small picture's sides are rounded to pixels
  if (!metadata.exif_width_px || !metadata.exif_height_px) return false;
  return std::abs(shape(*metadata.width_px, *metadata.height_px) /
                      shape(*metadata.exif_width_px, *metadata.exif_height_px) -
                  1.0) > kTolerance;
}

/// True if a sensor is likely to have this shape: 3:2 or 4:3, as all bodies of the table. A camera that is
/// set to 16:9 or to a square crops its pictures by an unknown amount.
bool has_shape_of_a_sensor(double width, double height) {
  constexpr double kTolerance = 0.02;  // rows and columns at the edges that the camera leaves out
  const double s = shape(width, height);
  return std::abs(s / 1.5 - 1.0) < kTolerance || std::abs(s * 0.75 - 1.0) < kTolerance;
}

/// Returns the field of view by the sensor of the camera's body, if the picture names one that is in the
/// table.
PictureFieldOfView view_by_body(const sim::PictureMetadata& metadata) {
  PictureFieldOfView view;
  view.why_not = "the picture does not say how wide its lens sees";
  if (!metadata.focal_length_mm || !metadata.model) return view;
  const std::string focal_words = "EXIF FocalLength " + sim::short_number(*metadata.focal_length_mm) + " mm";
  const std::string folder = lensfun_folder();
  if (folder.empty()) {
    view.why_not =
        "the picture has a focal length (" + focal_words +
        ") but no sensor's size, and the table of cameras that may have it, Lensfun's (Debian's package "
        "liblensfun-data-v1), is not installed";
    return view;
  }
  const std::optional<CameraBody> body =
      find_camera_body(folder, metadata.make.value_or(""), *metadata.model);
  if (!body) {
    view.why_not = "the picture has a focal length (" + focal_words +
                   ") but no sensor's size, and Lensfun's table of cameras has no " + *metadata.model;
    return view;
  }
  if (!has_shape_of_a_sensor(*metadata.width_px, *metadata.height_px)) {
    view.why_not = "the picture has been cut, by the camera perhaps: its shape is neither 3:2 nor 4:3";
    return view;
  }
  view.focal_px = focal_of_35mm_px(*metadata.focal_length_mm * body->crop_factor, *metadata.width_px,
                                   *metadata.height_px);
  view.hfov_deg = hfov_of_focal_deg(*view.focal_px, *metadata.width_px);
  view.source = focal_words + " and the sensor of the " + body->model + ", crop factor " +
                sim::short_number(body->crop_factor) + " by Lensfun's table";
  view.why_not.clear();
  return view;
}

}  // namespace

double hfov_of_focal_deg(double focal_px, double width_px) {
  return 2.0 * std::atan(0.5 * width_px / focal_px) / sim::kRadiansPerDegree;
}

double focal_of_hfov_px(double hfov_deg, double width_px) {
  return 0.5 * width_px / std::tan(0.5 * hfov_deg * sim::kRadiansPerDegree);
}

double focal_of_35mm_px(double equivalent_mm, double width_px, double height_px) {
  return equivalent_mm * std::hypot(width_px, height_px) / std::hypot(kFilmWidthMm, kFilmHeightMm);
}

PictureFieldOfView picture_field_of_view(const sim::PictureMetadata& metadata) {
  PictureFieldOfView view;
  if (!metadata.width_px || !metadata.height_px) {
    view.why_not = "the picture's size is not known";
    return view;
  }
  const double width = *metadata.width_px, height = *metadata.height_px;
  const bool by_film = metadata.focal_length_35mm_mm.has_value();
  const bool by_sensor = metadata.focal_length_mm && metadata.focal_plane_px_per_mm && metadata.exif_width_px;
  const PictureFieldOfView by_body = by_film || by_sensor ? PictureFieldOfView() : view_by_body(metadata);
  if (!by_film && !by_sensor && !by_body.focal_px) return by_body;
  if (is_cut(metadata)) {
    view.why_not = "the picture has been cut: it has another shape than the camera's had";
    return view;
  }
  if (by_body.focal_px) return by_body;
  if (by_film) {
    const double equivalent_mm = *metadata.focal_length_35mm_mm;
    view.focal_px = focal_of_35mm_px(equivalent_mm, width, height);
    view.source = "EXIF FocalLengthIn35mmFilm " + sim::short_number(equivalent_mm) + " mm, by the diagonal";
    view.rounding_deg =
        0.5 * (hfov_of_focal_deg(focal_of_35mm_px(equivalent_mm - 0.5, width, height), width) -
               hfov_of_focal_deg(focal_of_35mm_px(equivalent_mm + 0.5, width, height), width));
  } else {
    const double stored_width = metadata.orientation >= 5 ? height : width;
    view.focal_px =
        *metadata.focal_length_mm * *metadata.focal_plane_px_per_mm * stored_width / *metadata.exif_width_px;
    view.source = "EXIF FocalLength " + sim::short_number(*metadata.focal_length_mm) +
                  " mm and FocalPlaneXResolution " + sim::short_number(*metadata.focal_plane_px_per_mm) +
                  " px/mm";
  }
  view.hfov_deg = hfov_of_focal_deg(*view.focal_px, width);
  return view;
}

}  // namespace vegard::fit
