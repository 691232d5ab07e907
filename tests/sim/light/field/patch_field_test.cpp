#include "sim/light/field/field_patch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/base/number/constants.h"
#include "sim/emit/aurora/foot_field.h"
#include "sim/scene/structs/scene.h"
#include "sim/scene/structs/site_axes.h"

namespace vegard::sim::patch_field_test {
namespace {

constexpr double kRadius = kEarthRadiusKm + kFootAltitudeKm;

/// The field at a foot on the sphere, in the Earth's axes.
void exact(const Igrf& igrf, const double unit[3], double field[3]) {
  Site place;
  place.latitude_deg = std::asin(unit[2]) / kRadiansPerDegree;
  place.longitude_deg = std::atan2(unit[1], unit[0]) / kRadiansPerDegree;
  const FieldVector at = igrf.at(place.latitude_deg, place.longitude_deg, kFootAltitudeKm);
  const SiteAxes axes = axes_at(place);
  for (int i = 0; i < 3; ++i)
    field[i] = at.east_nt * axes.axis[0][i] + at.north_nt * axes.axis[1][i] - at.down_nt * axes.axis[2][i];
}

double angle_deg(const double a[3], const double b[3]) {
  double dot = 0.0, aa = 0.0, bb = 0.0;
  for (int i = 0; i < 3; ++i) dot += a[i] * b[i], aa += a[i] * a[i], bb += b[i] * b[i];
  return std::acos(std::min(1.0, dot / std::sqrt(aa * bb))) / kRadiansPerDegree;
}

// Light at 500 km stands 390 km above its foot: 0.01 degrees are 70 m of it.
TEST(FieldPatch, HasTheDirectionsOfTheFieldToAHundredthOfADegree) {
  const Igrf igrf(2015.2);
  for (const auto& [latitude, longitude] : {std::pair{69.6, 19.2}, {65.1, -147.4}, {-77.8, 166.7}}) {
    Site site;
    site.latitude_deg = latitude;
    site.longitude_deg = longitude;
    const SiteAxes axes = axes_at(site);
    const auto patch = plane_field(igrf, site);
    double worst = 0.0;
    for (double east = -2500.0; east <= 2500.0; east += 330.0)
      for (double north = -2500.0; north <= 2500.0; north += 290.0) {
        const double up = std::sqrt(kRadius * kRadius - east * east - north * north);
        double unit[3], want[3], local[3] = {};
        for (int i = 0; i < 3; ++i)
          unit[i] = (east * axes.axis[0][i] + north * axes.axis[1][i] + up * axes.axis[2][i]) / kRadius;
        exact(igrf, unit, want);
        for (int k = 0; k < 3; ++k)
          for (int i = 0; i < 3; ++i) local[k] += want[i] * axes.axis[k][i];
        double field[3];
        field_of_patch(patch->numbers<double>(), east * patch->per_place, north * patch->per_place, field);
        worst = std::max(worst, angle_deg(field, local));
      }
    EXPECT_LT(worst, 0.01) << latitude;
  }
}

TEST(FieldPatch, GoesAroundTheEarthAndStaysWhereTheEarthIsAsTheCubeTurns) {
  const Igrf igrf(2015.2);
  for (const double turned : {0.0, 25.0}) {
    const auto faces = face_fields(igrf, turned);
    double worst = 0.0;
    for (int face = 0; face < 6; ++face)
      for (double u = -1.0; u <= 1.0; u += 0.19)
        for (double v = -1.0; v <= 1.0; v += 0.23) {
          const int a = face / 2;
          double on[3];
          on[a] = face % 2 == 0 ? 1.0 : -1.0;
          on[(a + 1) % 3] = u;
          on[(a + 2) % 3] = v;
          const double size = std::sqrt(1.0 + u * u + v * v), c = std::cos(turned * kRadiansPerDegree),
                       s = std::sin(turned * kRadiansPerDegree);
          const double unit[3] = {(c * on[0] - s * on[1]) / size, (s * on[0] + c * on[1]) / size,
                                  on[2] / size};
          double want[3], field[3];
          exact(igrf, unit, want);
          const FieldPatch& patch = (*faces)[static_cast<std::size_t>(face)];
          field_of_patch(patch.numbers<double>(), evened(u) * patch.per_place, evened(v) * patch.per_place,
                         field);
          const double back[3] = {c * want[0] + s * want[1], c * want[1] - s * want[0], want[2]};
          worst = std::max(worst, angle_deg(field, back));
        }
    EXPECT_LT(worst, 0.05) << turned;
  }
}

TEST(FieldPatch, HasDerivativesThatAreItsDifferences) {
  Scene scene;
  scene.field.model = FieldModel::igrf;
  scene.site.latitude_deg = 67.0;
  scene.site.longitude_deg = -50.0;
  scene.site.time_utc = "2012-02-03T04:05:06Z";
  const FootField field(scene);
  PlaceDual east(240.0), north(-310.0);
  east.d.t[foot_east] = 1.0;
  north.d.t[foot_north] = 1.0;
  const FallFrame<PlaceDual> frame = field.at(east, north);
  constexpr double h = 0.01;
  const FallFrame<double> e1 = field.at(240.0 + h, -310.0), e0 = field.at(240.0 - h, -310.0),
                          n1 = field.at(240.0, -310.0 + h), n0 = field.at(240.0, -310.0 - h);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(frame.along[i].d.t[foot_east], (e1.along[i] - e0.along[i]) / (2.0 * h), 1e-10);
    EXPECT_NEAR(frame.along[i].d.t[foot_north], (n1.along[i] - n0.along[i]) / (2.0 * h), 1e-10);
    EXPECT_NEAR(frame.across1[i].d.t[foot_north], (n1.across1[i] - n0.across1[i]) / (2.0 * h), 1e-9);
  }
  EXPECT_GT(std::abs(frame.along[1].d.t[foot_north]), 1e-5) << "it would pass with none";
}

}  // namespace
}  // namespace vegard::sim::patch_field_test
