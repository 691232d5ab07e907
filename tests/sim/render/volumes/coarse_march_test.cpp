#include "sim/render/volumes/volumes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

namespace vegard::sim::coarse_march_test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

FilmGeometry film_of(int columns, int rows) {
  FilmGeometry film;
  film.x0_px = -3.0;
  film.y0_px = -2.0;
  film.columns = columns;
  film.rows = rows;
  return film;
}

using AtPlace = std::function<float(double x_px, double y_px)>;

/// Values at the middles of a film's cells.
std::vector<float> sampled(const FilmGeometry& film, const AtPlace& value) {
  std::vector<float> all;
  for (int r = 0; r < film.rows; ++r)
    for (int c = 0; c < film.columns; ++c)
      all.push_back(
          value(film.x0_px + (c + 0.5) * film.cell_width_px, film.y0_px + (r + 0.5) * film.cell_height_px));
  return all;
}

/// A march of made-up light that counts its rays, of one line.
struct MadeUp {
  AtPlace light, end;
  bool absorbs = false;
  std::size_t rays = 0;

  VolumeLight of(const FilmGeometry& film, int shrink) {
    return march_coarsely(
        film, shrink, [&](const FilmGeometry& g) { return sampled(g, end); },
        [&](const FilmGeometry& g, const std::vector<std::uint8_t>& wanted) {
          VolumeLight made;
          made.lines = 1;
          const std::vector<float> lit = sampled(g, light);
          made.rayleigh.assign(lit.size(), 0.0f);
          made.depth_km.assign(lit.size(), kInfinity);
          if (absorbs) made.kept.assign(lit.size(), 1.0f);
          for (std::size_t i = 0; i < lit.size(); ++i) {
            if (!wanted.empty() && wanted[i] == 0) continue;
            ++rays;
            made.rayleigh[i] = lit[i];
            made.depth_km[i] = 100.0f;
            if (absorbs) made.kept[i] = std::exp(-lit[i]);
          }
          return made;
        },
        2);
  }
};

float wavy(double x, double y) { return static_cast<float>(2.0 + std::sin(x / 9.0) * std::cos(y / 11.0)); }
float free_sky(double, double) { return kInfinity; }

TEST(MarchCoarsely, OfTheSameResolutionIsTheMarchItself) {
  const FilmGeometry film = film_of(41, 29);
  MadeUp made{wavy, free_sky, true};
  const VolumeLight light = made.of(film, 1);
  const std::vector<float> whole = sampled(film, wavy);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    ASSERT_EQ(light.rayleigh[i], whole[i]);
    ASSERT_EQ(light.kept[i], std::exp(-whole[i]));
    ASSERT_EQ(light.depth_km[i], 100.0f);
  }
}

TEST(MarchCoarsely, LeavesAConstantAsItIs) {
  MadeUp made{[](double, double) { return 0.1f; }, free_sky, true};
  const VolumeLight light = made.of(film_of(43, 31), 5);
  for (const float v : light.rayleigh) ASSERT_EQ(v, 0.1f);
  for (const float v : light.kept) ASSERT_EQ(v, std::exp(-0.1f));
}

TEST(MarchCoarsely, KeepsTotalsOfSmoothLight) {
  const FilmGeometry film = film_of(120, 90);
  const AtPlace blob = [](double x, double y) {
    return static_cast<float>(
        std::exp(-0.5 * (std::pow((x - 55.3) / 9.0, 2) + std::pow((y - 41.7) / 8.0, 2))));
  };
  const std::vector<float> whole = sampled(film, blob);
  const double truth = std::accumulate(whole.begin(), whole.end(), 0.0);
  for (const int shrink : {2, 3, 4}) {
    MadeUp made{blob, free_sky};
    const VolumeLight light = made.of(film, shrink);
    EXPECT_LT(made.rays, whole.size() / (shrink * shrink) + 1000);
    // Sums over a grid of a Gaussian twice as wide as its steps are exact to 1e-8, and each coarse value has
    // shrink^2 cells; what is left is the tail at the film's edges (4.6 sigma) and rounding.
    EXPECT_NEAR(std::accumulate(light.rayleigh.begin(), light.rayleigh.end(), 0.0), truth, 1e-4 * truth);
    // Linear interpolation errs by at most h^2 / 8 of the second derivative, 1 / sigma^2 each way.
    const double most = shrink * shrink / 8.0 * (1.0 / 81.0 + 1.0 / 64.0);
    for (std::size_t i = 0; i < whole.size(); ++i) ASSERT_NEAR(light.rayleigh[i], whole[i], most);
  }
}

TEST(MarchCoarsely, KeepsTheEdgeOfWhatStandsBeforeTheLightSharp) {
  // A slanting edge: light to its right, a near thing that hides it to its left.
  const auto is_near = [](double x, double y) { return x < 20.3 + 0.31 * y; };
  const AtPlace lit = [&](double x, double y) { return is_near(x, y) ? 0.0f : wavy(x, y); };
  const AtPlace end = [&](double x, double y) { return is_near(x, y) ? 5.0f : kInfinity; };
  const FilmGeometry film = film_of(80, 60);
  const std::vector<float> whole = sampled(film, lit);
  const auto largest_error = [&](const AtPlace& guide) {
    MadeUp made{lit, guide};
    const VolumeLight light = made.of(film, 4);
    double largest = 0.0;
    for (std::size_t i = 0; i < whole.size(); ++i)
      largest = std::max(largest, static_cast<double>(std::abs(light.rayleigh[i] - whole[i])));
    return largest;
  };
  // Bilinear alone, as with a guide that is the same everywhere, smears half of the light over the edge.
  EXPECT_GT(largest_error(free_sky), 0.8);
  // By depth what is left is linear light of one side: less than a step of 4 px times the steepest slope of
  // 1 / 9 + 1 / 11, which is where a value is held on from one side of the edge.
  EXPECT_LT(largest_error(end), 4.0 * (1.0 / 9.0 + 1.0 / 11.0));
  MadeUp made{lit, end};
  const VolumeLight light = made.of(film, 4);
  const std::vector<float> ends = sampled(film, end);
  for (std::size_t i = 0; i < whole.size(); ++i)
    if (ends[i] == 5.0f) {
      ASSERT_EQ(light.rayleigh[i], 0.0f) << "nothing bleeds over what is near";
    }
}

TEST(MarchCoarsely, MarchesWhatNoCoarseRaySpeaksForByItself) {
  // A wire, one pixel wide, between the coarse rays.
  const auto is_wire = [](double x, double) { return x > 20.0 && x < 21.0; };
  const AtPlace lit = [&](double x, double y) { return is_wire(x, y) ? 0.25f : wavy(x, y); };
  const AtPlace end = [&](double x, double y) { return is_wire(x, y) ? 2.0f : kInfinity; };
  const FilmGeometry film = film_of(64, 48);
  MadeUp made{lit, end};
  const VolumeLight light = made.of(film, 4);
  EXPECT_EQ(made.rays, 16u * 12u + 48u);
  for (int r = 0; r < film.rows; ++r) ASSERT_EQ(light.rayleigh[r * 64 + 23], 0.25f);
}

TEST(MarchCoarsely, IsDarkAndClearWhereTheLensSeesNothing) {
  const auto sees = [](double x, double y) { return std::hypot(x - 30.0, y - 20.0) < 17.0; };
  const AtPlace lit = [&](double x, double y) { return sees(x, y) ? 3.0f : 0.0f; };
  const AtPlace end = [&](double x, double y) { return sees(x, y) ? kInfinity : kNone; };
  const FilmGeometry film = film_of(70, 50);
  MadeUp made{lit, end, true};
  const VolumeLight light = made.of(film, 3);
  const std::vector<float> whole = sampled(film, lit);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    ASSERT_EQ(light.rayleigh[i], whole[i]) << "nor does darkness from there bleed in";
    ASSERT_EQ(light.kept[i], whole[i] > 0.0f ? std::exp(-3.0f) : 1.0f);
  }
}

}  // namespace
}  // namespace vegard::sim::coarse_march_test
