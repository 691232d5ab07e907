// The catalogue of naked-eye stars, data/stars/bright_stars.csv, 5044 stars to magnitude 6, and those that
// only narrow fields need: data/stars/faint_stars.csv, 36 367 stars from there to magnitude 8.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "sim/view/sky/star_place.h"

namespace vegard::sim {

struct BrightStar {
  int hip = 0, hd = 0;      ///< Hipparcos and Henry Draper numbers; 0: none
  std::string designation;  ///< "alf Lyr", "17 Tau", or empty
  std::string name;         ///< "Vega", or empty
  CataloguePlace place;
  double magnitude = 0.0;     ///< V
  double colour_index = 0.6;  ///< B - V; a solar value for the two stars without one

  /// Returns the name, else the designation, else "HIP 91262".
  std::string label() const;
};

/// Returns all stars, the brightest first.
const std::vector<BrightStar>& catalogue_stars();

/// Returns the 921 stars to magnitude 4.5, with which cameras are calibrated.
const std::vector<BrightStar>& bright_stars();

/// The faintest of catalogue_stars(), and of deep_stars().
inline constexpr double kFaintestCatalogued = 6.0, kFaintestDeep = 8.0;

/// The number of deep_stars(), which is known without making them.
inline constexpr std::size_t kDeepStars = 41411;

/// Returns catalogue_stars() and behind them, the brightest first, the stars of faint_stars.csv.
const std::vector<BrightStar>& deep_stars();

/// Finds a star by name or designation, without regard to case, or by "HIP 91262" or "HD 172167"; else null.
const BrightStar* find_bright_star(const std::string& words);

}  // namespace vegard::sim
