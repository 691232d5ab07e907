// Features of a picture's sky that hold for a camera never seen before: they need neither its pointing nor
// its lens, do not change with its gain, and use colour only where there is one. A few more are of cameras
// whose directions are known.
//
// The picture is averaged over some 64 x 64 cells.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "fit/photo/photo.h"
#include "fit/sky_kind/cell_light.h"

namespace vegard::fit {

enum class SkyFeature {
  brightness,  ///< log10 of the median cell, the file's white = 1
  contrast,    ///< difference of log10 of brightness between the 95th and the 5th percentile of cells
  structure,   ///< standard deviation of log10 of brightness about a smooth (quadratic) sky
  elongated,   ///< coherence of the local structure tensor, weighted by its energy: 0 to 1
  green,       ///< of light brighter than the sky: green minus the mean of red and blue, over the sum
  blue,        ///< of the median sky: blue minus red, over the sum
  points,      ///< log10 of 1 + the number of star-like points
  clipped,     ///< log10 of 0.01 + the share of pixels at white in the cell that has most of them
  // Greenness: green minus the mean of red and blue, over the sum; no number without colour.
  peak,          ///< log10 of the brightest blob over the ring about it
  green_spread,  ///< greenness of the cell that two in a hundred exceed, minus the median cell's
  green_light,   ///< correlation of greenness with light above the smooth sky
  warm,          ///< of light brighter than the sky: red minus blue, over the sum
  star_cover,    ///< share of the tiles of the sky that have a star-like point
  disc,          ///< log10 of 1e-5 + the largest connected area at white, as a share of the sky
  disc_round,    ///< that area over the one of the circle about it; 0 if there is none
  texture,       ///< light's differences between neighbouring cells over its standard deviation
  ridge_length,  ///< length of the longest bright and long part of the sky, over the picture's longer side
  ridges,        ///< number of such parts
  ridge_share,   ///< their share of all bright parts
  green_length,
  green_ridges,
  green_share,  ///< the same, of greenness in place of light
  crossed,      ///< share of the gradients' energy along bright ridges rather than across: rays
  central,      ///< mean distance of bright cells from the middle of the sky, over that of all cells
  level,        ///< log10 of the cell that one in twenty exceeds, the file's white = 1
  smooth,       ///< as contrast, of the smooth sky alone: what twilight and a town make
  crossings,    ///< mean number of bright bands that a line across them meets, of lines that meet any
  fine_rays,    ///< share of the light's small changes along bright ridges rather than across: fine rays
  halo,         ///< log10 of the ring about the brightest blob over the median cell
  star_gaps,    ///< share of the sky's tiles that have no star, less what so many stars would leave by chance
  grey_light,   ///< structure that is not greener than the sky: of clouds, towns and the Milky Way
  // By the camera's directions and the time, where these are known (fit/survey/filter), else no numbers.
  banded,          ///< share of structure that bins of equal angle in the magnetic meridian explain
  crosswise,       ///< energy of gradients across arcs minus that along arcs, over their sum: -1 to 1
  moon_peak,       ///< log10 of the brightest cell at the Moon's position over the ring about it
  lamp_peak,       ///< the same ratio for the brightest blob elsewhere
  sunward,         ///< increase of log10 of brightness towards the Sun's azimuth, at the horizon
  sun_elevation,   ///< degrees
  moon_elevation,  ///< degrees, as seen from the site
  moon_light,      ///< illuminated fraction of the Moon, 0 if it is below the horizon
  // By fit/sky_kind/sky_lines.h, of pictures by themselves alone, else no numbers.
  star_tiles,   ///< share of the sky's tiles that have more star-like points than dark ones
  ridge_top,    ///< log10 of how strong the strongest thin bright lines are
  thin_lines,   ///< length of all thin bright lines, over the picture's longer side
  wide_lines,   ///< the same of lines twice as wide
  ray_strength  ///< log10 of the strength of fine lines that cross the coarse ones, where the light is
};
inline constexpr int kSkyFeatures = 44;

/// Whether the filter of surveys finds the feature too.
inline bool is_of_surveys(SkyFeature feature) { return feature < SkyFeature::star_tiles; }

using SkyFeatures = std::array<double, kSkyFeatures>;

struct SkyFeatureWords {
  SkyFeature feature;
  const char *name, *unit;
};
/// Returns names and units of all features in their order ("sun elevation", "deg"), as in results and in
/// files of a model.
const std::array<SkyFeatureWords, kSkyFeatures>& sky_feature_words();

inline double& feature(SkyFeatures& features, SkyFeature which) {
  return features[static_cast<std::size_t>(which)];
}
inline double feature(const SkyFeatures& features, SkyFeature which) {
  return features[static_cast<std::size_t>(which)];
}

/// Returns the cells of a picture. `is_kept`: per pixel, 0 if masked; empty: no mask. A cell is sky if half
/// of its pixels are kept. Throws sim::Error(unreadable_input) about `file` if no cell is sky.
FeatureCells sky_cells(int width, int height, const std::vector<std::uint8_t>& is_kept,
                       const std::string& file);

/// The light of the sky as features are made of it: log_grey in units of the sky's own, so that a camera's
/// gain does not count, and its residual.
CellLight sky_light(const Photo& photo, const FeatureCells& cells);

/// Computes the features of a photograph; those of colour are NaN for a grey one, and those of directions for
/// all. The same picture gives the same numbers.
SkyFeatures sky_features(const Photo& photo, const FeatureCells& cells);

}  // namespace vegard::fit
