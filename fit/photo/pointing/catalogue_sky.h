// The catalogue's stars in the sky of a picture, and in equatorial axes for pictures whose time is unknown.
//
// In equatorial axes StarSighting::enu is x to the vernal equinox, y to right ascension 90 degrees, z to the
// north pole, J2000: axes that are right-handed as east, north, up are, so that the fits of cameras work with
// them too.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "fit/photo/pointing/sky_camera.h"
#include "fit/photo/pointing/star_sighting.h"
#include "sim/view/sky/star_place.h"

namespace vegard::fit {

/// Returns the stars up to a magnitude and above an elevation, the brightest first; x_px and y_px are 0.
/// Stars nearer than `apart_deg` to a brighter one are left out: in the picture they are one.
std::vector<StarSighting> catalogue_sky(const sim::Observer& observer, double julian_date, double faintest,
                                        double min_elevation_deg = 5.0, double apart_deg = 0.3);

/// The part of the sky in a frame: its middle, in the axes of the camera's sky, and the angle to the farthest
/// corner.
struct FieldCone {
  Eigen::Vector3d middle = Eigen::Vector3d::UnitZ();
  double radius_rad = 0.0;
};
/// None if the lens has no image of the middle or of a corner.
std::optional<FieldCone> field_cone(const SkyCamera& camera, const Frame& frame);

/// What a camera should see: stars up to magnitude 6 as catalogue_sky() has them, or, if its frame is no
/// larger than 28 degrees from corner to corner and shows fewer than `enough` of them, those of
/// sim::deep_stars() in and around its frame. Of these a star is left out that stands nearer to a brighter
/// one than 0.5 % of the frame's longer side, unless `apart_deg` is 0.
std::vector<StarSighting> field_sky(const SkyCamera& camera, const Frame& frame,
                                    const sim::Observer& observer, double julian_date,
                                    double min_elevation_deg, double apart_deg = 0.3, int enough = 60);

/// Returns the 921 stars to magnitude 4.5, with which wide pictures are recognised, the brightest first, at
/// the epoch J2000; x_px and y_px are 0.
const std::vector<StarSighting>& equatorial_sky();

/// Returns all of sim::deep_stars() in their order, in the same way; equatorial_sky() is their beginning.
const std::vector<StarSighting>& deep_equatorial_sky();

/// Returns one of them; all are only made if it is a faint one.
const StarSighting& equatorial_star(int index);
/// Returns its place in the catalogue.
const sim::CataloguePlace& catalogue_place(int index);

/// Convert a place to a vector (x, y, z) of length 1, and back.
Eigen::Vector3d equatorial_vector(const sim::Equatorial& place);
sim::Equatorial equatorial_place(const Eigen::Vector3d& vector);

}  // namespace vegard::fit
