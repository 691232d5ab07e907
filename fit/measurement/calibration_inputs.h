// What a calibration is given, read: stars in tables and lists, other programs' solutions, and the size of
// the picture that they speak of.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fit/measurement/calibration_request.h"
#include "fit/photo/photo.h"
#include "fit/photo/pointing/exchange/star_files.h"
#include "fit/photo/pointing/scene_camera.h"

namespace vegard::fit {

/// The size of the picture, or that of the option; else large enough for the stars. Throws Error(usage).
Frame frame_of_stars(const CalibrationRequest& request, const std::optional<Photo>& photo,
                     const std::vector<StarSighting>& stars);
Frame frame_of_maps(const CalibrationRequest& request, const std::optional<Photo>& photo,
                    const sim::DirectionMap& map);

/// The points of light of solve-field's list, if the table of stars is one.
std::optional<StarPoints> listed_points(const CalibrationRequest& request);

/// Moves a star from the pixels of a crop to those of the picture.
void move_by_offset(const CalibrationRequest& request, StarSighting& star);

/// The stars of the table, in the pixels of the picture.
std::vector<StarSighting> table_of(const CalibrationRequest& request, const SkyOfPicture& sky);

/// Where the pixels look by another program's solution. Throws Error(usage, unreadable_input).
KnownMaps told_directions(const CalibrationRequest& request, const std::optional<Photo>& photo,
                          const SkyOfPicture& sky);

}  // namespace vegard::fit
