#include "sim/emit/footprint/map/make_footprint.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include "sim/base/number/constants.h"
#include "sim/base/parallel.h"
#include "sim/emit/footprint/map/footprint_map.h"

namespace vegard::sim {
namespace {

constexpr int kMaxSubcells = 8;  // along an edge of a cell

/// The first channel of a picture to a power, linear between the middles of its pixels.
class PictureValues {
 public:
  PictureValues(const Image& image, double power, bool goes_round)
      : width_(image.width), height_(image.height), goes_round_(goes_round) {
    const std::size_t pixels = static_cast<std::size_t>(width_) * height_;
    value_.resize(pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
      const float value = std::max(0.0f, image.data[i * image.channels()]);
      value_[i] = power == 1.0 ? value : static_cast<float>(std::pow(value, power));
    }
  }

  int width() const { return width_; }
  int height() const { return height_; }

  /// Beyond the outermost middles: on the other side if the picture goes round, else the outermost pixel's.
  double at(const PicturePlace& place) const {
    const double x = place.u * width_ - 0.5, y = place.v * height_ - 0.5;
    const double left = std::floor(x), top = std::floor(y);
    const double to_right = x - left, down = y - top;
    const double upper = mix(pixel(left, top), pixel(left + 1.0, top), to_right);
    const double lower = mix(pixel(left, top + 1.0), pixel(left + 1.0, top + 1.0), to_right);
    return mix(upper, lower, down);
  }

 private:
  static double mix(double a, double b, double t) { return a + (b - a) * t; }
  double pixel(double x, double y) const {
    int column = static_cast<int>(x);
    if (goes_round_)
      column = (column % width_ + width_) % width_;
    else
      column = std::clamp(column, 0, width_ - 1);
    const int row = std::clamp(static_cast<int>(y), 0, height_ - 1);
    return value_[static_cast<std::size_t>(row) * width_ + column];
  }

  int width_, height_;
  bool goes_round_;
  std::vector<float> value_;
};

/// How many places of a picture are looked at along a cell's edge, so that finer pixels are averaged.
int subcells(double pixels_per_cell) {
  return std::clamp(static_cast<int>(std::ceil(pixels_per_cell)), 1, kMaxSubcells);
}

/// The values of one layer of a shell, from one picture or six, on all inner cells.
void fill_layer(const std::vector<PictureValues>& pictures, double scale, int threads,
                std::vector<double> FootprintGrid<double>::*layer, CubeFootprint<double>& cube) {
  const int n = cube.face_cells;
  const bool is_cube = pictures.size() == 6;
  // A face is a quarter of the way around.
  const int parts =
      subcells(static_cast<double>(is_cube ? pictures[0].width() : 0.25 * pictures[0].width()) / n);
  parallel_for(static_cast<std::size_t>(6) * n, threads, [&](std::size_t job, int) {
    const int face = static_cast<int>(job) / n, row = static_cast<int>(job) % n;
    FootprintGrid<double>& grid = cube.face[face];
    for (int column = 0; column < n; ++column) {
      double sum = 0.0;
      for (int j = 0; j < parts; ++j)
        for (int i = 0; i < parts; ++i) {
          double direction[3];
          direction_on_face(face, face_coordinate(column + (i + 0.5) / parts - 0.5, n),
                            face_coordinate(row + (j + 0.5) / parts - 0.5, n), direction);
          if (is_cube) {
            const CubePlace place = cube_place(direction);
            sum += pictures[place.picture].at(place.at);
          } else {
            sum += pictures[0].at(equirectangular_place(direction));
          }
        }
      (grid.*layer)[static_cast<std::size_t>(row + 1) * grid.columns + column + 1] =
          scale * sum / (parts * parts);
    }
  });
}

std::vector<PictureValues> values_of(const Image* one, const std::array<const Image*, 6>& six, double power) {
  std::vector<PictureValues> all;
  if (six[0] != nullptr)
    for (const Image* image : six) all.emplace_back(*image, power, false);
  else if (one != nullptr)
    all.emplace_back(*one, power, true);
  return all;
}

}  // namespace

PicturePlace equirectangular_place(const double d[3]) {
  // The source's axes are -x, z, y of ours: its atan2(-z, -x) is ours of (-y, x).
  return {0.5 + std::atan2(d[1], d[0]) / (2.0 * kPi), 0.5 - std::asin(std::clamp(d[2], -1.0, 1.0)) / kPi};
}

CubePlace cube_place(const double d[3]) {
  const double x = -d[0], y = d[2], z = d[1];
  const double ax = std::abs(x), ay = std::abs(y), az = std::abs(z);
  const auto place = [](int picture, double right, double down, double axis) {
    return CubePlace{picture, {0.5 * (right / axis + 1.0), 0.5 * (down / axis + 1.0)}};
  };
  if (ax >= ay && ax >= az) return x > 0.0 ? place(0, -z, -y, ax) : place(1, z, -y, ax);
  if (ay >= az) return y > 0.0 ? place(2, x, z, ay) : place(3, x, -z, ay);
  return z > 0.0 ? place(4, x, -y, az) : place(5, -x, -y, az);
}

PlaneFootprint<double> picture_plane(const Footprint& f, const FootprintPictures& pictures, int threads) {
  PlaneFootprint<double> plane = plane_grid<double>(f);
  FootprintGrid<double>& grid = plane.grid;
  if (pictures.flux == nullptr) return plane;
  const auto fill = [&](const PictureValues& picture, double scale, std::vector<double>& layer) {
    layer.assign(grid.cells(), 0.0);
    const int across = subcells(picture.width() * f.cell_km / f.size_km.east),
              down = subcells(picture.height() * f.cell_km / f.size_km.north);
    parallel_for(grid.rows, threads, [&](std::size_t row, int) {
      for (int column = 0; column < grid.columns; ++column) {
        double sum = 0.0;
        for (int j = 0; j < down; ++j)
          for (int i = 0; i < across; ++i) {
            const double east = (column + (i + 0.5) / across - 0.5 * grid.columns) * f.cell_km,
                         north = (static_cast<double>(row) + (j + 0.5) / down - 0.5 * grid.rows) * f.cell_km;
            const PicturePlace place{0.5 + east / f.size_km.east, 0.5 - north / f.size_km.north};
            if (place.u < 0.0 || place.u > 1.0 || place.v < 0.0 || place.v > 1.0) continue;
            sum += picture.at(place);
          }
        layer[row * grid.columns + column] = scale * sum / (across * down);
      }
    });
  };
  fill(PictureValues(*pictures.flux, f.image_gamma, false), 1.0, grid.flux_mw_m2);
  if (pictures.energy != nullptr)
    fill(PictureValues(*pictures.energy, 1.0, false), std::log(f.energy_ratio), grid.ln_energy);
  return plane;
}

CubeFootprint<double> picture_cube(const Footprint& f, const FootprintPictures& pictures, int threads) {
  const std::vector<PictureValues> flux = values_of(pictures.flux, pictures.face, f.image_gamma),
                                   energy = values_of(pictures.energy, pictures.energy_face, 1.0);
  CubeFootprint<double> cube = cube_grid<double>(f.face_cells, !energy.empty());
  if (!flux.empty()) fill_layer(flux, f.energy_flux_mw_m2, threads, &FootprintGrid<double>::flux_mw_m2, cube);
  if (!energy.empty())
    fill_layer(energy, std::log(f.energy_ratio), threads, &FootprintGrid<double>::ln_energy, cube);
  fill_borders(cube);
  return cube;
}

}  // namespace vegard::sim
