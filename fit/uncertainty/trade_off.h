// Degeneracies as text: changes of the free numbers that leave the picture the same.
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
  /// A change that one would notice, in the unit: a tenth of the value, of an angle ten degrees.
  double noticeable = 1.0;
  enum class Place { none, east, north } place = Place::none;  ///< a component of a centre
  int centre = -1;                    ///< of which: sheets' centres, then footprints'
  bool other_component_free = false;  ///< of that centre
  sim::EastNorth centre_km;           ///< from the observer
  bool of_profile = false;            ///< a coefficient of a free-form profile
  bool is_altitude = false;           ///< which is higher, not more
};

/// `values` are those of `free` in the order of the scene file.
std::vector<DescribedNumber> described_numbers(const sim::Scene& scene, const std::vector<FreeNumber>& free,
                                               const std::vector<double>& values);

/// "distance and energy of the main sheet trade off: 10 km further with 0.3 keV less looks the same", of a
/// direction in the numbers' own units; its length and sign do not matter. At most three numbers are named,
/// those that one would notice most, and always number `always` (an index; none if negative); how many more
/// there are is said. East and north of one centre are reported as one: further or nearer as seen by the
/// observer, or to the right or left. For a direction of one number: "the data do not constrain the energy of
/// the main sheet".
std::string trade_off_text(const std::vector<DescribedNumber>& numbers, const std::vector<double>& direction,
                           int always = -1);

/// Why coordinate j has no error bar: the trade-off that it takes the largest part in, or "the data do not
/// bound it". `u` is in coordinates, as uncertainty() and drop_flat_directions() leave it.
std::string why_undetermined(const sim::Scene& scene, const std::vector<FreeNumber>& free,
                             const std::vector<double>& values, const Uncertainty& u, std::size_t j);

/// "distance and energy of the main sheet are correlated by −0.95: 3.1 km further (one standard deviation)
/// goes with 0.12 keV less", for every pair with |correlation| above `least`, the strongest first, at most
/// `most` of them. `sigma` in the numbers' own units; pairs with one that is not finite, and coefficients of
/// free-form profiles, are left out.
std::vector<std::string> strong_correlations(const std::vector<DescribedNumber>& numbers,
                                             const std::vector<double>& sigma,
                                             const std::vector<std::vector<double>>& correlation,
                                             double least = 0.9, std::size_t most = 6);

}  // namespace vegard::fit
