// The light of a sheet's beams against altitude, as the sheet asks for it.
#pragma once

#include <vector>

#include "sim/light/height_profile.h"
#include "sim/scene/scene.h"

namespace vegard::sim {

/// Whether a sheet's light is given by its brightness, and its energy flux counts for nothing.
bool has_given_brightness(const Sheet& sheet);

/// The sheet's profile: Maxwellian or of its form. Of a sheet of given brightness, scaled for an energy flux
/// of 1: the column of 557.7 nm from the bottom up to top_km is then brightness_kilorayleigh seen vertically,
/// whatever lines are asked for. (Seen along the field, where a path is longer by one over the cosine to the
/// vertical, the beams are weaker by as much: sim/render/beams.cpp.)
HeightProfile sheet_profile(const std::vector<double>& wavelengths_nm, const Sheet& sheet);

}  // namespace vegard::sim
