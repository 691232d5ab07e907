#include "sim/emit/footprint/foot.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/emit/aurora/beam.h"
#include "sim/emit/aurora/foot_field.h"
#include "sim/emit/footprint/foot_projection.h"
#include "sim/scene/structs/site_axes.h"

namespace vegard::sim::foot_test {
namespace {

/// The point of a beam, from the Earth's centre.
AirPoint<double> point_of_beam(const Beam<double>& beam, const FallFrame<double>& fall, double part) {
  AirPoint<double> p;
  for (int i = 0; i < 3; ++i)
    p.x[i] =
        beam.start_in_enu_km[i] + part * beam.length_km * fall.along[i] + (i == 2 ? kEarthRadiusKm : 0.0);
  p.square = p.x[0] * p.x[0] + p.x[1] * p.x[1] + p.x[2] * p.x[2] - kEarthRadiusKm * kEarthRadiusKm;
  return p;
}

TEST(Foot, IsThatOfTheBeamThroughThePoint) {
  const FallFrame<double> fall = fall_frame(75.0 * kRadiansPerDegree, 12.0 * kRadiansPerDegree);
  for (const double east : {-700.0, 0.0, 300.0})
    for (const double north : {-400.0, 50.0, 900.0}) {
      const Beam<double> beam = start_beam(east, north, fall, 0.0, 500.0, 80.0);
      for (const double part : {0.0, 0.3, 0.9, 1.0}) {
        const PlaneFoot<double> foot =
            foot_along(point_of_beam(beam, fall, part), fall.along, kEarthRadiusKm);
        ASSERT_TRUE(foot.is_there);
        EXPECT_NEAR(foot.east_km, east, 1e-8);
        EXPECT_NEAR(foot.north_km, north, 1e-8);
      }
    }
}

TEST(Foot, OfADipoleIsThatOfItsBeamToAFewMetres) {
  Field field;
  Site site;
  const DipoleAxis axis = dipole_axis(field, site);
  for (const double east : {-700.0, 0.0, 300.0})
    for (const double north : {-400.0, 50.0, 900.0}) {
      const FallFrame<double> fall = dipole_fall_frame(axis, east, north);
      const Beam<double> beam = start_beam(east, north, fall, 0.0, 300.0, 80.0);
      for (const double part : {0.0, 0.3, 0.9, 1.0}) {
        const PlaneFoot<double> foot =
            foot_of_dipole(point_of_beam(beam, fall, part), axis.in_enu, kEarthRadiusKm);
        ASSERT_TRUE(foot.is_there);
        EXPECT_NEAR(foot.east_km, east, 0.02);
        EXPECT_NEAR(foot.north_km, north, 0.02);
      }
    }
}

// A shell's light falls along the field: a point of a beam has its foot around the Earth where the beam has
// it. The fields of plane and globe are fitted apart, by some thousandths of a degree: 0.1 km over 390.
TEST(Foot, AroundTheEarthIsThatOfTheBeam) {
  Scene scene;
  scene.site.latitude_deg = 66.0;
  scene.site.longitude_deg = 25.0;
  scene.site.time_utc = "2015-03-20T00:00:00Z";
  const SiteAxes axes = axes_at(scene.site);
  for (const FieldModel model : {FieldModel::dipole, FieldModel::igrf}) {
    scene.field.model = model;
    Footprint shell;
    shell.shape = FootprintShape::shell;
    const FootRule<double> rule = rule_of_foot<double>(scene, shell, [](const double& n) { return n; });
    const FootField field(scene);
    for (const double east : {-700.0, 0.0, 300.0})
      for (const double north : {-400.0, 50.0, 900.0}) {
        const FallFrame<double> fall = field.at(east, north);
        const Beam<double> beam = start_beam(east, north, fall, 0.0, 500.0, 80.0);
        for (const double part : {0.0, 0.3, 0.9, 1.0}) {
          const AirPoint<double> local = point_of_beam(beam, fall, part);
          AirPoint<double> p;
          p.square = local.square;
          double want[3];
          constexpr double kRadius = kEarthRadiusKm + kFootAltitudeKm;
          const double up = std::sqrt(kRadius * kRadius - east * east - north * north);
          for (int a = 0; a < 3; ++a) {
            p.x[a] =
                local.x[0] * axes.axis[0][a] + local.x[1] * axes.axis[1][a] + local.x[2] * axes.axis[2][a];
            want[a] = east * axes.axis[0][a] + north * axes.axis[1][a] + up * axes.axis[2][a];
          }
          const int face = static_cast<int>(face_number(p));
          const AirPoint<double> foot =
              model == FieldModel::dipole
                  ? foot_in_dipole_around_body(p, rule.axis, kEarthRadiusKm)
                  : foot_in_patch_around_earth(
                        p, face, (*rule.patches)[static_cast<std::size_t>(face)].numbers<double>(),
                        (*rule.patches)[static_cast<std::size_t>(face)].per_place);
          for (int a = 0; a < 3; ++a) EXPECT_NEAR(foot.x[a], want[a], 0.15) << part;
        }
      }
  }
}

TEST(Foot, IsMissingWhereTheLineRisesOrPassesTheEarth) {
  const double level[3] = {0.0, 1.0, 0.0};
  AirPoint<double> p{{0.0, -100.0, kEarthRadiusKm + 300.0}, 0.0};
  p.square = 100.0 * 100.0 + 300.0 * (300.0 + 2.0 * kEarthRadiusKm);
  EXPECT_FALSE(foot_along(p, level, kEarthRadiusKm).is_there);
  AirPoint<double> behind = p;
  behind.x[2] = -p.x[2];
  EXPECT_FALSE(foot_below(behind, kEarthRadiusKm).is_there);
}

TEST(Foot, StandsOnTheFaceThatReachesFarthest) {
  // A direction of each face, and its u and v by hand.
  const double directions[6][3] = {{5e3, 1e3, 2e3},  {-5e3, 1e3, 2e3}, {2e3, 5e3, 1e3},
                                   {2e3, -5e3, 1e3}, {1e3, 2e3, 5e3},  {1e3, 2e3, -5e3}};
  for (int face = 0; face < 6; ++face) {
    AirPoint<double> p;
    for (int i = 0; i < 3; ++i) p.x[i] = directions[face][i];
    p.square = 0.0;
    EXPECT_EQ(face_number(p), face);
    const FacePlace<double> at = place_on_face(p, face);
    EXPECT_NEAR(at.u, 0.2, 1e-12);
    EXPECT_NEAR(at.v, 0.4, 1e-12);
    EXPECT_GT(at.ahead, 0.0);
    EXPECT_LT(place_on_face(p, face ^ 1).ahead, 0.0);
  }
}

}  // namespace
}  // namespace vegard::sim::foot_test
