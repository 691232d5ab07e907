// Profiles of light against elevation, one for each sector of azimuth, and their table as CSV.
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

/// The ratio of two channels' light with its standard error to first order, the channels assumed independent;
/// NaN if either is unknown or the denominator is not positive.
struct Ratio {
  double value = 0.0, sigma = 0.0;
};
Ratio channel_ratio(const Profile& profile, int band, int row, int numerator, int denominator);

/// A profile in direction_bins(), with what its table and its plot state besides.
struct DirectionProfile {
  Profile profile;  ///< with any dark level subtracted
  DirectionSectors sectors;
  std::string camera;  ///< source of the directions: "the scene's camera", "maps: az.exr, el.exr"
  std::array<double, 3> dark = {0.0, 0.0, 0.0};
};

/// Returns extract_profile() in direction_bins(), with `dark` subtracted in each channel.
DirectionProfile direction_profile(const Photo& photo, const sim::DirectionMap& map, const Region& region,
                                   const DirectionSectors& sectors, const std::array<double, 3>& dark,
                                   const std::string& camera);

/// Finds the layer of green light at the limb in each sector of a profile with tangent steps.
std::vector<std::optional<LimbLayer>> green_limb_layers(const DirectionProfile& directions);

/// Describes a layer: "azimuth 10°: emission 96.2 ± 0.4 km (half of it at 90.1 and 103.0 km), most light at
/// 93.4 km, ..."; without one: "azimuth 10°: no layer".
std::string limb_layer_words(double azimuth_deg, const std::optional<LimbLayer>& layer);

/// Returns the table in the form of profile_csv(), with one line per sector and step that has a pixel in any
/// channel. With tangent steps, comments describe the layers.
std::string direction_profile_csv(const Photo& photo, const DirectionProfile& directions);

}  // namespace vegard::fit
