#include "fit/measurement/main_border.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "fit/border/border_distance.h"
#include "fit/report/border/border_run.h"
#include "sim/base/number/constants.h"
#include "sim/base/number/quantile.h"

namespace vegard::fit {
namespace main_border_place {

constexpr double kEqualProbability = 0.05;
constexpr std::size_t kStretch = 5;  // points

double median_of(const std::vector<const BorderPoint*>& points, double BorderPoint::*value) {
  std::vector<double> values;
  for (const BorderPoint* p : points) values.push_back(p->*value);
  return sim::median(values);
}

/// How much there is of a trace: its length times its signal.
double weight_of(const BorderTrace& trace) {
  double sum = 0.0;
  for (const BorderPoint& p : trace.points)
    if (p.measured()) sum += p.signal;
  return sum;
}

bool is_better(const BorderTrace& a, const BorderTrace& b) {
  const double more = a.aurora_probability - b.aurora_probability;
  if (std::abs(more) >= kEqualProbability) return more > 0.0;
  return weight_of(a) > weight_of(b);
}

/// The standard error of a distance that is known between two limits only, each value as likely.
double error_by_altitude(const sim::Site& site, double apparent_elevation_deg) {
  const double true_deg = true_elevation_deg(apparent_elevation_deg, site.altitude_m);
  return (ground_distance_km(true_deg, site.altitude_m, kBorderAltitudesKm.back()) -
          ground_distance_km(true_deg, site.altitude_m, kBorderAltitudesKm.front())) /
         std::sqrt(12.0);
}

/// The neighbouring points whose median elevation is highest.
std::vector<const BorderPoint*> nearest_stretch(const BorderTrace& trace) {
  std::vector<const BorderPoint*> measured, best;
  for (const BorderPoint& p : trace.points)
    if (p.measured()) measured.push_back(&p);
  if (measured.size() <= kStretch) return measured;
  double highest = -1.0;
  for (std::size_t i = 0; i + kStretch <= measured.size(); ++i) {
    const std::vector<const BorderPoint*> here(measured.begin() + static_cast<std::ptrdiff_t>(i),
                                               measured.begin() + static_cast<std::ptrdiff_t>(i + kStretch));
    const double elevation = median_of(here, &BorderPoint::elevation_deg);
    if (elevation <= highest) continue;
    highest = elevation;
    best = here;
  }
  return best;
}

}  // namespace main_border_place

MainBorder placed_border(const Border& border, std::size_t trace_index, const sim::Scene& scene,
                         double pointing_error_deg) {
  using namespace main_border_place;
  const BorderTrace& trace = border.traces[trace_index];
  const BorderSummary all = border_summary(trace, scene);
  MainBorder m;
  m.trace = trace_index;
  m.from_azimuth_deg = all.from_azimuth_deg;
  m.to_azimuth_deg = all.to_azimuth_deg;
  m.lowest_deg = all.lowest_deg;
  m.highest_deg = all.highest_deg;
  const std::vector<const BorderPoint*> stretch = nearest_stretch(trace);
  m.azimuth_deg = stretch[stretch.size() / 2]->azimuth_deg;
  m.elevation_deg = median_of(stretch, &BorderPoint::elevation_deg);
  m.elevation_error_deg =
      std::hypot(median_of(stretch, &BorderPoint::elevation_error_deg), pointing_error_deg);
  const BorderPlace place =
      border_place(scene.site, m.azimuth_deg, m.elevation_deg, m.elevation_error_deg, kAssumedBorder_km);
  m.distance_km = place.distance_km;
  m.latitude_deg = place.latitude_deg;
  m.longitude_deg = place.longitude_deg;
  m.distance_error_km = std::hypot(place.distance_error_km, error_by_altitude(scene.site, m.elevation_deg));
  const auto distance = [&](double apparent_deg, double altitude_km) {
    return ground_distance_km(true_elevation_deg(apparent_deg, scene.site.altitude_m), scene.site.altitude_m,
                              altitude_km);
  };
  m.lowest_distance_km = distance(m.elevation_deg, kBorderAltitudesKm.front());
  m.highest_distance_km = distance(m.elevation_deg, kBorderAltitudesKm.back());
  const double half_fall = 0.5 * median_of(stretch, &BorderPoint::fall_deg);
  m.upper_level_km = distance(m.elevation_deg + half_fall, kAssumedBorder_km);
  m.lower_level_km = distance(m.elevation_deg - half_fall, kAssumedBorder_km);
  return m;
}

std::optional<MainBorder> main_border(const Border& border, const sim::Scene& scene,
                                      double pointing_error_deg) {
  using namespace main_border_place;
  std::optional<std::size_t> best;
  for (std::size_t t = 0; border.measured > 0 && t < border.traces.size(); ++t)
    if (border.traces[t].is_claimed() && border.traces[t].measured > 0 &&
        (!best || is_better(border.traces[t], border.traces[*best])))
      best = t;
  if (!best) return std::nullopt;
  return placed_border(border, *best, scene, pointing_error_deg);
}

DistanceAlong distance_along(const BorderTrace& trace, const sim::Scene& scene, double azimuth_deg) {
  constexpr double kNear_deg = 2.0;
  const BorderPoint* nearest = nullptr;
  double off = kNear_deg;
  for (const BorderPoint& p : trace.points) {
    const double here = std::abs(std::remainder(p.azimuth_deg - azimuth_deg, 360.0));
    if (!p.measured() || here > off) continue;
    off = here;
    nearest = &p;
  }
  if (nearest == nullptr) return {sim::kNaN, sim::kNaN};
  const BorderPlace place = border_place(scene.site, azimuth_deg, nearest->elevation_deg,
                                         nearest->elevation_error_deg, kAssumedBorder_km);
  return {place.distance_km, std::hypot(place.distance_error_km, main_border_place::error_by_altitude(
                                                                     scene.site, nearest->elevation_deg))};
}

std::string unclaimed_words(const Border& border) {
  std::vector<std::pair<std::string, int>> kinds;
  for (const BorderTrace& trace : border.traces) {
    if (trace.is_claimed() || trace.measured == 0) continue;
    const std::string what = trace.doubt.empty() ? "uncertain" : trace.doubt;
    const auto known =
        std::find_if(kinds.begin(), kinds.end(), [&](const auto& kind) { return kind.first == what; });
    if (known == kinds.end())
      kinds.emplace_back(what, 1);
    else
      ++known->second;
  }
  std::stable_sort(kinds.begin(), kinds.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  std::string words;
  for (const auto& [what, count] : kinds)
    words += (words.empty() ? "" : ", ") + fmt::format("{} edge{} ({})", count, count == 1 ? "" : "s", what);
  return words;
}

std::string compass_word(double azimuth_deg) {
  static constexpr std::array kWords = {"north", "north-east", "east", "south-east",
                                        "south", "south-west", "west", "north-west"};
  const double turned = std::fmod(std::fmod(azimuth_deg, 360.0) + 360.0, 360.0);
  return kWords[static_cast<std::size_t>(std::lround(turned / 45.0)) % kWords.size()];
}

}  // namespace vegard::fit
