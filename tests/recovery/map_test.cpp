// Maps of pictures that another program made of curtains of free shape, against what is true of them
// (docs/validation.md, "Maps of precipitation"). They are too large to ship: absent, these tests are skipped.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "fit/map/curtains/curtains.h"
#include "fit/map/curtains/map_verdicts.h"
#include "fit/map/map_fit.h"
#include "fit/map/raster_grid.h"
#include "fit/photo/photo.h"
#include "sim/base/number/constants.h"
#include "sim/base/picture/fits_io.h"
#include "sim/scene/structs/scene.h"
#include "tests/recovery/independent_picture.h"

namespace vegard::fit::map_test {
namespace {

namespace fs = std::filesystem;

/// Energy flux and energy on the ground, as the other program had them: [row * 600 + column], from -599 km.
struct Truth {
  static constexpr int kSide = 600;
  static constexpr double kFirst_km = -599.0, kStep_km = 2.0;
  std::vector<double> flux, flux_ln_energy;

  explicit Truth(const fs::path& file) : flux(kSide * kSide), flux_ln_energy(kSide * kSide) {
    std::ifstream stream(file, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(stream)), {});
    const sim::FitsImage fits = sim::read_fits_image(bytes, file.string());
    for (int row = 0; row < kSide; ++row)
      for (int column = 0; column < kSide; ++column) {
        const std::size_t i = static_cast<std::size_t>(row) * kSide + column;
        flux[i] = fits.image.at(column, kSide - 1 - row, 0);
        flux_ln_energy[i] = flux[i] * std::log(std::max(1e-3f, fits.image.at(column, kSide - 1 - row, 1)));
      }
  }
};

RasterGrid truth_raster() {
  RasterGrid raster;
  raster.west_km = raster.south_km = Truth::kFirst_km;
  raster.step_km = Truth::kStep_km;
  raster.columns = raster.rows = Truth::kSide;
  return raster;
}

/// Camera `which` of the truth; cameras away from the origin stand on the sphere, and look along the axes of
/// the origin's frame, whose north is turned by the meridians' convergence.
sim::Scene scene_of(const nlohmann::json& truth, int which) {
  sim::Scene scene;
  scene.emission.tables = "glow";  // those of the program that made the pictures, as is
  scene.emission.flux_law = sim::FluxLaw::linear;
  scene.site.latitude_deg = truth.at("site").at("latitude_deg");
  scene.field.inclination_deg = truth.at("field").at("inclination_deg");
  scene.field.declination_deg = truth.at("field").at("declination_deg");
  const nlohmann::json& camera = truth.at("cameras").at(static_cast<std::size_t>(which));
  scene.camera.width = camera.at("width");
  scene.camera.height = camera.at("height");
  scene.camera.azimuth_deg = camera.at("azimuth_deg");
  scene.camera.elevation_deg = camera.at("elevation_deg");
  scene.camera.roll_deg = camera.at("roll_deg");
  double px_per_deg = 0.0;
  if (camera.at("model") == "pinhole") {
    scene.camera.hfov_deg = camera.at("hfov_deg");
    px_per_deg = scene.camera.width / scene.camera.hfov_deg;
  } else {
    scene.camera.model = sim::LensModel::equidistant;
    scene.camera.focal_px = camera.at("focal_px");
    px_per_deg = scene.camera.focal_px * sim::kRadiansPerDegree;
  }
  for (std::size_t line = 0; line < 3; ++line)
    scene.blur.width_deg[line] = truth.at("photo").at("blur_px").at(line).get<double>() / px_per_deg;
  scene.sensor.gain_per_kilorayleigh =
      camera.at("gain_per_rayleigh").get<double>() * truth.at("photo").at("exposure").get<double>();
  const double east = camera.at("position_km").at(0), north = camera.at("position_km").at(1);
  if (east != 0.0 || north != 0.0) {
    const double here = scene.site.latitude_deg * sim::kRadiansPerDegree;
    const double up = std::sqrt(sim::kEarthRadiusKm * sim::kEarthRadiusKm - east * east - north * north);
    const double out = std::cos(here) * up - std::sin(here) * north,
                 pole = std::sin(here) * up + std::cos(here) * north;
    scene.site.latitude_deg = std::asin(pole / sim::kEarthRadiusKm) / sim::kRadiansPerDegree;
    scene.site.longitude_deg = std::atan2(east, out) / sim::kRadiansPerDegree;
    scene.camera.azimuth_deg +=
        scene.site.longitude_deg * std::sin(scene.site.latitude_deg * sim::kRadiansPerDegree);
  }
  return scene;
}

Photo photo_of(const fs::path& file, const nlohmann::json& camera) {
  Photo photo = read_photo(file.string(), Decoding::srgb);
  if (camera.at("model") == "pinhole") return photo;
  const double lowest_deg = camera.at("lowest_deg").get<double>() + 0.7;
  const double radius = (90.0 - lowest_deg) * sim::kRadiansPerDegree * camera.at("focal_px").get<double>();
  for (int y = 0; y < photo.linear.height; ++y)
    for (int x = 0; x < photo.linear.width; ++x)
      if (std::hypot(x + 0.5 - 0.5 * photo.linear.width, y + 0.5 - 0.5 * photo.linear.height) > radius)
        for (int c = 0; c < 3; ++c) photo.usable[photo.linear.index(x, y, c)] = 0;
  return photo;
}

double quantile(std::vector<double> values, double share) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * (values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

struct Score {
  double distance_median = 0.0, distance_nine_in_ten = 0.0;  ///< relative errors
  double ln_energy_median = 0.0, ln_energy_scatter = 0.0;
  double correlation = 0.0;
  double held = 0.0;  ///< share of azimuths at which the 68 % interval of ln E0 holds the truth
  double chi2_per_value = 0.0;
};

/// Degree by degree of azimuth, where the true curtain's lower border is in view and at least a quarter as
/// bright as its median: the brightest place of the map and of the truth along the azimuth, both smoothed by
/// 2 km.
Score score(const MapResult& result, const Truth& truth, const nlohmann::json& camera) {
  const RasterGrid raster = truth_raster();
  const RasterFlux found = raster_flux(result, raster, result.cells);
  const std::vector<std::uint8_t> in_view = places_in_view(result, raster);
  const std::vector<CellError> errors = cell_errors(result);
  std::vector<double> error;
  for (std::size_t c = 0; c < errors.size(); ++c)
    error.push_back(result.cells[c].flux_mw_m2 * errors[c].ln_energy);
  const std::vector<double> of_error = rasterised(result, raster, error);
  std::vector<double> true_flux = truth.flux, true_ln = truth.flux_ln_energy;
  for (std::size_t i = 0; i < in_view.size(); ++i)
    if (in_view[i] == 0) true_flux[i] = true_ln[i] = 0.0;
  const auto smooth = [&](const std::vector<double>& values, double km) {
    return smoothed_raster(raster, values, km / raster.step_km);
  };
  const std::vector<double> q = smooth(found.flux, 2.0), l = smooth(found.flux_ln_energy, 2.0);
  const std::vector<double> e = smooth(of_error, 2.0);
  const std::vector<double> tq = smooth(true_flux, 2.0), tl = smooth(true_ln, 2.0);
  struct Along {
    double distance = 0.0, true_distance = 0.0, brightness = 0.0, ln = 0.0, true_ln = 0.0, error = 0.0;
  };
  std::vector<Along> all;
  const double half =
      camera.at("model") == "pinhole" ? 0.5 * camera.at("hfov_deg").get<double>() - 1.0 : 181.0;
  for (int azimuth = 0; azimuth < 360; ++azimuth) {
    const double off = std::remainder(azimuth - camera.at("azimuth_deg").get<double>(), 360.0);
    if (std::abs(off) > half) continue;
    Along a;
    double most = 0.0;
    for (double d = 40.0; d < 590.0; d += 0.5) {
      const double east = d * std::sin(azimuth * sim::kRadiansPerDegree);
      const double north = d * std::cos(azimuth * sim::kRadiansPerDegree);
      const auto column = static_cast<int>(std::lround((east - raster.west_km) / raster.step_km));
      const auto row = static_cast<int>(std::lround((north - raster.south_km) / raster.step_km));
      if (column < 0 || row < 0 || column >= raster.columns || row >= raster.rows) continue;
      const std::size_t i = static_cast<std::size_t>(row) * raster.columns + column;
      if (in_view[i] == 0) continue;
      if (q[i] > most) {
        most = q[i];
        a.distance = d;
        a.ln = l[i] / q[i];
        a.error = e[i] / q[i];
      }
      if (tq[i] > a.brightness) {
        a.brightness = tq[i];
        a.true_distance = d;
        a.true_ln = tl[i] / tq[i];
      }
    }
    if (a.brightness > 0.0) all.push_back(a);
  }
  std::vector<double> brightness;
  double brightest = 0.0;
  for (const Along& a : all) brightest = std::max(brightest, a.brightness);
  for (const Along& a : all)
    if (a.brightness > 0.02 * brightest) brightness.push_back(a.brightness);
  const double quarter = 0.25 * quantile(brightness, 0.5);
  std::vector<double> distance, ln, deviation;
  int held = 0;
  for (const Along& a : all) {
    if (a.brightness < quarter) continue;
    distance.push_back(std::abs(a.distance - a.true_distance) / a.true_distance);
    if (distance.back() > 0.1) continue;  // another curtain's energy
    ln.push_back(a.ln - a.true_ln);
    if (std::abs(ln.back()) <= a.error) ++held;
  }
  Score s;
  s.distance_median = quantile(distance, 0.5);
  s.distance_nine_in_ten = quantile(distance, 0.9);
  std::vector<double> size;
  for (const double x : ln) size.push_back(std::abs(x));
  s.ln_energy_median = quantile(size, 0.5);
  const double middle = quantile(ln, 0.5);
  for (const double x : ln) deviation.push_back(std::abs(x - middle));
  s.ln_energy_scatter = quantile(deviation, 0.5) * 1.4826;
  s.held = static_cast<double>(held) / ln.size();
  const std::vector<double> a = smooth(found.flux, 6.0), b = smooth(true_flux, 6.0);
  double n = 0.0, sa = 0.0, sb = 0.0, saa = 0.0, sbb = 0.0, sab = 0.0;
  for (std::size_t i = 0; i < in_view.size(); ++i) {
    if (in_view[i] == 0) continue;
    n += 1.0;
    sa += a[i];
    sb += b[i];
    saa += a[i] * a[i];
    sbb += b[i] * b[i];
    sab += a[i] * b[i];
  }
  s.correlation = (sab - sa * sb / n) / std::sqrt((saa - sa * sa / n) * (sbb - sb * sb / n));
  s.chi2_per_value = result.chi2_per_value();
  std::printf(
      "distance %.2f %% in the median, %.1f %% for nine in ten; ln E0 %.1f %%, scatter %.1f %%, held %.0f "
      "%%; "
      "correlation %.3f; chi2 per value %.2f\n",
      100.0 * s.distance_median, 100.0 * s.distance_nine_in_ten, 100.0 * s.ln_energy_median,
      100.0 * s.ln_energy_scatter, 100.0 * s.held, s.correlation, s.chi2_per_value);
  return s;
}

class MapOfIndependentPicture : public testing::TestWithParam<const char*> {};

TEST_P(MapOfIndependentPicture, HasTheCurtainsPlaceAndEnergy) {
  const std::optional<fs::path> folder = photographs();
  const std::string name = GetParam();
  if (!folder || !fs::exists(*folder / (name + ".precipitation.fits"))) GTEST_SKIP() << "no photographs here";
  const nlohmann::json truth = read_json(*folder / (name + ".truth.json"));
  const nlohmann::json& camera = truth.at("cameras").at(0);
  const std::string picture = fs::exists(*folder / (name + ".jpg")) ? name : name + "a";
  const MapResult result =
      map_photos(scene_of(truth, 0), {photo_of(*folder / (picture + ".jpg"), camera)}, MapOptions());
  const Score s = score(result, Truth(*folder / (name + ".precipitation.fits")), camera);
  // The figures that the map was built to reach.
  EXPECT_LE(s.distance_median, 0.02);
  EXPECT_LE(s.ln_energy_median, 0.06);
  EXPECT_LE(s.ln_energy_scatter, 0.10);
  EXPECT_GE(s.correlation, 0.75);
  EXPECT_LE(s.chi2_per_value, 1.5);
}

INSTANTIATE_TEST_SUITE_P(MapRecovery, MapOfIndependentPicture,
                         testing::Values("w000", "w001", "w002", "w003"));

/// Of the points of all curtains of a map, how many hold the truth in one and in two standard errors.
struct Held {
  int points = 0, lost = 0;  ///< lost: no true curtain is near
  std::array<int, 2> distance{}, energy{};
  std::vector<double> ln_energy_off;

  double share(const std::array<int, 2>& of, int errors) const {
    return points > 0 ? static_cast<double>(of[static_cast<std::size_t>(errors - 1)]) / points : 0.0;
  }
};

/// The truth of a point is the true curtain that is nearest along its azimuth.
Held held_by_curtains(const MapResult& result, const Truth& truth) {
  constexpr double kStep_km = 0.25, kReach = 0.25, kFaint = 0.1;
  const RasterGrid raster = truth_raster();
  const std::vector<double> flux = smoothed_raster(raster, truth.flux, 1.0),
                            by_energy = smoothed_raster(raster, truth.flux_ln_energy, 1.0);
  const auto at = [&](const std::vector<double>& plane, double azimuth_deg, double distance_km) {
    const double angle = azimuth_deg * sim::kRadiansPerDegree;
    const double x = (distance_km * std::sin(angle) - raster.west_km) / raster.step_km,
                 y = (distance_km * std::cos(angle) - raster.south_km) / raster.step_km;
    const int column = static_cast<int>(std::floor(x)), row = static_cast<int>(std::floor(y));
    if (column < 0 || row < 0 || column + 1 >= raster.columns || row + 1 >= raster.rows) return 0.0;
    const double s = x - column, t = y - row;
    const double* p = &plane[static_cast<std::size_t>(row) * raster.columns + column];
    return (1.0 - t) * ((1.0 - s) * p[0] + s * p[1]) +
           t * ((1.0 - s) * p[raster.columns] + s * p[raster.columns + 1]);
  };
  const double brightest = *std::max_element(flux.begin(), flux.end());
  Held held;
  for (const Curtain& curtain : find_curtains(result))
    for (const CurtainPoint& point : curtain.points) {
      if (!point.border_in_view || point.at_edge) continue;
      ++held.points;
      double nearest_km = -1.0;
      for (double d = (1.0 - kReach) * point.distance_km; d < (1.0 + kReach) * point.distance_km;
           d += kStep_km) {
        const double here = at(flux, point.azimuth_deg, d);
        if (here > kFaint * brightest && here >= at(flux, point.azimuth_deg, d - kStep_km) &&
            here > at(flux, point.azimuth_deg, d + kStep_km) &&
            std::abs(d - point.distance_km) < std::abs(nearest_km - point.distance_km))
          nearest_km = d;
      }
      if (nearest_km < 0.0) {
        ++held.lost;
        continue;
      }
      const double off = std::log(point.energy_kev.value) - at(by_energy, point.azimuth_deg, nearest_km) /
                                                                at(flux, point.azimuth_deg, nearest_km);
      held.ln_energy_off.push_back(off);
      for (int errors = 1; errors <= 2; ++errors) {
        const auto i = static_cast<std::size_t>(errors - 1);
        if (std::abs(nearest_km - point.distance_km) <= errors * point.distance_error_km) ++held.distance[i];
        if (std::abs(off) <= errors * point.energy_kev.error / point.energy_kev.value) ++held.energy[i];
      }
    }
  return held;
}

/// Whether a quantity's verdict is good.
bool is_good(const std::vector<QuantityVerdict>& verdicts, const std::string& begins) {
  return std::any_of(verdicts.begin(), verdicts.end(), [&](const QuantityVerdict& verdict) {
    return verdict.quantity.compare(0, begins.size(), begins) == 0 && verdict.trust == Trust::good;
  });
}

/// The light of these pictures is not that of the program's tables, whose uncertainty must hold the
/// difference.
TEST_P(MapOfIndependentPicture, HoldsTheTruthWithTheProgramsOwnTables) {
  const std::optional<fs::path> folder = photographs();
  const std::string name = GetParam();
  if (!folder || !fs::exists(*folder / (name + ".precipitation.fits"))) GTEST_SKIP() << "no photographs here";
  const nlohmann::json truth = read_json(*folder / (name + ".truth.json"));
  sim::Scene scene = scene_of(truth, 0);
  scene.emission.tables = sim::Scene().emission.tables;
  scene.emission.flux_law = sim::Scene().emission.flux_law;
  const std::string picture = fs::exists(*folder / (name + ".jpg")) ? name : name + "a";
  const MapResult result =
      map_photos(scene, {photo_of(*folder / (picture + ".jpg"), truth.at("cameras").at(0))}, MapOptions());
  const Held held = held_by_curtains(result, Truth(*folder / (name + ".precipitation.fits")));
  const std::vector<QuantityVerdict> verdicts = map_verdicts(result, find_curtains(result));
  if (held.ln_energy_off.empty()) {  // What is not claimed is not wrong.
    EXPECT_FALSE(is_good(verdicts, "distance") || is_good(verdicts, "energy"));
    return;
  }
  for (const QuantityVerdict& verdict : verdicts)
    std::printf("%s: %s (%s)\n", verdict.quantity.c_str(), verdict.value.c_str(), trust_name(verdict.trust));
  std::printf(
      "%d points, %d lost; distance %.0f, %.0f %%; ln E0 %.0f, %.0f %%, off %.2f in the median; chi2 per "
      "value %.2f\n",
      held.points, held.lost, 100.0 * held.share(held.distance, 1), 100.0 * held.share(held.distance, 2),
      100.0 * held.share(held.energy, 1), 100.0 * held.share(held.energy, 2),
      quantile(held.ln_energy_off, 0.5), result.chi2_per_value());
  // Of a normal distribution 95 % are within two standard errors; curtains have some ten independent points.
  if (is_good(verdicts, "distance")) {
    EXPECT_GE(held.share(held.distance, 2), 0.88);
  }
  if (is_good(verdicts, "energy")) {
    EXPECT_GE(held.share(held.energy, 2), 0.88);
  }
}

TEST(MapRecovery, OfTwoStationsIsNearerTheTruth) {
  const std::optional<fs::path> folder = photographs();
  if (!folder || !fs::exists(*folder / "w003.precipitation.fits")) GTEST_SKIP() << "no photographs here";
  const nlohmann::json truth = read_json(*folder / "w003.truth.json");
  sim::Scene scene = scene_of(truth, 0);
  const sim::Scene there = scene_of(truth, 1);
  scene.fit.photos = {{"a", "w003a.jpg", "", "", {}, 0},
                      {"b",
                       "w003b.jpg",
                       "",
                       "",
                       {{"site.latitude_deg", std::to_string(there.site.latitude_deg)},
                        {"site.longitude_deg", std::to_string(there.site.longitude_deg)},
                        {"camera.azimuth_deg", std::to_string(there.camera.azimuth_deg)}},
                       0}};
  const nlohmann::json& camera = truth.at("cameras").at(0);
  MapOptions options;
  options.replicates = 8;
  const MapResult result = map_photos(
      scene, {photo_of(*folder / "w003a.jpg", camera), photo_of(*folder / "w003b.jpg", camera)}, options);
  const Score s = score(result, Truth(*folder / "w003.precipitation.fits"), camera);
  EXPECT_GE(s.correlation, 0.9);
  EXPECT_LE(s.distance_median, 0.02);
}

}  // namespace
}  // namespace vegard::fit::map_test
