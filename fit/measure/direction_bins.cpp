#include "fit/measure/direction_bins.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "fit/measure/bin_grid.h"
#include "sim/base/error.h"
#include "sim/base/file/number_text.h"
#include "sim/view/camera/camera.h"

namespace vegard::fit {
namespace {

constexpr double kDirectionZenithDeg = 90.0;
constexpr double kRounding = 1e-9;  ///< of degrees, so that touching sectors do not overlap
constexpr int kDirectionPositionsEachSide = 1;
constexpr double kDeepestKm = 1000.0;  ///< below the Earth's edge, for tangent altitudes
constexpr int kDirectionMaxSteps = 10000;

/// From -180 up to 180.
double signed_turn_deg(double degrees) { return degrees - 360.0 * std::floor((degrees + 180.0) / 360.0); }

constexpr double kMinStep_deg = 1e-4;

void check_tangent_steps(const DirectionSectors& sectors) {
  const TangentSteps& steps = *sectors.tangent;
  if (!sectors.observer_km)
    throw sim::Error(sim::ErrorKind::usage, "the observer is not known to be above the air")
        .key("--tangent-step")
        .expected("a scene whose site.altitude_m is at least " +
                  sim::short_number(1e3 * sim::kLimbObserverKm));
  if (!(steps.step_km > 0.0))
    throw sim::Error(sim::ErrorKind::usage, sim::short_number(steps.step_km) + " km is no step")
        .key("--tangent-step")
        .expected("more than 0");
  if (!(steps.lowest_km >= -kDeepestKm && steps.highest_km > steps.lowest_km &&
        steps.highest_km <= *sectors.observer_km))
    throw sim::Error(sim::ErrorKind::usage, sim::short_number(steps.lowest_km) + " to " +
                                                sim::short_number(steps.highest_km) + " km holds no limb")
        .key("--tangent-range")
        .expected("growing, from -" + sim::short_number(kDeepestKm) + " to at most " +
                  sim::short_number(*sectors.observer_km) + ", where the observer is");
  if ((steps.highest_km - steps.lowest_km) / steps.step_km > kDirectionMaxSteps)
    throw sim::Error(sim::ErrorKind::usage, "more than " + std::to_string(kDirectionMaxSteps) + " steps")
        .key("--tangent-step")
        .expected("larger steps");
}

void check_sectors(const DirectionSectors& sectors) {
  if (sectors.azimuths_deg.empty())
    throw sim::Error(sim::ErrorKind::usage, "no direction is asked for")
        .key("--azimuths")
        .expected("azimuths in degrees");
  for (const double azimuth : sectors.azimuths_deg)
    if (!std::isfinite(azimuth))
      throw sim::Error(sim::ErrorKind::usage, "an azimuth is no number")
          .key("--azimuths")
          .expected("azimuths in degrees");
  if (sectors.tangent) check_tangent_steps(sectors);
  if (!(sectors.step_deg >= kMinStep_deg && sectors.step_deg <= kDirectionZenithDeg))
    throw sim::Error(sim::ErrorKind::usage, sim::short_number(sectors.step_deg) + "\u00b0 is no step")
        .key("--elevation-step")
        .expected("0.0001 to 90");
  if (!(sectors.lowest_deg >= -kDirectionZenithDeg && sectors.lowest_deg < kDirectionZenithDeg))
    throw sim::Error(sim::ErrorKind::usage,
                     sim::short_number(sectors.lowest_deg) + "\u00b0 is no elevation to begin at")
        .key("--lowest")
        .expected("-90 to below 90");
  const double spacing = min_spacing_deg(sectors.azimuths_deg);
  if (!(sectors.width_deg > 0.0 && sectors.width_deg <= spacing + kRounding))
    throw sim::Error(sim::ErrorKind::usage, "sectors of " + sim::short_number(sectors.width_deg) + "\u00b0 " +
                                                (sectors.width_deg > 0.0 ? "would overlap" : "hold nothing"))
        .key("--azimuth-width")
        .expected("more than 0, at most " + sim::short_number(spacing) + ", the distance of the nearest two");
}

int position_count(const DirectionSectors& sectors) {
  if (sectors.tangent)
    return static_cast<int>(std::ceil(
        (sectors.tangent->highest_km - sectors.tangent->lowest_km) / sectors.tangent->step_km - kRounding));
  return std::max(
      1,
      static_cast<int>(std::ceil((kDirectionZenithDeg - sectors.lowest_deg) / sectors.step_deg - kRounding)));
}

/// Positions from the lowest's lower edge; NaN where there are none.
double steps_up(const DirectionSectors& sectors, double elevation_deg) {
  if (!sectors.tangent) return (elevation_deg - sectors.lowest_deg) / sectors.step_deg;
  const double tangent_km = sim::tangent_altitude_km(*sectors.observer_km, elevation_deg);
  if (!(tangent_km < sectors.tangent->highest_km)) return std::numeric_limits<double>::quiet_NaN();
  return (tangent_km - sectors.tangent->lowest_km) / sectors.tangent->step_km;
}

}  // namespace

DirectionSectors even_sectors(int count) {
  if (count < 1 || count > 360)
    throw sim::Error(sim::ErrorKind::usage, std::to_string(count) + " directions")
        .key("--directions")
        .expected("1 to 360");
  DirectionSectors sectors;
  for (int k = 0; k < count; ++k) sectors.azimuths_deg.push_back(360.0 * k / count);
  sectors.width_deg = 360.0 / count;
  return sectors;
}

double min_spacing_deg(const std::vector<double>& azimuths_deg) {
  double least = 360.0;
  for (std::size_t i = 0; i < azimuths_deg.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      least = std::min(least, std::abs(signed_turn_deg(azimuths_deg[i] - azimuths_deg[j])));
  return least;
}

double elevation_of_position_deg(const DirectionSectors& sectors, int position) {
  if (sectors.tangent)
    return sim::elevation_of_tangent_deg(*sectors.observer_km, tangent_of_position_km(sectors, position));
  const double low = sectors.lowest_deg + position * sectors.step_deg;
  return 0.5 * (low + std::min(kDirectionZenithDeg, low + sectors.step_deg));
}

double tangent_of_position_km(const DirectionSectors& sectors, int position) {
  if (!sectors.observer_km) return std::numeric_limits<double>::quiet_NaN();
  if (!sectors.tangent)
    return sim::tangent_altitude_km(*sectors.observer_km, elevation_of_position_deg(sectors, position));
  const TangentSteps& steps = *sectors.tangent;
  const double low_km = steps.lowest_km + position * steps.step_km;
  return 0.5 * (low_km + std::min(steps.highest_km, low_km + steps.step_km));
}

BinGrid direction_bins(const sim::DirectionMap& map, const Region& region, const DirectionSectors& sectors) {
  check_sectors(sectors);
  BinGrid grid;
  grid.region = region;
  grid.groups = static_cast<int>(sectors.azimuths_deg.size());
  grid.positions = position_count(sectors);
  grid.pooled = kDirectionPositionsEachSide;
  grid.position_px = 0.0;
  for (int group = 0; group < grid.groups; ++group) grid.band.insert(grid.band.end(), grid.positions, group);
  gather(
      [&](int x, int y) {
        const std::size_t i = map.index(x, y);
        const double steps = steps_up(sectors, map.elevation_deg[i]);
        if (!(steps >= 0.0)) return kNoBin;  // NaN too
        // The zenith itself belongs to the last step.
        const int position = std::min(static_cast<int>(steps), grid.positions - 1);
        for (int group = 0; group < grid.groups; ++group) {
          const double off = signed_turn_deg(map.azimuth_deg[i] - sectors.azimuths_deg[group]);
          if (off >= -0.5 * sectors.width_deg && off < 0.5 * sectors.width_deg)
            return static_cast<int>(grid.bin(group, position));
        }
        return kNoBin;
      },
      grid);
  if (grid.runs.empty())
    throw sim::Error(sim::ErrorKind::usage, "no pixel looks into any of the sectors")
        .key("--azimuths")
        .expected("directions that the picture shows");
  grid.narrowest_px = region.width;
  for (const BinGrid::Run& run : grid.runs)
    grid.narrowest_px = std::min(grid.narrowest_px, run.end - run.begin);
  return grid;
}

}  // namespace vegard::fit
