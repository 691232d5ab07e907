#include "sim/view/camera/lens.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "sim/base/number/random.h"
#include "sim/view/camera/camera.h"
#include "tests/support/kind_named.h"

namespace vegard::sim::lens_test {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// A camera of a model with everything that a lens may have, where the model has it.
Camera crooked(const std::string& model) {
  Camera camera;
  camera.model = tests::kind_named<LensModel>(model);
  camera.width = 700;
  camera.height = 500;
  camera.hfov_deg = 80.0;
  camera.focal_px = 150.0;
  camera.azimuth_deg = 130.0;
  camera.elevation_deg = 62.0;
  camera.roll_deg = -25.0;
  camera.principal_x_px = 14.0;
  camera.principal_y_px = -9.0;
  camera.aspect = 1.03;
  camera.mirrored = true;
  if (model == "pinhole" || model == "polynomial") {
    camera.k1 = -0.04;
    camera.k2 = 0.003;
    camera.k3 = -0.0001;
  }
  camera.p1 = 0.002;
  camera.p2 = -0.0015;
  return camera;
}

const char* const kModels[] = {"pinhole",       "equidistant",  "equisolid",
                               "stereographic", "orthographic", "polynomial"};
class EveryLens : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Model, EveryLens, testing::ValuesIn(kModels));

TEST_P(EveryLens, LooksWhereItDraws) {
  const CameraView<double> view = camera_view(crooked(GetParam()));
  int seen = 0;
  for (double y = 5.5; y < 500.0; y += 41.0)
    for (double x = 3.5; x < 700.0; x += 37.0) {
      double enu[3], back_x = 0.0, back_y = 0.0;
      if (!enu_of_pixel(view, x, y, enu)) continue;
      ++seen;
      EXPECT_NEAR(enu[0] * enu[0] + enu[1] * enu[1] + enu[2] * enu[2], 1.0, 1e-12);
      ASSERT_TRUE(pixel_of_enu(view, enu, back_x, back_y)) << x << ' ' << y;
      // The orthographic lens's rim is seen edge on: a rounding of the direction is 1e-8 of a radius there.
      EXPECT_NEAR(back_x, x, 1e-6);
      EXPECT_NEAR(back_y, y, 1e-6);
    }
  EXPECT_GT(seen, 40);
}

TEST_P(EveryLens, HasTheRadiusOfItsNameWithoutDistortion) {
  Camera camera;
  camera.model = tests::kind_named<LensModel>(GetParam());
  camera.width = camera.height = 1000;
  camera.hfov_deg = 90.0;  // of a pinhole: 500 pixels to a radian, as focal_px of the others
  camera.focal_px = 500.0;
  camera.elevation_deg = 0.0;
  const CameraView<double> view = camera_view(camera);
  const double degrees = 40.0, theta = degrees * kPi / 180.0;
  // North is ahead; 40 degrees to the east of it lies to the right.
  const double enu[3] = {std::sin(theta), std::cos(theta), 0.0};
  double x = 0.0, y = 0.0;
  ASSERT_TRUE(pixel_of_enu(view, enu, x, y));
  const std::string model = GetParam();
  // Ray, "Applied photographic optics" (2002), chapter 29, to eight digits by hand: f tan theta and so on.
  const double radius = model == "pinhole"         ? 0.83909963
                        : model == "equisolid"     ? 0.68404029
                        : model == "stereographic" ? 0.72794047
                        : model == "orthographic"  ? 0.64278761
                                                   : 0.69813170;
  EXPECT_NEAR(x, 500.0 + 500.0 * radius, 1e-5);
  EXPECT_NEAR(y, 500.0, 1e-9);
}

TEST_P(EveryLens, HasAllOfASkyInItsPixels) {
  // The solid angles of the pixels inside a cone of 50 degrees about the axis: 2 pi (1 - cos 50). A pixel is
  // in or out by its centre, which leaves 1e-3.
  Camera camera = crooked(GetParam());
  camera.p1 = camera.p2 = 0.0;
  camera.focal_px = 200.0;
  camera.hfov_deg = 121.0;
  const Lens<double> lens = camera_view(camera).lens;
  double sum = 0.0;
  for (int y = -100; y < camera.height + 100; ++y)
    for (int x = -100; x < camera.width + 100; ++x) {
      double direction[3];
      if (!unproject(lens, x + 0.5, y + 0.5, direction) || direction[2] < std::cos(50.0 * kPi / 180.0))
        continue;
      sum += pixel_steradians(lens, x + 0.5, y + 0.5);
    }
  EXPECT_NEAR(sum / (2.0 * kPi * (1.0 - std::cos(50.0 * kPi / 180.0))), 1.0, 1e-3);
}

TEST_P(EveryLens, KnowsHowItsLinesOfSightTurn) {
  using LensDual = Dual<double, Tangents<double, camera_numbers>>;
  const Camera camera = crooked(GetParam());
  const CameraView<LensDual> dual = camera_view<LensDual>(camera, [&](CameraNumber which) {
    LensDual number(camera_number(camera, which));
    number.d.t[which] = 1.0;
    return number;
  });
  LensDual enu[3];
  ASSERT_TRUE(enu_of_pixel(dual, 290.5, 333.5, enu));
  for (int n = 0; n < camera_numbers; ++n) {
    const auto which = static_cast<CameraNumber>(n);
    Camera more = camera, less = camera;
    const double step = which >= k1_number ? 1e-6 : 1e-5;
    const_cast<double&>(camera_number(more, which)) += step;
    const_cast<double&>(camera_number(less, which)) -= step;
    double up[3], down[3];
    ASSERT_TRUE(enu_of_pixel(camera_view(more), 290.5, 333.5, up));
    ASSERT_TRUE(enu_of_pixel(camera_view(less), 290.5, 333.5, down));
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(enu[i].d.t[n], (up[i] - down[i]) / (2.0 * step), 2e-8) << GetParam() << " number " << n;
  }
}

TEST_P(EveryLens, IsASeriesOfItsAngle) {
  const std::string model = GetParam();
  const Lens<double> lens = camera_view(crooked(model)).lens;
  // A pinhole has its formula in the kernel, but is a series as well as far as its picture has any size.
  const double end = (model == "pinhole" ? 60.0 : 133.0) * kPi / 180.0;
  const double widest = std::min(std::acos(lens.min_cosine), end);
  const LensSeries<double> series = lens_series(lens, widest);
  for (double theta = 0.01; theta < widest; theta += 0.05) {
    const double half = std::sin(0.5 * theta), q = half * half, t = 2.0 * q / series.max_q - 1.0;
    double value = 0.0, slope = 0.0;
    for (int k = 0; k < series.terms; ++k) {
      value += series.value[k] * std::cos(k * std::acos(std::min(t, 1.0)));
      slope += series.slope[k] * std::cos(k * std::acos(std::min(t, 1.0)));
    }
    EXPECT_NEAR(half * value, radius_of_angle(lens, theta), 2e-8);
    // d rho / d theta = (S / 2 + Q S') cos(theta / 2).
    const double step = 1e-5;
    const double growth =
        (radius_of_angle(lens, theta + step) - radius_of_angle(lens, theta - step)) / (2.0 * step);
    EXPECT_NEAR((0.5 * value + q * slope) * std::cos(0.5 * theta), growth, 2e-6);
  }
}

TEST_P(EveryLens, HasNothingOfItsFilmBeyondItsEdges) {
  Camera camera = crooked(GetParam());
  camera.focal_px = 220.0;
  const Lens<double> lens = camera_view(camera).lens;
  FilmGeometry film;
  film.x0_px = 240.0;
  film.y0_px = 130.0;
  film.columns = 160;
  film.rows = 170;
  const FilmEdges edges = film_edges(lens, film);
  ASSERT_EQ(edges.count, 4);
  // Any seed will do: what is on the film must never be beyond an edge.
  int on_film = 0;
  for (std::uint32_t i = 0; i < 20000; ++i) {
    const Words words = random_words(7, Stream::path, i, 0, 0);
    double direction[3], x = 0.0, y = 0.0;
    for (int k = 0; k < 3; ++k) direction[k] = words[k] / 2147483648.0 - 1.0;
    if (!project(lens, direction, x, y)) continue;
    if (x < film.x0_px || x > film.x0_px + film.columns || y < film.y0_px || y > film.y0_px + film.rows)
      continue;
    ++on_film;
    for (int e = 0; e < edges.count; ++e)
      EXPECT_LE(direction[0] * edges.outward[e][0] + direction[1] * edges.outward[e][1] +
                    direction[2] * edges.outward[e][2],
                0.0);
  }
  EXPECT_GT(on_film, 100);
}

TEST(FilmEdges, KeepNothingOfAWholeSkyOut) {
  // Circles of all sizes in a frame of 200 pixels, up to where the border looks behind the camera.
  for (const char* model : {"equidistant", "equisolid", "stereographic", "polynomial"})
    for (double focal_px = 30.0; focal_px < 160.0; focal_px += 1.7) {
      Camera camera;
      camera.model = tests::kind_named<LensModel>(model);
      camera.width = camera.height = 200;
      camera.focal_px = focal_px;
      const Lens<double> lens = camera_view(camera).lens;
      FilmGeometry film;
      film.columns = film.rows = 200;
      const FilmEdges edges = film_edges(lens, film);
      for (double y = 0.5; y < 200.0; y += 13.0)
        for (double x = 0.5; x < 200.0; x += 13.0) {
          double direction[3];
          if (!unproject(lens, x, y, direction)) continue;
          for (int e = 0; e < edges.count; ++e)
            ASSERT_LE(direction[0] * edges.outward[e][0] + direction[1] * edges.outward[e][1] +
                          direction[2] * edges.outward[e][2],
                      0.0)
                << model << ' ' << focal_px << " px, at " << x << ' ' << y;
        }
    }
}

// The fold is found without a search through all radii; terms as in lenses that are fitted to noise, 400
// draws.
TEST(Lens, EndsAtTheFirstOfItsFolds) {
  int folds = 0;
  for (std::uint32_t draw = 0; draw < 400; ++draw) {
    const Words words = random_words(5, Stream::stars, draw);
    const double k1 = 0.8 * (uniform(words[0]) - 0.5), k2 = 0.3 * (uniform(words[1]) - 0.5),
                 k3 = 0.1 * (uniform(words[2]) - 0.5);
    constexpr int kSteps = 20000;
    constexpr double kEnd = 170.0 * kPi / 180.0;
    double fold = kEnd;
    for (int i = 1; i <= kSteps; ++i) {
      const double r2 = std::pow(kEnd * i / kSteps, 2);
      if (1.0 + r2 * (3.0 * k1 + r2 * (5.0 * k2 + r2 * 7.0 * k3)) > 0.0) continue;
      fold = kEnd * i / kSteps;
      ++folds;
      break;
    }
    // A step of this search, and one of the lens's own 4096 for a fold that is as narrow as that.
    EXPECT_NEAR(std::acos(min_cosine(LensModel::polynomial, k1, k2, k3)), fold, 2.0 * kEnd / 4096) << draw;
  }
  EXPECT_GT(folds, 100);
  EXPECT_LT(folds, 399);
}

TEST(Lens, EndsWhereItsTermsWouldFoldThePictureBack) {
  // r (1 - 0.1 r^2) grows up to r = sqrt(1 / 0.3).
  const double fold = std::sqrt(1.0 / 0.3);
  EXPECT_NEAR(min_cosine(LensModel::pinhole, -0.1, 0.0, 0.0), 1.0 / std::sqrt(1.0 + fold * fold), 1e-9);
  EXPECT_NEAR(min_cosine(LensModel::polynomial, -0.1, 0.0, 0.0), std::cos(fold), 1e-9);
  EXPECT_EQ(min_cosine(LensModel::pinhole, 0.1, 0.0, 0.0), 0.0);
  // r (1 - 0.02 r^4) up to r^4 = 1 / 0.1, r (1 - 0.01 r^6) up to r^6 = 1 / 0.07, and r (1 - 0.5 r^2 + 0.09
  // r^4) to the lesser root of 1 - 1.5 r^2 + 0.45 r^4.
  const double of_k2 = std::pow(10.0, 0.25), of_k3 = std::pow(1.0 / 0.07, 1.0 / 6.0),
               of_both = std::sqrt((1.5 - std::sqrt(1.5 * 1.5 - 4.0 * 0.45)) / (2.0 * 0.45));
  EXPECT_NEAR(min_cosine(LensModel::polynomial, 0.0, -0.02, 0.0), std::cos(of_k2), 1e-9);
  EXPECT_NEAR(min_cosine(LensModel::polynomial, 0.0, 0.0, -0.01), std::cos(of_k3), 1e-9);
  EXPECT_NEAR(min_cosine(LensModel::polynomial, -0.5, 0.09, 0.0), std::cos(of_both), 1e-9);
  Camera camera;
  camera.model = LensModel::polynomial;
  camera.k1 = -0.1;
  camera.focal_px = 100.0;
  camera.elevation_deg = 90.0;
  const CameraView<double> view = camera_view(camera);
  const double beyond[3] = {std::sin(fold + 0.01), 0.0, std::cos(fold + 0.01)};
  double x = 0.0, y = 0.0;
  EXPECT_FALSE(pixel_of_enu(view, beyond, x, y));
  double enu[3];
  EXPECT_FALSE(enu_of_pixel(view, 360.0 + 100.0 * fold, 240.0, enu)) << "nor is any radius as large as this";
  EXPECT_TRUE(std::isnan(direction_of_pixel(camera, 360.0 + 100.0 * fold, 240.0).elevation_deg));
}

TEST(Lens, AMirrorExchangesLeftAndRight) {
  Camera camera;
  camera.elevation_deg = 10.0;
  const Direction right = direction_of_pixel(camera, 500.0, 240.0);
  camera.mirrored = true;
  const Direction left = direction_of_pixel(camera, 220.0, 240.0);
  EXPECT_NEAR(left.azimuth_deg, right.azimuth_deg, 1e-9);
  EXPECT_NEAR(left.elevation_deg, right.elevation_deg, 1e-9);
}

TEST(Lens, WidestAngleIsThatOfTheFarthestCorner) {
  Camera camera;
  camera.model = LensModel::equidistant;
  camera.width = 301;
  camera.height = 401;
  camera.focal_px = 250.0;
  FilmGeometry film;
  film.columns = 300;
  film.rows = 400;
  // Half a diagonal of (301 + 1, 401 + 1), off the middle by half a pixel.
  EXPECT_NEAR(widest_angle_rad(camera_view(camera).lens, film), std::hypot(151.5, 201.5) / 250.0, 1e-9);
}

}  // namespace
}  // namespace vegard::sim::lens_test
