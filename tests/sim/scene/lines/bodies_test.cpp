#include "sim/scene/lines/bodies.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "sim/base/number/constants.h"
#include "sim/emit/aurora/foot_field.h"
#include "sim/light/field/igrf.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/scene/table/parameter_table.h"
#include "sim/scene/table/value_check.h"
#include "sim/view/camera/camera.h"
#include "sim/view/sky/air.h"
#include "tests/support/bad_scene.h"
#include "tests/support/expect_error.h"

namespace vegard::sim::bodies_test {
namespace {

const KnownBody& known(const std::string& name) {
  for (const KnownBody& body : known_bodies())
    if (body.body.name == name) return body;
  ADD_FAILURE() << name;
  return known_bodies().front();
}

TEST(Bodies, OfEarthsNameAreADefaultScene) {
  const Scene scene = parse_scene("[body]\nname = \"earth\"\n", "earth.toml");
  EXPECT_EQ(write_scene(scene, ""), write_scene(Scene(), ""));
}

// The dipole moments are those of Russell and Dougherty 2010; the fields here are of later missions: JRM09
// (4.170 G, Connerney et al. 2018) and Cassini (g10 = 21140 nT, Dougherty et al. 2018, Science 362,
// eaat5434), each at its own reference radius.
TEST(Bodies, HaveTheFieldsThatSpacecraftMeasured) {
  const Body &jupiter = known("jupiter").body, &saturn = known("saturn").body;
  EXPECT_NEAR(dipole_field_t(jupiter, 71492.0, 0.0), 4.170e-4, 0.02 * 4.170e-4);
  EXPECT_NEAR(dipole_field_t(jupiter, 71492.0, 90.0), 8.340e-4, 0.02 * 8.340e-4);
  EXPECT_NEAR(dipole_field_t(saturn, 60268.0, 0.0), 2.114e-5, 0.01 * 2.114e-5);
  // The first degree of IGRF-14 in 2020: g10, g11, h11.
  const double earth_t = 1e-9 * std::hypot(29404.8, 1450.9, 4652.5);
  EXPECT_NEAR(dipole_field_t(Body(), 6371.2, 0.0), earth_t, 0.005 * earth_t);
  for (const double latitude : {0.0, 20.0, 55.0, 90.0}) {
    // |B| of a dipole, from its two components.
    const double radial = 2.0 * std::sin(latitude * kRadiansPerDegree),
                 level = std::cos(latitude * kRadiansPerDegree);
    EXPECT_NEAR(dipole_field_t(jupiter, 70000.0, latitude) / dipole_field_t(jupiter, 70000.0, 0.0),
                std::hypot(radial, level), 1e-12);
  }
}

// GM in km^3 s^-2 of Jacobson (2013; 2006) and of the Earth.
TEST(Bodies, HaveTheGravityOfTheirMassAndSize) {
  const auto expect = [](const std::string& name, double gm) {
    const Body& body = known(name).body;
    EXPECT_NEAR(body.gravity_m_s2, 1e3 * gm / (body.radius_km * body.radius_km), 0.005) << name;
  };
  expect("earth", 398600.4);
  expect("jupiter", 126686534.0);
  expect("saturn", 37931208.0);
}

TEST(Bodies, HaveAScaleHeightByTheirGravity) {
  Body body;
  body.air_temperature_k = 300.0;
  body.air_mass_dalton = 28.0;
  // The textbook's 8.4 to 9.1 km of nitrogen near 300 K.
  EXPECT_NEAR(scale_height_km(body, 0.0), 1.380649e-23 * 300.0 / (28.0 * 1.66053907e-27 * 9.82) * 1e-3, 1e-4);
  EXPECT_NEAR(scale_height_km(body, body.radius_km), 4.0 * scale_height_km(body, 0.0), 1e-9);
  body.gravity_m_s2 *= 2.0;
  EXPECT_NEAR(scale_height_km(body, 0.0), 0.5 * 9.0713, 0.001);
}

TEST(Bodies, HaveTheirHorizonWhereRaysBeginToMeetTheGround) {
  for (const KnownBody& of : known_bodies())
    for (const double observer_km : {1.0, 400.0, 30000.0}) {
      const double radius = of.body.radius_km,
                   dip = horizon_dip_deg(of.body, observer_km) * kRadiansPerDegree;
      EXPECT_NEAR(sine_of_horizon(observer_km, radius), -std::sin(dip), 1e-9);
      EXPECT_TRUE(std::isinf(ground_km(observer_km, -std::sin(dip) + 1e-6, radius)));
      // A tangent, from the triangle with the right angle at the horizon.
      const double way = std::sqrt(observer_km * (observer_km + 2.0 * radius));
      EXPECT_NEAR(ground_km(observer_km, -std::sin(dip) - 1e-9, radius), way, 2e-3 * way);
    }
}

TEST(Bodies, BringTheirLinesAndTheirFieldAndTheFileGoesBefore) {
  const Scene jupiter = parse_scene("[body]\nname = \"jupiter\"\n", "j.toml");
  EXPECT_EQ(jupiter.body.radius_km, 69911.0);
  EXPECT_EQ(jupiter.field.model, FieldModel::dipole);
  EXPECT_NEAR(jupiter.field.pole_latitude_deg, 90.0 - 10.31, 1e-9);
  EXPECT_EQ(jupiter.own_lines.size(), 4u);
  EXPECT_EQ(jupiter.blur.width_deg.size(), jupiter.emission.lines.size());
  EXPECT_FALSE(falls_along_field([&] {
    Scene north = jupiter;
    north.site.latitude_deg = 70.0;
    return north;
  }()))
      << "its field points out of the north";
  const Scene own = parse_scene(
      "[body]\nname = \"jupiter\"\nradius_km = 71492\n[field]\npole_latitude_deg = 80\n"
      "[[line]]\nname = \"mine\"\nwavelength_nm = 588.0\nrayleigh_per_mw_m2 = 5\n[emission]\nlines = "
      "[588.0]\n",
      "own.toml");
  EXPECT_EQ(own.body.radius_km, 71492.0);
  EXPECT_EQ(own.field.pole_latitude_deg, 80.0);
  EXPECT_EQ(own.own_lines.size(), 1u);
  for (const Scene& scene : {jupiter, own})
    EXPECT_EQ(write_scene(parse_scene(write_scene(scene, ""), "again.toml"), ""), write_scene(scene, ""));
  Scene set;
  set_from_text(set, "body.name", "saturn");
  EXPECT_EQ(set.body.radius_km, 59032.0);
  set_from_text(set, "body.name", "earth");
  EXPECT_EQ(set.emission.lines, Emission().lines);
  EXPECT_TRUE(set.own_lines.empty());
}

class BadBody : public ::testing::TestWithParam<Bad> {};
TEST_P(BadBody, IsRefusedInItsLine) { expect_refused(GetParam()); }

const char* const kOfEarth = "the Earth alone | \"jupiter\"";

INSTANTIATE_TEST_SUITE_P(
    Bodies, BadBody,
    ::testing::Values(
        Bad{"name", "[body]\nname = \"krypton\"\n", 2, "body.name", "\"jupiter\""},
        Bad{"earths_radius", "[body]\nradius_km = 6378\n", 2, "body.radius_km", "or body.name = \"own\""},
        Bad{"too_small", "[body]\nname = \"own\"\nradius_km = 1700\n", 3, "body.radius_km", "6000"},
        Bad{"igrf", "[body]\nname = \"jupiter\"\n[field]\nmodel = \"igrf\"\n", 4, "field.model", kOfEarth},
        Bad{"tables", "[body]\nname = \"jupiter\"\n[[sheet]]\nenergy_kev = 3\nprofile = \"maxwellian\"\n", 5,
            "sheet.main.profile", "the emission tables are of the Earth alone"},
        Bad{"footprint", "[body]\nname = \"jupiter\"\n[[footprint]]\nprofile = \"form\"\n", 4,
            "footprint.arc.profile", kOfEarth},
        Bad{"line",
            "[body]\nname = \"jupiter\"\n[emission]\nlines = [557.7, 656.3]\n[[sheet]]\nprofile = "
            "\"layer\"\n",
            4, "emission.lines", "the program's line of 557.7 nm is of the Earth alone"},
        Bad{"follows",
            "[body]\nname = \"jupiter\"\n[[line]]\nwavelength_nm = 656.3\nfollows_nm = 557.7\n"
            "[emission]\nlines = [656.3]\n",
            5, "line.line.follows_nm", kOfEarth},
        Bad{"blur", "[body]\nname = \"jupiter\"\n[blur]\nmodel = \"physical\"\n", 4, "blur.model", kOfEarth},
        Bad{"air", "[body]\nname = \"jupiter\"\n[air]\nmodel = \"standard\"\n", 4, "air.model", kOfEarth},
        Bad{"airglow", "[body]\nname = \"jupiter\"\n[airglow]\nsodium_rayleigh = 30\n", 4,
            "airglow.sodium_rayleigh", kOfEarth},
        Bad{"twilight", "[body]\nname = \"jupiter\"\n[twilight]\nshown = true\n", 4, "twilight.shown",
            kOfEarth},
        Bad{"town", "[body]\nname = \"jupiter\"\n[light_pollution]\nluminance_mcd_m2 = 1\n", 4,
            "light_pollution.luminance_mcd_m2", kOfEarth},
        Bad{"ground", "[body]\nname = \"jupiter\"\n[ground]\nshown = true\n", 4, "ground.shown", kOfEarth},
        Bad{"stars",
            "[body]\nname = \"jupiter\"\n[site]\ntime_utc = \"2020-01-01\"\n[stars]\nshown = true\n"
            "source = \"catalogue\"\n",
            7, "stars.source", kOfEarth},
        Bad{"moon", "[body]\nname = \"jupiter\"\n[site]\ntime_utc = \"2020-01-01\"\n[moon]\nshown = true\n",
            6, "moon.shown", kOfEarth}),
    [](const auto& info) { return std::string(info.param.what); });

TEST(Bodies, ButTheEarthHaveNoFitsAndMaps) {
  const Scene jupiter = parse_scene("[body]\nname = \"jupiter\"\n", "j.toml");
  require_earth(Scene(), "a fit");
  tests::expect_words(ErrorKind::scene, {"Earth alone", "jupiter"}, [&] { require_earth(jupiter, "a fit"); });
}

}  // namespace
}  // namespace vegard::sim::bodies_test
