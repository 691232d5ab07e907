// Describes degeneracies (changes of the free numbers that leave the picture the same) and correlations as
// text.
#pragma once

#include <string>
#include <vector>

#include "fit/parameters/free_parameters.h"
#include "fit/uncertainty/uncertainty.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// A free number with its description for messages.
struct DescribedNumber {
  std::string path;   ///< "sheet.main.energy_kev"
  std::string noun;   ///< "energy"
  std::string owner;  ///< "the main sheet"; may be empty
  std::string unit;   ///< as in the parameter table
  double value = 0.0;
  /// A change that matters, in the unit: a tenth of the value; for an angle ten degrees.
  double noticeable = 1.0;
  enum class Place { none, east, north } place = Place::none;  ///< a component of a centre
  int centre = -1;                    ///< index of this centre: sheets' centres, then footprints'
  bool other_component_free = false;  ///< the other component of this centre is free too
  sim::EastNorth centre_km;           ///< from the observer
  bool of_profile = false;            ///< a coefficient of a free-form profile
  bool is_altitude = false;           ///< the text says "higher" instead of "more"
};

/// Returns the descriptions of `free`; `values` are in the same order.
std::vector<DescribedNumber> described_numbers(const sim::Scene& scene, const std::vector<FreeNumber>& free,
                                               const std::vector<double>& values);

/// Describes a direction in the numbers' own units: "distance and energy of the main sheet trade off: 10 km
/// further with 0.3 keV less looks the same". The direction's length and sign do not matter. The text names
/// at most three numbers, those with the largest change relative to `noticeable`, and always number `always`
/// (an index; none if negative), and tells how many more there are. East and north of one centre are reported
/// as one: further or nearer as seen by the observer, or to the right or left. For a direction of one number:
/// "the data do not constrain the energy of the main sheet".
std::string trade_off_text(const std::vector<DescribedNumber>& numbers, const std::vector<double>& direction,
                           int always = -1);

/// Returns why coordinate j has no error bar: the trade-off in which its component is largest, or "the data
/// do not bound it". `u` is in coordinates, as uncertainty() and drop_flat_directions() return it.
std::string why_undetermined(const sim::Scene& scene, const std::vector<FreeNumber>& free,
                             const std::vector<double>& values, const Uncertainty& u, std::size_t j);

/// Returns texts such as "distance and energy of the main sheet are correlated by −0.95: 3.1 km further (one
/// standard deviation) goes with 0.12 keV less", for every pair with |correlation| above `least`, the
/// strongest first, at most `most` of them. `sigma` is in the numbers' own units. Pairs with a sigma that is
/// not finite, and coefficients of free-form profiles, are omitted.
std::vector<std::string> strong_correlations(const std::vector<DescribedNumber>& numbers,
                                             const std::vector<double>& sigma,
                                             const std::vector<std::vector<double>>& correlation,
                                             double least = 0.9, std::size_t most = 6);

}  // namespace vegard::fit
