// Light in two colours between two altitudes, in the place of the electrons' own: what a painter wants.
//
// Source: "Rendering volume nebulae and aurorae" (Gaia Sky), whose aurora has a base colour and a high colour
// from a file (row G17 of docs/volumes.md). Here the film is in rayleighs per emission line, so that a colour
// becomes amounts of the scene's lines.
#pragma once

#include <array>
#include <vector>

#include "sim/light/height_profile.h"
#include "sim/light/profile_table.h"

namespace vegard::sim {

/// Amounts, none below 0, of lines whose colours are `of_line`, that make `colour` or come closest to it in
/// the sum of squares. A colour inside the cone of the lines' colours comes out exactly. At most three
/// amounts are not 0; of several ways the one with the least light is taken.
std::vector<double> line_amounts(const std::vector<std::array<double, 3>>& of_line,
                                 const std::array<double, 3>& colour);

/// The two colours as amounts of lines, and the altitudes between which one passes linearly into the other.
struct ColourLadder {
  std::vector<double> low, high;  ///< [line]
  double low_km = 110.0, high_km = 220.0;
};

/// A profile with all its light, summed over the lines, left at its altitude and shared out among the lines
/// by the ladder: total and vertical shape are the usual profile's, colours the ladder's. Only the ratios of
/// a colour's channels count. Where its amounts are all 0 it is dark.
HeightProfile colours_profile(const HeightProfile& usual, const ColourLadder& ladder);

/// The same of every entry of a table.
ProfileTable colours_table(const ProfileTable& usual, const ColourLadder& ladder);

}  // namespace vegard::sim
