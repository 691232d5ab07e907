#include "sim/emit/aurora/foot_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "sim/light/field/igrf.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim::foot_field_test {
namespace {

Scene scene_at(double latitude_deg, double longitude_deg, FieldModel model) {
  Scene scene;
  scene.field.model = model;
  scene.site.latitude_deg = latitude_deg;
  scene.site.longitude_deg = longitude_deg;
  scene.site.time_utc = "2015-01-01T00:00:00Z";
  return scene;
}

TEST(FootField, FallsAlongTheReferenceFieldInTheNorthAndAgainstItInTheSouth) {
  const Igrf igrf(2015.0);
  for (const auto& [latitude, longitude] : {std::pair{69.6, 19.2}, {-69.0, 39.6}}) {
    const Scene scene = scene_at(latitude, longitude, FieldModel::igrf);
    EXPECT_EQ(falls_along_field(scene), latitude > 0.0);
    const FallFrame<double> frame = FootField(scene).at(0.0, 0.0);
    const FieldVector field = igrf.at(latitude, longitude, kFootAltitudeKm);
    const double size = std::hypot(field.north_nt, field.east_nt, field.down_nt);
    const double sign = latitude > 0.0 ? 1.0 : -1.0;
    EXPECT_NEAR(frame.along[0], sign * field.east_nt / size, 1e-4);
    EXPECT_NEAR(frame.along[1], sign * field.north_nt / size, 1e-4);
    EXPECT_NEAR(frame.along[2], -sign * field.down_nt / size, 1e-4);
    EXPECT_LT(frame.along[2], -0.85);
    EXPECT_EQ(frame.across1[2], 0.0);
    for (const double* axis : {frame.across1, frame.across2}) {
      double dot = 0.0, own = 0.0;
      for (int i = 0; i < 3; ++i) dot += axis[i] * frame.along[i], own += axis[i] * axis[i];
      EXPECT_NEAR(dot, 0.0, 1e-12);
      EXPECT_NEAR(own, 1.0, 1e-12);
    }
  }
}

// Of 2015 the centred dipole is that of the first three coefficients, and over North America the real field's
// declination is far off it.
TEST(FootField, DiffersFromTheDipoleWhereTheEarthDoes) {
  const Scene real = scene_at(61.0, -110.0, FieldModel::igrf),
              dipole = scene_at(61.0, -110.0, FieldModel::dipole);
  const FallFrame<double> a = FootField(real).at(0.0, 0.0), b = FootField(dipole).at(0.0, 0.0);
  double dot = 0.0;
  for (int i = 0; i < 3; ++i) dot += a.along[i] * b.along[i];
  const double off_deg = std::acos(dot) / kRadiansPerDegree;
  EXPECT_GT(off_deg, 2.0);
  EXPECT_LT(off_deg, 12.0);
}

TEST(FootField, IsKeptByPlaceAndTime) {
  Scene scene = scene_at(69.6, 19.2, FieldModel::igrf);
  const auto first = reference_field(scene, scene.site);
  EXPECT_EQ(reference_field(scene, scene.site), first);
  scene.site.time_utc = "1950-01-01T00:00:00Z";
  const auto then = reference_field(scene, scene.site);
  EXPECT_NE(then->coefficient, first->coefficient);
  EXPECT_FALSE(FootField(scene_at(60.0, 0.0, FieldModel::uniform)).varies());
}

}  // namespace
}  // namespace vegard::sim::foot_field_test
