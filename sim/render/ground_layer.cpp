// The layer of the ground in a picture: what is seen of the landscape, its colours, and the light of the air.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "sim/base/number/constants.h"
#include "sim/base/number/smooth_step.h"
#include "sim/base/parallel.h"
#include "sim/render/ground/landscape.h"
#include "sim/render/lit_ground.h"
#include "sim/view/camera/camera.h"
#include "sim/view/colour/line_colours.h"
#include "sim/view/sky/air.h"

namespace vegard::sim {
namespace {

constexpr double kHighestGround_m = 9000.0;
constexpr double kHighestLandscape_m = 6000.0;  // above it the landscape passes into a level ground
constexpr double kTreesAlbedo = 0.12;  // of conifers over snow: Betts and Ball 1997, doi:10.1029/96JD03876
constexpr double kMolecules_km = 8.0, kAerosol_km = 1.5;  // scale heights at the ground; the second is ours
constexpr double kChannel_nm[3] = {610.0, 550.0, 465.0};

/// The light that the air scatters into the line of sight, tabulated over the elevation.
class LightOfAir {
 public:
  LightOfAir(const Scene& scene, const GroundIllumination& light)
      : lowest_(sine_of_horizon(scene.site.altitude_m * 1e-3)) {
    const AirAbove air(scene);
    if (air.none()) return;
    table_.resize(kKnots);
    for (const LineInAir& line : light.in_air) {
      const LineDepths<double> depths(line.wavelength_nm, scene.air.aerosol_optical_depth,
                                      scene.air.angstrom_exponent, scene.air.ozone_dobson);
      const Vector3 colour = line_colour(scene, line.wavelength_nm);
      const double from_around = 0.5 * (line.mean + scene.ground.albedo * line.level) * 1e-3;
      for (int knot = 0; knot < kKnots; ++knot) {
        const double place = static_cast<double>(knot) / (kKnots - 1);
        const Airmasses<double> masses = air.towards(lowest_ + (1.0 - lowest_) * place * place);
        // Ozone scatters nothing; of aerosol nearly all is scattered (0.9 and more).
        const double scatters = masses.molecules * depths.molecules + masses.aerosol * depths.aerosol;
        const double all = scatters + masses.ozone * depths.ozone;
        if (all <= 0.0) continue;
        const double share = scatters / all * (1.0 - depths.transmission(masses));
        for (int c = 0; c < 3; ++c) table_[knot][c] += colour[c] * from_around * share;
      }
    }
  }

  Vector3 at(double sine) const {
    if (table_.empty()) return {};
    const double place = std::sqrt(std::max(0.0, sine - lowest_) / (1.0 - lowest_)) * (kKnots - 1);
    const int knot = std::min(static_cast<int>(place), kKnots - 2);
    const double t = place - knot;
    Vector3 rgb;
    for (int c = 0; c < 3; ++c) rgb[c] = (1.0 - t) * table_[knot][c] + t * table_[knot + 1][c];
    return rgb;
  }

 private:
  static constexpr int kKnots = 512;
  double lowest_;
  std::vector<Vector3> table_;
};

/// The colours of what the observer sees of the landscape.
class LandscapeLight {
 public:
  LandscapeLight(const Scene& scene, const GroundIllumination& light, const LightOfAir& air)
      : light_(light), level_sky_(scene.sky.level), albedo_(scene.ground.albedo) {
    air_ = air.at(-1.0);
    if (AirAbove(scene).none()) return;
    const double pressure = pressure_share(scene.site.altitude_m * 1e-3);
    for (int c = 0; c < 3; ++c)
      per_m_[c] = 1e-3 * (rayleigh_optical_depth(kChannel_nm[c]) * pressure / kMolecules_km +
                          LineDepths<double>(kChannel_nm[c], scene.air.aerosol_optical_depth,
                                             scene.air.angstrom_exponent, 0.0)
                                  .aerosol /
                              kAerosol_km);
  }

  std::array<float, 3> of(const LandscapePoint& point, double azimuth_rad) const {
    constexpr int kSlopes = GroundIllumination::kSlopes;
    const auto place = [](double slope) {
      return std::clamp((slope / GroundIllumination::kSteepest + 1.0) * 0.5 * (kSlopes - 1), 0.0,
                        kSlopes - 1.0);
    };
    const double e = place(point.slope_east), n = place(point.slope_north);
    const int e0 = std::min(static_cast<int>(e), kSlopes - 2),
              n0 = std::min(static_cast<int>(n), kSlopes - 2);
    const double te = e - e0, tn = n - n0;
    const double steep = 1.0 / std::sqrt(1.0 + point.slope_east * static_cast<double>(point.slope_east) +
                                         point.slope_north * static_cast<double>(point.slope_north));
    const double albedo =
        point.light * (point.snow * albedo_ + (1.0 - point.snow) * std::min(albedo_, kTreesAlbedo));
    const Vector3 horizon = before_horizon(azimuth_rad);
    std::array<float, 3> rgb;
    for (int c = 0; c < 3; ++c) {
      const auto on = [&](int i, int j) { return light_.on[(n0 + j) * kSlopes + e0 + i][c]; };
      const double sky =
          (1.0 - tn) * ((1.0 - te) * on(0, 0) + te * on(1, 0)) + tn * ((1.0 - te) * on(0, 1) + te * on(1, 1));
      const double plain = 0.5 * (1.0 - steep) * albedo_ * light_.rgb[c];
      const double seen = std::exp(-per_m_[c] * point.distance_m);
      rgb[c] = static_cast<float>(seen * albedo * (sky + plain) / kPi + (1.0 - seen) * horizon[c]);
    }
    return rgb;
  }

 private:
  Vector3 before_horizon(double azimuth_rad) const {
    Vector3 rgb = level_sky_;
    const auto count = static_cast<int>(light_.horizon.size());
    const double turn = azimuth_rad / kTwoPi;
    const double place = (turn - std::floor(turn)) * count - 0.5;
    const int degree = static_cast<int>(std::floor(place));
    for (int c = 0; c < 3; ++c) {
      rgb[c] += air_[c];
      if (count == 0) continue;
      const double t = place - degree;
      rgb[c] += (1.0 - t) * light_.horizon[(degree + count) % count][c] +
                t * light_.horizon[(degree + 1 + count) % count][c];
    }
    return rgb;
  }

  const GroundIllumination& light_;
  Vector3 level_sky_, air_{}, per_m_{};
  double albedo_;
};

/// The ground before observers who are higher than any: even, its border as the sky's.
Image level_ground(const Scene& scene, const GroundIllumination& light, int threads) {
  const Camera& camera = scene.camera;
  Image layer(camera.width, camera.height, {"R", "G", "B", "A"});
  const CameraView<double> view = camera_view(camera);
  const double lowest = sine_of_horizon(scene.site.altitude_m * 1e-3);
  Vector3 ground{};
  for (int c = 0; c < 3; ++c) ground[c] = scene.ground.albedo * light.rgb[c] / kPi;
  const auto below = [&](double x_px, double y_px) {
    double enu[3];
    return enu_of_pixel(view, x_px, y_px, enu) && enu[2] < lowest;
  };
  constexpr int kFine = 8;
  parallel_for(static_cast<std::size_t>(camera.height), threads, [&](std::size_t row, int) {
    const int y = static_cast<int>(row);
    std::vector<std::uint8_t> above(camera.width + 1), under(camera.width + 1);
    for (int x = 0; x <= camera.width; ++x) {
      above[x] = below(x, y) ? 1 : 0;
      under[x] = below(x, y + 1) ? 1 : 0;
    }
    for (int x = 0; x < camera.width; ++x) {
      const int corners = above[x] + above[x + 1] + under[x] + under[x + 1];
      double share = corners / 4;
      // The sky of a pixel whose middle is below the horizon is dark already.
      if (corners % 4 != 0 && below(x + 0.5, y + 0.5)) {
        share = 1.0;
      } else if (corners % 4 != 0) {
        int inside = 0;
        for (int i = 0; i < kFine * kFine; ++i)
          inside += below(x + (i % kFine + 0.5) / kFine, y + (i / kFine + 0.5) / kFine) ? 1 : 0;
        share = static_cast<double>(inside) / (kFine * kFine);
      }
      for (int c = 0; c < 3; ++c) layer.at(x, y, c) = static_cast<float>(share * ground[c]);
      layer.at(x, y, 3) = static_cast<float>(share);
    }
  });
  return layer;
}

/// A picture's pixels in groups by the azimuth that they look at: [first[group], first[group + 1]) of
/// `pixel`.
struct PixelsByAzimuth {
  static constexpr int kGroups = 96;
  std::vector<std::uint32_t> pixel;
  std::array<std::size_t, kGroups + 1> first{};
  std::array<double, kGroups> lowest{};  ///< sine of the elevation

  PixelsByAzimuth(const Camera& camera, const CameraView<double>& view, int threads) {
    constexpr std::uint8_t kNone = 255;
    std::vector<std::uint8_t> group_of(static_cast<std::size_t>(camera.width) * camera.height, kNone);
    std::vector<float> sine(group_of.size());
    parallel_for(static_cast<std::size_t>(camera.height), threads, [&](std::size_t y, int) {
      for (int x = 0; x < camera.width; ++x) {
        double enu[3];
        if (!enu_of_pixel(view, x + 0.5, static_cast<double>(y) + 0.5, enu)) continue;
        const double turn = std::atan2(enu[0], enu[1]) / kTwoPi;
        group_of[y * camera.width + x] =
            static_cast<std::uint8_t>(std::min(kGroups - 1, static_cast<int>((turn + 0.5) * kGroups)));
        sine[y * camera.width + x] = static_cast<float>(enu[2]);
      }
    });
    lowest.fill(1.0);
    for (std::size_t i = 0; i < group_of.size(); ++i)
      if (group_of[i] != kNone) {
        ++first[group_of[i] + 1];
        lowest[group_of[i]] = std::min(lowest[group_of[i]], static_cast<double>(sine[i]));
      }
    for (int group = 0; group < kGroups; ++group) first[group + 1] += first[group];
    pixel.resize(first[kGroups]);
    std::array<std::size_t, kGroups + 1> next = first;
    for (std::size_t i = 0; i < group_of.size(); ++i)
      if (group_of[i] != kNone) pixel[next[group_of[i]]++] = static_cast<std::uint32_t>(i);
  }
};

/// What is seen of the landscape in the directions of a group, side by side in azimuth.
class SeenLandscape {
 public:
  SeenLandscape(const Landscape& landscape, const LandscapeLight& light, double from_rad, double to_rad,
                double lowest_sine, double step_rad)
      : from_rad_(from_rad - 2.0 * step_rad), step_rad_(step_rad) {
    const int count = static_cast<int>(std::ceil((to_rad - from_rad) / step_rad)) + 4;
    std::vector<LandscapePoint> seen;
    for (int i = 0; i < count; ++i) {
      const double azimuth = from_rad_ + (i + 0.5) * step_rad_;
      landscape.look(azimuth, lowest_sine, 1.5 * step_rad_, seen);
      first_.push_back(sine_.size());
      for (const LandscapePoint& point : seen) {
        sine_.push_back(point.sine);
        rgb_.push_back(light.of(point, azimuth));
      }
    }
    first_.push_back(sine_.size());
  }

  /// Returns the colour in a direction; null: above all.
  const std::array<float, 3>* at(const double enu[3], double lowest_sine) const {
    const double turn = (std::atan2(enu[0], enu[1]) - from_rad_) / kTwoPi;
    const double place = (turn - std::floor(turn + 0.25)) * kTwoPi / step_rad_;
    const auto look =
        static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(first_.size() - 2)));
    const auto begin = sine_.begin() + static_cast<std::ptrdiff_t>(first_[look]),
               end = sine_.begin() + static_cast<std::ptrdiff_t>(first_[look + 1]);
    auto found = std::lower_bound(begin, end, static_cast<float>(enu[2]));
    if (found == end) {
      if (enu[2] >= lowest_sine) return nullptr;
      --found;
    }
    return &rgb_[static_cast<std::size_t>(found - sine_.begin())];
  }

 private:
  double from_rad_, step_rad_;
  std::vector<std::size_t> first_;
  std::vector<float> sine_;
  std::vector<std::array<float, 3>> rgb_;
};

/// Draws a pixel: the mean of 2 x 2 places, and where the sky borders on the ground of 6 x 6.
template <class Look>
void draw_pixel(int x, int y, const CameraView<double>& view, const Look& look, float* rgba) {
  for (const int fine : {2, 6}) {
    int inside = 0;
    Vector3 sum{};
    for (int i = 0; i < fine * fine; ++i) {
      double enu[3];
      if (!enu_of_pixel(view, x + (i % fine + 0.5) / fine, y + (i / fine + 0.5) / fine, enu)) continue;
      if (const std::array<float, 3>* rgb = look(enu)) {
        ++inside;
        for (int c = 0; c < 3; ++c) sum[c] += (*rgb)[c];
      }
    }
    const double all = fine * fine;
    for (int c = 0; c < 3; ++c) rgba[c] = static_cast<float>(sum[c] / all);
    rgba[3] = static_cast<float>(inside / all);
    if (inside == 0 || inside == fine * fine) return;
  }
}

Image landscape_layer(const Scene& scene, const GroundIllumination& light, int threads) {
  const Camera& camera = scene.camera;
  Image layer(camera.width, camera.height, {"R", "G", "B", "A"});
  const CameraView<double> view = camera_view(camera);
  const double lowest = sine_of_horizon(scene.site.altitude_m * 1e-3);
  const LightOfAir air(scene, light);
  const Landscape landscape(scene.seed);
  const LandscapeLight colours(scene, light, air);
  constexpr double kFinest_rad = 2e-4;
  const double px_rad = kRadiansPerDegree / pixels_per_degree(camera);
  const double step_rad = std::max(kFinest_rad, 0.5 * px_rad);
  const PixelsByAzimuth pixels(camera, view, threads);
  constexpr int kGroups = PixelsByAzimuth::kGroups;
  parallel_for(kGroups, threads, [&](std::size_t group, int) {
    const double from = kTwoPi * (static_cast<double>(group) / kGroups - 0.5);
    std::optional<SeenLandscape> seen;
    if (pixels.lowest[group] < Landscape::kHighestSine + px_rad)
      seen.emplace(landscape, colours, from, from + kTwoPi / kGroups, pixels.lowest[group] - 2.0 * px_rad,
                   step_rad);
    const auto look = [&](const double enu[3]) -> const std::array<float, 3>* {
      return enu[2] < Landscape::kHighestSine ? seen->at(enu, lowest) : nullptr;
    };
    for (std::size_t i = pixels.first[group]; i < pixels.first[group + 1]; ++i) {
      const int x = static_cast<int>(pixels.pixel[i] % camera.width),
                y = static_cast<int>(pixels.pixel[i] / camera.width);
      float* rgba = &layer.at(x, y, 0);
      double enu[3];
      enu_of_pixel(view, x + 0.5, y + 0.5, enu);
      if (seen) draw_pixel(x, y, view, look, rgba);
      const Vector3 scattered = air.at(enu[2]);
      for (int c = 0; c < 3; ++c) rgba[c] += static_cast<float>((1.0 - rgba[3]) * scattered[c]);
    }
  });
  return layer;
}

}  // namespace

Image ground_layer(const Scene& scene, const GroundIllumination& light, int threads) {
  const double level =
      smooth_step((scene.site.altitude_m - kHighestLandscape_m) / (kHighestGround_m - kHighestLandscape_m));
  if (level >= 1.0) return level_ground(scene, light, threads);
  Image layer = landscape_layer(scene, light, threads);
  if (level <= 0.0) return layer;
  const Image even = level_ground(scene, light, threads);
  for (std::size_t i = 0; i < layer.data.size(); ++i)
    layer.data[i] = static_cast<float>((1.0 - level) * layer.data[i] + level * even.data[i]);
  return layer;
}

}  // namespace vegard::sim
