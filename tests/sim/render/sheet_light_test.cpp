// What a sheet says of its light, measured on the film: brightness along the field, steps that follow the
// electrons' energy. Its light against altitude is in forms_on_film_test.cpp.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <tuple>
#include <utility>

#include "sim/base/number/constants.h"
#include "sim/emit/aurora/sheet_brightness.h"
#include "sim/render/beam_exposer.h"
#include "sim/render/film.h"
#include "sim/scene/file/scene_toml.h"
#include "tests/support/exposed.h"
#include "tests/support/kind_named.h"
#include "tests/support/small_scene.h"

namespace vegard::sim::sheet_light_test {
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
  sheet.pitch_law = PitchLaw::constant;
  scene.sheets = {sheet};
  return scene;
}

/// Mean light of a line of a film of magnetic_zenith(), its border left out, in kilorayleigh.
double kilorayleigh_of(const Exposure& exposure, int line) {
  double sum = 0.0;
  int cells = 0;
  for (int r = 4; r < 36; ++r)
    for (int c = 4; c < 36; ++c, ++cells) sum += exposure.rayleigh[line * exposure.cells() + r * 40 + c];
  return 1e-3 * sum / cells;
}

double green_kilorayleigh(const Exposure& exposure) { return kilorayleigh_of(exposure, 1); }

TEST(Brightness, OfIbcTwoIsTenKilorayleighAlongTheField) {
  // Source paper, table 1; docs/physics.md row B21. Beams and steps are random: from seed to seed the mean of
  // the picture scatters by 1 %.
  for (double inclination : {78.0, 50.0}) {
    for (const char* profile : {"maxwellian", "form"}) {
      Scene scene = magnetic_zenith(inclination);
      scene.sheets[0].profile = tests::kind_named<ProfileKind>(profile);
      scene.sheets[0].brightness_kilorayleigh = 10.0;
      EXPECT_NEAR(green_kilorayleigh(exposed(scene)), 10.0, 0.25)
          << profile << ", inclination " << inclination;
    }
  }
}

TEST(Brightness, OfALineAndOfProtonsIsAsGivenAlongTheField) {
  for (const auto& [profile, line_nm, line] :
       {std::tuple(ProfileKind::line, 557.7, 1), std::tuple(ProfileKind::proton, 427.8, 2)}) {
    Scene scene = magnetic_zenith(60.0);
    scene.sheets[0].profile = profile;
    scene.sheets[0].line_nm = line_nm;
    scene.sheets[0].line_kilorayleigh = 3.0;
    scene.sheets[0].energy_flux_mw_m2 = 77.0;  // has no effect
    EXPECT_NEAR(kilorayleigh_of(exposed(scene), line), 3.0, 0.075) << line_nm;
    EXPECT_EQ(kilorayleigh_of(exposed(scene), 0), 0.0) << "no red line";
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

TEST(Brightness, AlongTheFieldIsWhatSheetBrightnessTells) {
  // Scatters by 1 % from seed to seed, as above.
  Scene scene = magnetic_zenith(60.0);
  scene.sheets[0].energy_flux_mw_m2 = 4.0;
  const double told = sheet_brightness(scene, 0).layer_green_kilorayleigh;
  EXPECT_NEAR(green_kilorayleigh(exposed(scene)) / told, 1.0, 0.025);
}

TEST(Brightness, DoesNotDependOnTheEnergyFlux) {
  Scene scene = tests::small_scene();
  scene.sheets[0].brightness_kilorayleigh = 10.0;
  const Exposure once = exposed(scene);
  scene.sheets[0].energy_flux_mw_m2 = 0.0;
  EXPECT_EQ(exposed(scene).rayleigh, once.rayleigh);
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
  BeamExposer given(scene, whole_picture(scene), 0);
  sheet.step_rule = PathStepRule::energy;
  BeamExposer of_energy(scene, whole_picture(scene), 0);
  const auto at_ten = points(of_energy);
  EXPECT_EQ(at_ten, points(given)) << "d_t = 1/300 by default";
  sheet.energy_kev = 2.5;
  EXPECT_EQ(points(of_energy), at_ten) << "frozen while a fit varies E0";
  BeamExposer fresh(scene, whole_picture(scene), 0);
  EXPECT_NEAR(static_cast<double>(points(fresh)) / static_cast<double>(at_ten), 0.5, 0.005);
  sheet.profile = ProfileKind::mono;
  sheet.energy_kev = 10.0;
  BeamExposer of_one_energy(scene, whole_picture(scene), 0);
  EXPECT_EQ(points(of_one_energy), at_ten) << "their mean is the energy itself";
}

}  // namespace
}  // namespace vegard::sim::sheet_light_test
