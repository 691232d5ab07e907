#include "apps/commands/direction_profile.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "apps/options/refusals.h"
#include "fit/measure/direction_bins.h"
#include "fit/measure/direction_profile.h"
#include "fit/report/profile_plot.h"
#include "sim/base/number/constants.h"
#include "sim/view/camera/camera.h"

namespace vegard::apps {
namespace {

constexpr double kUsualWidthDeg = 10.0;
constexpr double kGreenKm = 97.0;  ///< about where green layers are, for the scale that is printed

fit::DirectionSectors sectors_of(const SectorOptions& options, std::optional<double> observer_km) {
  fit::DirectionSectors sectors;
  if (options.directions) {
    sectors = fit::even_sectors(*options.directions);
  } else {
    sectors.azimuths_deg = options.azimuths_deg;
    sectors.width_deg = std::min(kUsualWidthDeg, fit::min_spacing_deg(options.azimuths_deg));
  }
  sectors.width_deg = options.width_deg.value_or(sectors.width_deg);
  sectors.step_deg = options.step_deg.value_or(sectors.step_deg);
  sectors.lowest_deg = options.lowest_deg.value_or(sectors.lowest_deg);
  sectors.observer_km = observer_km;
  if (options.tangent_step_km) {
    fit::TangentSteps steps;
    steps.step_km = *options.tangent_step_km;
    if (observer_km) steps.highest_km = std::min(steps.highest_km, *observer_km);
    if (!options.tangent_range_km.empty()) {
      steps.lowest_km = options.tangent_range_km.front();
      steps.highest_km = options.tangent_range_km.back();
    }
    sectors.tangent = steps;
  }
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

void add_sector_options(const Command& command, SectorOptions& options) {
  command
      .option("--azimuths", options.azimuths_deg,
              "Profiles against elevation in these directions (needs --scene or --azimuth-map)")
      .delimiter(',')
      .type_name("DEG,DEG,...");
  command.option("--directions", options.directions,
                 "Profiles in this number of directions, evenly all around");
  command.option("--azimuth-width", options.width_deg,
                 "Width of a direction's sector in degrees (default: 10, less if sectors would overlap)");
  command.option("--elevation-step", options.step_deg, "Degrees of elevation between rows (default: 1)");
  command.option("--lowest", options.lowest_deg, "Lowest elevation (default: 0)");
  command.option("--tangent-step", options.tangent_step_km,
                 "Kilometres of tangent altitude between rows, in place of elevation, for an observer above "
                 "the air; prints the height of the green layer");
  command
      .option("--tangent-range", options.tangent_range_km,
              "Lowest and highest tangent altitude (default: 0,250)")
      .delimiter(',')
      .expected(2)
      .type_name("KM,KM");
  command
      .option("--dark", options.dark,
              "Dark level, in the table's linear light, to subtract before ratios are formed")
      .delimiter(',')
      .expected(3)
      .type_name("R,G,B");
}

void check_sector_options(const SectorOptions& options) {
  if (!options.azimuths_deg.empty() && options.directions)
    throw usage_error("--directions", "--azimuths names the directions already", "one of the two");
  if (!options.tangent_range_km.empty() && !options.tangent_step_km)
    throw usage_error("--tangent-range", "no step of tangent altitude is given", "--tangent-step with it");
  if (options.tangent_step_km && (options.step_deg || options.lowest_deg))
    throw usage_error("--tangent-step", "rows are steps of elevation already",
                      "no --elevation-step or --lowest with it");
  if (options.asked()) return;
  if (options.tangent_step_km)
    throw usage_error("--tangent-step", "no direction is asked for", "--azimuths or --directions with it");
  const bool given = options.width_deg || options.step_deg || options.lowest_deg || !options.dark.empty();
  if (given)
    throw usage_error(options.dark.empty() ? "--elevation-step" : "--dark", "no direction is asked for",
                      "--azimuths or --directions with it");
}

MeasuredDirections measure_directions(const SectorOptions& options, const fit::Photo& photo,
                                      const fit::Region& region, const KnownDirections& known,
                                      std::optional<double> observer_km) {
  std::array<double, 3> dark = {0.0, 0.0, 0.0};
  for (std::size_t c = 0; c < options.dark.size(); ++c) dark[c] = options.dark[c];
  const fit::DirectionProfile measured =
      fit::direction_profile(photo, known.map, region, sectors_of(options, observer_km), dark, known.words);
  check_dark(dark, measured.profile);
  MeasuredDirections found{fit::direction_profile_csv(photo, measured),
                           fit::direction_profile_plot(photo, measured),
                           std::to_string(measured.profile.bands) + " directions of " +
                               std::to_string(measured.profile.rows) + " steps of " +
                               (options.tangent_step_km ? "tangent altitude" : "elevation"),
                           {}};
  if (!options.tangent_step_km) return found;
  const auto layers = fit::green_limb_layers(measured);
  for (std::size_t k = 0; k < layers.size(); ++k)
    found.details.push_back(fit::limb_layer_words(measured.sectors.azimuths_deg[k], layers[k]));
  const double elevation_deg = sim::elevation_of_tangent_deg(*observer_km, std::min(kGreenKm, *observer_km));
  found.details.push_back(
      fmt::format("errors are those of the scatter; 0.1\u00b0 of the camera's elevation is {:.1f} km there",
                  0.1 * sim::kRadiansPerDegree * sim::tangent_distance_km(*observer_km, elevation_deg)));
  return found;
}

}  // namespace vegard::apps
