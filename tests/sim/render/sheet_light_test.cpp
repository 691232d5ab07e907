// What a sheet says of its light, measured on the film: brightness along the field, light against altitude,
// steps that follow the electrons' energy.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>

#include "sim/base/earth.h"
#include "sim/light/form_profile.h"
#include "sim/render/film.h"
#include "sim/scene/scene_toml.h"
#include "tests/support/exposed.h"
#include "tests/support/small_scene.h"

namespace vegard::sim {
namespace {

using tests::exposed;
using tests::whole_picture;

/// A sheet 60 km wide through the magnetic zenith of a camera that looks there, 4 degrees across.
Scene magnetic_zenith(double inclination_deg) {
  Scene scene;
  scene.camera.width = scene.camera.height = 40;
  scene.camera.hfov_deg = 4.0;
  scene.camera.azimuth_deg = 180.0;
  scene.camera.elevation_deg = inclination_deg;
  scene.field.inclination_deg = inclination_deg;
  Sheet sheet;
  sheet.center_km = {0.0, -110.0 / std::tan(inclination_deg * kRadiansPerDegree)};
  sheet.length_km = 40.0;
  sheet.thickness_km = 0.01;
  sheet.width_km = 60.0;
  sheet.layers = 1;
  sheet.beams = 200000;
  sheet.path_step = 0.02;
  sheet.loss_cone_deg = 0.0;
  sheet.pitch_law = "constant";
  scene.sheets = {sheet};
  return scene;
}

/// Mean green light of a film of magnetic_zenith(), its border left out, in kilorayleigh.
double green_kilorayleigh(const Exposure& exposure) {
  double sum = 0.0;
  int cells = 0;
  for (int r = 4; r < 36; ++r)
    for (int c = 4; c < 36; ++c, ++cells) sum += exposure.rayleigh[exposure.cells() + r * 40 + c];
  return 1e-3 * sum / cells;
}

TEST(Brightness, OfIbcTwoIsTenKilorayleighAlongTheField) {
  // Source paper, table 1; docs/physics.md row B21. Beams and steps are random: from seed to seed the mean of
  // the picture scatters by 1 %.
  for (double inclination : {78.0, 50.0}) {
    for (const char* profile : {"maxwellian", "form"}) {
      Scene scene = magnetic_zenith(inclination);
      scene.sheets[0].profile = profile;
      scene.sheets[0].brightness_kilorayleigh = 10.0;
      EXPECT_NEAR(green_kilorayleigh(exposed(scene)), 10.0, 0.25)
          << profile << ", inclination " << inclination;
    }
  }
}

TEST(Brightness, OfTheSourcesFourClassesIsOneToAThousandKilorayleighAlongTheField) {
  // Source paper, table 1: IBC 1, 2, 3 and 4 as a scene file says them. Half the beams of the test above.
  for (const auto& [ibc, kilorayleigh] :
       {std::pair(1, 1.0), std::pair(2, 10.0), std::pair(3, 100.0), std::pair(4, 1000.0)}) {
    Scene scene = magnetic_zenith(78.0);
    scene.sheets[0].beams = 100000;
    scene.sheets[0].brightness_kilorayleigh =
        parse_scene("[[sheet]]\nibc = " + std::to_string(ibc) + "\n", "x.toml")
            .sheets[0]
            .brightness_kilorayleigh;
    EXPECT_NEAR(green_kilorayleigh(exposed(scene)) / kilorayleigh, 1.0, 0.035) << "IBC " << ibc;
  }
}

TEST(Brightness, DoesNotDependOnTheEnergyFlux) {
  Scene scene = tests::small_scene();
  scene.sheets[0].brightness_kilorayleigh = 10.0;
  const Exposure once = exposed(scene);
  scene.sheets[0].energy_flux_mw_m2 = 0.0;
  EXPECT_EQ(exposed(scene).rayleigh, once.rayleigh);
}

/// Total light of a thin sheet 200 km to the north against altitude, by rows of a camera that looks at it.
struct SideView {
  std::vector<double> altitude_km, light;

  /// Where the light passes a share of its peak below or above that.
  double altitude_of(double share, bool above) const {
    std::size_t peak = 0;
    for (std::size_t i = 0; i < light.size(); ++i)
      if (light[i] > light[peak]) peak = i;
    const double limit = share * light[peak];
    std::size_t i = peak;
    const int step = above ? -1 : 1;  // rows run down
    while (i > 0 && i + 1 < light.size() && light[i] > limit) i += step;
    const double part = (light[i - step] - limit) / (light[i - step] - light[i]);
    return altitude_km[i - step] + part * (altitude_km[i] - altitude_km[i - step]);
  }
};

SideView side_view(const Sheet& of) {
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
  const Exposure exposure = exposed(scene);
  SideView view;
  for (int r = 0; r < 400; ++r) {
    const double elevation =
        direction_of_pixel(scene.camera, 30.0, r + 0.5).elevation_deg * kRadiansPerDegree;
    const double up = 200.0 * std::tan(elevation) + kEarthRadiusKm;
    view.altitude_km.push_back(std::hypot(200.0, up) - kEarthRadiusKm);
    double sum = 0.0;
    for (int l = 0; l < 3; ++l)
      for (int c = 0; c < 60; ++c) sum += exposure.rayleigh[l * exposure.cells() + r * 60 + c];
    view.light.push_back(sum * std::cos(elevation));  // a line of sight crosses the sheet aslant
  }
  return view;
}

TEST(FormOnFilm, FallsAsItsCurveDoes) {
  // Docs/physics.md row B19. A row is 0.2 km; the deflections' spread adds less.
  Sheet sheet;
  sheet.profile = "form";
  sheet.lower_km = 4.0;
  sheet.upper_km = 20.0;
  const SideView view = side_view(sheet);
  EXPECT_NEAR(view.altitude_of(0.1, false), 106.0, 0.4);
  EXPECT_NEAR(view.altitude_of(0.01, false), 110.0 - 4.0 * std::sqrt(2.0), 0.4);
  EXPECT_NEAR(view.altitude_of(0.1, true), 130.0, 1.0);
}

TEST(FormOnFilm, EvenArcsAndBandsAreTwentyToThirtyKilometresTall) {
  // Source paper, sections 2.3 and 3.4: 20 to 30 km in all; a tenth within a few kilometres below the peak,
  // a hundredth one or two below that.
  for (const char* form : {"homogeneous_arc", "band"}) {
    const Scene scene = parse_scene(std::string("[[sheet]]\nform = \"") + form + "\"\n", "x.toml");
    const Sheet& sheet = scene.sheets[0];
    const SideView view = side_view(sheet);
    const double tenth = view.altitude_of(0.1, false), hundredth = view.altitude_of(0.01, false);
    const double tall = view.altitude_of(0.1, true) - tenth;
    EXPECT_GT(tall, 20.0) << form;
    EXPECT_LT(tall, 30.0) << form;
    EXPECT_NEAR(sheet.peak_km - tenth, sheet.lower_km, 0.5) << form;
    EXPECT_GT(tenth - hundredth, 1.0) << form;
    EXPECT_LT(tenth - hundredth, 2.3) << form;
  }
}

TEST(StepRule, OfTheEnergyTakesTheStepsOfItsMeanAndKeepsThemWhileTheEnergyVaries) {
  // Mean energy 2 E0: 10 keV has d_t = 1/300, and twice as many points as 5 keV. The sheet is short, so that
  // all its beams are seen down to their ends: of the others points are counted by whole blocks.
  Scene scene = tests::small_scene();
  Sheet& sheet = scene.sheets[0];
  sheet.length_km = 60.0;
  sheet.energy_kev = 5.0;
  const auto points = [&](Exposer& exposer) {
    Exposure exposure;
    exposer.expose(scene, exposure);
    return exposure.deflection_points;
  };
  Exposer given(scene, whole_picture(scene), 0);
  sheet.step_rule = "energy";
  Exposer of_energy(scene, whole_picture(scene), 0);
  const auto at_ten = points(of_energy);
  EXPECT_EQ(at_ten, points(given)) << "d_t = 1/300 by default";
  sheet.energy_kev = 2.5;
  EXPECT_EQ(points(of_energy), at_ten) << "frozen while a fit varies E0";
  Exposer fresh(scene, whole_picture(scene), 0);
  EXPECT_NEAR(static_cast<double>(points(fresh)) / static_cast<double>(at_ten), 0.5, 0.005);
}

}  // namespace
}  // namespace vegard::sim
