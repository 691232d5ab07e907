#include "fit/triangulation/curtain_profiles.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "sim/base/image.h"
#include "sim/base/number/constants.h"
#include "sim/light/field/igrf.h"

namespace vegard::fit::curtain_profiles_test {
namespace {

constexpr double kBorder_km = 103.0, kYear = 2014.0;
constexpr EarthShape kShape = EarthShape::wgs84;

ViewPoint all_sky(double latitude_deg, double longitude_deg) {
  PlacedCamera camera;
  camera.camera.model = sim::LensModel::equidistant;
  camera.camera.width = camera.camera.height = 400;
  camera.camera.focal_px = 130.0;
  camera.camera.elevation_deg = 90.0;
  camera.site.latitude_deg = latitude_deg;
  camera.site.longitude_deg = longitude_deg;
  return ViewPoint(camera, kShape);
}

/// A thin curtain through 68.2° N, 20° E, from west to east and along the field there.
struct Curtain {
  Eigen::Vector3d origin_km, east, rise, normal;

  Curtain() {
    const GeodeticPlace place{68.2, 20.0, kBorder_km};
    origin_km = earth_place_km(kShape, place);
    const Eigen::Matrix3d axes = east_north_up(place);
    east = axes.row(0);
    const sim::FieldVector field = sim::Igrf(kYear).at(68.2, 20.0, kBorder_km);
    rise = axes.transpose() *
           Eigen::Vector3d(-field.east_nt / field.down_nt, -field.north_nt / field.down_nt, 1.0);
    normal = east.cross(rise).normalized();
  }

  /// The light at a distance along the curtain and a height: a border with half of the peak at kBorder_km, a
  /// slow fall above, and stripes if it has any.
  static double light(double along_km, double height_km, double stripes) {
    if (std::abs(along_km) > 110.0) return 0.0;
    const double above = height_km - kBorder_km;
    const double profile = 1.0 / (1.0 + std::exp(-above / 1.5)) * std::exp(-std::max(0.0, above) / 18.0);
    return profile *
           (1.0 + stripes * (0.5 * std::sin(along_km / 4.0) + 0.3 * std::sin(along_km / 9.0 + 1.0)));
  }

  Photo seen_by(const ViewPoint& view, double gain, double gamma, double stripes,
                const Eigen::Vector3d& moved_km) const {
    sim::Image image(400, 400, {"L"});
    for (int y = 0; y < 400; ++y)
      for (int x = 0; x < 400; ++x) {
        double sum = 0.0;
        const auto direction = view.direction({x + 0.5, y + 0.5});
        if (direction) {
          const Eigen::Vector3d from = view.place_km() - moved_km - origin_km;
          const double distance = -from.dot(normal) / direction->dot(normal);
          const Eigen::Vector3d place = from + distance * *direction;
          const double height_km = geodetic_place(kShape, origin_km + place).height_km;
          const double along = (place - (height_km - kBorder_km) * rise).dot(east);
          if (distance > 0.0 && height_km > 60.0 && height_km < 200.0) sum = light(along, height_km, stripes);
        }
        image.at(x, y, 0) = static_cast<float>(gain * std::pow(0.05 + sum, gamma));
      }
    return photo_of_light(image, {}, "curtain");
  }

  BorderCurve border_in(const ViewPoint& view, std::size_t camera) const {
    BorderCurve curve;
    for (const double level_km : {0.0, 0.6}) {
      PictureCurve& one = level_km == 0.0 ? curve.border : curve.higher;
      one.camera = camera;
      for (double along = -100.0; along <= 100.0; along += 2.5) {
        // Down to the border's height: the Earth is round.
        Eigen::Vector3d place = origin_km + along * east;
        for (int i = 0; i < 3; ++i)
          place += (kBorder_km + level_km - geodetic_place(kShape, place).height_km) * rise;
        one.points.push_back(view.pixel(place).value());
        one.error_px.push_back(0.2);
      }
    }
    return curve;
  }
};

ProfileMatch match_of(const std::vector<ViewPoint>& views, const Photo& a, const Photo& b,
                      const BorderCurve& curve) {
  ProfileSettings settings;
  settings.year = kYear;
  settings.range = {87.0, 123.0};
  return profile_match(views, {&a, &b}, curve, settings);
}

TEST(CurtainProfiles, FindTheBorderAlongTheBaseWhateverTheToneCurves) {
  const Curtain curtain;
  const std::vector<ViewPoint> views = {all_sky(67.0, 19.4), all_sky(67.0, 21.0)};
  const Photo a = curtain.seen_by(views[0], 1.0, 1.0, 1.0, Eigen::Vector3d::Zero());
  // The light has moved by 2 km to the north, which is to the left of a base to the east.
  const Eigen::Vector3d north = east_north_up({68.2, 20.0, 0.0}).row(1);
  const Photo b = curtain.seen_by(views[1], 0.3, 0.5, 1.0, 2.0 * north);
  const ProfileMatch found = match_of(views, a, b, curtain.border_in(views[0], 0));
  ASSERT_TRUE(found.is_given());
  EXPECT_TRUE(found.is_clear());
  EXPECT_GT(found.weight, 0.99);
  EXPECT_GT(found.correlation, 0.9);
  // A pixel is 1.5 km at this distance; its hundredth parts do not show in a cubic or in boxes of pixels.
  EXPECT_NEAR(found.border_km, kBorder_km, 1.5);
  EXPECT_NEAR(found.border_km, kBorder_km, 3.0 * std::sqrt(found.covariance_km2(0, 0)));
  EXPECT_NEAR(found.across_km, 2.0, 0.6);
  // The height over the base: 103 km over 70 km, for a movement of 1 km along it.
  EXPECT_NEAR(found.border_km_per_km, kBorder_km / 70.0, 0.25);
  // Where the logistic border and the exponential fall meet, the light is brightest: 1.5 ln(18 / 1.5 - 1) km.
  EXPECT_NEAR(found.profiles.peak_above_km, 3.6, 1.0);
}

TEST(CurtainProfiles, GiveNoHeightOfOtherLight) {
  const Curtain curtain;
  const std::vector<ViewPoint> views = {all_sky(67.0, 19.4), all_sky(67.0, 21.0)};
  const Photo a = curtain.seen_by(views[0], 1.0, 1.0, 1.0, Eigen::Vector3d::Zero());
  sim::Image waves(400, 400, {"L"});
  for (int y = 0; y < 400; ++y)
    for (int x = 0; x < 400; ++x)
      waves.at(x, y, 0) =
          static_cast<float>(0.5 + 0.2 * std::sin(x / 5.0 + 0.01 * y) + 0.2 * std::sin(y / 7.0));
  const Photo b = photo_of_light(waves, {}, "waves");
  const ProfileMatch found = match_of(views, a, b, curtain.border_in(views[0], 0));
  EXPECT_FALSE(found.is_clear());
}

ProfileMatch made(double border_km, double error_km) {
  ProfileMatch match;
  match.border_km = border_km;
  match.across_km = 0.0;
  match.covariance_km2 = Eigen::Vector2d(error_km * error_km, 1.0).asDiagonal();
  match.weight = match.correlation = match.alike = 0.95;
  return match;
}

TEST(CurtainProfiles, OfBothBordersAreJoined) {
  const ProfileMatch joined = joined_profiles(made(104.0, 1.0), made(106.0, 1.0));
  EXPECT_DOUBLE_EQ(joined.border_km, 105.0);
  EXPECT_DOUBLE_EQ(joined.covariance_km2(0, 0), 2.0);  // their own, and half of the difference
  EXPECT_DOUBLE_EQ(joined_profiles(ProfileMatch(), made(106.0, 1.0)).border_km, 106.0);
  ProfileMatch worse = made(130.0, 1.0);
  worse.correlation = 0.6;
  const ProfileMatch contradicted = joined_profiles(worse, made(104.0, 1.0));
  EXPECT_DOUBLE_EQ(contradicted.border_km, 104.0);
  EXPECT_DOUBLE_EQ(contradicted.contradicting_km, 130.0);
  EXPECT_TRUE(std::isnan(joined.contradicting_km));
  worse.alike = 0.2;  // no clear height: it contradicts nothing
  EXPECT_TRUE(std::isnan(joined_profiles(made(104.0, 1.0), worse).contradicting_km));
  EXPECT_FALSE(joined_profiles(ProfileMatch(), ProfileMatch()).is_given());
}

}  // namespace
}  // namespace vegard::fit::curtain_profiles_test
