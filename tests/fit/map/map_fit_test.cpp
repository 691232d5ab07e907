#include "fit/map/map_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <vector>

#include "fit/map/curtains.h"
#include "fit/map/map_verdicts.h"
#include "sim/light/tables/emission_tables.h"
#include "sim/render/ground/sight_lines.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/scene/table/photo_scene.h"
#include "tests/support/expect_error.h"
#include "tests/support/two_stations.h"

namespace vegard::fit::map_fit_test {
namespace {

const char* const kCamera =
    "[site]\nlatitude_deg = 67.0\n[field]\ninclination_deg = 78.0\n[camera]\nwidth = 150\nheight = "
    "100\nhfov_deg = 66\n"
    "elevation_deg = 33\n[emission]\nflux_law = \"linear\"\n[sensor]\ngain_per_kilorayleigh = 0.01\n"
    "[sky]\nlevel = [0.003, 0.006, 0.008]\n";

/// A band that is no sine, rendered by the march through footprints, which shares no code with the map's sums
/// but the tables and the geometry of feet.
sim::Scene with_band() {
  return sim::parse_scene(
      std::string(kCamera) +
          "[[footprint]]\nname = \"band\"\nsource = \"spline\"\ncenter_km = [0, 190]\nsize_km = [420, 120]\n"
          "cell_km = 1.0\nwidth_km = 3.0\nenergy_kev = 4.0\nenergy_flux_mw_m2 = 12.0\n"
          "east_km = [-200, -110, -30, 25, 60, 130, 200]\nnorth_km = [15, 5, -18, 12, -10, 6, -5]\n",
      "scene");
}

/// The same without what is to be found.
sim::Scene without_band() { return sim::parse_scene(kCamera, "scene"); }

const Photo& photo() {
  static const Photo made = tests::photo_of(with_band(), 0.0015, 5);
  return made;
}

MapOptions quick() {
  MapOptions options;
  options.replicates = 3;
  options.sparsity = 4.0;
  options.threads = 2;
  return options;
}

const MapResult& result() {
  static const MapResult mapped = map_photos(without_band(), {photo()}, quick());
  return mapped;
}

TEST(MapFit, ExplainsThePicture) {
  // Noise of seed 5 and 2 % of the light: the sum of squares is that of the values, give or take what the
  // noise's estimate from the picture itself is off by.
  EXPECT_GT(result().chi2_per_value(), 0.5);
  EXPECT_LT(result().chi2_per_value(), 1.5);
  EXPECT_GT(result().chi2_without_aurora, 8.0 * result().chi2);
}

TEST(MapFit, FindsTheCurtainWhereItIs) {
  const std::vector<Curtain> curtains = find_curtains(result());
  ASSERT_FALSE(curtains.empty());
  EXPECT_GT(curtains[0].length_km, 150.0);
  // Points of the curve that the band follows, which lie in view: 2 % of the distance is 4 km.
  for (const sim::EastNorth truth : {sim::EastNorth{-30.0, 172.0}, {25.0, 202.0}, {60.0, 180.0}}) {
    double nearest = 1e9, energy = 0.0;
    for (const CurtainPoint& p : curtains[0].points) {
      const double d = std::hypot(p.foot_km.east - truth.east, p.foot_km.north - truth.north);
      if (d < nearest) {
        nearest = d;
        energy = p.energy_kev.value;
      }
    }
    EXPECT_LT(nearest, 4.0 + 2.5) << truth.east;  // points stand 5 km apart
    EXPECT_NEAR(std::log(energy / 4.0), 0.0, 0.1) << truth.east;
  }
}

TEST(MapFit, HasTheFluxOfTheBand) {
  // Of all that falls on the ground in view of the camera: 12 mW m^-2 times sqrt(2 pi) 3 km along the curve.
  // The sensor's gain is the scene's own. Of stretches near the edges of the view some is cut.
  double watts = 0.0;
  for (int c = 0; c < result().grid.cells(); ++c) {
    const sim::EastNorth m = result().grid.middle_km(c);
    if (std::abs(m.east) < 60.0 && std::abs(m.north - 190.0) < 40.0)
      watts += result().cells[c].flux_mw_m2 * result().grid.area_km2(c);
  }
  const double per_km = 12.0 * std::sqrt(2.0 * 3.141592653589793) * 3.0;
  // The curve is 160 km long from east = -60 to 60, by its chords, a little more by its bends.
  double length = 0.0;
  const double x[] = {-60.0, -30.0, 25.0, 60.0}, y[] = {-7.0, -18.0, 12.0, -10.0};
  for (int i = 0; i < 3; ++i) length += std::hypot(x[i + 1] - x[i], y[i + 1] - y[i]);
  EXPECT_NEAR(watts / (per_km * length), 1.05, 0.1);
}

TEST(MapFit, IsTheSameForAnyNumberOfThreads) {
  MapOptions one = quick();
  one.threads = 1;
  one.replicates = 1;
  const MapResult other = map_photos(without_band(), {photo()}, one);
  EXPECT_EQ(other.map, result().map);
  ASSERT_EQ(other.replicates.size(), 1u);
  for (std::size_t c = 0; c < other.cells.size(); ++c)
    ASSERT_EQ(other.replicates[0][c].flux_mw_m2, result().replicates[0][c].flux_mw_m2);
}

TEST(MapFit, SaysWhatIsToBeBelieved) {
  const std::vector<QuantityVerdict> verdicts = map_verdicts(result(), find_curtains(result()));
  ASSERT_EQ(verdicts.size(), 5u);
  EXPECT_EQ(verdicts[0].trust, Trust::good) << verdicts[0].value;
  EXPECT_EQ(verdicts[2].trust, Trust::good) << verdicts[2].reason;
  EXPECT_EQ(verdicts[4].trust, Trust::doubtful);  // the sensor is not calibrated
  EXPECT_NE(verdicts[4].reason.find("relative"), std::string::npos);
}

TEST(MapFit, RefusesAPictureWithoutLight) {
  sim::Scene dark = without_band();
  const Photo noise = tests::photo_of(dark, 0.0015, 6);
  const std::string text =
      tests::expect_error(sim::ErrorKind::unreadable_input, [&] { map_photos(dark, {noise}, quick()); });
  EXPECT_NE(text.find("noise"), std::string::npos) << text;
}

TEST(MapFit, RefusesACameraThatLooksDown) {
  sim::Scene down = without_band();
  down.camera.elevation_deg = -60.0;
  const std::string text =
      tests::expect_error(sim::ErrorKind::scene, [&] { map_photos(down, {photo()}, quick()); });
  EXPECT_NE(text.find("the sky"), std::string::npos) << text;
}

TEST(MapFit, RefusesAnotherSize) {
  sim::Scene other = without_band();
  other.camera.width = 151;
  const std::string text =
      tests::expect_error(sim::ErrorKind::scene, [&] { map_photos(other, {photo()}, quick()); });
  EXPECT_NE(text.find("151 x 100"), std::string::npos) << text;
}

TEST(MapFit, RefusesStationsWithoutACommonVolume) {
  sim::Scene two = without_band();
  two.fit.photos = {{"here", "a.png", "", "", {}, 0},
                    {"there", "b.png", "", "", {{"site.latitude_deg", "-20.0"}}, 0}};
  const std::string text = tests::expect_error(sim::ErrorKind::scene, [&] {
    map_photos(two, {photo(), photo()}, quick());
  });
  EXPECT_NE(text.find("two"), std::string::npos) << text;
}

TEST(MapFit, RefusesAFieldForEachPhotograph) {
  sim::Scene two = without_band();
  two.fit.photos = {{"here", "a.png", "", "", {}, 0},
                    {"there", "b.png", "", "", {{"field.inclination_deg", "70.0"}}, 0}};
  const std::string text = tests::expect_error(sim::ErrorKind::scene, [&] {
    map_photos(two, {photo(), photo()}, quick());
  });
  EXPECT_NE(text.find("magnetic field"), std::string::npos) << text;
}

TEST(MapNumbers, AreThoseOfCameraAndAirWithTheirPriors) {
  const sim::Scene scene = sim::parse_scene(
      std::string(kCamera) +
          "[air]\nmodel = \"standard\"\n[[sheet]]\nname = \"s\"\n[[fit.photo]]\nname = \"a\"\nfile = "
          "\"a.png\"\n[[fit.photo]]\nname = "
          "\"b\"\nfile = \"b.png\"\nset.camera.elevation_deg = 41.0\n"
          "[fit]\nfree = [\"sheet.s.energy_kev\", { path = \"camera.elevation_deg\", photo = \"b\", prior = "
          "{ "
          "mean = 41.0, sigma = 0.25 } }, { path = \"air.aerosol_optical_depth\", prior = { mean = 0.1, "
          "sigma = "
          "0.05 } }]\n",
      "scene");
  const std::vector<MapNumber> numbers = map_numbers(scene);
  ASSERT_EQ(numbers.size(), 2u);
  EXPECT_EQ(numbers[0].label, "camera.elevation_deg of b");
  EXPECT_EQ(numbers[0].value, 41.0);
  EXPECT_EQ(numbers[0].error, 0.25);
  const sim::Scene other = scene_with(scene, numbers, {41.5, 0.2});
  EXPECT_EQ(other.air.aerosol_optical_depth, 0.2);
  EXPECT_EQ(other.camera.elevation_deg, scene.camera.elevation_deg);
  EXPECT_EQ(sim::scene_of_photo(other, other.fit.photos[1]).camera.elevation_deg, 41.5);
}

TEST(MapNumbers, ModesOfTheTablesAreDrawnAsNumbers) {
  sim::Scene scene = sim::parse_scene(kCamera, "scene");
  const std::vector<MapNumber> modes = mode_numbers(scene);
  ASSERT_EQ(static_cast<int>(modes.size()), sim::emission_tables(scene).modes().count());
  ASSERT_GT(modes.size(), 2u);
  std::vector<double> values(modes.size(), 0.0);
  values[1] = -1.5;
  EXPECT_EQ(scene_with(scene, modes, values).emission.modes, values);
  scene.emission.uncertainty = sim::TablesUncertainty::none;
  EXPECT_TRUE(mode_numbers(scene).empty());
}

TEST(MapNumbers, NeedPriors) {
  const sim::Scene scene =
      sim::parse_scene(std::string(kCamera) + "[fit]\nfree = [\"camera.roll_deg\"]\n", "scene");
  const std::string text = tests::expect_error(sim::ErrorKind::scene, [&] { map_numbers(scene); });
  EXPECT_NE(text.find("camera.roll_deg"), std::string::npos) << text;
  EXPECT_NE(text.find("prior"), std::string::npos) << text;
}

TEST(MapNumbers, HavePriorsAboutTheScenesOwnValues) {
  const auto refused = [](const std::string& free) {
    const sim::Scene scene =
        sim::parse_scene(std::string(kCamera) +
                             "[[fit.photo]]\nname = \"a\"\nfile = \"a.png\"\n[fit]\nfree = [" + free + "]\n",
                         "scene");
    return tests::expect_error(sim::ErrorKind::scene, [&] { map_numbers(scene); });
  };
  const std::string about =
      refused("{ path = \"camera.elevation_deg\", prior = { mean = 30.0, sigma = 0.5 } }");
  EXPECT_TRUE(tests::has_facts(about, "30 | 33")) << about;
  const std::string field =
      refused("{ path = \"field.inclination_deg\", photo = \"a\", prior = { mean = 78.0, sigma = 0.5 } }");
  EXPECT_NE(field.find("one field"), std::string::npos) << field;
}

TEST(MapFit, ErrorBarsHoldWhatIsNotKnownOfTheCamera) {
  // A border at 105 km and 190 km away is seen 28 degrees high; half a degree more or less moves it by
  // 0.5 deg / (sin cos) of 28 degrees, 2.1 % or 4.0 km. Four draws (the scene's seed): their root mean square
  // lies between 0.4 and 1.7 times that with 97 % probability each side (chi2 of four).
  sim::Scene scene = without_band();
  scene.fit.free = {{"camera.elevation_deg",
                     {},
                     {},
                     {},
                     sim::Prior{33.0, 0.5, sim::PriorLaw::normal},
                     0,
                     "",
                     sim::FreeScale::of_table,
                     ""}};
  MapOptions options = quick();
  options.replicates = 4;
  const MapResult mapped = map_photos(scene, {photo()}, options);
  EXPECT_EQ(mapped.map, result().map);
  std::vector<double> errors;
  for (const Curtain& curtain : find_curtains(mapped))
    for (const CurtainPoint& p : curtain.points)
      if (std::abs(p.foot_km.east) < 60.0) errors.push_back(p.distance_error_km);
  ASSERT_FALSE(errors.empty());
  std::nth_element(errors.begin(), errors.begin() + errors.size() / 2, errors.end());
  EXPECT_GT(errors[errors.size() / 2], 0.4 * 4.0);
  EXPECT_LT(errors[errors.size() / 2], 1.7 * 4.0);
}

TEST(FindCurtains, TakesNoRidgeWhereTheViewEnds) {
  // The view ends in the middle of the band: beyond 185 km in the north no pixel is used.
  constexpr double kEnd_km = 185.0, kBorder_km = 105.0;
  MapResult cut = result();
  MappedPhoto& seen = cut.photos[0];
  for (double east = -400.0; east <= 400.0; east += 1.0)
    for (double north = kEnd_km; north <= 400.0; north += 1.0) {
      double x = 0.0, y = 0.0;
      if (!sim::pixel_over_foot(seen.scene, cut.scene.site, {east, north}, kBorder_km, x, y)) continue;
      const int column = static_cast<int>((x - seen.film.x0_px) / seen.film.cell_width_px);
      const int row = static_cast<int>((y - seen.film.y0_px) / seen.film.cell_height_px);
      for (int c = 0; c < 3; ++c)
        seen.sigma[(static_cast<std::size_t>(row) * seen.film.columns + column) * 3 + c] = 0.0f;
    }
  // A film's cell sees some 2 km of the ground there.
  double farthest = 0.0, before = 0.0;
  for (const Curtain& curtain : find_curtains(result()))
    for (const CurtainPoint& p : curtain.points) before = std::max(before, p.foot_km.north);
  for (const Curtain& curtain : find_curtains(cut))
    for (const CurtainPoint& p : curtain.points) farthest = std::max(farthest, p.foot_km.north);
  EXPECT_GT(before, 195.0);
  EXPECT_GT(farthest, 0.0);
  EXPECT_LT(farthest, kEnd_km - 2.0);
}

TEST(MapFit, StopsWhereItIsTold) {
  const std::atomic<bool> stop{true};
  MapOptions options = quick();
  options.stop = &stop;
  const MapResult cut = map_photos(without_band(), {photo()}, options);
  EXPECT_TRUE(cut.interrupted);
  EXPECT_TRUE(cut.replicates.empty());
}

TEST(LowerBorder, SinksWithTheEnergy) {
  const sim::Scene scene = without_band();
  const LowerBorder low = lower_border(scene, 1.0), high = lower_border(scene, 6.0);
  EXPECT_GT(low.altitude_km, high.altitude_km + 8.0);
  // Its derivative against a difference over a step that the profile's rows of 0.25 km resolve.
  const double difference =
      (lower_border(scene, 4.4).altitude_km - lower_border(scene, 3.6).altitude_km) / std::log(4.4 / 3.6);
  EXPECT_NEAR(lower_border(scene, 4.0).by_ln_energy, difference, 0.1 * std::abs(difference));
}

}  // namespace
}  // namespace vegard::fit::map_fit_test
