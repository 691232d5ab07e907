#include "fit/border/border_claim.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "sim/base/number/constants.h"
#include "sim/base/number/quantile.h"
#include "sim/scene/structs/line_of.h"
#include "sim/view/camera/camera.h"
#include "sim/view/sky/moon.h"
#include "sim/view/sky/star_place.h"

namespace vegard::fit {
namespace border_claim {
namespace {

constexpr double kSigmaOfMad = 1.4826;
constexpr double kNeighbourhood_deg = 5.0;  // of azimuth, on each side of a point
constexpr int kLeastPoints = 5;
constexpr double kCorrelatedPoints = 3.0;  // that smoothing across azimuth makes of one
constexpr double kGreenDepth = 0.2;        // of the air at the zenith, clear
constexpr double kMilkyWay_deg = 12.0;     // of galactic latitude
constexpr double kMoonHalo_deg = 24.0;     // its halo has 22

double median(std::vector<double> values) { return values.empty() ? sim::kNaN : sim::quantile(values, 0.5); }

double spread(const std::vector<double>& values) {
  const double middle = median(values);
  std::vector<double> off;
  off.reserve(values.size());
  for (const double v : values) off.push_back(std::abs(v - middle));
  return kSigmaOfMad * median(off);
}

using Light3 = std::array<double, 3>;

/// The mean light of a small patch about a direction, NaN where it is not usable.
class Patches {
 public:
  Patches(const Photo& photo, const sim::Camera& camera, const SkyCells& cells)
      : photo_(photo),
        view_(sim::camera_view(camera)),
        frame_(cells.frame),
        across_deg_(cells.azimuth_step_deg) {
    const double pixel = 1.0 / sim::pixels_per_degree(camera);
    up_deg_ = std::max(0.25, pixel);
    const auto count = [&](double size) {
      return std::clamp(static_cast<int>(std::ceil(2.0 * size / pixel)), 2, 8);
    };
    columns_ = count(0.5 * across_deg_), rows_ = count(up_deg_);
  }

  Light3 at(double azimuth_deg, double elevation_deg) const {
    Light3 sum{};
    double weight = 0.0;
    const int asked = columns_ * rows_;
    for (int i = 0; i < asked; ++i) {
      const double aside = (i % columns_ + 0.5) / columns_ - 0.5, above = (i / columns_ + 0.5) / rows_ - 0.5;
      double enu[3], x = 0.0, y = 0.0;
      sim::enu_of_direction(
          frame_.direction(azimuth_deg + aside * across_deg_, elevation_deg + 2.0 * above * up_deg_), enu);
      if (!sim::pixel_of_enu(view_, enu, x, y) || !(x >= 0.0 && y >= 0.0) || x >= photo_.linear.width ||
          y >= photo_.linear.height)
        continue;
      const std::size_t pixel = photo_.linear.index(static_cast<int>(x), static_cast<int>(y), 0);
      if (photo_.usable[pixel] == 0 || photo_.usable[pixel + 1] == 0 || photo_.usable[pixel + 2] == 0)
        continue;
      for (std::size_t c = 0; c < 3; ++c) sum[c] += photo_.linear.data[pixel + c];
      weight += 1.0;
    }
    if (weight < 0.5 * asked) return {sim::kNaN, sim::kNaN, sim::kNaN};
    for (double& v : sum) v /= weight;
    return sum;
  }

 private:
  const Photo& photo_;
  sim::CameraView<double> view_;
  SkyFrame frame_;
  double across_deg_, up_deg_ = 0.25;
  int columns_ = 2, rows_ = 2;
};

/// Where a point's border is by its neighbours, without itself and those that share its light.
struct Predicted {
  double border_deg = sim::kNaN, peak_deg = sim::kNaN, fall_deg = sim::kNaN;
  double slope = 0.0;  // of elevation by azimuth
};

Predicted predicted(const BorderTrace& trace, std::size_t at, double step_deg) {
  double n = 0.0, sx = 0.0, sxx = 0.0, sb = 0.0, sxb = 0.0;
  std::vector<double> height, fall;
  for (const BorderPoint& p : trace.points) {
    const double x = std::remainder(p.azimuth_deg - trace.points[at].azimuth_deg, 360.0);
    if (!p.measured() || std::abs(x) > kNeighbourhood_deg || std::abs(x) < 1.5 * step_deg) continue;
    n += 1.0, sx += x, sxx += x * x, sb += p.elevation_deg, sxb += x * p.elevation_deg;
    height.push_back(p.peak_elevation_deg - p.elevation_deg);
    fall.push_back(p.fall_deg);
  }
  Predicted out;
  if (n < 3.0) return out;
  const double xx = sxx - sx * sx / n;
  const double slope = xx > 0.0 ? (sxb - sx * sb / n) / xx : 0.0;
  out.slope = slope;
  out.border_deg = sb / n - slope * sx / n;
  out.peak_deg = out.border_deg + median(height);
  out.fall_deg = median(fall);
  return out;
}

/// The angle of a line against the horizontal. Of a frame's slope, in degrees of row to degree of column.
double steepness_deg(const SkyFrame& frame, const BorderPoint& p, double slope, double level) {
  if (frame.is_upright()) return std::atan(std::abs(slope) / level) / sim::kRadiansPerDegree;
  double from[3], to[3];
  sim::enu_of_direction(frame.direction(p.azimuth_deg - 0.5, p.elevation_deg - 0.5 * slope), from);
  sim::enu_of_direction(frame.direction(p.azimuth_deg + 0.5, p.elevation_deg + 0.5 * slope), to);
  const double rise = std::abs(to[2] - from[2]);
  const double length = std::hypot(to[0] - from[0], to[1] - from[1], rise);
  // The vertical's part across the line of sight is 1 long.
  const double across =
      std::cos(frame.direction(p.azimuth_deg, p.elevation_deg).elevation_deg * sim::kRadiansPerDegree);
  return std::asin(std::min(1.0, rise / std::max(1e-9, length * across))) / sim::kRadiansPerDegree;
}

/// Air mass by Kasten and Young 1989 (Applied Optics 28, 4735).
double air_mass(double elevation_deg) {
  const double e = std::max(0.0, elevation_deg);
  return 1.0 / (std::sin(e * sim::kRadiansPerDegree) + 0.50572 * std::pow(e + 6.07995, -1.6364));
}

double normal(double x, double mean, double sigma) {
  const double z = (x - mean) / sigma;
  return std::exp(-0.5 * z * z) / (sigma * std::sqrt(sim::kTwoPi));
}

double below_normal(double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); }

/// The degrees from a border down to what is masked, NaN if that is farther than 4 degrees.
double above_edge_deg(const SkyCells& cells, const BorderPoint& p) {
  const int column = static_cast<int>(std::lround(p.azimuth_deg / cells.azimuth_step_deg)) % cells.columns;
  const int from = static_cast<int>((p.elevation_deg - cells.lowest_deg) / cells.elevation_step_deg);
  for (int r = std::min(from, cells.rows - 1); r >= 0; --r) {
    const double off = p.elevation_deg - cells.elevation_deg(r);
    if (off > 4.0) break;
    if (!std::isfinite(cells.light[cells.index(column, r)])) return off;
  }
  return sim::kNaN;
}

/// True if a line runs along the rows or the columns of the picture, within a pixel over more than forty.
bool is_seam(std::vector<double> x_px, std::vector<double> y_px) {
  if (x_px.size() < 5) return false;
  const auto is_along = [](const std::vector<double>& along, const std::vector<double>& across) {
    const auto [low, high] = std::minmax_element(along.begin(), along.end());
    return *high - *low > 40.0 && spread(across) < 0.75;
  };
  return is_along(x_px, y_px) || is_along(y_px, x_px);
}

/// True if a long line stays at one elevation, where a straight one at one height would come nearer: the
/// tangent of a straight line's elevation falls as the cosine of the azimuth from its nearest point.
bool is_circle(const std::vector<const BorderPoint*>& points) {
  constexpr double kLong_deg = 90.0, kShare = 0.35;
  if (points.size() < 5) return false;
  double range = std::fmod(points.back()->azimuth_deg - points.front()->azimuth_deg + 360.0, 360.0);
  if (range < kLong_deg) return false;
  range = std::min(range, 150.0);
  std::vector<double> tangent;
  tangent.reserve(points.size());
  for (const BorderPoint* p : points)
    tangent.push_back(std::log(std::tan(p->elevation_deg * sim::kRadiansPerDegree)));
  const double change = sim::quantile(tangent, 0.95) - sim::quantile(tangent, 0.05);
  return change < -kShare * std::log(std::cos(0.5 * range * sim::kRadiansPerDegree));
}

/// Sets what time and place tell: whether the points lie in the Milky Way or about the Moon.
void look_at_known_sky(const std::vector<const BorderPoint*>& points, const SkyFrame& frame,
                       const sim::Scene& scene, BorderEvidence& out) {
  const auto time = sim::julian_date(scene.site.time_utc);
  if (!time || points.empty() || !sim::is_latitude_given(scene) || !sim::is_longitude_given(scene)) return;
  const sim::Observer observer{scene.site.latitude_deg, scene.site.longitude_deg, scene.site.altitude_m,
                               false};
  // The pole of the galaxy (J2000: 192.8595, 27.1283 degrees).
  const std::array<double, 3> pole = sim::direction_of_star({{192.8595, 27.1283}, 0.0, 0.0}, observer, *time);
  const std::array<double, 3> moon = sim::direction_of_moon(observer, *time);
  const auto dot = [](const std::array<double, 3>& a, const double* b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  };
  double galactic = 0.0, near = 0.0;
  for (const BorderPoint* p : points) {
    double enu[3];
    sim::enu_of_direction(frame.direction(p->azimuth_deg, 0.5 * (p->elevation_deg + p->peak_elevation_deg)),
                          enu);
    galactic += std::abs(dot(pole, enu)) < std::sin(kMilkyWay_deg * sim::kRadiansPerDegree) ? 1.0 : 0.0;
    near += moon[2] > 0.0 && dot(moon, enu) > std::cos(kMoonHalo_deg * sim::kRadiansPerDegree) ? 1.0 : 0.0;
  }
  out.in_milky_way = galactic / static_cast<double>(points.size());
  out.near_moon = near / static_cast<double>(points.size());
}

/// A piece of evidence: the logarithm of its likelihood ratio, and what speaks against aurora by it.
struct Term {
  double log_ratio = 0.0;
  const char* doubt = "";
};

/// Length: a trace of aurora in half of the pictures, 60 degrees long in the mean; against it chance, as
/// measured, and two traces, 20 degrees long in the mean, of what has a top and a bottom (cloud, horizon).
Term length_term(double length_deg, const BorderChance& chance, double least_deg) {
  const double over = std::max(0.0, length_deg - least_deg);
  const auto density = [&](double count, double mean) { return count / mean * std::exp(-over / mean); };
  // One trace of 8 degrees more: the picture upside down is one draw.
  const double mean =
      (chance.traces * std::max(4.0, chance.mean_length_deg - least_deg) + 8.0) / (chance.traces + 1.0);
  const double ratio = density(0.5, 60.0) / (density(chance.traces + 1.0, mean) + density(2.0, 20.0));
  return {std::min(2.0, std::log(ratio)), "as short as what chance gives in this picture"};
}

Term continuity_term(double light_of_peaks) {
  const double continuity = std::clamp(light_of_peaks, -1.0, 1.0);
  const double aurora = normal(continuity, 0.85, 0.25) + 1e-2;
  const double other = 0.3 * normal(continuity, 0.85, 0.25) + 0.7 * normal(continuity, 0.3, 0.35);
  return {std::log(aurora / other), "stars or noise: its light is not there between its brightest points"};
}

/// Continuum: no share of a line, within 0.15 for colours of lamps and camera; lines' light, a share of 0.2
/// to 1. Of other things two in a hundred have any colour (green lamps, reflections in the lens).
Term colour_term(const BorderEvidence& e) {
  const double x = std::clamp(e.line_share, -2.0, 1.5);
  const double s = std::hypot(0.1, e.line_share_error);
  const double aurora = (below_normal((x - 0.2) / s) - below_normal((x - 1.0) / s)) / 0.8 + 1e-3;
  const double other = 0.98 * normal(x, 0.0, std::hypot(0.15, e.line_share_error)) + 0.02 / 2.0;
  const double most = std::max({e.excess[0], e.excess[1], e.excess[2]});
  const char* doubt = most == e.excess[0] ? "reddish light: lamps, or cloud lit by them"
                      : most == e.excess[2]
                          ? "bluish light: twilight, the Moon's or stars' light"
                          : "the colour of the sky itself: cloud, stars, the Moon's light or haze";
  return {std::log(aurora / other), doubt};
}

/// The sky's own slope adds to the light between foot and peak: where it is most of it, there is hardly a
/// peak.
Term slope_term(double light_of_peaks) {
  const double over = std::max(0.0, light_of_peaks - 1.0);
  const double ratio = normal(over, 0.0, 0.35) / normal(over, 0.0, 1.0);
  return {std::clamp(std::log(ratio), -4.0, 0.0),
          "the slope of the sky's own light: haze, the Moon or a lamp"};
}

Term contrast_term(double contrast) {
  const double x = std::log(std::clamp(contrast, 1e-3, 1e3));
  const double aurora = normal(x, std::log(0.6), 1.2);
  const double other = 0.97 * normal(x, std::log(0.15), 0.8) + 0.03 * normal(x, 0.0, 2.0);
  return {std::log(aurora / other), "faint against the sky: cloud, airglow or the Milky Way"};
}

Term shape_term(double sharper_below) {
  const double x = std::clamp(sharper_below, -2.0, 2.0);
  const double aurora = normal(x, 0.4, 0.5) + 1e-2;
  const double other = 0.7 * normal(x, 0.0, 0.35) + 0.3 / 4.0 + 0.1 * normal(x, -1.0, 0.7);
  return {std::log(aurora / other), "no sharper below than above: cloud or a glow"};
}

Term roughness_term(double roughness_deg) {
  const double x = std::log(std::clamp(roughness_deg, 0.02, 5.0));
  const double ratio = normal(x, std::log(0.25), 0.6) / normal(x, std::log(0.6), 0.6);
  return {std::clamp(std::log(ratio), -1.5, 1.0), "rough: cloud or stars"};
}

}  // namespace
}  // namespace border_claim

namespace border_claim {
namespace {

/// The light of one point where its neighbours say that the border runs.
struct PointLight {
  std::size_t index = 0;           // of the trace's points
  Light3 excess{}, sky{}, over{};  // over: as far above the peak as the foot is below
  Light3 edge{};                   // excess next to the border: high up aurora may be red
  double sharper = sim::kNaN, fall = 0.0, without_air = 0.0, colour = 0.0, light = 0.0;
};

std::vector<PointLight> lights_of(const BorderTrace& trace, const SkyCells& cells, const Photo& photo,
                                  const sim::Scene& scene, std::size_t traced) {
  const Patches patches(photo, scene.camera, cells);
  const double pixel_deg = 1.0 / sim::pixels_per_degree(scene.camera);
  std::vector<PointLight> out;
  for (std::size_t i = 0; i < trace.points.size(); ++i) {
    const BorderPoint& p = trace.points[i];
    if (!p.measured()) continue;
    const Predicted place = predicted(trace, i, cells.azimuth_step_deg);
    if (!std::isfinite(place.border_deg)) continue;
    const double foot_deg = place.border_deg - std::max({1.25 * place.fall_deg, 0.5, 1.5 * pixel_deg});
    const Light3 top = patches.at(p.azimuth_deg, place.peak_deg), foot = patches.at(p.azimuth_deg, foot_deg);
    if (!std::isfinite(top[0] + foot[0])) continue;
    const Light3 near =
        patches.at(p.azimuth_deg, std::min(place.peak_deg, place.border_deg + place.fall_deg));
    PointLight light;
    light.index = i;
    for (std::size_t c = 0; c < 3; ++c) {
      light.excess[c] = top[c] - foot[c];
      light.edge[c] = std::isfinite(near[c]) ? near[c] - foot[c] : light.excess[c];
      light.sky[c] = foot[c];
      light.light += top[c] + foot[c];
    }
    light.colour = std::abs(top[0] - top[1]) + std::abs(top[2] - top[1]);
    light.over = patches.at(p.azimuth_deg, 2.0 * place.peak_deg - foot_deg);
    light.sharper = light.over[traced] - foot[traced];
    // Of the fall itself: the peak may stand so far above it that any light between is dimmed by much.
    const double upper_deg = place.border_deg + 0.5 * place.fall_deg,
                 lower_deg = place.border_deg - 0.5 * place.fall_deg;
    const double upper = patches.at(p.azimuth_deg, upper_deg)[traced],
                 lower = patches.at(p.azimuth_deg, lower_deg)[traced];
    light.fall = upper - lower;
    light.without_air = upper - lower * std::exp(kGreenDepth * (air_mass(lower_deg) - air_mass(upper_deg)));
    out.push_back(light);
  }
  return out;
}

template <class Value>
std::vector<double> values_of(const std::vector<PointLight>& lights, std::size_t from, std::size_t to,
                              const Value& value) {
  std::vector<double> out;
  for (std::size_t i = from; i < to; ++i)
    if (const double v = value(lights[i]); std::isfinite(v)) out.push_back(v);
  return out;
}

/// Whether the picture has colours: a grey one has three equal channels.
bool is_coloured(const std::vector<PointLight>& lights) {
  double colour = 0.0, all = 0.0;
  for (const PointLight& light : lights) colour += light.colour, all += light.light;
  return colour > 1e-3 * all;
}

/// How much of the traced channel's light a continuum gives for the mean of the others: that of the sky
/// beneath or above, or of the whole sky, whichever is more, within what cameras with and without white
/// balance have. Above, since a cloud or a hill beneath takes away what the sky above has.
double continuum_of(const std::vector<PointLight>& lights, std::size_t from, std::size_t to,
                    std::size_t traced, double sky_colour) {
  double most = sky_colour;
  for (const auto place : {&PointLight::sky, &PointLight::over}) {
    const auto sky = [&](std::size_t c) {
      return median(values_of(lights, from, to, [&](const PointLight& l) { return (l.*place)[c]; }));
    };
    const double ratio = sky(traced) / std::max(1e-9, 0.5 * (sky((traced + 1) % 3) + sky((traced + 2) % 3)));
    if (std::isfinite(ratio)) most = std::max(most, ratio);
  }
  return std::clamp(most, 1.0, 2.0);
}

double line_light(const PointLight& light, std::size_t traced, double continuum) {
  return light.edge[traced] - continuum * 0.5 * (light.edge[(traced + 1) % 3] + light.edge[(traced + 2) % 3]);
}

}  // namespace
}  // namespace border_claim

double colour_of_sky(const SkyCells& cells, const Photo& photo, const sim::Scene& scene,
                     const BorderSettings& settings) {
  using namespace border_claim;
  const Patches patches(photo, scene.camera, cells);
  const auto traced = static_cast<std::size_t>(settings.channel);
  std::vector<double> ratios;
  for (int c = 0; c < cells.columns; c += std::max(1, cells.columns / 60))
    for (int r = 0; r < cells.rows; r += std::max(1, cells.rows / 20)) {
      if (!std::isfinite(cells.light[cells.index(c, r)])) continue;
      const Light3 light = patches.at(cells.azimuth_deg(c), cells.elevation_deg(r));
      const double others = 0.5 * (light[(traced + 1) % 3] + light[(traced + 2) % 3]);
      if (std::isfinite(others) && others > 0.0) ratios.push_back(light[traced] / others);
    }
  return ratios.empty() ? 1.0 : median(ratios);
}

std::vector<BorderTrace> parted_by_colour(const BorderTrace& trace, const SkyCells& cells, const Photo& photo,
                                          const sim::Scene& scene, const BorderSettings& settings,
                                          double sky_colour) {
  using namespace border_claim;
  constexpr std::size_t kReach = 5;    // points on each side that a colour is measured over
  constexpr double kLineShare = 0.15;  // between a continuum's and lines' light
  const auto traced = static_cast<std::size_t>(settings.channel);
  const std::vector<PointLight> lights = lights_of(trace, cells, photo, scene, traced);
  const auto least = static_cast<std::size_t>(settings.min_length_deg / settings.azimuth_step_deg);
  if (lights.size() < 2 * least || !is_coloured(lights)) return {trace};
  std::vector<char> is_line;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const std::size_t from = i > kReach ? i - kReach : 0, to = std::min(lights.size(), i + kReach + 1);
    const double continuum = continuum_of(lights, from, to, traced, sky_colour);
    const double light =
        median(values_of(lights, from, to, [&](const PointLight& l) { return l.edge[traced]; }));
    const double line = median(
        values_of(lights, from, to, [&](const PointLight& l) { return line_light(l, traced, continuum); }));
    is_line.push_back(line > kLineShare * light ? 1 : 0);
  }
  // A run that is shorter than a border may be belongs to the one before.
  std::vector<std::size_t> cuts;
  std::size_t begin = 0;
  for (std::size_t i = 1; i <= lights.size(); ++i) {
    if (i < lights.size() && is_line[i] == is_line[begin]) continue;
    if (i - begin >= least && (cuts.empty() || is_line[begin] != is_line[cuts.back()])) cuts.push_back(begin);
    begin = i;
  }
  std::vector<BorderTrace> parts;
  for (std::size_t k = 0; k < std::max<std::size_t>(1, cuts.size()); ++k) {
    const std::size_t from = k == 0 ? 0 : lights[cuts[k]].index;
    const std::size_t to = k + 1 < cuts.size() ? lights[cuts[k + 1]].index : trace.points.size();
    BorderTrace part;
    part.points.assign(trace.points.begin() + static_cast<std::ptrdiff_t>(from),
                       trace.points.begin() + static_cast<std::ptrdiff_t>(to));
    for (const BorderPoint& p : part.points) part.measured += p.measured() ? 1 : 0;
    parts.push_back(std::move(part));
  }
  return parts;
}

BorderEvidence border_evidence(const BorderTrace& trace, const SkyCells& cells, const Photo& photo,
                               const sim::Scene& scene, const BorderSettings& settings, double sky_colour) {
  using namespace border_claim;
  BorderEvidence out;
  const auto traced = static_cast<std::size_t>(settings.channel);
  std::vector<double> rough, edge, steep, x_px, y_px, fall;
  const sim::CameraView<double> view = sim::camera_view(scene.camera);
  std::vector<const BorderPoint*> given;
  for (std::size_t i = 0; i < trace.points.size(); ++i) {
    const BorderPoint& p = trace.points[i];
    if (!p.measured()) continue;
    given.push_back(&p);
    if (const double above = above_edge_deg(cells, p); std::isfinite(above)) edge.push_back(above);
    const Predicted place = predicted(trace, i, cells.azimuth_step_deg);
    if (!std::isfinite(place.border_deg)) continue;
    // Across the line and along it, on the sky.
    const double level = std::cos(p.elevation_deg * sim::kRadiansPerDegree);
    const double run = std::hypot(level, std::clamp(place.slope, -3.0, 3.0));
    steep.push_back(steepness_deg(cells.frame, p, place.slope, level));
    fall.push_back(p.fall_deg);
    double enu[3], x = 0.0, y = 0.0;
    sim::enu_of_direction(cells.frame.direction(p.azimuth_deg, p.elevation_deg), enu);
    if (sim::pixel_of_enu(view, enu, x, y)) x_px.push_back(x), y_px.push_back(y);
    out.length_deg += cells.azimuth_step_deg * run;
    rough.push_back(std::abs(p.elevation_deg - place.border_deg) * level / run);
  }
  look_at_known_sky(given, cells.frame, scene, out);
  out.steepness_deg = steep.empty() ? 0.0 : median(steep);
  out.is_seam = is_seam(x_px, y_px) && median(fall) < 4.0 * cells.elevation_step_deg;
  out.is_circle = cells.frame.is_upright() && is_circle(given);
  const std::vector<PointLight> lights = lights_of(trace, cells, photo, scene, traced);
  out.points = static_cast<int>(lights.size());
  if (out.points < kLeastPoints) return out;
  const auto middle = [&](const auto& value) { return median(values_of(lights, 0, lights.size(), value)); };
  for (std::size_t c = 0; c < 3; ++c)
    out.excess[c] = middle([&](const PointLight& l) { return l.excess[c]; });
  const double light = out.excess[traced], whole = std::max(std::abs(light), 1e-12);
  out.continuity = light / middle([&](const PointLight& l) { return trace.points[l.index].brightness; });
  out.contrast = light / std::max(1e-9, middle([&](const PointLight& l) { return l.sky[traced]; }));
  const double sharper = middle([](const PointLight& l) { return l.sharper; });
  out.sharper_below = std::isfinite(sharper) ? sharper / whole : 0.0;
  out.roughness_deg = kSigmaOfMad * median(rough);
  out.left_without_air = middle([](const PointLight& l) { return l.without_air; }) /
                         std::max(middle([](const PointLight& l) { return std::abs(l.fall); }), 1e-12);
  if (edge.size() * 5 >= given.size() * 3 && spread(edge) < 0.6)
    out.beside_edge = static_cast<double>(edge.size()) / static_cast<double>(given.size());
  out.is_coloured = is_coloured(lights);
  if (!out.is_coloured) return out;
  const double continuum = continuum_of(lights, 0, lights.size(), traced, sky_colour);
  const auto line = [&](const PointLight& l) { return line_light(l, traced, continuum); };
  const double at_edge =
      std::max(std::abs(middle([&](const PointLight& l) { return l.edge[traced]; })), 1e-12);
  out.line_share = middle(line) / at_edge;
  // The error of a ratio is that of what it leaves.
  const std::vector<double> left = values_of(lights, 0, lights.size(), [&](const PointLight& l) {
    return line(l) - out.line_share * l.edge[traced];
  });
  out.line_share_error =
      1.2533 * spread(left) / std::sqrt(std::max(1.0, out.points / kCorrelatedPoints)) / at_edge;
  return out;
}

void judge_border(BorderTrace& trace, const BorderEvidence& evidence, const BorderChance& chance,
                  const BorderSettings& settings) {
  using namespace border_claim;
  trace.doubt.clear();
  if (trace.measured * settings.azimuth_step_deg < settings.min_length_deg) {
    trace.aurora_probability = 0.0;
    trace.doubt = "too little of its lower border is in sight";
    return;
  }
  if (evidence.points < kLeastPoints) {
    trace.aurora_probability = 0.0;
    trace.doubt = "too few points in a row";
    return;
  }
  std::vector<Term> terms = {length_term(evidence.length_deg, chance, settings.min_length_deg),
                             continuity_term(evidence.continuity),
                             slope_term(evidence.continuity),
                             contrast_term(evidence.contrast),
                             shape_term(evidence.sharper_below),
                             roughness_term(evidence.roughness_deg)};
  if (evidence.is_coloured) terms.push_back(colour_term(evidence));
  if (evidence.is_seam) terms.push_back({-4.0, "a seam of the sensor: it runs along the picture's pixels"});
  if (evidence.is_circle)
    terms.push_back({-3.0, "a circle about the zenith: the lens's edge or the horizon"});
  if (evidence.steepness_deg > 65.0) terms.push_back({-2.0, "the side of rays"});
  if (evidence.beside_edge > 0.0) terms.push_back({-2.0, "the edge of the ground or of the mask"});
  if (evidence.left_without_air < 0.3) terms.push_back({-3.0, "the air's dimming towards the horizon"});
  if (evidence.in_milky_way > 0.7) terms.push_back({-2.0, "the Milky Way"});
  if (evidence.near_moon > 0.7) terms.push_back({-2.0, "the Moon's halo"});
  double sum = 0.0;
  const Term* worst = &terms.front();
  for (const Term& term : terms) {
    sum += term.log_ratio;
    if (term.log_ratio < worst->log_ratio) worst = &term;
  }
  trace.aurora_probability = 1.0 / (1.0 + std::exp(-sum));
  if (!trace.is_claimed()) trace.doubt = worst->doubt;
}

}  // namespace vegard::fit
