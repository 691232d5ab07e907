// Artistic colouring of the aurora: two chosen colours at two altitudes replace the colours that the
// electrons excite.
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

/// Returns the non-negative amounts of lines with the colours `of_line` whose sum is `colour`, or is closest
/// to it in the sum of squares. A colour inside the cone of the lines' colours is reproduced exactly. At most
/// three amounts are not 0; of several solutions the one with the least light is returned.
std::vector<double> line_amounts(const std::vector<std::array<double, 3>>& of_line,
                                 const std::array<double, 3>& colour);

/// The two colours as amounts of lines. Between the altitudes low_km and high_km the colour changes linearly
/// from `low` to `high`.
struct ColourLadder {
  std::vector<double> low, high;  ///< [line]
  double low_km = 110.0, high_km = 220.0;
};

/// Returns a profile with the total light (the sum over the lines) of `usual` at each altitude, divided among
/// the lines as the ladder says: total and vertical shape are those of `usual`, the colours are the ladder's.
/// Only the ratios of a colour's amounts matter. The profile is dark where the amounts are all 0.
HeightProfile colours_profile(const HeightProfile& usual, const ColourLadder& ladder);

/// Applies colours_profile() to every entry of a table.
ProfileTable colours_table(const ProfileTable& usual, const ColourLadder& ladder);

}  // namespace vegard::sim
