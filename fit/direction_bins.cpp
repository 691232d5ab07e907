#include "fit/direction_bins.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "fit/bin_gather.h"
#include "fit/number_text.h"
#include "sim/base/error.h"

namespace vegard::fit {
namespace {

constexpr double kZenithDeg = 90.0;
constexpr double kRounding = 1e-9;  ///< of degrees, so that touching sectors do not overlap
constexpr int kPositionsEachSide = 1;

[[noreturn]] void refuse(const std::string& key, const std::string& problem, const std::string& expected) {
  sim::ErrorDetails details;
  details.key = key;
  details.problem = problem;
  details.expected = expected;
  throw sim::Error(sim::ErrorKind::usage, details);
}

/// From -180 up to 180.
double signed_turn_deg(double degrees) { return degrees - 360.0 * std::floor((degrees + 180.0) / 360.0); }

constexpr double kLeastStep_deg = 1e-4;

void check(const DirectionSectors& sectors) {
  if (sectors.azimuths_deg.empty()) refuse("--azimuths", "no direction is asked for", "azimuths in degrees");
  for (const double azimuth : sectors.azimuths_deg)
    if (!std::isfinite(azimuth)) refuse("--azimuths", "an azimuth is no number", "azimuths in degrees");
  if (!(sectors.step_deg >= kLeastStep_deg && sectors.step_deg <= kZenithDeg))
    refuse("--elevation-step", short_number(sectors.step_deg) + "\u00b0 is no step", "0.0001 to 90");
  if (!(sectors.lowest_deg >= -kZenithDeg && sectors.lowest_deg < kZenithDeg))
    refuse("--lowest", short_number(sectors.lowest_deg) + "\u00b0 is no elevation to begin at",
           "-90 to below 90");
  const double spacing = least_spacing_deg(sectors.azimuths_deg);
  if (!(sectors.width_deg > 0.0 && sectors.width_deg <= spacing + kRounding))
    refuse("--azimuth-width",
           "sectors of " + short_number(sectors.width_deg) + "\u00b0 " +
               (sectors.width_deg > 0.0 ? "would overlap" : "hold nothing"),
           "more than 0, at most " + short_number(spacing) + ", the distance of the nearest two");
}

int position_count(const DirectionSectors& sectors) {
  return std::max(
      1, static_cast<int>(std::ceil((kZenithDeg - sectors.lowest_deg) / sectors.step_deg - kRounding)));
}

}  // namespace

DirectionSectors even_sectors(int count) {
  if (count < 1 || count > 360) refuse("--directions", std::to_string(count) + " directions", "1 to 360");
  DirectionSectors sectors;
  for (int k = 0; k < count; ++k) sectors.azimuths_deg.push_back(360.0 * k / count);
  sectors.width_deg = 360.0 / count;
  return sectors;
}

double least_spacing_deg(const std::vector<double>& azimuths_deg) {
  double least = 360.0;
  for (std::size_t i = 0; i < azimuths_deg.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      least = std::min(least, std::abs(signed_turn_deg(azimuths_deg[i] - azimuths_deg[j])));
  return least;
}

double elevation_of_position_deg(const DirectionSectors& sectors, int position) {
  const double low = sectors.lowest_deg + position * sectors.step_deg;
  return 0.5 * (low + std::min(kZenithDeg, low + sectors.step_deg));
}

BinGrid direction_bins(const sim::DirectionMap& map, const Region& region, const DirectionSectors& sectors) {
  check(sectors);
  BinGrid grid;
  grid.region = region;
  grid.groups = static_cast<int>(sectors.azimuths_deg.size());
  grid.positions = position_count(sectors);
  grid.pooled = kPositionsEachSide;
  grid.position_px = 0.0;
  for (int group = 0; group < grid.groups; ++group) grid.band.insert(grid.band.end(), grid.positions, group);
  gather(
      [&](int x, int y) {
        const std::size_t i = map.index(x, y);
        const double steps = (map.elevation_deg[i] - sectors.lowest_deg) / sectors.step_deg;
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
    refuse("--azimuths", "no pixel looks into any of the sectors", "directions that the picture shows");
  grid.narrowest_px = region.width;
  for (const BinGrid::Run& run : grid.runs)
    grid.narrowest_px = std::min(grid.narrowest_px, run.end - run.begin);
  return grid;
}

}  // namespace vegard::fit
