// Profiles against elevation, one for each direction, with their table.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "fit/measure/direction_bins.h"
#include "fit/measure/limb_layer.h"
#include "fit/measure/profile.h"
#include "fit/photo/photo.h"

namespace vegard::fit {

/// A quotient of two channels' light with its standard error to first order, the two taken as independent;
/// NaN where either is unknown or the denominator is not positive.
struct Ratio {
  double value = 0.0, sigma = 0.0;
};
Ratio channel_ratio(const Profile& profile, int band, int row, int numerator, int denominator);

/// What belongs to the table and the plot beside the numbers.
struct DirectionProfile {
  Profile profile;  ///< of direction_bins(), any dark level taken off
  DirectionSectors sectors;
  std::string camera;  ///< whose directions: "the scene's camera", "maps: az.exr, el.exr"
  std::array<double, 3> dark = {0.0, 0.0, 0.0};
};

/// extract_profile() in direction_bins(), less `dark` in each channel.
DirectionProfile direction_profile(const Photo& photo, const sim::DirectionMap& map, const Region& region,
                                   const DirectionSectors& sectors, const std::array<double, 3>& dark,
                                   const std::string& camera);

/// The limb's layer of green light in each sector, of a profile with tangent steps.
std::vector<std::optional<LimbLayer>> green_limb_layers(const DirectionProfile& directions);

/// "azimuth 10°: emission 96.2 ± 0.4 km (half of it at 90.1 and 103.0 km), most light at 93.4 km, ..."; of
/// none: "azimuth 10°: no layer".
std::string limb_layer_words(double azimuth_deg, const std::optional<LimbLayer>& layer);

/// As profile_csv(); one line per sector and step that has a pixel in any channel. With tangent steps
/// comments give the layers.
std::string direction_profile_csv(const Photo& photo, const DirectionProfile& directions);

}  // namespace vegard::fit
