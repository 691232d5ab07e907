// Whether stars can tell anything of a camera.
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

}  // namespace vegard::fit
