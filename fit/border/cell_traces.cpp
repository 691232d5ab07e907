#include "fit/border/cell_traces.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "fit/border/border_air.h"
#include "fit/border/border_candidates.h"
#include "fit/border/border_claim.h"
#include "fit/border/border_light.h"
#include "fit/border/border_links.h"
#include "sim/base/number/constants.h"
#include "sim/view/camera/camera.h"

namespace vegard::fit {
namespace {

/// Traces the light of cells. Returns false if there is none.
bool traces_of_cells(const SkyCells& cells, BorderAir air, double site_altitude_m,
                     const BorderSettings& settings, std::vector<BorderTrace>& traces) {
  const std::optional<BorderLight> light = border_light(cells, std::move(air));
  if (!light) return false;
  std::vector<std::vector<BorderCandidate>> candidates = border_candidates(*light, settings);
  traces = linked_borders(candidates, settings);
  for (BorderTrace& trace : traces)
    for (BorderPoint& p : trace.points)
      if (p.measured())
        p.elevation_error_deg =
            std::hypot(p.elevation_error_deg, refraction_error_deg(p.elevation_deg, site_altitude_m));
  return true;
}

/// The borders that the same cells have upside down, at the elevations that they have upright.
std::vector<BorderTrace> traces_upside_down(const SkyCells& cells, BorderSettings settings) {
  SkyCells turned = cells;
  for (int c = 0; c < cells.columns; ++c) {
    const auto from = static_cast<std::ptrdiff_t>(cells.index(c, 0)), to = from + cells.rows;
    std::reverse(turned.light.begin() + from, turned.light.begin() + to);
    std::reverse(turned.limit.begin() + from, turned.limit.begin() + to);
  }
  settings.lowest_measured_deg = settings.lowest_elevation_deg;
  std::vector<BorderTrace> traces;
  traces_of_cells(turned, no_air(turned), 0.0, settings, traces);
  const double sum = settings.lowest_elevation_deg + settings.highest_elevation_deg;
  for (BorderTrace& trace : traces)
    for (BorderPoint& p : trace.points) {
      p.elevation_deg = sum - p.elevation_deg;
      p.peak_elevation_deg = sum - p.peak_elevation_deg;
    }
  return traces;
}

/// True if most of a trace's points have the peaks of another.
bool shares_border_light(const BorderTrace& trace, const BorderTrace& other) {
  constexpr double kSame_deg = 2.0;
  std::size_t shared = 0;
  for (const BorderPoint& p : trace.points)
    for (const BorderPoint& q : other.points)
      if (std::abs(std::remainder(p.azimuth_deg - q.azimuth_deg, 360.0)) < 0.01 &&
          std::abs(p.peak_elevation_deg - q.peak_elevation_deg) < kSame_deg) {
        ++shared;
        break;
      }
  return 2 * shared >= trace.points.size();
}

/// The slope of a trace about one of its points, in degrees of row to degree of column.
double slope_at(const BorderTrace& trace, std::size_t at) {
  constexpr double kReach_deg = 5.0;
  double n = 0.0, sx = 0.0, sxx = 0.0, sy = 0.0, sxy = 0.0;
  for (const BorderPoint& p : trace.points) {
    const double x = std::remainder(p.azimuth_deg - trace.points[at].azimuth_deg, 360.0);
    if (!p.measured() || std::abs(x) > kReach_deg) continue;
    n += 1.0, sx += x, sxx += x * x, sy += p.elevation_deg, sxy += x * p.elevation_deg;
  }
  const double xx = sxx - sx * sx / std::max(n, 1.0);
  return xx > 0.0 ? (sxy - sx * sy / n) / xx : 0.0;
}

/// Whether `next` begins where `trace` would go on, and is as bright and of its colour.
bool goes_on(const BorderTrace& trace, const BorderEvidence& of_trace, const BorderTrace& next,
             const BorderEvidence& of_next, const BorderSettings& settings) {
  constexpr double kGaps = 2.0, kBrighter = 4.0, kSameColour = 0.3;
  const auto measured = [](const BorderPoint& p) { return p.measured(); };
  const auto last = std::find_if(trace.points.rbegin(), trace.points.rend(), measured);
  const auto first = std::find_if(next.points.begin(), next.points.end(), measured);
  if (last == trace.points.rend() || first == next.points.end()) return false;
  const double gap = std::remainder(first->azimuth_deg - last->azimuth_deg, 360.0);
  if (!(gap > 0.0 && gap <= kGaps * settings.longest_gap_deg)) return false;
  const auto at = static_cast<std::size_t>(trace.points.rend() - last) - 1;
  const double off = first->elevation_deg - last->elevation_deg - slope_at(trace, at) * gap;
  const double ratio = next.mean_brightness() / std::max(1e-12, trace.mean_brightness());
  return std::abs(off) < settings.max_jump_deg && ratio < kBrighter && ratio * kBrighter > 1.0 &&
         std::abs(of_trace.line_share - of_next.line_share) < kSameColour;
}

/// A border that is broken by a wire, a cloud or clipped light is as long as all of its pieces; and if one of
/// them is a seam of the detector, all are.
void join_pieces(const std::vector<BorderTrace>& traces, std::vector<BorderEvidence>& evidence,
                 const BorderSettings& settings) {
  std::vector<std::size_t> whole(traces.size());
  for (std::size_t t = 0; t < traces.size(); ++t) whole[t] = t;
  for (std::size_t a = 0; a < traces.size(); ++a)
    for (std::size_t b = 0; b < traces.size(); ++b) {
      if (whole[a] == whole[b] || !goes_on(traces[a], evidence[a], traces[b], evidence[b], settings))
        continue;
      const std::size_t from = whole[b], to = whole[a];
      for (std::size_t& w : whole)
        if (w == from) w = to;
    }
  std::vector<double> length(traces.size(), 0.0);
  std::vector<char> is_seam(traces.size(), 0);
  for (std::size_t t = 0; t < traces.size(); ++t) {
    length[whole[t]] += evidence[t].length_deg;
    if (evidence[t].is_seam) is_seam[whole[t]] = 1;
  }
  for (std::size_t t = 0; t < traces.size(); ++t) {
    evidence[t].length_deg = length[whole[t]];
    evidence[t].is_seam = is_seam[whole[t]] != 0;
  }
}

/// What chance gives of traces that are at least half as bright as this one: a faint edge tells nothing of
/// how often chance makes a bright one. What aurora's own light is upside down is not chance.
BorderChance chance_of(std::size_t t, const std::vector<BorderTrace>& traces,
                       const std::vector<char>& is_claimed, const std::vector<BorderTrace>& turned,
                       const BorderSettings& settings) {
  constexpr double kAsBright = 0.5;
  BorderChance chance;
  double length = 0.0;
  for (const BorderTrace& other : turned) {
    if (other.measured * settings.azimuth_step_deg < settings.min_length_deg) continue;
    if (other.mean_brightness() < kAsBright * traces[t].mean_brightness()) continue;
    bool is_aurora = shares_border_light(other, traces[t]);
    for (std::size_t k = 0; k < traces.size() && !is_aurora; ++k)
      is_aurora = is_claimed[k] != 0 && shares_border_light(other, traces[k]);
    if (is_aurora) continue;
    ++chance.traces;
    for (const BorderPoint& p : other.points)
      length +=
          p.measured() ? settings.azimuth_step_deg * std::cos(p.elevation_deg * sim::kRadiansPerDegree) : 0.0;
  }
  if (chance.traces > 0) chance.mean_length_deg = length / chance.traces;
  return chance;
}

/// Gives each trace its probability.
void judge_traces(std::vector<BorderTrace>& traces, const SkyCells& cells, const Photo& photo,
                  const sim::Scene& scene, const BorderSettings& settings) {
  const std::vector<BorderTrace> turned = traces_upside_down(cells, settings);
  const double sky_colour = colour_of_sky(cells, photo, scene, settings);
  std::vector<BorderTrace> parts;
  for (const BorderTrace& trace : traces)
    for (BorderTrace& part : parted_by_colour(trace, cells, photo, scene, settings, sky_colour))
      parts.push_back(std::move(part));
  traces = std::move(parts);
  std::vector<BorderEvidence> evidence;
  for (const BorderTrace& trace : traces)
    evidence.push_back(border_evidence(trace, cells, photo, scene, settings, sky_colour));
  join_pieces(traces, evidence, settings);
  std::vector<char> is_claimed(traces.size(), 0);
  for (int round = 0; round < 2; ++round) {
    for (std::size_t t = 0; t < traces.size(); ++t)
      judge_border(traces[t], evidence[t], chance_of(t, traces, is_claimed, turned, settings), settings);
    for (std::size_t t = 0; t < traces.size(); ++t) is_claimed[t] = traces[t].is_claimed() ? 1 : 0;
  }
}

/// Leaves what lies below its light, where a border has a below: a line whose side in the frame's columns is
/// the horizon's side, too, and that is not so near to the magnetic zenith that aurora is seen from below.
void drop_upper_borders(std::vector<BorderTrace>& traces, const SkyFrame& frame, const sim::Scene& scene,
                        const BorderSettings& settings) {
  constexpr double kFromBelow_deg = 15.0, kDownwards = 0.26;  // the cosine of 75 degrees
  double magnetic_zenith[3];
  sim::enu_of_direction({scene.field.declination_deg + (scene.field.inclination_deg > 0.0 ? 180.0 : 0.0),
                         std::abs(scene.field.inclination_deg)},
                        magnetic_zenith);
  const auto is_upper = [&](const BorderTrace& trace, std::size_t i) {
    const BorderPoint& p = trace.points[i];
    if (!p.measured()) return false;
    const sim::Direction direction = frame.direction(p.azimuth_deg, p.elevation_deg);
    double here[3];
    sim::enu_of_direction(direction, here);
    const double off =
        here[0] * magnetic_zenith[0] + here[1] * magnetic_zenith[1] + here[2] * magnetic_zenith[2];
    return direction.elevation_deg > settings.highest_elevation_deg ||
           off > std::cos(kFromBelow_deg * sim::kRadiansPerDegree) ||
           frame.downwards(p.azimuth_deg, p.elevation_deg, slope_at(trace, i)) < kDownwards;
  };
  for (BorderTrace& trace : traces) {
    std::vector<BorderPoint> kept;
    for (std::size_t i = 0; i < trace.points.size(); ++i)
      if (!is_upper(trace, i)) kept.push_back(trace.points[i]);
    trace.points = std::move(kept);
    trace.measured = static_cast<int>(std::count_if(trace.points.begin(), trace.points.end(),
                                                    [](const BorderPoint& p) { return p.measured(); }));
  }
}

/// Gives points the azimuth and the elevation that they have about the zenith.
void set_upright(BorderTrace& trace, const SkyFrame& frame) {
  for (BorderPoint& p : trace.points) {
    p.peak_elevation_deg = frame.direction(p.azimuth_deg, p.peak_elevation_deg).elevation_deg;
    const sim::Direction there =
        frame.direction(p.azimuth_deg, p.measured() ? p.elevation_deg : p.peak_elevation_deg);
    p.azimuth_deg = there.azimuth_deg;
    if (p.measured()) p.elevation_deg = there.elevation_deg;
  }
}

}  // namespace

std::optional<std::vector<BorderTrace>> judged_traces(const SkyCells& cells, const Photo& photo,
                                                      const sim::Scene& scene,
                                                      const BorderSettings& settings) {
  std::vector<BorderTrace> traces;
  const bool is_upright = cells.frame.is_upright();
  // About a tilted pole a row has no elevation of its own, but all of it is high.
  if (!traces_of_cells(cells, is_upright ? air_of_rows(scene, cells, settings.channel) : no_air(cells),
                       scene.site.altitude_m, settings, traces))
    return {};
  if (!is_upright) drop_upper_borders(traces, cells.frame, scene, settings);
  judge_traces(traces, cells, photo, scene, settings);
  if (!is_upright)
    for (BorderTrace& trace : traces) set_upright(trace, cells.frame);
  return traces;
}

}  // namespace vegard::fit
