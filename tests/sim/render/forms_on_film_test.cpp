// The height and brightness of the auroral forms, measured on the film.
//
// Baranoski et al. 2000, sections 2.2, 2.3 and 3.4, table 1; rows B19 to B21 of docs/physics.md.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include "sim/base/number/constants.h"
#include "sim/render/film.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/scene/rows/forms.h"
#include "tests/support/exposed.h"

namespace vegard::sim::forms_on_film_test {
namespace {

using tests::exposed;
using tests::whole_picture;

/// By its curve, which this file measures; tests/sim/scene/rows/forms_test.cpp has the electrons.
Scene scene_of_form(const std::string& form) {
  return parse_scene("[[sheet]]\nprofile = \"form\"\nform = \"" + form + "\"\n", "x.toml");
}

/// Light of the three lines against altitude, by the rows of a camera that looks at a sheet from the side.
struct SideView {
  std::vector<double> altitude_km, light;

  std::size_t peak_row() const {
    return static_cast<std::size_t>(std::max_element(light.begin(), light.end()) - light.begin());
  }
  double peak_km() const { return altitude_km[peak_row()]; }

  /// Where the light passes a share of its peak below or above that.
  double altitude_of(double share, bool above) const {
    const std::size_t peak = peak_row();
    const double limit = share * light[peak];
    std::size_t i = peak;
    const int step = above ? -1 : 1;  // rows run down
    while (i > 0 && i + 1 < light.size() && light[i] > limit) i += step;
    const double part = (light[i - step] - limit) / (light[i - step] - light[i]);
    return altitude_km[i - step] + part * (altitude_km[i] - altitude_km[i - step]);
  }
};

/// The scene's only sheet stands that far to the north across the line of sight, its beams upright.
SideView side_view(const Scene& scene, const FilmGeometry& film, double distance_km) {
  const Exposure exposure = exposed(scene, film);
  SideView view;
  for (int r = 0; r < film.rows; ++r) {
    const double elevation =
        direction_of_pixel(scene.camera, 0.5 * scene.camera.width, r + 0.5).elevation_deg * kRadiansPerDegree;
    const double up = distance_km * std::tan(elevation) + kEarthRadiusKm;
    view.altitude_km.push_back(std::hypot(distance_km, up) - kEarthRadiusKm);
    double sum = 0.0;
    for (int l = 0; l < 3; ++l)
      for (int c = 0; c < film.columns; ++c)
        sum += exposure.rayleigh[l * exposure.cells() + static_cast<std::size_t>(r) * film.columns + c];
    view.light.push_back(sum * std::cos(elevation));  // a line of sight crosses the sheet aslant
  }
  return view;
}

/// Of a sheet made thin and even, 200 km away.
SideView thin_side_view(const Sheet& of) {
  Scene scene;
  scene.camera.width = 60;
  scene.camera.height = 400;
  scene.camera.hfov_deg = 2.4;
  scene.camera.elevation_deg = 33.0;
  scene.field.inclination_deg = 90.0;
  Sheet sheet = of;
  sheet.center_km = {0.0, 200.0};
  sheet.length_km = 20.0;
  sheet.thickness_km = 0.01;
  sheet.width_km = 0.01;
  sheet.layers = 1;
  sheet.beams = 4000;
  sheet.beams_per_km = 0.0;
  scene.sheets = {sheet};
  return side_view(scene, whole_picture(scene), 200.0);
}

TEST(FormOnFilm, FallsAsItsCurveDoes) {
  // Docs/physics.md row B19. A row is 0.2 km; the deflections' spread adds less.
  Sheet sheet;
  sheet.profile = ProfileKind::form;
  sheet.lower_km = 4.0;
  sheet.upper_km = 20.0;
  const SideView view = thin_side_view(sheet);
  EXPECT_NEAR(view.altitude_of(0.1, false), 106.0, 0.4);
  EXPECT_NEAR(view.altitude_of(0.01, false), 110.0 - 4.0 * std::sqrt(2.0), 0.4);
  EXPECT_NEAR(view.altitude_of(0.1, true), 130.0, 1.0);
}

TEST(FormOnFilm, EvenArcsAndBandsAreTwentyToThirtyKilometresTall) {
  // Source paper, sections 2.3 and 3.4: 20 to 30 km in all; a tenth within a few kilometres below the peak,
  // a hundredth one or two below that.
  for (const char* form : {"homogeneous_arc", "band"}) {
    const Sheet sheet = scene_of_form(form).sheets[0];
    const SideView view = thin_side_view(sheet);
    const double tenth = view.altitude_of(0.1, false), hundredth = view.altitude_of(0.01, false);
    const double tall = view.altitude_of(0.1, true) - tenth;
    EXPECT_GT(tall, 20.0) << form;
    EXPECT_LT(tall, 30.0) << form;
    EXPECT_NEAR(sheet.peak_km - tenth, sheet.lower_km, 0.5) << form;
    EXPECT_GT(tenth - hundredth, 1.0) << form;
    EXPECT_LT(tenth - hundredth, 2.3) << form;
  }
}

constexpr double kLengthKm = 160.0;

/// A form with every key of its own but the length, 800 km away: from the ground no line of sight to it runs
/// flatter, so that its depth blurs the altitude least: a beam 1 km nearer is taken for one 0.2 km higher.
SideView form_from_the_side(const std::string& form) {
  Scene scene = scene_of_form(form);
  Sheet& sheet = scene.sheets[0];
  sheet.center_km = {0.0, 800.0};
  sheet.length_km = std::min(sheet.length_km, kLengthKm);
  scene.field.inclination_deg = 90.0;
  scene.camera.width = 280;
  scene.camera.height = 760;  // 65 to 560 km
  scene.camera.hfov_deg = 12.0;
  scene.camera.elevation_deg = 17.0;
  FilmGeometry film = whole_picture(scene);
  film.cell_width_px = 28.0;
  film.columns = 10;
  return side_view(scene, film, 800.0);
}

struct Overhead {
  double brightest_kilorayleigh = 0.0, mean_kilorayleigh = 0.0;
};

/// The green light of a form seen along the field, over some 49 by 49 km at 110 km in pixels of 1.2 km.
Overhead form_overhead(const std::string& form) {
  Scene scene = scene_of_form(form);
  Sheet& sheet = scene.sheets[0];
  sheet.center_km = {0.0, 0.0};
  sheet.length_km = std::min(sheet.length_km, kLengthKm);
  scene.field.inclination_deg = 90.0;
  scene.camera.width = scene.camera.height = 40;
  scene.camera.hfov_deg = 25.0;
  scene.camera.elevation_deg = 90.0;
  const Exposure exposure = exposed(scene);
  Overhead seen;
  for (std::size_t i = 0; i < exposure.cells(); ++i) {
    const double kilorayleigh = 1e-3 * exposure.rayleigh[exposure.cells() + i];
    seen.brightest_kilorayleigh = std::max(seen.brightest_kilorayleigh, kilorayleigh);
    seen.mean_kilorayleigh += kilorayleigh / static_cast<double>(exposure.cells());
  }
  return seen;
}

double tall_km(const SideView& view) { return view.altitude_of(0.1, true) - view.altitude_of(0.1, false); }

struct Stated {
  const char* form;
  double shortest_km, tallest_km;  ///< between the tenths of the peak
  double lower_side_km;            ///< at most, from the peak down to a tenth
};

/// Sections 2.2, 2.3 and 3.4: arcs and bands are 20 to 30 km tall and fall to a tenth within a few kilometres
/// below their peak. Rays go from what is taller than that "up to several hundred kilometers"; rayed bands
/// have shorter ones than draperies. Lower sides are the sheet's 4 to 4.8 km and what the depth of a band of
/// +-8 to +-10 km adds, some +-2 km; on rayed forms the border undulates by 2 to 3 km besides, and the
/// drapery's folds reach further to the side. Of patches the paper states no height; their width of 25 km
/// blurs theirs.
const Stated kStated[] = {
    {"homogeneous_arc", 20.0, 30.0, 7.0}, {"band", 20.0, 30.0, 7.0},      {"rayed_arc", 40.0, 90.0, 8.0},
    {"rayed_band", 60.0, 130.0, 10.0},    {"rays", 200.0, 500.0, 12.0},   {"corona", 60.0, 130.0, 10.0},
    {"drapery", 150.0, 300.0, 13.0},      {"diffuse_patches", 0, 50, 15},
};

void PrintTo(const Stated& stated, std::ostream* out) { *out << stated.form; }

class EveryForm : public testing::TestWithParam<Stated> {};

TEST_P(EveryForm, IsAsTallOnTheFilmAsTheSourceStates) {
  const SideView view = form_from_the_side(GetParam().form);
  EXPECT_GE(tall_km(view), GetParam().shortest_km);
  EXPECT_LE(tall_km(view), GetParam().tallest_km);
  const double lower_side_km = view.peak_km() - view.altitude_of(0.1, false);
  EXPECT_GE(lower_side_km, 2.0);
  EXPECT_LE(lower_side_km, GetParam().lower_side_km);
  const Sheet sheet = scene_of_form(GetParam().form).sheets[0];
  if (sheet.ray_contrast > 0.0) {
    // Rays are of unlike length, and the bundle of 60 km has few: with seeds 1 to 6 (here the default,
    // 1) it is 0.85 to 1.17 of the mean ray, the other forms 1.00 to 1.13.
    const double of_the_mean_ray = sheet.lower_km + sheet.upper_km;
    EXPECT_GE(tall_km(view), 0.8 * of_the_mean_ray);
    EXPECT_LE(tall_km(view), 1.25 * of_the_mean_ray);
  }
}

TEST_P(EveryForm, IsAsBrightOnTheFilmAsTheSourceStates) {
  const Overhead seen = form_overhead(GetParam().form);
  if (std::string(GetParam().form) == "diffuse_patches") {
    // "Difficult to see with the naked eye", whose limit is "of the order of 1 kR in the green line"; with
    // seeds 1 to 6 the mean is 0.27 to 0.80.
    EXPECT_LT(seen.mean_kilorayleigh, 1.0);
    EXPECT_GT(seen.mean_kilorayleigh, 0.1);
    EXPECT_LT(seen.brightest_kilorayleigh, 10.0);
  } else {
    // Table 1: classes from 1 to 1000 kR. A form with definite structures is beyond the weakest.
    EXPECT_GT(seen.brightest_kilorayleigh, 5.0);
    EXPECT_LT(seen.brightest_kilorayleigh, 1000.0);
  }
}

INSTANTIATE_TEST_SUITE_P(FormOnFilm, EveryForm, testing::ValuesIn(kStated),
                         [](const auto& stated) { return std::string(stated.param.form); });

TEST(FormOnFilm, IsMeasuredForEveryForm) {
  std::vector<std::string> measured = {"custom"};
  for (const Stated& stated : kStated) measured.emplace_back(stated.form);
  measured.emplace_back("spirals");  // the source leaves them to the future and states nothing of them
  measured.emplace_back("steve");    // no form of the source
  measured.emplace_back("picket_fence");
  measured.emplace_back("proton_arc");
  EXPECT_EQ(measured, form_names());
}

TEST(FormOnFilm, RaysOfBandsAreShorterThanThoseOfDraperies) {
  const auto tall = [](const char* form) { return tall_km(form_from_the_side(form)); };
  const double rayed_band = tall("rayed_band"), drapery = tall("drapery");
  EXPECT_GT(drapery, 1.5 * rayed_band);
  EXPECT_GT(rayed_band, 1.5 * tall("band"));
}

}  // namespace
}  // namespace vegard::sim::forms_on_film_test
