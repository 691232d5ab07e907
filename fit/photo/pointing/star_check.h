// Checks whether stars can constrain a camera.
#pragma once

#include <string>
#include <vector>

#include "fit/photo/pointing/star_sighting.h"

namespace vegard::fit {

/// Throws sim::Error(unreadable_input) about the file `name` if there are too few stars for this number of
/// free numbers, or if all are in one point or on one line of the picture or of the sky. `called`: their name
/// in the plural.
void check_stars(const std::vector<StarSighting>& stars, int free_numbers, const std::string& name,
                 const std::string& called = "stars");

/// Throws sim::Error(unreadable_input) about the file `name` if a star of a table is more than a pixel
/// outside of the picture: the table belongs to another picture, or to another size of this one.
void check_star_places(const std::vector<StarSighting>& stars, const Frame& frame, const std::string& name);

/// The number of parts that a picture is divided into, three by three.
inline constexpr int kPictureNinths = 9;

/// Returns the ninth of the picture that contains a place, from the upper left on by rows, and its name:
/// "upper left", "middle".
int ninth_of(const Frame& frame, double x_px, double y_px);
std::string region_name(const Frame& frame, double x_px, double y_px);

/// True if there are at least six stars and all are in the picture's upper left quarter, as those of a
/// smaller version or a crop of the picture are. Of tables with six stars all over the picture, one in four
/// thousand is so.
bool only_in_first_quarter(const std::vector<StarSighting>& stars, const Frame& frame);

}  // namespace vegard::fit
