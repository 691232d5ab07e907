// Films around all of a picture: their margins, their sums, and blur over the poles.
#include "sim/view/film/panorama.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/base/number/constants.h"
#include "sim/base/number/random.h"

namespace vegard::sim::panorama_test {
namespace {

FilmGeometry film_around(int rows, int margin) {
  FilmGeometry film;
  film.x0_px = film.y0_px = -margin;
  film.turn_rows = rows;
  film.turn_columns = 2 * rows;
  film.rows = rows + 2 * margin;
  film.columns = 2 * rows + 2 * margin;
  return film;
}

/// Steradians of a cell within the turn.
double steradians_of(const FilmGeometry& film, int row) {
  return width_of_row(film, row) * std::pow(kPi / film.turn_rows, 2);
}

double light_in(const FilmGeometry& film, int margin, const std::vector<float>& plane) {
  double sum = 0.0;
  for (int row = margin; row < margin + film.turn_rows; ++row)
    for (int column = margin; column < margin + film.turn_columns; ++column)
      sum += steradians_of(film, row) * plane[row * film.columns + column];
  return sum;
}

TEST(PanoramaFilm, GoesOnBeyondItsEdges) {
  const FilmGeometry film = film_around(10, 3);
  const auto expect = [&](int row, int column, int row_within, int column_within) {
    const CellWithin within = cell_within(film, row, column);
    EXPECT_EQ(within.row, row_within);
    EXPECT_EQ(within.column, column_within);
  };
  expect(5, 7, 5, 7);
  expect(5, 2, 5, 22);  // left of the first column is the last
  expect(5, 23, 5, 3);  // and the other way round
  expect(2, 4, 3, 14);  // above the first row is itself, half a turn on
  expect(13, 4, 12, 14);
  expect(0, 2, 5, 12);  // a corner
  double whole = 0.0;
  for (int row = 3; row < 13; ++row) whole += steradians_of(film, row) * film.turn_columns;
  EXPECT_NEAR(whole, 4.0 * kPi, 1e-12);
}

TEST(PanoramaFilm, WhatFellIntoTheMarginIsKept) {
  constexpr int kMargin = 3;
  const FilmGeometry film = film_around(12, kMargin);
  std::vector<float> plane(static_cast<std::size_t>(film.rows) * film.columns);
  double splatted = 0.0;
  for (std::size_t i = 0; i < plane.size(); ++i) {
    plane[i] = uniform(random_words(5, Stream::stars, static_cast<std::uint32_t>(i))[0]);
    splatted += plane[i] * std::pow(kPi / film.turn_rows, 2);
  }
  close_turn(film, plane.data());
  EXPECT_NEAR(light_in(film, kMargin, plane), splatted, 1e-5 * splatted);
  for (int row = 0; row < film.rows; ++row)
    for (int column = 0; column < film.columns; ++column) {
      const CellWithin within = cell_within(film, row, column);
      EXPECT_EQ(plane[row * film.columns + column], plane[within.row * film.columns + within.column]);
    }
}

class BlurOnSphere : public testing::TestWithParam<double> {
 protected:
  static constexpr int kRows = 180, kMargin = 2;
  static constexpr double kSigma = 4.0;
  FilmGeometry film = film_around(kRows, kMargin);
  std::vector<float> plane = std::vector<float>(static_cast<std::size_t>(film.rows) * film.columns, 0.0f);

  std::vector<float> blurred() const {
    std::vector<float> out(plane.size());
    blur_on_sphere(film, plane.data(), kSigma, -1, {0, 0, film.rows, film.columns}, out.data(), 2);
    return out;
  }
};
// Degrees from the upper pole of a single bright cell.
INSTANTIATE_TEST_SUITE_P(FromPole, BlurOnSphere, testing::Values(0.5, 2.5, 8.5, 40.5, 90.5));

TEST_P(BlurOnSphere, ASpotBecomesAGaussianOnTheSphere) {
  const int row = static_cast<int>(GetParam()), column = 3;  // a degree to a cell, near the seam
  plane[(row + kMargin) * film.columns + column + kMargin] = 1.0f;
  close_turn(film, plane.data());
  const double light = light_in(film, kMargin, plane);
  const std::vector<float> out = blurred();
  // A Gaussian on the sphere has exp(-sigma^2 / 2) of the light of one on the plane, 0.24 % less; the plane
  // about a pole stretches areas by 1 % at 16 degrees.
  EXPECT_NEAR(light_in(film, kMargin, out) / light, 1.0, 0.02);
  // At the spot, and two widths away along a meridian and across it: the Gaussian on a plane, exp(-2) there.
  const double sigma_rad = kSigma * kPi / kRows, peak = light / (kTwoPi * sigma_rad * sigma_rad);
  const auto at = [&](int of_row, int of_column) {
    const CellWithin within = cell_within(film, of_row + kMargin, of_column + kMargin);
    return out[within.row * film.columns + within.column] / peak;
  };
  EXPECT_NEAR(at(row, column), 1.0, 0.02);
  EXPECT_NEAR(at(row + 8, column), std::exp(-2.0), 0.02);
  EXPECT_NEAR(at(row - 8, column), std::exp(-2.0), 0.02);
  if (GetParam() > 20.0) {
    const double turn = std::sin(8.0 * kPi / kRows) / std::sin(GetParam() * kPi / kRows);
    EXPECT_NEAR(at(row, column - static_cast<int>(std::lround(turn * kRows / kPi))), std::exp(-2.0), 0.02);
  }
}

TEST_P(BlurOnSphere, AnEvenSkyStaysEven) {
  std::fill(plane.begin(), plane.end(), 3.0f);
  for (const float value : blurred()) ASSERT_NEAR(value, 3.0f, 1e-5f);
}

}  // namespace
}  // namespace vegard::sim::panorama_test
