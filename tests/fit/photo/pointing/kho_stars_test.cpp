// Seventeen stars of an all-sky camera at the Kjell Henriksen Observatory, 2012-11-12: where the photographs
// are (VEGARD_PHOTOS, or ../shared/photos beside the repository).
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "fit/photo/pointing/calibration.h"
#include "fit/photo/pointing/star_table.h"
#include "sim/base/number/constants.h"
#include "sim/view/sky/bright_stars.h"
#include "sim/view/sky/star_place.h"
#include "tests/support/source_folder.h"

namespace vegard::tests::kho_stars_test {
namespace {

class KhoStars : public testing::Test {
 protected:
  void SetUp() override {
    const char* given = std::getenv("VEGARD_PHOTOS");
    const std::string folder = given != nullptr ? given : tests::source_folder() + "/../shared/photos";
    file = folder + "/stars/kho_nipr_20121112.csv";
    if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
    stars = fit::read_star_table(file, {});
  }
  static fit::LensSettings only(sim::LensModel model, int radial) {
    fit::LensSettings settings;
    settings.model = model;
    settings.form = fit::LensForm{model, radial, false, false};
    return settings;
  }
  std::string file;
  std::vector<fit::StarSighting> stars;
  const fit::Frame frame{462, 464, false};
};

// The figures of a least-squares check by another program.
TEST_F(KhoStars, RmsOfTwoLenses) {
  const fit::Calibration equisolid = fit::calibrate(only(sim::LensModel::equisolid, 0), stars, frame, file);
  EXPECT_EQ(equisolid.used(), 17);
  EXPECT_NEAR(equisolid.rms_px, 0.479, 5e-4);
  EXPECT_FALSE(equisolid.camera.mirrored);
  const fit::Calibration polynomial = fit::calibrate(only(sim::LensModel::polynomial, 1), stars, frame, file);
  EXPECT_EQ(polynomial.used(), 17);
  EXPECT_NEAR(polynomial.rms_px, 0.267, 5e-4);
  EXPECT_NEAR(polynomial.camera.numbers[fit::centre_x_number], 231.0, 3.0);
  EXPECT_NEAR(polynomial.camera.numbers[fit::centre_y_number], 232.0, 3.0);
  EXPECT_GT(polynomial.without_rms_px, polynomial.rms_px);
}

TEST_F(KhoStars, OneMovedStarIsLeftOut) {
  const fit::Calibration before = fit::calibrate(only(sim::LensModel::polynomial, 1), stars, frame, file);
  for (std::size_t which = 0; which < stars.size(); which += 4) {
    auto moved = stars;
    moved[which].x_px += 12.0;
    moved[which].y_px += 16.0;
    const fit::Calibration after = fit::calibrate(only(sim::LensModel::polynomial, 1), moved, frame, file);
    EXPECT_EQ(after.used(), 16) << which;
    EXPECT_FALSE(after.residuals[which].used) << which;
    EXPECT_NEAR(after.camera.numbers[fit::focal_px_number], before.camera.numbers[fit::focal_px_number], 1.0);
  }
}

// The table's azimuths and zenith distances are those of stars that night: at one instant all seventeen stand
// where the catalogue has a star of about their brightness, and at no other of the day.
TEST_F(KhoStars, StandWhereTheCatalogueHasThem) {
  const sim::Observer observer{78.148, 16.043, 520.0, true};
  const double midnight = *sim::julian_date("2012-11-12T00:00Z");
  const auto rms_deg = [&](double julian_date) {
    double sum = 0.0;
    std::vector<std::array<double, 3>> sky;
    for (const sim::BrightStar& star : sim::bright_stars())
      if (star.magnitude < 4.2) sky.push_back(sim::direction_of_star(star.place, observer, julian_date));
    for (const fit::StarSighting& star : stars) {
      double nearest = -1.0;
      for (std::size_t i = 0; i < sky.size(); ++i) {
        if (std::abs(sim::bright_stars()[i].magnitude - star.magnitude) > 0.3) continue;
        nearest =
            std::max(nearest, sky[i][0] * star.enu[0] + sky[i][1] * star.enu[1] + sky[i][2] * star.enu[2]);
      }
      sum += 2.0 * (1.0 - nearest);
    }
    return std::sqrt(std::max(sum, 0.0) / stars.size()) / sim::kRadiansPerDegree;
  };
  double least = 1e9, when = 0.0, elsewhere = 1e9;
  for (int minute = 0; minute < 24 * 60; minute += 4) {
    const double rms = rms_deg(midnight + minute / 1440.0);
    if (rms < least) {
      least = rms;
      when = midnight + minute / 1440.0;
    }
  }
  for (int minute = 0; minute < 24 * 60; minute += 4) {
    const double then = midnight + minute / 1440.0;
    if (std::abs(then - when) > 0.02) elsewhere = std::min(elsewhere, rms_deg(then));
  }
  double low = when - 4.0 / 1440.0, high = when + 4.0 / 1440.0;
  for (int step = 0; step < 40; ++step) {
    const double a = low + 0.382 * (high - low), b = low + 0.618 * (high - low);
    (rms_deg(a) < rms_deg(b) ? high : low) = rms_deg(a) < rms_deg(b) ? b : a;
  }
  const double best = 0.5 * (low + high);
  RecordProperty("instant", sim::text_of_julian_date(best));
  RecordProperty("rms_deg", std::to_string(rms_deg(best)));
  EXPECT_LT(rms_deg(best), 0.05) << sim::text_of_julian_date(best);
  EXPECT_GT(elsewhere, 1.0);
}

}  // namespace
}  // namespace vegard::tests::kho_stars_test
