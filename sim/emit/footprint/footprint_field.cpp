// A footprint's light as a field in space.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/emit/footprint/foot_projection.h"
#include "sim/emit/footprint/footprint_emitter.h"
#include "sim/emit/footprint/scalar_march.h"

namespace vegard::sim {
namespace {

class FootprintField : public LightField {
 public:
  FootprintField(const Scene& scene, const Footprint& footprint, const ProfileTable& profiles,
                 std::array<FootprintGrid<double>, 6> grids, double turned_deg = 0.0)
      : grids_(std::move(grids)),
        profile_(profiles, footprint.top_km, 0.0),
        rays_(scene, footprint, profile_.bottom_km(), turned_deg),
        rule_(rule_of_foot<double>(scene, footprint, plain_number, turned_deg)) {
    f_.projection = rule_.projection;
    f_.sphere_km = rule_.sphere_km;
    std::copy_n(rule_.axis, 3, f_.axis);
    f_.patches = rule_.patches ? rule_.patches->data() : nullptr;
    f_.profile = &profile_;
    f_.ln_energy_shift = f_.flux_shift = 0.0;
    for (int face = 0; face < 6; ++face) f_.grid[face] = &grids_[face];
    for (const FootprintGrid<double>& grid : grids_)
      for (const double flux : grid.flux_mw_m2) least_ = std::max(least_, flux * kDarkShare);
  }
  FootprintField(const FootprintField&) = delete;
  FootprintField& operator=(const FootprintField&) = delete;

  /// Texels by places, and the maps of what is dark.
  void finish(double texels, double first_x, double first_y, std::vector<LitMap> maps) {
    f_.texels = texels;
    f_.first_x = first_x;
    f_.first_y = first_y;
    lit_ = std::move(maps);
    for (std::size_t face = 0; face < lit_.size(); ++face) f_.lit[face] = &lit_[face];
    find_bounds();
  }
  double min_flux() const { return least_; }
  const FootprintGrid<double>& grid(int face) const { return grids_[face]; }

  Box3 bounds() const override { return bounds_; }

  bool is_dark(const Box3& box) const override {
    AirPoint<double> corner[8], middle;
    double centre[3], half2 = 0.0;
    for (int i = 0; i < 3; ++i) {
      if (box.low[i] > bounds_.high[i] || box.high[i] < bounds_.low[i]) return true;
      centre[i] = 0.5 * (box.low[i] + box.high[i]);
      half2 += 0.25 * (box.high[i] - box.low[i]) * (box.high[i] - box.low[i]);
    }
    rays_.place_of(centre, middle.x, middle.square);
    const double altitude = altitude_km(middle, f_.sphere_km), half = std::sqrt(half2);
    if (altitude + half < rays_.bottom_km() || altitude - half > rays_.top_km()) return true;
    if (half > 500.0) return false;  // feet run too crookedly to be bounded by their corners
    for (int c = 0; c < 8; ++c) {
      const double at[3] = {c & 1 ? box.high[0] : box.low[0], c & 2 ? box.high[1] : box.low[1],
                            c & 4 ? box.high[2] : box.low[2]};
      rays_.place_of(at, corner[c].x, corner[c].square);
    }
    return ScalarMarch<double, double>(f_).are_dark(middle, corner, 8);
  }

  void sample(std::size_t count, const double* const point[3], float* const emission[],
              float* density) const override {
    const ScalarMarch<double, double> march(f_);
    for (std::size_t i = 0; i < count; ++i) {
      const double enu[3] = {point[0][i], point[1][i], point[2][i]};
      AirPoint<double> p;
      rays_.place_of(enu, p.x, p.square);
      const double altitude = altitude_km(p, f_.sphere_km);
      double light[kMaxLines] = {};
      const bool lit =
          altitude >= rays_.bottom_km() && altitude <= rays_.top_km() && march.light_at(p, 0, light);
      for (int l = 0; l < profile_.lines(); ++l) emission[l][i] = lit ? static_cast<float>(light[l]) : 0.0f;
      if (density != nullptr) density[i] = 0.0f;
    }
  }

 private:
  /// Around the columns over all texels with light, and a texel more.
  void find_bounds() {
    for (int i = 0; i < 3; ++i) {
      bounds_.low[i] = std::numeric_limits<double>::infinity();
      bounds_.high[i] = -bounds_.low[i];
    }
    for (int face = 0; face < 6; ++face) {
      const FootprintGrid<double>& grid = grids_[face];
      for (std::size_t i = 0; i < grid.flux_mw_m2.size(); ++i) {
        if (!(grid.flux_mw_m2[i] > least_)) continue;
        const int column = static_cast<int>(i % grid.columns), row = static_cast<int>(i / grid.columns);
        for (int corner = 0; corner < 4; ++corner)
          take_column(face, column + (corner % 2 == 0 ? -1 : 1), row + (corner < 2 ? -1 : 1));
      }
    }
    if (!(bounds_.low[0] <= bounds_.high[0]))
      for (int i = 0; i < 3; ++i) bounds_.low[i] = bounds_.high[i] = 0.0;
  }

  void take_column(int face, double x, double y) {
    const double u = (x - f_.first_x) / f_.texels, v = (y - f_.first_y) / f_.texels;
    double foot[3], up[3];
    const double radius = f_.sphere_km + kFootAltitudeKm;
    if (is_shell_projection(f_.projection)) {
      const int a = face / 2;
      const double scale = radius / std::sqrt(1.0 + u * u + v * v);
      foot[a] = face % 2 == 0 ? scale : -scale;
      foot[(a + 1) % 3] = u * scale;
      foot[(a + 2) % 3] = v * scale;
    } else {
      const double height2 = radius * radius - u * u - v * v;
      if (height2 <= 0.0) return;
      foot[0] = u, foot[1] = v, foot[2] = std::sqrt(height2);
    }
    double place[3], fall[3];
    for (int i = 0; i < 3; ++i) place[i] = foot[i] / radius;
    fall_at_place(rule_, place, fall);
    for (int i = 0; i < 3; ++i) up[i] = -fall[i];
    const double rise = (foot[0] * up[0] + foot[1] * up[1] + foot[2] * up[2]);
    for (const double altitude : {rays_.bottom_km(), rays_.top_km()}) {
      const double squares = (altitude - kFootAltitudeKm) * (altitude + kFootAltitudeKm + 2.0 * f_.sphere_km);
      const double way = -rise + std::copysign(std::sqrt(std::max(0.0, rise * rise + squares)), rise);
      const double above[3] = {foot[0] + way * up[0], foot[1] + way * up[1], foot[2] + way * up[2]};
      double enu[3];
      rays_.enu_of(above, enu);
      for (int i = 0; i < 3; ++i) {
        bounds_.low[i] = std::min(bounds_.low[i], enu[i]);
        bounds_.high[i] = std::max(bounds_.high[i], enu[i]);
      }
    }
  }

  std::array<FootprintGrid<double>, 6> grids_;
  StepProfile profile_;
  MarchRays rays_;
  FootRule<double> rule_;
  ScalarFootprint<double, double> f_;
  std::vector<LitMap> lit_;
  double least_ = 0.0;
  Box3 bounds_{};
};

}  // namespace

std::unique_ptr<LightField> plane_footprint_field(const Scene& scene, const Footprint& footprint,
                                                  PlaneFootprint<double> map, const ProfileTable& profiles,
                                                  int threads) {
  std::array<FootprintGrid<double>, 6> grids;
  grids[0] = std::move(map.grid);
  auto field = std::make_unique<FootprintField>(scene, footprint, profiles, std::move(grids));
  const FootprintGrid<double>& grid = field->grid(0);
  std::vector<LitMap> maps;
  maps.push_back(plane_lit_map(grid.columns, grid.rows, lit_texels(grid, field->min_flux()), threads));
  const double texels = 1.0 / map.cell_km;
  field->finish(texels, -map.west_km * texels - 0.5, -map.south_km * texels - 0.5, std::move(maps));
  return field;
}

std::unique_ptr<LightField> cube_footprint_field(const Scene& scene, const Footprint& footprint,
                                                 CubeFootprint<double> map, const ProfileTable& profiles,
                                                 int threads) {
  auto field =
      std::make_unique<FootprintField>(scene, footprint, profiles, std::move(map.face), map.turned_deg);
  std::array<std::vector<std::uint8_t>, 6> lit;
  for (int face = 0; face < 6; ++face) lit[face] = lit_texels(field->grid(face), field->min_flux());
  const double half = 0.5 * map.face_cells;
  field->finish(half, half + 0.5, half + 0.5, cube_lit_maps(map.face_cells, lit, threads));
  return field;
}

}  // namespace vegard::sim
