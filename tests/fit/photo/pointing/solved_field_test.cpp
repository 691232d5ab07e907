#include "fit/photo/pointing/star_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "fit/photo/pointing/calibration.h"
#include "sim/view/sky/star_place.h"
#include "tests/support/expect_error.h"
#include "tests/support/fits_bytes.h"
#include "tests/support/star_field.h"
#include "tests/support/temporary_folder.h"

namespace vegard::tests::solved_field_test {
namespace {

const fit::SkyOfPicture kSky{sim::julian_date("2014-02-21T19:30:40Z"),
                             sim::Observer{78.148, 16.043, 520.0, true}};

/// A .corr file of one star, with other columns between as solve-field has them.
std::vector<FitsColumn> one_star() {
  return {{"field_x", 'D', {11.5}},      {"field_y", 'D', {21.0}},      {"field_ra", 'D', {0.0}},
          {"index_ra", 'D', {279.2347}}, {"index_dec", 'D', {38.7837}}, {"index_id", 'J', {77}},
          {"match_weight", 'D', {0.999}}};
}

std::string refused(const std::vector<FitsColumn>& columns) {
  return expect_error(sim::ErrorKind::unreadable_input,
                      [&] { fit::solved_field(fits_table(columns), "crop.corr", kSky); });
}

// The path of the tables of text gives the same star the same place; only the first pixel counts from 1.
TEST(SolvedField, AStarStandsWhereATableHasIt) {
  const auto solved = fit::solved_field(fits_table(one_star()), "crop.corr", kSky);
  const auto table = fit::parse_star_table("x_px,y_px,ra_deg,dec_deg\n11,20.5,279.2347,38.7837\n", "s", kSky);
  ASSERT_EQ(solved.size(), 1u);
  EXPECT_EQ(solved[0].x_px, table[0].x_px);
  EXPECT_EQ(solved[0].y_px, table[0].y_px);
  EXPECT_EQ(solved[0].enu, table[0].enu);
  EXPECT_EQ(solved[0].name, "row 1");
}

TEST(SolvedField, IsRecognisedByItsContent) {
  const TemporaryFolder folder;
  put(folder / "stars.csv", fits_table(one_star()));
  EXPECT_EQ(fit::read_star_table(folder / "stars.csv", kSky)[0].x_px, 11.0);
  // Told otherwise, the file counts from there.
  EXPECT_EQ(fit::read_star_table(folder / "stars.csv", kSky, 0.0)[0].x_px, 12.0);
}

// A camera of 640 x 480 px whose crop from (120, 80) on was solved.
TEST(SolvedField, TheCameraOfACropIsFound) {
  const double left = 120.0, top = 80.0, width = 300.0, height = 260.0;
  const fit::SkyCamera truth = known_camera(sim::LensModel::pinhole, 700.0, 40.0, 50.0, 7.0);
  std::vector<FitsColumn> columns = {
      {"field_x", 'D', {}}, {"field_y", 'D', {}}, {"index_ra", 'D', {}}, {"index_dec", 'D', {}}};
  for (int ra = 0; ra < 360; ra += 5)
    for (int dec = -10; dec <= 85; dec += 5) {
      sim::CataloguePlace place;
      place.j2000 = {ra + 0.3 * dec + (dec < 0 ? 3.0 : 0.0), static_cast<double>(dec)};
      place.j2000.right_ascension_deg = std::fmod(place.j2000.right_ascension_deg, 360.0);
      double x = 0.0, y = 0.0;
      const auto enu = sim::direction_of_star(place, *kSky.observer, *kSky.julian_date);
      if (!fit::place_of_star(truth, enu, x, y)) continue;
      if (x < left || x > left + width || y < top || y > top + height) continue;
      const double row[] = {x - left + 0.5, y - top + 0.5, place.j2000.right_ascension_deg,
                            place.j2000.declination_deg};
      for (int c = 0; c < 4; ++c) columns[c].values.push_back(row[c]);
    }
  ASSERT_GE(columns[0].values.size(), 12u);
  auto stars = fit::solved_field(fits_table(columns), "crop.corr", kSky);
  for (fit::StarSighting& star : stars) star.x_px += left, star.y_px += top;
  fit::LensSettings settings;
  settings.model = sim::LensModel::pinhole;
  settings.form = fit::LensForm{sim::LensModel::pinhole, 0, false, false};
  const fit::Calibration found = fit::calibrate(settings, stars, {640, 480, true}, "crop.corr");
  EXPECT_EQ(found.used(), static_cast<int>(stars.size()));
  // Without noise: what is left is where the least squares stop.
  EXPECT_NEAR(found.camera.numbers[fit::focal_px_number], 700.0, 1e-4);
  EXPECT_NEAR(found.camera.numbers[fit::centre_x_number], 327.0, 1e-4);
  EXPECT_NEAR(found.camera.numbers[fit::centre_y_number], 236.0, 1e-4);
  EXPECT_LT((found.camera.camera_from_enu - truth.camera_from_enu).norm(), 1e-6);
  EXPECT_FALSE(found.camera.mirrored);
}

TEST(SolvedField, WhatIsNoneIsRefused) {
  for (const char* name : {"field_x", "field_y", "index_ra", "index_dec"}) {
    auto columns = one_star();
    for (FitsColumn& column : columns)
      if (column.name == name) column.name = "other";
    EXPECT_TRUE(tests::has_facts(refused(columns), std::string("crop.corr | ") + name));
  }
  auto columns = one_star();
  for (FitsColumn& column : columns) column.values.clear();
  EXPECT_NE(refused(columns).find("no rows"), std::string::npos);
  columns = one_star();
  columns[4].values[0] = 91.0;
  EXPECT_TRUE(tests::has_facts(refused(columns), "index_dec | row 1"));
  columns[4].values[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refused(columns).find("index_dec of row 1"), std::string::npos);
  const std::string whole = fits_table(one_star());
  expect_error(sim::ErrorKind::unreadable_input,
               [&] { fit::solved_field(whole.substr(0, 2 * 2880), "crop.corr", kSky); });
  expect_error(sim::ErrorKind::unreadable_input, [] {
    fit::solved_field(fits_image(8, {1, 1}, {1}), "crop.corr", kSky);
  });
}

TEST(SolvedField, NeedsATimeAndASite) {
  const auto wanting = [](const fit::SkyOfPicture& sky) {
    return expect_error(sim::ErrorKind::usage,
                        [&] { fit::solved_field(fits_table(one_star()), "crop.corr", sky); });
  };
  EXPECT_NE(wanting({}).find("--time"), std::string::npos);
  EXPECT_NE(wanting({kSky.julian_date, {}}).find("--site"), std::string::npos);
}

}  // namespace
}  // namespace vegard::tests::solved_field_test
