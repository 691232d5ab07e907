// The stars that the eye sees, by name: data/stars/bright_stars.csv, 5044 stars to magnitude 6.
#pragma once

#include <string>
#include <vector>

#include "sim/view/sky/star_place.h"

namespace vegard::sim {

struct BrightStar {
  int hip = 0, hd = 0;      ///< numbers of the catalogues of Hipparcos and Henry Draper; 0 if it has none
  std::string designation;  ///< "alf Lyr", "17 Tau", or empty
  std::string name;         ///< "Vega", or empty
  CataloguePlace place;
  double magnitude = 0.0;     ///< V
  double colour_index = 0.6;  ///< B - V; that of the Sun's like for the two that have none

  /// The first of name, designation and "HIP 91262" that there is.
  std::string label() const;
};

/// All of them, the brightest first.
const std::vector<BrightStar>& catalogue_stars();

/// The 921 of them to magnitude 4.5, which a camera is calibrated by.
const std::vector<BrightStar>& bright_stars();

/// By name or designation, capitals or not, or by "HIP 91262" or "HD 172167"; null if there is none.
const BrightStar* find_bright_star(const std::string& words);

}  // namespace vegard::sim
