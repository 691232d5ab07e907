#include "fit/border/high_borders.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "fit/border/cell_traces.h"
#include "fit/border/sky_cells.h"
#include "sim/base/number/constants.h"
#include "sim/base/parallel.h"
#include "sim/view/camera/camera.h"

namespace vegard::fit {
namespace high_borders {
namespace {

constexpr double kTilt_deg = 45.0;
constexpr int kPoles = 8;
constexpr double kSame_deg = 3.0;
constexpr double kLonger = 1.25;  // what is to take another's place

struct PlaceOnSky {
  double enu[3];
};

std::vector<PlaceOnSky> places_of(const BorderTrace& trace) {
  std::vector<PlaceOnSky> places;
  for (const BorderPoint& p : trace.points) {
    if (!p.measured()) continue;
    places.emplace_back();
    sim::enu_of_direction({p.azimuth_deg, p.elevation_deg}, places.back().enu);
  }
  return places;
}

double cosine(const PlaceOnSky& a, const PlaceOnSky& b) {
  return a.enu[0] * b.enu[0] + a.enu[1] * b.enu[1] + a.enu[2] * b.enu[2];
}

double length_deg(const std::vector<PlaceOnSky>& places) {
  double sum = 0.0;
  for (std::size_t i = 1; i < places.size(); ++i)
    sum += std::acos(std::min(1.0, cosine(places[i - 1], places[i]))) / sim::kRadiansPerDegree;
  return sum;
}

bool is_mostly_on(const std::vector<PlaceOnSky>& places, const std::vector<PlaceOnSky>& other) {
  const double least = std::cos(kSame_deg * sim::kRadiansPerDegree);
  std::size_t on = 0;
  for (const PlaceOnSky& place : places)
    on +=
        std::any_of(other.begin(), other.end(), [&](const PlaceOnSky& o) { return cosine(place, o) > least; })
            ? 1
            : 0;
  return 2 * on >= places.size();
}

bool sees_zenith(const sim::Camera& camera) {
  const double up[3] = {0.0, 0.0, 1.0};
  double x = 0.0, y = 0.0;
  return sim::pixel_of_enu(sim::camera_view(camera), up, x, y) && x >= 0.0 && y >= 0.0 && x < camera.width &&
         y < camera.height;
}

}  // namespace
}  // namespace high_borders

void add_high_borders(std::vector<BorderTrace>& traces, const Photo& photo, const sim::Scene& scene,
                      const BorderSettings& settings) {
  using namespace high_borders;
  if (!sees_zenith(scene.camera)) return;
  std::vector<std::optional<std::vector<BorderTrace>>> found(kPoles);
  std::atomic<int> done{0};
  sim::parallel_for(kPoles, 0, [&](std::size_t k, int) {
    const double towards_deg = static_cast<double>(k) * 360.0 / kPoles;
    SkyCells cells = sky_cells(photo, scene.camera, settings, SkyFrame{kTilt_deg, towards_deg});
    bridge_holes(cells);
    found[k] = judged_traces(cells, photo, scene, settings);
    constexpr double kBefore = 0.4, kWithAll = 0.9;  // of the work
    if (settings.progress) settings.progress(kBefore + (kWithAll - kBefore) * ++done / kPoles);
  });
  std::vector<BorderTrace> high;
  for (std::optional<std::vector<BorderTrace>>& of_pole : found) {
    if (!of_pole) continue;
    for (BorderTrace& trace : *of_pole)
      if (trace.is_claimed()) high.push_back(std::move(trace));
  }
  std::stable_sort(high.begin(), high.end(), [](const BorderTrace& a, const BorderTrace& b) {
    return length_deg(places_of(a)) > length_deg(places_of(b));
  });
  for (BorderTrace& trace : high) {
    const std::vector<PlaceOnSky> here = places_of(trace);
    const bool is_known = std::any_of(traces.begin(), traces.end(), [&](const BorderTrace& other) {
      if (!other.is_claimed()) return false;
      const std::vector<PlaceOnSky> there = places_of(other);
      const bool is_part = is_mostly_on(there, here) && length_deg(here) > kLonger * length_deg(there);
      return !is_part && (is_mostly_on(here, there) || is_mostly_on(there, here));
    });
    if (is_known) continue;
    traces.erase(std::remove_if(traces.begin(), traces.end(),
                                [&](const BorderTrace& other) {
                                  const std::vector<PlaceOnSky> there = places_of(other);
                                  return !there.empty() && is_mostly_on(there, here);
                                }),
                 traces.end());
    traces.push_back(std::move(trace));
  }
}

}  // namespace vegard::fit
