#include "sim/view/film/level_ladder.h"

#include <gtest/gtest.h>

#include <vector>

namespace vegard::sim::film_ladder_test {
namespace {

FilmGeometry film_of_cells(double width_px, double height_px) {
  FilmGeometry film;
  film.x0_px = -3.0;
  film.y0_px = 5.0;
  film.cell_width_px = width_px;
  film.cell_height_px = height_px;
  film.columns = static_cast<int>(400 / width_px);
  film.rows = static_cast<int>(400 / height_px);
  return film;
}

struct Moments {
  double light = 0.0, x_px = 0.0, y_px = 0.0, variance_px2 = 0.0;  // the mean of both directions
};

Moments moments_of(const FilmGeometry& film, const std::vector<float>& planes, int width, int number) {
  Moments m;
  double xx = 0.0, yy = 0.0;
  for (int r = 0; r < film.rows; ++r)
    for (int c = 0; c < film.columns; ++c) {
      const double v = planes[(static_cast<std::size_t>(r) * film.columns + c) * width + number];
      const double x = film.x0_px + (c + 0.5) * film.cell_width_px,
                   y = film.y0_px + (r + 0.5) * film.cell_height_px;
      m.light += v;
      m.x_px += v * x;
      m.y_px += v * y;
      xx += v * x * x;
      yy += v * y * y;
    }
  m.x_px /= m.light;
  m.y_px /= m.light;
  m.variance_px2 = 0.5 * (xx / m.light - m.x_px * m.x_px + yy / m.light - m.y_px * m.y_px);
  return m;
}

/// A cell's light, and twice as much of a second number, by way of one level.
std::vector<float> by_level(const FilmLevel& level, const FilmGeometry& film, double x_px, double y_px) {
  std::vector<float> cells(level.cells() * 2, 0.0f), scratch,
      planes(static_cast<std::size_t>(film.rows) * film.columns * 2, 0.0f);
  const float light[2] = {1.0f, 2.0f};
  const double area = film.cell_width_px * film.cell_height_px / (level.across.cell_px * level.down.cell_px);
  splat_on_film_level(level, x_px, y_px, area, light, 2, cells.data());
  blur_level(level, 2, cells, scratch);
  add_film_level(level, cells, film, 2, planes.data(), 1);
  return planes;
}

// Splines and integrated Gaussians spread a point by the same variance wherever it lies; floats and the end
// of the kernels at 4 sigma leave 1e-4.
TEST(FilmLadder, KeepsLightPlaceAndVariance) {
  for (const auto& [width_px, height_px] : {std::pair{1.0, 1.0}, {4.0, 1.0}, {2.0, 3.0}}) {
    const FilmGeometry film = film_of_cells(width_px, height_px);
    const std::vector<FilmLevel> levels = film_ladder(film, 40.0);
    ASSERT_GT(levels.size(), 10u);
    EXPECT_EQ(levels[0].variance_px2, 0.0);
    EXPECT_GE(levels.back().variance_px2, 1600.0);
    const double x_px = film.x0_px + (film.columns / 2 + 0.5) * width_px,
                 y_px = film.y0_px + (film.rows / 2 + 0.5) * height_px;
    for (std::size_t l = 0; l < levels.size(); ++l) {
      if (l > 1) {
        EXPECT_GT(levels[l].variance_px2, levels[l - 1].variance_px2) << l;
      }
      const std::vector<float> planes = by_level(levels[l], film, x_px, y_px);
      for (int number = 0; number < 2; ++number) {
        const Moments m = moments_of(film, planes, 2, number);
        EXPECT_NEAR(m.light, 1.0 + number, 2e-4) << l;
        EXPECT_NEAR(m.x_px, x_px, 1e-3 * (1.0 + x_px)) << l;
        EXPECT_NEAR(m.y_px, y_px, 1e-3 * (1.0 + y_px)) << l;
        EXPECT_NEAR(m.variance_px2, levels[l].variance_px2, 3e-3 * levels[l].variance_px2 + 1e-6) << l;
      }
    }
  }
}

TEST(FilmLadder, PutsTheLightOfACellOnThatCell) {
  const FilmGeometry film = film_of_cells(1.0, 1.0);
  const std::vector<float> planes = by_level(film_ladder(film, 10.0)[0], film, 97.5, 105.5);
  for (std::size_t i = 0; i < planes.size(); ++i)
    EXPECT_EQ(planes[i], i / 2 == 100u * 400u + 100u ? 1.0f + static_cast<float>(i % 2) : 0.0f);
}

TEST(FilmLadder, LeavesOutWhatIsTooFarAway) {
  const FilmGeometry film = film_of_cells(1.0, 1.0);
  for (const FilmLevel& level : film_ladder(film, 10.0))
    for (const float light : by_level(level, film, 1e7, -1e7)) ASSERT_EQ(light, 0.0f);
}

}  // namespace
}  // namespace vegard::sim::film_ladder_test
