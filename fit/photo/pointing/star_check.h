// Checks that stars can constrain a camera.
#pragma once

#include <string>
#include <vector>

#include "fit/photo/pointing/star_sighting.h"

namespace vegard::fit {

/// Throws sim::Error(unreadable_input) about the file `name` if there are fewer stars than so many numbers
/// need, or if all stand in one point or on one line of the picture or of the sky. `called`: what they are,
/// several of them.
void check_stars(const std::vector<StarSighting>& stars, int free_numbers, const std::string& name,
                 const std::string& called = "stars");

/// Throws sim::Error(unreadable_input) about the file `name` if a star of a table stands more than a pixel
/// outside of the picture: the table is another picture's, or this one's at another size.
void check_star_places(const std::vector<StarSighting>& stars, const Frame& frame, const std::string& name);

/// Whether six stars or more are all in the picture's upper left quarter, as those of the picture made
/// smaller or of a crop are; of stars all over it one in four thousand tables would be so.
bool only_in_first_quarter(const std::vector<StarSighting>& stars, const Frame& frame);

}  // namespace vegard::fit
