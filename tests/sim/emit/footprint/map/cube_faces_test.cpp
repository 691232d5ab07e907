#include "sim/emit/footprint/map/footprint_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/base/number/random.h"

namespace vegard::sim::cube_faces_test {
namespace {

constexpr int kCells = 12;

/// What footprint_map.h says of a face's place (u, v): linear between the middles of cells, border included.
double read(const CubeFootprint<double>& cube, int face, double u, double v) {
  const FootprintGrid<double>& grid = cube.face[face];
  const double x = 0.5 * kCells * (u + 1.0) + 0.5, y = 0.5 * kCells * (v + 1.0) + 0.5;
  const int c = std::min(static_cast<int>(x), kCells), r = std::min(static_cast<int>(y), kCells);
  const auto at = [&](int i, int j) { return grid.flux_mw_m2[(r + j) * grid.columns + c + i]; };
  const double fx = x - c, fy = y - r;
  return (at(0, 0) * (1 - fx) + at(1, 0) * fx) * (1 - fy) + (at(0, 1) * (1 - fx) + at(1, 1) * fx) * fy;
}

/// Reads at a direction on a face that it lies on.
double read_towards(const CubeFootprint<double>& cube, int face, const double d[3]) {
  const int axis = face / 2;
  const double along = std::abs(d[axis]);
  return read(cube, face, d[(axis + 1) % 3] / along, d[(axis + 2) % 3] / along);
}

CubeFootprint<double> random_cube() {
  CubeFootprint<double> cube = cube_grid<double>(kCells, true);
  for (int face = 0; face < 6; ++face)
    for (std::size_t i = 0; i < cube.face[face].cells(); ++i) {
      const Words words = random_words(5, Stream::footprint, face, static_cast<std::uint32_t>(i));
      cube.face[face].flux_mw_m2[i] = uniform(words[0]);
      cube.face[face].ln_energy[i] = uniform(words[1]);
    }
  fill_borders(cube);
  return cube;
}

TEST(CubeFaces, AgreeOnBothSidesOfEveryEdgeAndAtEveryCorner) {
  const CubeFootprint<double> cube = random_cube();
  int edges = 0, corners = 0;
  for (int a = 0; a < 3; ++a)
    for (const double side_a : {-1.0, 1.0})
      for (const double side_b : {-1.0, 1.0}) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        const int face_a = 2 * a + (side_a < 0.0), face_b = 2 * b + (side_b < 0.0);
        double least = 1e9, most = -1e9;
        for (int k = 0; k <= 96; ++k) {
          double d[3];
          d[a] = side_a;
          d[b] = side_b;
          d[c] = k / 48.0 - 1.0;
          const double here = read_towards(cube, face_a, d), there = read_towards(cube, face_b, d);
          EXPECT_NEAR(here, there, 1e-14) << face_a << " " << face_b << " " << d[c];
          least = std::min(least, here);
          most = std::max(most, here);
          if (std::abs(d[c]) == 1.0) {
            EXPECT_NEAR(here, read_towards(cube, 2 * c + (d[c] < 0.0), d), 1e-14);
            ++corners;
          }
        }
        // Random cells differ along an edge: that they agree across it says something.
        EXPECT_GT(most - least, 0.3);
        ++edges;
      }
  EXPECT_EQ(edges, 12);
  EXPECT_EQ(corners, 24);
}

TEST(CubeFaces, KnowTheDirectionsOfTheirPlaces) {
  for (int face = 0; face < 6; ++face) {
    double d[3];
    direction_on_face(face, 0.3, -0.7, d);
    const int axis = face / 2;
    EXPECT_NEAR(d[0] * d[0] + d[1] * d[1] + d[2] * d[2], 1.0, 1e-15);
    EXPECT_EQ(d[axis] > 0.0, face % 2 == 0);
    EXPECT_NEAR(d[(axis + 1) % 3] / std::abs(d[axis]), 0.3, 1e-15);
    EXPECT_NEAR(d[(axis + 2) % 3] / std::abs(d[axis]), -0.7, 1e-15);
  }
}

TEST(CubeFaces, FindAllCellsOfACap) {
  constexpr int n = 40;
  int inside = 0, looked_at = 0;
  for (std::uint32_t k = 0; k < 60; ++k) {
    const Words words = random_words(9, Stream::footprint, k, 0);
    double middle[3];
    direction_on_face(static_cast<int>(k % 6), 2.0 * uniform(words[0]) - 1.0, 2.0 * uniform(words[1]) - 1.0,
                      middle);
    const double cosine = std::cos(1.2 * uniform(words[2]));
    for (int face = 0; face < 6; ++face) {
      const CapOnFace cap = cap_on_face(face, n, middle, cosine);
      looked_at += (cap.end_column - cap.first_column) * (cap.end_row - cap.first_row);
      for (int r = 0; r < n; ++r)
        for (int c = 0; c < n; ++c) {
          double d[3];
          direction_on_face(face, face_coordinate(c, n), face_coordinate(r, n), d);
          if (d[0] * middle[0] + d[1] * middle[1] + d[2] * middle[2] < cosine) continue;
          ++inside;
          EXPECT_TRUE(c >= cap.first_column && c < cap.end_column && r >= cap.first_row && r < cap.end_row);
        }
    }
  }
  EXPECT_GT(inside, 10000);
  // A square about a circle has 4 / pi of its area; large caps bend.
  EXPECT_LT(looked_at, 3 * inside);
}

}  // namespace
}  // namespace vegard::sim::cube_faces_test
