#include "fit/map/map_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <random>
#include <vector>

#include "fit/map/curtains/curtains.h"
#include "fit/map/curtains/map_verdicts.h"
#include "fit/map/lower_border.h"
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

/// With tables that are taken as exact, as those are that the picture is made with.
sim::Scene with_exact_tables() {
  sim::Scene scene = without_band();
  scene.emission.uncertainty = sim::TablesUncertainty::none;
  return scene;
}

const MapResult& result() {
  static const MapResult mapped = map_photos(with_exact_tables(), {photo()}, quick());
  return mapped;
}

/// With tables that are taken as uncertain; coarse, as it is slower.
const MapResult& learnt_result() {
  static const MapResult mapped = [] {
    MapOptions options = quick();
    options.pixels_per_cell = 2;
    return map_photos(without_band(), {photo()}, options);
  }();
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
    double nearest = 1e9;
    double energy = 0.0;
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

// The picture is made with the light of another model, GLOW.
TEST(MapFit, LearnsTheLightFromThePicture) {
  sim::Scene other = with_band();
  other.emission.tables = "glow";
  const Photo photo = tests::photo_of(other, 0.0015, 5);
  MapOptions options = quick();
  options.replicates = 0;
  const MapResult by_tables = map_photos(with_exact_tables(), {photo}, options),
                  learnt = map_photos(without_band(), {photo}, options);
  sim::Scene right = with_exact_tables();
  right.emission.tables = "glow";
  const MapResult known = map_photos(right, {photo}, options);
  EXPECT_TRUE(by_tables.scene.emission.modes.empty());
  EXPECT_GT(by_tables.chi2 - known.chi2, 0.05 * known.chi2);  // else there is nothing to learn
  EXPECT_LT(learnt.chi2 - known.chi2, 0.1 * (by_tables.chi2 - known.chi2));
  for (const double mode : learnt.scene.emission.modes) EXPECT_LT(std::abs(mode), 2.0);
}

TEST(MapFit, OfUncertainTablesHasTheTruthInItsErrorBars) {
  const std::vector<Curtain> curtains = find_curtains(learnt_result());
  ASSERT_FALSE(curtains.empty());
  int points = 0, held = 0;
  for (const CurtainPoint& p : curtains[0].points) {
    ++points;
    held += std::abs(p.energy_kev.value - 4.0) < 2.0 * p.energy_kev.error ? 1 : 0;
    EXPECT_LT(p.energy_kev.error, 0.6 * p.energy_kev.value);
  }
  // 95 % if errors were independent and normal; those along a curtain are alike, and three replicates tell
  // an error to 40 %.
  EXPECT_GT(held, 0.7 * points);
}

// The picture's light is that of the tables: nothing that it asks of them is beyond its error.
TEST(MapFit, AsksNothingOfTablesThatAreRight) {
  const std::vector<TablesCorrection> asked =
      map_corrections(learnt_result(), find_curtains(learnt_result()));
  ASSERT_FALSE(asked.empty());  // a picture tells a ratio of lines better than half of the tables' error
  for (const TablesCorrection& c : asked) {
    EXPECT_LT(std::abs(std::log(c.factor)), 3.0 * c.ln_sigma) << c.wavelength_nm;
    EXPECT_LT(c.ln_sigma, c.ln_sigma_of_tables) << c.wavelength_nm;
  }
  EXPECT_TRUE(map_corrections(result(), find_curtains(result())).empty());  // exact tables
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

/// Mean over the brightest curtain, by its light.
double border_of_curtain_km(const MapResult& map) {
  double flux = 0.0, sum = 0.0;
  for (const Curtain& curtain : find_curtains(map)) {
    if (flux > 0.0) break;
    for (const CurtainPoint& p : curtain.points) {
      flux += p.flux_mw_m2.value;
      sum += p.flux_mw_m2.value * p.lower_border_km.value;
    }
  }
  return sum / flux;
}

TEST(MapFit, NeedsTheSpectrumOfTheElectrons) {
  // Light of a narrow spectrum ends within fewer kilometres than that of any Maxwellian.
  sim::Scene scene = with_band();
  scene.footprints[0].profile = sim::ProfileKind::gaussian;
  scene.footprints[0].energy_spread = 0.1;
  scene.footprints[0].energy_kev = 8.0;
  const Photo narrow = tests::photo_of(scene, 0.0015, 5);
  MapOptions options = quick();
  options.replicates = 0;
  options.pixels_per_cell = 2;
  const MapResult maxwellian = map_photos(without_band(), {narrow}, options);
  options.spectrum = {sim::ElectronSpectrum::Kind::gaussian, 0.1};
  const MapResult gaussian = map_photos(without_band(), {narrow}, options);
  EXPECT_LT(gaussian.chi2, 0.6 * maxwellian.chi2);
  const double border = lower_border(scene, 8.0, options.spectrum).altitude_km;
  EXPECT_LT(std::abs(border_of_curtain_km(gaussian) - border),
            0.5 * std::abs(border_of_curtain_km(maxwellian) - border));
  // The mean energies are the same.
  EXPECT_NEAR(gaussian.energies_kev.front(), 2.0 * maxwellian.energies_kev.front(), 1e-3);
}

/// Mean over the brightest curtain of the lower border's standard error, in km.
double border_error_km(const MapResult& map) {
  const std::vector<Curtain> curtains = find_curtains(map);
  double sum = 0.0;
  if (curtains.empty()) return sum;
  for (const CurtainPoint& p : curtains[0].points)
    sum += p.lower_border_km.error / static_cast<double>(curtains[0].points.size());
  return sum;
}

TEST(MapFit, OneStationsErrorBarsHoldTheSpectrumOfTheElectrons) {
  sim::Scene scene = with_band();
  scene.footprints[0].profile = sim::ProfileKind::gaussian;
  scene.footprints[0].energy_spread = 0.1;
  scene.footprints[0].energy_kev = 8.0;
  const Photo narrow = tests::photo_of(scene, 0.0015, 5);
  MapOptions options = quick();
  options.replicates = 4;
  options.pixels_per_cell = 2;
  const MapResult map = map_photos(without_band(), {narrow}, options);
  // A narrow spectrum is nearer to a Gaussian than to a Maxwellian, and farthest from a broad one.
  using Kind = sim::ElectronSpectrum::Kind;
  ASSERT_EQ(map.spectra.size(), 2u);
  EXPECT_EQ(map.spectra[0].spectrum.kind, Kind::gaussian);
  EXPECT_TRUE(map.spectra[0].is_preferred()) << map.spectra[0].better;
  EXPECT_EQ(map.spectra[1].spectrum.kind, Kind::kappa);
  EXPECT_FALSE(map.spectra[1].is_open()) << map.spectra[1].better;
  ASSERT_EQ(map.replicate_spectra.size(), 4u);
  EXPECT_EQ(map.replicate_spectra[1].kind, Kind::gaussian);
  EXPECT_EQ(map.replicate_spectra[2].kind, Kind::maxwellian);
  EXPECT_EQ(map.replicate_spectra[3].kind, Kind::gaussian);
  const double border = lower_border(scene, 8.0, {sim::ElectronSpectrum::Kind::gaussian, 0.1}).altitude_km;
  const double off = std::abs(border_of_curtain_km(map) - border), error = border_error_km(map);
  EXPECT_GT(off, 3.0);  // else there is nothing to hold
  // Sharper than any spectrum that is drawn (0.25), and four replicates: it is 2.1 errors off.
  EXPECT_LT(off, 2.5 * error) << error;
  const std::vector<QuantityVerdict> verdicts = map_verdicts(map, find_curtains(map));
  EXPECT_NE(verdicts[3].trust, Trust::good) << verdicts[3].value;
  EXPECT_NE(verdicts[3].reason.find("--spectrum gaussian"), std::string::npos) << verdicts[3].reason;
  EXPECT_NE(verdicts[5].trust, Trust::good) << verdicts[5].value;
  EXPECT_NE(verdicts[5].reason.find("assumed"), std::string::npos) << verdicts[5].reason;
}

TEST(MapFit, IsTheSameForAnyNumberOfThreads) {
  MapOptions one = quick();
  one.threads = 1;
  one.replicates = 1;
  one.pixels_per_cell = 2;
  const MapResult other = map_photos(without_band(), {photo()}, one);
  EXPECT_EQ(other.map, learnt_result().map);
  EXPECT_EQ(other.scene.emission.modes, learnt_result().scene.emission.modes);
  ASSERT_EQ(other.replicates.size(), 1u);
  for (std::size_t c = 0; c < other.cells.size(); ++c)
    ASSERT_EQ(other.replicates[0][c].flux_mw_m2, learnt_result().replicates[0][c].flux_mw_m2);
}

TEST(MapFit, SaysWhatIsToBeBelieved) {
  const std::vector<QuantityVerdict> verdicts = map_verdicts(result(), find_curtains(result()));
  ASSERT_EQ(verdicts.size(), 6u);
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
  sim::Scene scene = with_exact_tables();
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
  // The spectrum of the electrons, which one station does not know, adds what 3 km of height are here: 5.6
  // km.
  EXPECT_LT(errors[errors.size() / 2], std::hypot(1.7 * 4.0, 5.6));
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

/// A map of the same picture with any flux (mW m^-2, by the foot) of 4 keV in all cells, and six replicates
/// that differ from it by independent errors of the cells.
template <class Flux>
MapResult made_map(const Flux& flux, double error) {
  const sim::GroundGrid grid(sim::rings_resolved(0.012, 4.0, 260.0));
  MapResult map(result().scene, grid);
  map.photos = result().photos;
  map.energies_kev = result().energies_kev;
  map.chi2 = 1.0;
  map.values = 1;
  std::mt19937 random(8);
  std::normal_distribution<double> normal(0.0, error);
  for (int r = 0; r < 5; ++r) {
    std::vector<CellFlux> cells;
    for (int c = 0; c < grid.cells(); ++c)
      cells.push_back({static_cast<float>(std::max(0.0, flux(grid.middle_km(c)) + normal(random))),
                       static_cast<float>(std::log(4.0))});
    if (r == 0)
      map.cells = cells;
    else
      map.replicates.push_back(cells);
  }
  for (int c = 0; c < grid.cells(); ++c)
    map.border_in_view.push_back(is_border_in_view(map, grid.middle_km(c)) ? 1 : 0);
  return map;
}

TEST(FindCurtains, TellsAnArcFromErrorsAndFromAPatch) {
  // An arc of 3 km standard deviation, 180 km away.
  const auto arc = [](sim::EastNorth foot) {
    return 10.0 * std::exp(-0.5 * std::pow((foot.north - 180.0) / 3.0, 2));
  };
  const std::vector<Curtain> curtains = find_curtains(made_map(arc, 0.8));
  ASSERT_EQ(curtains.size(), 1u);
  EXPECT_GT(curtains[0].length_km, 150.0);
  EXPECT_GE(curtains[0].probability, kCurtainProbability);
  for (const CurtainPoint& p : curtains[0].points) EXPECT_NEAR(p.foot_km.north, 180.0, 4.0);

  // Errors alone.
  const MapResult chance = made_map([](sim::EastNorth) { return 2.0; }, 0.8);
  EXPECT_TRUE(find_curtains(chance).empty());
  EXPECT_FALSE(find_faint_curtains(chance).empty());

  // A round patch of 40 km standard deviation.
  const auto patch = [](sim::EastNorth foot) {
    return 10.0 * std::exp(-0.5 * (std::pow(foot.east / 40.0, 2) + std::pow((foot.north - 180.0) / 40.0, 2)));
  };
  const MapResult diffuse = made_map(patch, 0.1);
  EXPECT_TRUE(find_curtains(diffuse).empty());
  const std::vector<Curtain> others = find_faint_curtains(diffuse);
  EXPECT_TRUE(std::any_of(others.begin(), others.end(), [](const Curtain& c) { return c.is_diffuse_patch; }));
}

// Replicates of the same energies and spectrum, which differ by their tables alone. Borders are interpolated
// between energies: 0.1 km.
TEST(FindCurtains, HaveTheBordersOfEachReplicatesOwnTables) {
  MapResult map = learnt_result();
  ASSERT_FALSE(map.numbers.empty());
  for (std::vector<CellFlux>& replicate : map.replicates) replicate = map.cells;
  map.replicate_spectra.assign(map.replicates.size(), map.spectrum);
  const std::vector<Curtain> curtains = find_curtains(map);
  ASSERT_FALSE(curtains.empty());
  const CurtainPoint& p = curtains[0].points[curtains[0].points.size() / 2];
  double square = 0.0;
  for (std::uint32_t r = 0; r < map.replicates.size(); ++r) {
    const sim::Scene scene = scene_with(map.scene, map.numbers, map.replicate_values.at(r));
    square += std::pow(lower_border(scene, p.energy_kev.value).altitude_km -
                           lower_border(map.scene, p.energy_kev.value).altitude_km,
                       2) /
              static_cast<double>(map.replicates.size());
  }
  EXPECT_GT(square, 0.01);  // else there is nothing to tell
  EXPECT_NEAR(p.lower_border_km.error, kEnergyInflation * std::sqrt(square), 0.1);
}

TEST(FindCurtains, SaysWhatIsNotTested) {
  MapResult map = result();
  map.replicates.clear();
  map.replicate_spectra.clear();
  const std::vector<Curtain> curtains = find_curtains(map);
  ASSERT_FALSE(curtains.empty());
  EXPECT_TRUE(std::isnan(curtains[0].probability));
  EXPECT_NE(map_verdicts(map, curtains)[2].reason.find("tested"), std::string::npos);
}

TEST(MapVerdicts, TakeTheLastEnergyForALimit) {
  MapResult map = result();
  while (map.energies_kev.back() > 4.2) map.energies_kev.pop_back();
  const std::vector<Curtain> curtains = find_curtains(map);
  ASSERT_FALSE(curtains.empty());
  int limits = 0;
  for (const CurtainPoint& p : curtains[0].points) limits += p.energy_limit == 1;
  EXPECT_GT(limits, static_cast<int>(curtains[0].points.size() / 2));
  const QuantityVerdict energy = map_verdicts(map, curtains)[3];
  EXPECT_EQ(energy.trust, Trust::unconstrained);
  EXPECT_NE(energy.reason.find("lower limit"), std::string::npos) << energy.reason;
}

TEST(MapVerdicts, DoubtDistancesWhereACurtainFoldsAlongTheLineOfSight) {
  std::vector<Curtain> curtains = find_curtains(result());
  ASSERT_FALSE(curtains.empty());
  EXPECT_EQ(map_verdicts(result(), curtains)[2].reason.find("folds"), std::string::npos);
  // A fifth of it comes back behind itself, far beyond its errors.
  std::vector<CurtainPoint>& points = curtains[0].points;
  for (std::size_t i = points.size(), back = points.size() - points.size() / 5; i-- > back;) {
    CurtainPoint behind = points[i];
    behind.distance_km += 10.0 * behind.distance_error_km;
    points.push_back(behind);
  }
  const QuantityVerdict distance = map_verdicts(result(), curtains)[2];
  EXPECT_NE(distance.trust, Trust::good);
  EXPECT_NE(distance.reason.find("folds"), std::string::npos) << distance.reason;
}

TEST(MapVerdicts, LeaveLightInTheFarthestCellsOpen) {
  // The map's ground ends before nearly all of the band: its nearest point is 175 km away.
  MapOptions options = quick();
  options.replicates = 2;
  options.farthest_km = 180.0;
  options.pixels_per_cell = 2;
  const MapResult map = map_photos(without_band(), {photo()}, options);
  const std::vector<QuantityVerdict> verdicts = map_verdicts(map, find_curtains(map));
  for (const std::size_t i : {1u, 2u, 3u})
    EXPECT_EQ(verdicts[i].trust, Trust::unconstrained) << verdicts[i].value;
}

TEST(MapFit, StopsWhereItIsTold) {
  const std::atomic<bool> stop{true};
  MapOptions options = quick();
  options.stop = &stop;
  EXPECT_THROW(map_photos(without_band(), {photo()}, options), MapStopped);
}

TEST(LowerBorder, SinksWithTheEnergy) {
  const sim::Scene scene = without_band();
  const LowerBorder low = lower_border(scene, 1.0), high = lower_border(scene, 6.0);
  EXPECT_GT(low.altitude_km, high.altitude_km + 8.0);
  // Its derivative against a difference over a step that the profile's rows of 0.25 km resolve.
  const double difference =
      (lower_border(scene, 4.4).altitude_km - lower_border(scene, 3.6).altitude_km) / std::log(4.4 / 3.6);
  EXPECT_NEAR(lower_border(scene, 4.0).by_ln_energy, difference, 0.1 * std::abs(difference));
  // At one mean energy it is lower by the fast electrons of a Maxwellian.
  EXPECT_GT(lower_border(scene, 8.0, {sim::ElectronSpectrum::Kind::mono}).altitude_km,
            lower_border(scene, 4.0).altitude_km + 1.0);
}

}  // namespace
}  // namespace vegard::fit::map_fit_test
