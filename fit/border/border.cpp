#include "fit/border/border.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "fit/border/border_distance.h"
#include "fit/border/cell_traces.h"
#include "fit/border/cut_peaks.h"
#include "fit/border/high_borders.h"
#include "sim/base/error.h"
#include "sim/scene/table/value_check.h"

namespace vegard::fit {
namespace {

constexpr std::size_t kMaxTraces = 20;

std::string no_border_note(const BorderTrace& trace) {
  int count[5] = {};
  for (const BorderPoint& p : trace.points) ++count[static_cast<int>(p.limit)];
  const int most = static_cast<int>(std::max_element(count + 1, count + 5) - count);
  return fmt::format(
      "Light at azimuths {:.0f} to {:.0f}° has its lower border beyond {}: not measured there.",
      trace.points.front().azimuth_deg, trace.points.back().azimuth_deg,
      border_limit_name(static_cast<BorderLimit>(most)));
}

/// How many traces are not claimed, and what they may be.
std::string not_claimed_note(const Border& border, const BorderSettings& settings) {
  std::vector<std::pair<std::string, int>> doubts;
  int count = 0;
  for (const BorderTrace& trace : border.traces) {
    if (trace.is_claimed() || trace.measured * settings.azimuth_step_deg < settings.min_length_deg) continue;
    ++count;
    const auto same = std::find_if(doubts.begin(), doubts.end(),
                                   [&](const auto& doubt) { return doubt.first == trace.doubt; });
    if (same != doubts.end())
      ++same->second;
    else
      doubts.emplace_back(trace.doubt, 1);
  }
  if (count == 0) return "";
  std::stable_sort(doubts.begin(), doubts.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  std::string why;
  for (const auto& [doubt, times] : doubts)
    why += (why.empty() ? "" : "; ") + doubt + (times > 1 ? fmt::format(" ({})", times) : "");
  return fmt::format("{} found but not claimed as aurora: {}.",
                     count == 1 ? "1 trace was" : fmt::format("{} traces were", count), why);
}

}  // namespace

Border trace_border(const Photo& photo, const sim::Scene& scene, const BorderSettings& settings) {
  sim::require_earth(scene, "the distance of a border");
  if (photo.linear.width != scene.camera.width || photo.linear.height != scene.camera.height)
    throw sim::Error(sim::ErrorKind::scene,
                     "the camera is " + sim::size_text(scene.camera.width, scene.camera.height) +
                         " and the photograph " + sim::size_text(photo.linear.width, photo.linear.height))
        .key("camera.width")
        .expected("the same size")
        .hint("give the camera of this photograph, with --camera");
  if (1e-3 * scene.site.altitude_m >= kBorderAltitudesKm.front())
    throw sim::Error(sim::ErrorKind::scene, "the observer is as high as the aurora")
        .key("site.altitude_m")
        .expected("a site below 95 km")
        .hint("vegard profile measures pictures from orbit");
  Border border;
  const auto tell = [&](double share) {
    if (settings.progress) settings.progress(share);
  };
  border.cells = sky_cells(photo, scene.camera, settings);
  tell(0.2);
  bridge_holes(border.cells);
  const SkyCells& cells = border.cells;
  std::optional<std::vector<BorderTrace>> traces = judged_traces(cells, photo, scene, settings);
  if (!traces) {
    border.notes.push_back(
        fmt::format("No usable part of the picture looks at elevations of {:.0f} to {:.0f}°.",
                    settings.lowest_measured_deg, settings.highest_elevation_deg));
    return border;
  }
  border.traces = std::move(*traces);
  tell(0.4);
  add_high_borders(border.traces, photo, scene, settings);
  const auto is_measured = [&](const BorderTrace& trace) {
    return trace.measured * cells.azimuth_step_deg >= settings.min_length_deg;
  };
  std::stable_sort(border.traces.begin(), border.traces.end(),
                   [&](const BorderTrace& a, const BorderTrace& b) {
                     if (a.is_claimed() != b.is_claimed()) return a.is_claimed();
                     if (is_measured(a) != is_measured(b)) return is_measured(a);
                     // Probabilities that differ by less than a hundredth are the same.
                     const double pa = std::floor(100.0 * a.aurora_probability),
                                  pb = std::floor(100.0 * b.aurora_probability);
                     if (pa != pb) return pa > pb;
                     return a.measured > b.measured;
                   });
  if (border.traces.size() > kMaxTraces) border.traces.resize(kMaxTraces);
  for (BorderTrace& trace : border.traces)
    trace.cut_peaks = cut_peak_share(trace, photo, scene.camera, settings.channel);
  for (const BorderTrace& trace : border.traces)
    if (trace.is_claimed())
      ++border.measured;
    else if (!is_measured(trace))
      border.notes.push_back(no_border_note(trace));
  if (const std::string note = not_claimed_note(border, settings); !note.empty())
    border.notes.insert(border.notes.begin(), note);
  if (border.traces.empty())
    border.notes.push_back(
        fmt::format("No light with an edge is brighter than sky and noise over {:.0f}° of azimuth.",
                    settings.min_length_deg));
  border.notes.push_back(fmt::format(
      "Searched were elevations of {:.0f} to {:.0f}°: higher up an arc is seen from below, and has no "
      "lower edge.",
      settings.lowest_measured_deg, settings.highest_elevation_deg));
  return border;
}

}  // namespace vegard::fit
