// Three curtains with folds and rays, made by the simulator itself: what the map finds of them, and what is
// left after they have been refined by beams (docs/validation.md, "Maps of precipitation"). Brightness 1 :
// 0.45 : 0.3, noise of seed 7.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "fit/fit.h"
#include "fit/map/curtains/curtains.h"
#include "fit/map/map_fit.h"
#include "fit/map/raster_grid.h"
#include "fit/report/table/curtain_steps_table.h"
#include "sim/base/number/constants.h"
#include "sim/emit/aurora/sheet_curve.h"
#include "sim/scene/file/scene_toml.h"
#include "tests/support/two_stations.h"

namespace vegard::fit::curtains_test {
namespace {

const char* const kCamera =
    "seed = 3\n[site]\nlatitude_deg = 67.0\nlongitude_deg = 20.0\n[field]\ninclination_deg = 78.0\n"
    "[camera]\nwidth = 360\nheight = 240\nhfov_deg = 70\nelevation_deg = 33\n"
    "[sensor]\ngain_per_kilorayleigh = 0.08\n[sky]\nlevel = [0.01, 0.02, 0.025]\n";

std::string curve(const char* name, double flux, const char* east, const char* north, const char* energies) {
  return std::string("[[sheet]]\nname = \"") + name +
         "\"\ncourse = \"curve\"\nlayers = 1\nwidth_km = 2\nbeams_per_km = 12\nray_contrast = "
         "0.3\nray_width_km = 2\n" +
         "energy_flux_mw_m2 = " + std::to_string(flux) + "\neast_km = " + east + "\nnorth_km = " + north +
         "\n" + energies + "\n";
}

sim::Scene camera() { return sim::parse_scene(kCamera, "camera.toml"); }

sim::Scene truth() {
  return sim::parse_scene(
      std::string(kCamera) +
          curve("front", 12.0, "[-190, -130, -95, -80, -60, -40, -20, 0, 20, 40, 70, 120, 190]",
                "[165, 170, 158, 172, 186, 172, 158, 160, 178, 186, 170, 160, 165]",
                "point_energy_kev = [3, 3, 3.5, 4, 4.5, 5, 5, 4.5, 4, 4, 3.5, 3, 3]") +
          curve("middle", 5.4, "[-260, -190, -120, -60, -20, 20, 60, 110, 180, 260]",
                "[250, 244, 262, 240, 256, 238, 256, 244, 250, 240]", "energy_kev = 2.8") +
          curve("far", 3.6, "[-330, -240, -150, -70, 0, 70, 150, 240, 330]",
                "[330, 345, 325, 348, 330, 350, 335, 345, 330]", "energy_kev = 3.5"),
      "truth.toml");
}

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values.at(static_cast<std::size_t>(share * static_cast<double>(values.size() - 1)));
}

/// Energy flux and flux times ln E0 of curves on a raster, smoothed by so many km.
struct CurveLight {
  std::vector<double> flux, flux_ln_energy;

  CurveLight(const std::vector<sim::Sheet>& sheets, const RasterGrid& raster, double smooth_km)
      : flux(raster.size(), 0.0), flux_ln_energy(raster.size(), 0.0) {
    for (const sim::Sheet& sheet : sheets) add(sheet, raster, smooth_km);
  }

  void add(const sim::Sheet& sheet, const RasterGrid& raster, double smooth_km) {
    constexpr double kStep_km = 0.5;
    const sim::CurveLayout layout = sim::curve_layout(sheet);
    const sim::SheetCurve<double> curve(
        sim::curve_nodes<double>(sheet, 0.0, [](const double& x) { return x; }), 0,
        static_cast<int>(sheet.east_km.size()) - 2);
    const auto& nodes = curve.nodes();
    const int steps = static_cast<int>(layout.length_km / kStep_km);
    for (int k = 0; k < steps; ++k) {
      const auto [piece, fraction] = layout.piece_at((k + 0.5) / steps);
      const auto value = [&, piece = piece, fraction = fraction](const std::vector<double>& list,
                                                                 double even) {
        return list.empty() ? even : std::exp(curve.along(list, piece, fraction));
      };
      const double width = value(nodes.ln_width, sheet.width_km),
                   ln_energy = std::log(value(nodes.ln_energy, sheet.energy_kev)),
                   light = sheet.energy_flux_mw_m2 * value(nodes.ln_brightness, 1.0) * width *
                           std::sqrt(2.0 * sim::kPi) * layout.length_km / steps;
      const std::array<double, 2> at = curve.place(piece, fraction).at;
      const double square = width * width + smooth_km * smooth_km, reach = 4.0 * std::sqrt(square);
      const auto index = [&](double km, double first) {
        return static_cast<int>(std::lround((km - first) / raster.step_km));
      };
      for (int y = std::max(0, index(at[1] - reach, raster.south_km));
           y <= std::min(raster.rows - 1, index(at[1] + reach, raster.south_km)); ++y)
        for (int x = std::max(0, index(at[0] - reach, raster.west_km));
             x <= std::min(raster.columns - 1, index(at[0] + reach, raster.west_km)); ++x) {
          const sim::EastNorth km = raster.place(x, y);
          const double r = std::pow(km.east - at[0], 2) + std::pow(km.north - at[1], 2);
          const double share = light * std::exp(-0.5 * r / square) / (2.0 * sim::kPi * square);
          const std::size_t i = static_cast<std::size_t>(y) * raster.columns + x;
          flux[i] += share;
          flux_ln_energy[i] += share * ln_energy;
        }
    }
  }
};

struct Figures {
  double distance_median = 0.0, distance_nine_in_ten = 0.0, ln_energy_median = 0.0;
};

/// Degree by degree of azimuth: the brightest place of what was found and of the truth along it, where the
/// truth is at least a quarter of its median.
Figures figures(const char* what, const RasterGrid& raster, const std::vector<std::uint8_t>& in_view,
                const std::vector<double>& flux, const std::vector<double>& ln, const CurveLight& truth) {
  struct Along {
    double found = 0.0, brightness = 0.0, distance = 0.0, true_distance = 0.0, ln = 0.0, true_ln = 0.0;
  };
  std::vector<Along> all;
  std::vector<double> brightness;
  for (int azimuth = -33; azimuth <= 33; ++azimuth) {
    Along a;
    for (double d = 60.0; d < 500.0; d += 0.5) {
      const int x = static_cast<int>(
          std::lround((d * std::sin(azimuth * sim::kRadiansPerDegree) - raster.west_km) / raster.step_km));
      const int y = static_cast<int>(
          std::lround((d * std::cos(azimuth * sim::kRadiansPerDegree) - raster.south_km) / raster.step_km));
      if (x < 0 || y < 0 || x >= raster.columns || y >= raster.rows) continue;
      const std::size_t i = static_cast<std::size_t>(y) * raster.columns + x;
      if (in_view[i] == 0) continue;
      if (flux[i] > a.found) a = {flux[i], a.brightness, d, a.true_distance, ln[i] / flux[i], a.true_ln};
      if (truth.flux[i] > a.brightness) {
        a.brightness = truth.flux[i];
        a.true_distance = d;
        a.true_ln = truth.flux_ln_energy[i] / truth.flux[i];
      }
    }
    if (a.brightness > 0.0) {
      all.push_back(a);
      brightness.push_back(a.brightness);
    }
  }
  const double quarter = 0.25 * quantile(brightness, 0.5);
  std::vector<double> distance, energy;
  for (const Along& a : all) {
    if (a.brightness < quarter) continue;
    distance.push_back(std::abs(a.distance - a.true_distance) / a.true_distance);
    if (distance.back() <= 0.1) energy.push_back(std::abs(a.ln - a.true_ln));
  }
  const Figures f{quantile(distance, 0.5), quantile(distance, 0.9), quantile(energy, 0.5)};
  std::printf("%s: distance %.2f %% in the median, %.1f %% for nine in ten; ln E0 %.1f %%; %zu azimuths\n",
              what, 100.0 * f.distance_median, 100.0 * f.distance_nine_in_ten, 100.0 * f.ln_energy_median,
              distance.size());
  return f;
}

double nearest_km(sim::EastNorth place, const std::vector<sim::EastNorth>& feet) {
  double nearest = 1e9;
  for (const sim::EastNorth& foot : feet)
    nearest = std::min(nearest, std::hypot(foot.east - place.east, foot.north - place.north));
  return nearest;
}

/// How far a ridge may be off the curve that it is of.
double near_km(sim::EastNorth place) { return std::max(8.0, 0.04 * std::hypot(place.east, place.north)); }

std::vector<Ridge> ridges(const std::vector<Curtain>& curtains, const std::string& stem) {
  std::vector<Ridge> ridges;
  for (const Curtain& curtain : curtains) {
    ridges.push_back({stem + std::to_string(ridges.size() + 1), {}});
    for (const CurtainPoint& p : curtain.points)
      ridges.back().points.push_back({p.foot_km, p.flux_mw_m2.value, p.energy_kev.value, p.width_km.value});
  }
  return ridges;
}

TEST(CurtainRecovery, OfThreeFoldedCurtainsWithRays) {
  const Photo photo = tests::photo_of(truth(), 0.003, 7);
  MapOptions options;
  options.replicates = 2;
  const MapResult map = map_photos(camera(), {photo}, options);
  const RasterGrid raster = raster_over(map);
  const std::vector<std::uint8_t> in_view = places_in_view(map, raster);
  const RasterFlux flux = raster_flux(map, raster, map.cells);
  constexpr double kSmooth_km = 2.0;
  const auto smooth = [&](const std::vector<double>& values) {
    return smoothed_raster(raster, values, kSmooth_km / raster.step_km);
  };
  const CurveLight light(truth().sheets, raster, kSmooth_km);
  const Figures of_map =
      figures("map", raster, in_view, smooth(flux.flux), smooth(flux.flux_ln_energy), light);
  EXPECT_LE(of_map.distance_median, 0.02);
  EXPECT_LE(of_map.distance_nine_in_ten, 0.10);
  EXPECT_LE(of_map.ln_energy_median, 0.06);

  // Each curve is found, and nothing else.
  const std::vector<Curtain> curtains = find_curtains(map), faint = find_faint_curtains(map);
  std::vector<sim::EastNorth> found;
  for (const Curtain& curtain : curtains)
    for (const CurtainPoint& p : curtain.points) found.push_back(p.foot_km);
  std::vector<sim::EastNorth> all_feet;
  for (const sim::Sheet& sheet : truth().sheets) {
    const std::vector<sim::EastNorth> feet = sim::curve_feet(sheet, 0.0, 1000);
    all_feet.insert(all_feet.end(), feet.begin(), feet.end());
    int points_in_view = 0, hit = 0;
    for (const sim::EastNorth& foot : feet) {
      if (!is_border_in_view(map, foot)) continue;
      ++points_in_view;
      hit += nearest_km(foot, found) < near_km(foot);
    }
    std::printf("%s: %.0f %% of it found\n", sheet.name.c_str(), 100.0 * hit / std::max(1, points_in_view));
    EXPECT_GT(hit, 0.6 * points_in_view) << sheet.name;
  }
  for (const Curtain& curtain : curtains) {
    int near = 0;
    for (const CurtainPoint& p : curtain.points) near += nearest_km(p.foot_km, all_feet) < near_km(p.foot_km);
    std::printf("a curtain of %.0f km: %.0f %% of it is of a curve\n", curtain.length_km,
                100.0 * near / curtain.points.size());
    EXPECT_GT(near, 0.5 * curtain.points.size());
  }

  // Refined by beams.
  const FitResult refined =
      fit_curtains(camera(), {photo}, ridges(curtains, "curtain_"), ridges(faint, "faint_"), FitOptions());
  for (const CurtainStep& step : refined.curtain_steps)
    std::printf("%s: chi2 %.0f\n", curtain_step_in_words(step).c_str(), step.chi2);
  std::printf("chi2 %.0f at the start, %.0f at the end, dof %d\n", refined.chi2_initial, refined.chi2,
              refined.dof);
  EXPECT_LT(refined.chi2, refined.chi2_initial);
  EXPECT_EQ(refined.best.sheets.size(), 3u);
  const CurveLight curves(refined.best.sheets, raster, kSmooth_km);
  const Figures of_curves = figures("curves", raster, in_view, curves.flux, curves.flux_ln_energy, light);
  EXPECT_LE(of_curves.distance_median, 0.02);
  EXPECT_LE(of_curves.ln_energy_median, 0.06);
}

}  // namespace
}  // namespace vegard::fit::curtains_test
