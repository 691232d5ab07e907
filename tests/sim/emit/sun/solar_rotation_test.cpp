// How the Sun turns: periods that are known, and what stands on it gone on by them.
#include "sim/emit/sun/solar_rotation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/emit/sun/chromosphere_density.h"
#include "sim/emit/sun/strand/bundle.h"
#include "sim/emit/sun/strand/flux_rope.h"
#include "sim/emit/sun/strand/macro_loop.h"
#include "sim/emit/sun/sun_frame.h"

namespace vegard::sim::solar_rotation_test {
namespace {

constexpr double kDay_s = 86400.0, kDegree = 3.14159265358979323846 / 180.0;

double degrees_a_day(SolarRotation rotation, RotationFrame frame, double latitude_deg) {
  const double sine = std::sin(latitude_deg * kDegree);
  return rotation_rad_s(rotation, frame, sine * sine) * kDay_s / kDegree;
}

Sun turning(SolarRotation rotation, RotationFrame frame = RotationFrame::sidereal) {
  Sun sun;
  sun.shown = true;
  sun.rotation = rotation;
  sun.rotation_frame = frame;
  return sun;
}

double longitude_deg(const Vec3<double>& place) { return std::atan2(place[1], place[0]) / kDegree; }
double latitude_deg(const Vec3<double>& place) { return std::asin(place[2] / length3(place)) / kDegree; }

// The magnetic field's rates of Snodgrass and Ulrich (1990) in degrees a day, as SolarSoft's diff_rot.pro and
// SunPy's diff_rot have them: 14.252 - 1.678 sin² b - 2.401 sin⁴ b, to the last digit that they give.
TEST(SolarRotation, HasTheRatesOfTheLiterature) {
  for (const double latitude : {0.0, 15.0, -30.0, 45.0, 60.0, 90.0}) {
    const double square = std::pow(std::sin(latitude * kDegree), 2);
    EXPECT_NEAR(degrees_a_day(SolarRotation::differential, RotationFrame::sidereal, latitude),
                14.252 - 1.678 * square - 2.401 * square * square, 0.0015)
        << latitude;
  }
  // Carrington's rotation: 25.38 days for the stars, 27.2753 for the Earth, at all latitudes.
  for (const double latitude : {0.0, 50.0}) {
    EXPECT_NEAR(360.0 / degrees_a_day(SolarRotation::rigid, RotationFrame::sidereal, latitude), 25.38, 1e-9);
    EXPECT_NEAR(360.0 / degrees_a_day(SolarRotation::rigid, RotationFrame::synodic, latitude), 27.2753, 1e-4);
  }
  // Seen from the Earth everything is later by its mean motion, 0.9856 degrees a day.
  EXPECT_NEAR(degrees_a_day(SolarRotation::differential, RotationFrame::sidereal, 20.0) -
                  degrees_a_day(SolarRotation::differential, RotationFrame::synodic, 20.0),
              0.9856, 1e-4);
}

TEST(SolarRotation, BringsAFootOnTheEquatorRoundInThePeriod) {
  // 360 / 14.252 days, which that number's last digit leaves open by 1e-4 of itself.
  const Sun sun = turning(SolarRotation::differential);
  Loop loop;
  loop.bearing_deg = 90.0;
  loop.strands = 1;
  const double period = 360.0 / 14.252 * kDay_s;
  const auto foot = [&](double instant) {
    return strands_of<double>(sun, loop, 1, plain_number, instant).all[0].points[0];
  };
  const double first = longitude_deg(foot(0.0));
  EXPECT_NEAR(longitude_deg(foot(period)), first, 0.04);
  EXPECT_NEAR(longitude_deg(foot(0.25 * period)), first + 90.0, 0.01) << "to the west";
}

TEST(SolarRotation, TakesEitherFootOfALoopByItsOwnLatitude) {
  const Sun sun = turning(SolarRotation::differential, RotationFrame::synodic);
  Loop loop;
  loop.latitude_deg = 30.0;
  loop.longitude_deg = -20.0;
  loop.bearing_deg = 10.0;
  loop.width = 300.0;
  loop.strands = 5;
  loop.root_noise = 10.0;
  const double instant = 3.0 * kDay_s;
  const Strands<double> first = strands_of<double>(sun, loop, 1, plain_number),
                        later = strands_of<double>(sun, loop, 1, plain_number, instant);
  for (std::size_t k = 0; k < first.all.size(); ++k)
    for (const int p : {0, 1, 2, 3}) {
      const Vec3<double>&from = first.all[k].points[p], &to = later.all[k].points[p];
      const double of_foot = latitude_deg(first.all[k].points[p < 2 ? 0 : 3]);
      EXPECT_NEAR(to[2], from[2], 1e-12 * length3(from)) << "turned about the axis";
      EXPECT_NEAR(length3(to), length3(from), 1e-12 * length3(from));
      EXPECT_NEAR(longitude_deg(to) - longitude_deg(from),
                  3.0 * degrees_a_day(SolarRotation::differential, RotationFrame::synodic, of_foot), 1e-9);
    }
}

TEST(SolarRotation, TakesBundlesByTheirFeetAndEjectionsByTheirPlaces) {
  const Sun sun = turning(SolarRotation::differential);
  const double instant = 5.0 * kDay_s;
  Bundle bundle;
  bundle.count = 50;
  bundle.filaments = 5;
  const Strands<double> first = strands_of<double>(sun, bundle, 1, plain_number),
                        later = strands_of<double>(sun, bundle, 1, plain_number, instant);
  ASSERT_EQ(first.all.size(), later.all.size());
  for (std::size_t k = 0; k < first.all.size(); ++k) {
    // All of a line by the angle of its foot, which is a third of (length + foot_radius) along, less it.
    Vec3<double> foot = first.all[k].points[0];
    foot = along3(foot, bundle.foot_radius / (bundle.length + bundle.foot_radius),
                  minus3(first.all[k].points[3], foot));
    const double angle =
        5.0 * degrees_a_day(SolarRotation::differential, RotationFrame::sidereal, latitude_deg(foot)) *
        kDegree;
    for (int p = 0; p < 4; ++p) {
      const Vec3<double> want = turned_west(first.all[k].points[p], angle);
      EXPECT_LT(length3(minus3(want, later.all[k].points[p])), 1e-9 * length3(want));
    }
  }
  Ejection ejection;
  ejection.latitude_deg = -25.0;
  ejection.longitude_deg = 40.0;
  ejection.speed_km_s = 0.0;
  EXPECT_NEAR(ejection_longitude_deg<double>(sun, instant, ejection, plain_number),
              40.0 + 5.0 * degrees_a_day(SolarRotation::differential, RotationFrame::sidereal, -25.0), 1e-9);
}

TEST(SolarRotation, TakesGranulesAlong) {
  Scene scene;
  scene.sun = turning(SolarRotation::differential);
  scene.chromospheres.emplace_back();
  scene.chromospheres[0].cutoff = false;
  const ChromosphereDensity<double> first(scene, 0, nullptr, plain_number, 0.0),
      later(scene, 0, nullptr, plain_number, 10.0 * kDay_s);
  int differ = 0;
  for (int k = 0; k < 40; ++k) {
    const double z = 700.0 * std::sin(0.07 * (k - 20)), level = std::sqrt(700.0 * 700.0 - z * z);
    const Vec3<double> place = {level * std::cos(1.0 * k), level * std::sin(1.0 * k), z};
    const double angle =
        10.0 * degrees_a_day(SolarRotation::differential, RotationFrame::sidereal, latitude_deg(place)) *
        kDegree;
    EXPECT_NEAR(later.at(turned_west(place, angle).data()), first.at(place.data()), 1e-9);
    differ += later.at(place.data()) != first.at(place.data());
  }
  EXPECT_GT(differ, 30);
}

TEST(SolarRotation, LeavesASunThatDoesNotTurnAsItIsToTheLastBit) {
  const Sun still = turning(SolarRotation::none);
  Loop loop;
  loop.root_noise = 5.0;
  Bundle bundle;
  const auto same = [](const Strands<double>& a, const Strands<double>& b) {
    for (std::size_t k = 0; k < a.all.size(); ++k) EXPECT_EQ(a.all[k].points, b.all[k].points);
  };
  same(strands_of<double>(still, loop, 1, plain_number),
       strands_of<double>(still, loop, 1, plain_number, 1e6));
  same(strands_of<double>(still, bundle, 1, plain_number),
       strands_of<double>(still, bundle, 1, plain_number, 1e6));
  EXPECT_EQ(degrees_a_day(SolarRotation::none, RotationFrame::synodic, 10.0), 0.0);
}

}  // namespace
}  // namespace vegard::sim::solar_rotation_test
