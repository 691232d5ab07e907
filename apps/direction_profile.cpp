#include "apps/direction_profile.h"

#include <algorithm>
#include <array>
#include <string>

#include "apps/usage_error.h"
#include "fit/direction_bins.h"
#include "fit/direction_profile.h"

namespace vegard::apps {
namespace {

constexpr double kUsualWidthDeg = 10.0;

fit::DirectionSectors sectors_of(const SectorOptions& options) {
  fit::DirectionSectors sectors;
  if (options.directions) {
    sectors = fit::even_sectors(*options.directions);
  } else {
    sectors.azimuths_deg = options.azimuths_deg;
    sectors.width_deg = std::min(kUsualWidthDeg, fit::least_spacing_deg(options.azimuths_deg));
  }
  sectors.width_deg = options.width_deg.value_or(sectors.width_deg);
  sectors.step_deg = options.step_deg.value_or(sectors.step_deg);
  sectors.lowest_deg = options.lowest_deg.value_or(sectors.lowest_deg);
  return sectors;
}

/// Counts given for light, say, would leave nothing, and no ratio.
void check_dark(const std::array<double, 3>& dark, const fit::Profile& less_dark) {
  constexpr const char* kChannels[3] = {"red", "green", "blue"};
  for (int c = 0; c < 3; ++c) {
    if (dark[c] == 0.0) continue;
    bool any = false, positive = false;
    for (std::size_t i = c; i < less_dark.mean.size(); i += 3) {
      any = any || less_dark.count[i] > 0;
      positive = positive || less_dark.mean[i] > 0.0;
    }
    if (any && !positive)
      throw usage_error("--dark", std::string("nothing of ") + kChannels[c] + " is brighter than that",
                        "a level in the table's linear light (white = 1)",
                        "counts are to be divided by white's");
  }
}

}  // namespace

void add_sector_options(CLI::App& command, SectorOptions& options) {
  command
      .add_option("--azimuths", options.azimuths_deg,
                  "Profiles against elevation in these directions (needs --scene or --azimuth-map)")
      ->delimiter(',')
      ->type_name("DEG,DEG,...");
  command.add_option("--directions", options.directions, "The same in so many directions all around");
  command.add_option("--azimuth-width", options.width_deg,
                     "Width of a direction's sector in degrees (default: 10, or where they touch)");
  command.add_option("--elevation-step", options.step_deg, "Degrees of elevation for a row (default: 1)");
  command.add_option("--lowest", options.lowest_deg, "Elevation to begin at (default: 0)");
  command
      .add_option("--dark", options.dark,
                  "Dark level, in the linear light of the table, to take off before ratios are formed")
      ->delimiter(',')
      ->expected(3)
      ->type_name("R,G,B");
}

void check_sector_options(const SectorOptions& options) {
  if (!options.azimuths_deg.empty() && options.directions)
    throw usage_error("--directions", "--azimuths names the directions already", "one of the two");
  if (options.asked()) return;
  const bool given = options.width_deg || options.step_deg || options.lowest_deg || !options.dark.empty();
  if (given)
    throw usage_error(options.dark.empty() ? "--elevation-step" : "--dark", "no direction is asked for",
                      "--azimuths or --directions beside it");
}

MeasuredDirections measure_directions(const SectorOptions& options, const fit::Photo& photo,
                                      const fit::Region& region, const KnownDirections& known) {
  std::array<double, 3> dark = {0.0, 0.0, 0.0};
  for (std::size_t c = 0; c < options.dark.size(); ++c) dark[c] = options.dark[c];
  const fit::DirectionProfile measured =
      fit::direction_profile(photo, known.map, region, sectors_of(options), dark, known.words);
  check_dark(dark, measured.profile);
  return {fit::direction_profile_csv(photo, measured), fit::direction_profile_plot(photo, measured),
          std::to_string(measured.profile.bands) + " directions of " + std::to_string(measured.profile.rows) +
              " steps of elevation"};
}

}  // namespace vegard::apps
