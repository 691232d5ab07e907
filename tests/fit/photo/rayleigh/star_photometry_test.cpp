// A camera's factor out of made pictures: the stars of a real sky and an airglow of known rayleighs, seen by
// a lens of a known collecting area through the air, with the noise of photons and of reading.
#include "fit/photo/rayleigh/star_photometry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/base/error.h"
#include "sim/base/number/constants.h"
#include "sim/base/number/distributions.h"
#include "sim/view/camera/camera.h"
#include "sim/view/sky/bright_stars.h"
#include "sim/view/sky/night_sky.h"
#include "sim/view/sky/star_photometry.h"
#include "sim/view/sky/star_place.h"
#include "tests/support/expect_error.h"
#include "tests/support/star_field.h"

namespace vegard::fit::star_photometry_test {
namespace {

/// A pixel of 0.24 degrees: with wider ones most stars have a neighbour in their circle. Of the lens, in
/// counts per photon through the filter. With it a pixel of the middle has a count per second of 25 R.
constexpr int kSide = 768;
constexpr double kFocal_px = 240.0, kFactor = 25.0, kDepth = 0.22, kAirglow_R = 250.0, kExposure_s = 100.0;
constexpr double kStarSigma_px = 0.8, kReadNoise = 5.0, kScatter = 0.05;

sim::Scene all_sky() {
  sim::Scene scene;
  scene.site.latitude_deg = 65.126;
  scene.site.longitude_deg = -147.479;
  scene.site.altitude_m = 200.0;
  scene.camera.model = sim::LensModel::equidistant;
  scene.camera.width = scene.camera.height = kSide;
  scene.camera.focal_px = kFocal_px;
  scene.camera.elevation_deg = 90.0;
  return scene;
}

FilterBand green_filter() {
  FilterBand band;
  band.line_nm = band.centre_nm = 557.7;
  band.width_nm = 2.0;
  return band;
}

/// Collecting area times counts per photon, cm^2, of a place where the pixel has this solid angle. An even
/// sky is even in the picture (flat = 1): what a lens of even illumination does.
double area_cm2(double steradians) { return 1.0 / (kFactor * 1e6 / (4.0 * sim::kPi) * steradians); }

double share_in_pixel(int at, double centre) {
  const double width = std::sqrt(2.0) * kStarSigma_px;
  return 0.5 * (std::erf((at + 1.0 - centre) / width) - std::erf((at - centre) / width));
}

/// The mean counts of one exposure, without noise: each star off by a factor of its own, airglow by van
/// Rhijn. Nothing of what is tested has a part in it but the stars' spectra.
sim::Image mean_counts(const sim::Scene& scene, double julian_date, std::uint64_t seed) {
  sim::Image counts(kSide, kSide, {"counts"});
  const sim::CameraView<double> view = sim::camera_view(scene.camera);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      double enu[3];
      if (!sim::enu_of_pixel(view, x + 0.5, y + 0.5, enu) || enu[2] < 0.05) continue;
      const double omega = sim::pixel_steradians(view.lens, x + 0.5, y + 0.5);
      const double rayleighs = kAirglow_R * sim::van_rhijn(enu[2], 97.0, 0.2) * std::exp(-kDepth / enu[2]);
      counts.at(x, y, 0) +=
          static_cast<float>(kExposure_s * rayleighs * 1e6 / (4.0 * sim::kPi) * omega * area_cm2(omega));
    }
  const sim::Observer observer{scene.site.latitude_deg, scene.site.longitude_deg, scene.site.altitude_m,
                               true};
  for (const sim::BrightStar& star : sim::catalogue_stars()) {
    const std::array<double, 3> enu = sim::direction_of_star(star.place, observer, julian_date);
    double x_px = 0.0, y_px = 0.0;
    if (enu[2] < 0.09 || !sim::pixel_of_enu(view, enu.data(), x_px, y_px)) continue;
    if (x_px < 12.0 || y_px < 12.0 || x_px > kSide - 12.0 || y_px > kSide - 12.0) continue;
    // Through a filter of 2 nm about the line, by its light there.
    const double photons = 2.0 * sim::star_photons_cm2_s_nm(star.magnitude, star.colour_index, 557.7);
    const double elevation_deg = std::asin(enu[2]) / sim::kRadiansPerDegree;
    const double own = 1.0 + kScatter * tests::normal(seed, static_cast<std::uint32_t>(star.hip), 5);
    const double total = kExposure_s * photons * area_cm2(sim::pixel_steradians(view.lens, x_px, y_px)) *
                         own * std::exp(-kDepth * relative_airmass(elevation_deg));
    for (int y = static_cast<int>(y_px) - 9; y <= static_cast<int>(y_px) + 9; ++y)
      for (int x = static_cast<int>(x_px) - 9; x <= static_cast<int>(x_px) + 9; ++x)
        counts.at(x, y, 0) += static_cast<float>(total * share_in_pixel(x, x_px) * share_in_pixel(y, y_px));
  }
  return counts;
}

/// A gain of one electron to the count.
CountPicture exposed(const sim::Image& mean, std::uint64_t seed) {
  CountPicture picture;
  picture.rate = mean;
  picture.variance.resize(mean.data.size());
  picture.usable.assign(mean.data.size(), 1);
  picture.exposure_s = kExposure_s;
  picture.is_noise_known = true;
  for (std::size_t i = 0; i < mean.data.size(); ++i) {
    const auto number = static_cast<std::uint32_t>(i);
    const double counts = sim::poisson(mean.data[i], seed, sim::Stream::photon_noise, number, 0, 0) +
                          kReadNoise * tests::normal(seed, number, 9);
    picture.rate.data[i] = static_cast<float>(counts / kExposure_s);
    picture.variance[i] =
        static_cast<float>((std::max(counts, 0.0) + kReadNoise * kReadNoise) / (kExposure_s * kExposure_s));
  }
  return picture;
}

const double kDate = *sim::julian_date("2015-10-07T08:23:51Z");

TEST(StarPhotometry, FindsAFactorWithIntervalsThatHold) {
  // Seeds 1 to 24, a picture each. Of the independent answers 16.4 ± 2.3 lie within a true interval of 68.3
  // %: three deviations allow 10 to 23. The mean of what they are off by, in their errors, is 0 ± 1 /
  // sqrt(24); three of these, and a fifth for the stars' light outside of the circle (0.01 % of a Gaussian)
  // and what is left of neighbours.
  const sim::Scene scene = all_sky();
  int within = 0, depth_within = 0;
  double mean_off = 0.0;
  constexpr int kSeeds = 24;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    StarPhotometer photometer(scene, green_filter(), {});
    photometer.add(exposed(mean_counts(scene, kDate, seed), seed), kDate);
    const StarFactor found = photometer.answer("made");
    ASSERT_EQ(found.extinction, ExtinctionBy::stars);
    ASSERT_GT(found.degrees_of_freedom, 20);
    const double off = std::log(found.factor.value / kFactor) / found.star_error;
    within += std::abs(off) < 1.0 ? 1 : 0;
    depth_within +=
        std::abs(found.magnitudes_per_airmass - 1.0857 * kDepth) < *found.extinction_error ? 1 : 0;
    mean_off += off / kSeeds;
    EXPECT_LT(found.star_error, 0.15);
  }
  EXPECT_GE(within, 10);
  EXPECT_LE(within, 23);
  EXPECT_GE(depth_within, 10);
  EXPECT_LE(depth_within, 23);
  EXPECT_LT(std::abs(mean_off), 3.0 / std::sqrt(kSeeds) + 0.2);
  RecordProperty("within", within);
  RecordProperty("depth_within", depth_within);
  RecordProperty("mean_off", std::to_string(mean_off));
}

TEST(StarPhotometry, GoesAsFaintAsItIsTold) {
  const sim::Scene scene = all_sky();
  CountPicture quiet = exposed(mean_counts(scene, kDate, 11), 11);
  for (std::size_t i = 0; i < quiet.rate.data.size(); ++i) quiet.variance[i] *= 1e-4f;
  const auto measured = [&](double faintest) {
    StarPhotometrySettings settings;
    settings.faintest = faintest;
    StarPhotometer photometer(scene, green_filter(), settings);
    photometer.add(quiet, kDate);
    return photometer.answer("made").stars;
  };
  const std::vector<MeasuredStar> some = measured(4.5), more = measured(5.5);
  EXPECT_GT(more.size(), some.size() + 50);
  EXPECT_GT(more.back().magnitude, 5.3);
  // Each star by itself, also those that have no number of Hipparcos.
  for (const MeasuredStar& star : more) EXPECT_EQ(star.pictures, 1) << star.name;
  // A star that is left out for a neighbour is so whatever is measured.
  for (const MeasuredStar& star : some)
    EXPECT_TRUE(std::any_of(more.begin(), more.end(), [&](const MeasuredStar& other) {
      return other.name == star.name;
    })) << star.name;
}

TEST(StarPhotometry, LeavesOutAStarForAFaintNeighbour) {
  // Stars of the eye's catalogue alone that put more than a fiftieth of the light into a brighter one's
  // circle.
  const sim::Scene scene = all_sky();
  const CountPicture picture = exposed(mean_counts(scene, kDate, 11), 11);
  StarPhotometer photometer(scene, green_filter(), {});
  photometer.add(picture, kDate);
  const sim::Observer observer{scene.site.latitude_deg, scene.site.longitude_deg, scene.site.altitude_m,
                               true};
  const sim::CameraView<double> view = sim::camera_view(scene.camera);
  int checked = 0;
  for (const MeasuredStar& star : photometer.answer("made").stars) {
    const sim::BrightStar* own = sim::find_bright_star(star.name);
    ASSERT_NE(own, nullptr) << star.name;
    const auto pixel = [&](const sim::BrightStar& one, double& x, double& y) {
      const std::array<double, 3> enu = sim::direction_of_star(one.place, observer, kDate);
      return enu[2] > 0.0 && sim::pixel_of_enu(view, enu.data(), x, y);
    };
    double x = 0.0, y = 0.0;
    ASSERT_TRUE(pixel(*own, x, y));
    double others = 0.0;
    for (const sim::BrightStar& other : sim::catalogue_stars()) {
      double other_x = 0.0, other_y = 0.0;
      if (&other == own || !pixel(other, other_x, other_y)) continue;
      if (std::hypot(other_x - x, other_y - y) < Aperture{}.radius_px)
        others += std::pow(10.0, -0.4 * (other.magnitude - own->magnitude));
    }
    EXPECT_LE(others, 0.02) << star.name;
    ++checked;
  }
  EXPECT_GT(checked, 50);
}

TEST(StarPhotometry, GivesTheAirglowItsRayleighsBack) {
  const sim::Scene scene = all_sky();
  const CountPicture picture = exposed(mean_counts(scene, kDate, 7), 7);
  StarPhotometrySettings settings;
  settings.extinction = ExtinctionBy::number;
  settings.magnitudes_per_airmass = 1.0857362 * kDepth;
  StarPhotometer photometer(scene, green_filter(), settings);
  photometer.add(picture, kDate);
  const StarFactor found = photometer.answer("made");
  EXPECT_FALSE(found.extinction_error);
  // About the zenith, without its stars: the median of 40 x 40 pixels.
  std::vector<float> zenith;
  for (int y = 364; y < 404; ++y)
    for (int x = 364; x < 404; ++x) zenith.push_back(picture.rate.at(x, y, 0));
  std::nth_element(zenith.begin(), zenith.begin() + zenith.size() / 2, zenith.end());
  const double rayleighs = found.factor.value * zenith[zenith.size() / 2];
  const double truth = kAirglow_R * std::exp(-kDepth);
  // The stars' own error, and 1.5 % for airglow off the zenith, faint stars and the noise of the median.
  EXPECT_NEAR(rayleighs / truth, 1.0, 3.0 * found.star_error + 0.015);
  EXPECT_NEAR(found.factor.error / found.factor.value, std::hypot(found.star_error, 0.02), 1e-9);
}

TEST(StarPhotometry, AveragesPicturesAndSeesWhatIsNotRight) {
  const sim::Scene scene = all_sky();
  const sim::Image mean = mean_counts(scene, kDate, 3);
  StarPhotometrySettings settings;
  settings.aperture.radius_px = 1.5;  // much of a star lies outside
  StarPhotometer narrow(scene, green_filter(), settings);
  StarPhotometer one(scene, green_filter(), {}), four(scene, green_filter(), {});
  for (std::uint64_t frame = 0; frame < 4; ++frame) {
    const CountPicture picture = exposed(mean, 50 + frame);
    if (frame == 0) one.add(picture, kDate);
    four.add(picture, kDate);
  }
  const StarFactor by_one = one.answer("made"), by_four = four.answer("made");
  EXPECT_EQ(by_four.stars.front().pictures, 4);
  EXPECT_NEAR(by_four.stars.front().rate_error, 0.5 * by_one.stars.front().rate_error,
              0.1 * by_one.stars.front().rate_error);
  // What the factor is known to is the stars' own scatter, which no number of pictures makes less.
  EXPECT_NEAR(by_four.star_error / by_one.star_error, 1.0, 0.25);
  EXPECT_NEAR(by_four.stars[0].airmass, by_one.stars[0].airmass, 1e-12);
  // Without noise all that is bright enough tells what lies outside.
  CountPicture quiet = exposed(mean, 50);
  for (std::size_t i = 0; i < mean.data.size(); ++i)
    quiet.rate.data[i] = mean.data[i] / static_cast<float>(kExposure_s);
  narrow.add(quiet, kDate);
  StarPhotometer wide(scene, green_filter(), {});
  wide.add(quiet, kDate);
  EXPECT_LT(std::abs(wide.answer("made").light_outside), 0.005);
  const StarFactor lost = narrow.answer("made");
  EXPECT_GT(lost.light_outside, 0.1);
  ASSERT_FALSE(lost.notes.empty());
  EXPECT_NE(lost.notes.front().find("--aperture"), std::string::npos);
  // Without light there is nothing to go by, and that is what the error says.
  StarPhotometer blind(scene, green_filter(), {});
  blind.add(exposed(sim::Image(kSide, kSide, {"counts"}), 1), kDate);
  EXPECT_GT(blind.answer("dark.fits").star_error, 0.5);
  StarPhotometer none(scene, green_filter(), {});
  tests::expect_words(sim::ErrorKind::unreadable_input, {"dark.fits", "0 stars", "agree on nothing"},
                      [&] { none.answer("dark.fits"); });
}

TEST(StarPhotometry, HasTheAirmassOfKastenAndYoung) {
  // Their table: 1.994 at 30 degrees of elevation, 5.586 at 10.
  EXPECT_NEAR(relative_airmass(90.0), 1.0, 1e-3);
  EXPECT_NEAR(relative_airmass(30.0), 1.994, 2e-3);
  EXPECT_NEAR(relative_airmass(10.0), 5.586, 5e-3);
}

}  // namespace
}  // namespace vegard::fit::star_photometry_test
