#include "sim/emit/footprint/map/make_footprint.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/number/random.h"
#include "sim/emit/footprint/map/footprint_map.h"
#include "tests/support/kind_named.h"

namespace vegard::sim::picture_footprint_test {
namespace {

/// A unit vector on our axes.
void towards(double latitude_deg, double longitude_deg, double d[3]) {
  const double latitude = latitude_deg * M_PI / 180.0, longitude = longitude_deg * M_PI / 180.0;
  d[0] = std::cos(latitude) * std::cos(longitude);
  d[1] = std::cos(latitude) * std::sin(longitude);
  d[2] = std::sin(latitude);
}

TEST(PictureFootprint, EquirectangularPlacesAreTheSourcesFormula) {
  for (std::uint32_t k = 0; k < 200; ++k) {
    const Words words = random_words(3, Stream::footprint, k, 1);
    double d[3];
    towards(180.0 * uniform(words[0]) - 90.0, 360.0 * uniform(words[1]) - 180.0, d);
    // The source's x, y, z: y to the pole, -x to longitude 0, right-handed.
    const double x = -d[0], y = d[2], z = d[1];
    const PicturePlace place = equirectangular_place(d);
    EXPECT_NEAR(place.u, 0.5 - std::atan2(-z, -x) / (2.0 * M_PI), 1e-12);
    EXPECT_NEAR(place.v, std::asin(-y) / M_PI + 0.5, 1e-12);
  }
}

/// A picture whose value is its place: `across` to the right and `down` downwards, linear between middles.
Image ramp(int width, int height, double across, double down, double base = 0.0) {
  Image image(width, height, {"Y"});
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      image.at(x, y, 0) = static_cast<float>(base + across * (x + 0.5) / width + down * (y + 0.5) / height);
  return image;
}

Footprint shell(const char* source) {
  Footprint f;
  f.shape = FootprintShape::shell;
  f.source = tests::kind_named<FootprintSource>(source);
  f.face_cells = 32;
  f.energy_flux_mw_m2 = 2.0;
  return f;
}

/// Of the cell that holds a direction.
double flux_towards(const CubeFootprint<double>& cube, double latitude_deg, double longitude_deg) {
  double d[3];
  towards(latitude_deg, longitude_deg, d);
  int axis = 0;
  for (const int a : {1, 2})
    if (std::abs(d[a]) > std::abs(d[axis])) axis = a;
  const int face = 2 * axis + (d[axis] < 0.0), n = cube.face_cells;
  const auto cell = [&](double x) {
    return std::min(n - 1, static_cast<int>(0.5 * n * (x / std::abs(d[axis]) + 1.0)));
  };
  return cube.face[face].flux_mw_m2[(cell(d[(axis + 2) % 3]) + 1) * (n + 2) + cell(d[(axis + 1) % 3]) + 1];
}

TEST(PictureFootprint, OfTheEarthHasNorthUpEastToTheRightAndGreenwichInTheMiddle) {
  const Image east = ramp(360, 180, 1.0, 0.0), south = ramp(360, 180, 0.0, 1.0);
  FootprintPictures pictures;
  for (const double longitude : {-150.0, -85.0, -30.0, 5.0, 60.0, 170.0})
    for (const double latitude : {-70.0, -20.0, 33.0, 65.0}) {
      // A cell is 4 degrees wide on the equator, and 12 degrees of longitude at 70 degrees.
      pictures.flux = &east;
      EXPECT_NEAR(flux_towards(picture_cube(shell("image"), pictures, 1), latitude, longitude),
                  2.0 * (0.5 + longitude / 360.0), 2.0 * 7.0 / 360.0);
      pictures.flux = &south;
      EXPECT_NEAR(flux_towards(picture_cube(shell("image"), pictures, 2), latitude, longitude),
                  2.0 * (0.5 - latitude / 180.0), 2.0 * 3.0 / 180.0);
    }
}

TEST(PictureFootprint, OfTheEarthGoesOnAcrossTheDateLine) {
  Image image(360, 180, {"Y"});
  for (int y = 0; y < 180; ++y)
    for (int x = 0; x < 360; ++x)
      image.at(x, y, 0) = static_cast<float>(0.5 + 0.5 * std::cos((x + 0.5 - 180.0) * M_PI / 180.0));
  FootprintPictures pictures;
  pictures.flux = &image;
  const CubeFootprint<double> cube = picture_cube(shell("image"), pictures, 1);
  for (const double longitude : {176.0, 179.9, -179.9, -176.0})
    EXPECT_LT(flux_towards(cube, 10.0, longitude), 2.0 * 0.005);
}

TEST(PictureFootprint, OfSixFacesKnowsWhichIsWhereAndWhichWayUp) {
  FootprintPictures pictures;
  std::array<Image, 6> right, down;
  for (int face = 0; face < 6; ++face) {
    right[face] = ramp(64, 64, 0.1, 0.0, 0.1 * face);
    down[face] = ramp(64, 64, 0.0, 0.1, 0.1 * face);
  }
  const auto value = [&](std::array<Image, 6>& of, double latitude, double longitude) {
    for (int face = 0; face < 6; ++face) pictures.face[face] = &of[face];
    return flux_towards(picture_cube(shell("cube"), pictures, 2), latitude, longitude) / 2.0;
  };
  // Middles of px, nx, py, ny, pz, nz, and what lies up and right of them.
  const double middle[6][2] = {{0, 180}, {0, 0}, {90, 0}, {-90, 0}, {0, 90}, {0, -90}};
  const double above[6][2] = {{30, 180}, {30, 0}, {60, -90}, {-60, 90}, {30, 90}, {30, -90}};
  const double beside[6][2] = {{0, -150}, {0, 30}, {60, 180}, {-60, 180}, {0, 120}, {0, -60}};
  const double off = 0.05 * std::tan(M_PI / 6.0);  // 30 degrees from the middle, of 0.1 a face
  for (int face = 0; face < 6; ++face) {
    // A cell is a thirty-second of a face.
    const double cell = 0.1 / 32.0;
    EXPECT_NEAR(value(right, middle[face][0], middle[face][1]), 0.1 * face + 0.05, cell);
    EXPECT_NEAR(value(right, beside[face][0], beside[face][1]), 0.1 * face + 0.05 + off, cell);
    EXPECT_NEAR(value(right, above[face][0], above[face][1]), 0.1 * face + 0.05, cell);
    EXPECT_NEAR(value(down, above[face][0], above[face][1]), 0.1 * face + 0.05 - off, cell);
    EXPECT_NEAR(value(down, beside[face][0], beside[face][1]), 0.1 * face + 0.05, cell);
  }
}

TEST(PictureFootprint, OverABoxHasNorthUpAndFillsIt) {
  Footprint f;
  f.source = FootprintSource::image;
  f.size_km = {100.0, 60.0};
  f.cell_km = 2.0;
  f.image_gamma = 2.0;
  f.energy_ratio = 3.0;
  const Image picture = ramp(400, 300, 0.3, 0.6), energy = ramp(10, 10, 1.0, 0.0);
  FootprintPictures pictures;
  pictures.flux = &picture;
  pictures.energy = &energy;
  const PlaneFootprint<double> plane = picture_plane(f, pictures, 2);
  ASSERT_EQ(plane.grid.columns, 50);
  ASSERT_EQ(plane.grid.rows, 30);
  for (const int row : {0, 11, 29})
    for (const int column : {1, 20, 48}) {
      const double u = (column + 0.5) / 50.0, v = 1.0 - (row + 0.5) / 30.0;
      const std::size_t i = row * 50 + column;
      // The mean of a square over a cell is above the square of the mean by its variance, 2e-5 here.
      EXPECT_NEAR(plane.grid.flux_mw_m2[i], std::pow(0.3 * u + 0.6 * v, 2.0), 1e-4);
      // The energy's picture has middles from 0.05 to 0.95 and is level beyond.
      EXPECT_NEAR(plane.grid.ln_energy[i], std::log(3.0) * std::min(std::max(u, 0.05), 0.95), 0.01);
    }
}

}  // namespace
}  // namespace vegard::sim::picture_footprint_test
