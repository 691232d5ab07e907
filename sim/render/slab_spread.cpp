#include "sim/render/slab_spread.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "sim/base/number/constants.h"
#include "sim/base/parallel.h"
#include "sim/view/camera/camera.h"
#include "sim/view/film/level_ladder.h"

namespace vegard::sim {
namespace {

constexpr double kNearestKm = 1.0;
constexpr double kVarianceOfBilinear = 1.0 / 6.0;  // of a cell's square

double observer_altitude_km(const Scene& scene) { return 1e-3 * scene.site.altitude_m; }

double bilinear_px2(const FilmGeometry& film) {
  return 0.5 * kVarianceOfBilinear *
         (film.cell_width_px * film.cell_width_px + film.cell_height_px * film.cell_height_px);
}

/// The variance in px^2 on the film per square radian of variance in direction.
double px2_per_rad2(const PlaceSlopes& slopes) {
  double squares = 0.0;
  for (const auto& axis : slopes.slope)
    for (const double slope : axis) squares += slope * slope;
  return 0.5 * squares;
}

/// Light after the wind has carried it: its place and spread on the film, and its distance.
struct CarriedLight {
  double x_px = 0.0, y_px = 0.0, px2 = 0.0, far_km = 0.0;
  float gain = 0.0f;
};

/// The wind that carries a slab's excited atoms before they shine.
class WindShift {
 public:
  WindShift(const Scene& scene, const AltitudeSlab& slab)
      : view_(camera_view(scene.camera)),
        carried_km_{1e-3 * scene.blur.wind_m_s.east * slab.lifetime_s,
                    1e-3 * scene.blur.wind_m_s.north * slab.lifetime_s} {}

  bool moves() const { return carried_km_[0] != 0.0 || carried_km_[1] != 0.0; }

  /// Returns where light at a distance along a direction goes; none if it leaves what the lens sees, or comes
  /// too near.
  std::optional<CarriedLight> carried(const std::array<float, 3>& enu, double far_km) const {
    double place[3], length2 = 0.0;
    for (int i = 0; i < 3; ++i) place[i] = enu[i] * far_km + (i < 2 ? carried_km_[i] : 0.0);
    for (const double axis : place) length2 += axis * axis;
    double in_camera[3];
    for (int r = 0; r < 3; ++r) {
      in_camera[r] = 0.0;
      for (int i = 0; i < 3; ++i) in_camera[r] += view_.camera_from_enu[r][i] * place[i] / std::sqrt(length2);
    }
    CarriedLight light;
    if (!(length2 > kNearestKm * kNearestKm && project(view_.lens, in_camera, light.x_px, light.y_px)))
      return std::nullopt;
    // Photons come from all of its volume, and go as 1 / (r^2 Omega).
    const PlaceSlopes there = place_slopes(view_.lens, in_camera);
    const double here = solid_angle_scale(enu);
    light.px2 = px2_per_rad2(there);
    light.gain = here > 0.0
                     ? static_cast<float>(std::abs(there.determinant()) / here * far_km * far_km / length2)
                     : 0.0f;
    light.far_km = std::sqrt(length2);
    return light;
  }

 private:
  /// The area on the film, in px^2, of a steradian in a direction.
  double solid_angle_scale(const std::array<float, 3>& enu) const {
    double in_camera[3];
    for (int r = 0; r < 3; ++r) {
      in_camera[r] = 0.0;
      for (int i = 0; i < 3; ++i) in_camera[r] += view_.camera_from_enu[r][i] * enu[i];
    }
    return std::abs(place_slopes(view_.lens, in_camera).determinant());
  }

  CameraView<double> view_;
  double carried_km_[2];
};

/// The levels of the ladder that some light goes to.
struct LevelRange {
  int least, most;

  void include(const LevelShare& share) {
    least = std::min(least, share.lower);
    most = std::max(most, share.lower + (share.upper_share > 0.0f ? 1 : 0));
  }
};

}  // namespace

double range_to_altitude_km(double observer_km, double sine, double altitude_km, double sphere_km) {
  const double from_centre = sphere_km + observer_km, above = altitude_km - observer_km;
  const double b = from_centre * sine, c = above * (2.0 * from_centre + above), square = b * b + c;
  double range = 0.0;
  if (c >= 0.0)
    range = c / (b + std::sqrt(square));
  else if (b < 0.0)  // an observer above the light
    range =
        square > 0.0 && std::isfinite(ground_km(observer_km, sine, sphere_km)) ? -b - std::sqrt(square) : -b;
  return std::max(std::isfinite(range) ? range : 0.0, kNearestKm);
}

FilmSight film_sight(const Scene& scene, const FilmGeometry& film, bool with_directions, int threads) {
  const CameraView<double> view = camera_view(scene.camera);
  FilmSight sight;
  sight.film = film;
  const std::size_t cells = static_cast<std::size_t>(film.rows) * film.columns;
  sight.sine.assign(cells, 0.0f);
  sight.px2.assign(cells, 0.0f);
  if (with_directions)
    for (std::vector<float>& axis : sight.enu) axis.assign(cells, 0.0f);
  parallel_for(static_cast<std::size_t>(film.rows), threads, [&](std::size_t row, int) {
    for (int column = 0; column < film.columns; ++column) {
      const double x_px = film.x0_px + (column + 0.5) * film.cell_width_px,
                   y_px = film.y0_px + (static_cast<double>(row) + 0.5) * film.cell_height_px;
      double in_camera[3], enu[3];
      if (!unproject(view.lens, x_px, y_px, in_camera) || !enu_of_pixel(view, x_px, y_px, enu)) continue;
      const PlaceSlopes slopes = place_slopes(view.lens, in_camera);
      const std::size_t cell = row * film.columns + column;
      sight.sine[cell] = static_cast<float>(enu[2]);
      sight.px2[cell] = static_cast<float>(px2_per_rad2(slopes));
      if (with_directions)
        for (int i = 0; i < 3; ++i) sight.enu[i][cell] = static_cast<float>(enu[i]);
    }
  });
  return sight;
}

SpreadRange spread_range(const Scene& scene, const FilmSight& sight, double altitude_km,
                         double variance_km2) {
  const double observer_km = observer_altitude_km(scene);
  SpreadRange range;
  bool any = false;
  for (std::size_t cell = 0; cell < sight.px2.size(); ++cell) {
    if (sight.px2[cell] == 0.0f) continue;
    const double far_km =
        range_to_altitude_km(observer_km, sight.sine[cell], altitude_km, scene.body.radius_km);
    const double px = std::sqrt(variance_km2 * sight.px2[cell]) / far_km;
    range.min_px = any ? std::min(range.min_px, px) : px;
    range.max_px = std::max(range.max_px, px);
    any = true;
  }
  return range;
}

SlabSpread::SlabSpread(const FilmGeometry& film, double widest_px)
    : film_(film), widest_px_(widest_px), levels_(film_ladder(film, widest_px)) {
  for (const FilmLevel& level : levels_) variance_px2_.push_back(static_cast<float>(level.variance_px2));
}

SlabPlaces SlabSpread::places(const Scene& scene, const FilmSight& sight, const AltitudeSlab& slab,
                              bool is_calm, int threads) const {
  const FilmGeometry& film = sight.film;
  const std::size_t cells = sight.px2.size();
  const double observer_km = observer_altitude_km(scene);
  const double variance_km2 = is_calm ? slab.calm_variance_km2 : slab.variance_km2;
  // Wide cells have spread it by so much already.
  const double already_px2 = std::max(0.0, bilinear_px2(film) - bilinear_px2(film_));
  const WindShift wind(scene, slab);
  const bool is_carried = !is_calm && !sight.enu[0].empty() && wind.moves();
  SlabPlaces places;
  places.lower.assign(cells, 0);
  places.upper_share.assign(cells, 0.0f);
  if (is_carried) {
    places.x_px.assign(cells, 0.0f);
    places.y_px.assign(cells, 0.0f);
    places.gain.assign(cells, 0.0f);
  }
  std::vector<LevelRange> row_levels(static_cast<std::size_t>(film.rows),
                                     LevelRange{static_cast<int>(levels_.size()) - 1, 0});
  parallel_for(row_levels.size(), threads, [&](std::size_t row, int) {
    for (int column = 0; column < film.columns; ++column) {
      const std::size_t cell = row * film.columns + column;
      double px2 = sight.px2[cell];
      if (px2 > 0.0) {
        double far_km =
            range_to_altitude_km(observer_km, sight.sine[cell], slab.altitude_km, scene.body.radius_km);
        if (is_carried)
          if (const auto carried = wind.carried(sight.direction(cell), far_km)) {
            places.x_px[cell] = static_cast<float>(carried->x_px);
            places.y_px[cell] = static_cast<float>(carried->y_px);
            places.gain[cell] = carried->gain;
            px2 = carried->px2;
            far_km = carried->far_km;
          }
        px2 = std::clamp(variance_km2 * px2 / (far_km * far_km) - already_px2, 0.0, widest_px_ * widest_px_);
      }
      const LevelShare share =
          level_share(variance_px2_.data(), static_cast<int>(levels_.size()), static_cast<float>(px2));
      places.lower[cell] = static_cast<std::uint8_t>(share.lower);
      places.upper_share[cell] = share.upper_share;
      row_levels[row].include(share);
    }
  });
  places.least = static_cast<int>(levels_.size()) - 1;
  for (const LevelRange& levels : row_levels) {
    places.least = std::min(places.least, levels.least);
    places.most = std::max(places.most, levels.most);
  }
  return places;
}

void SlabSpread::add(const std::vector<SlabLight>& light, int width, float* planes, int threads) const {
  const int at_once = thread_count(threads);
  std::vector<std::vector<float>> buffers(at_once), scratch(at_once);
  std::vector<std::uint8_t> lit(at_once);
  const auto fill = [&](const FilmLevel& level, int index, std::vector<float>& cells) {
    bool any = false;
    cells.assign(level.cells() * static_cast<std::size_t>(width), 0.0f);
    const double area = level.across.cell_px * level.down.cell_px;
    for (const SlabLight& from : light) {
      const SlabPlaces& places = *from.places;
      if (index < places.least || index > places.most) continue;
      const FilmGeometry& film = *from.film;
      const double per_cell = film.cell_width_px * film.cell_height_px / area;
      for (int row = 0; row < film.rows; ++row)
        for (int column = 0; column < film.columns; ++column) {
          const std::size_t cell = static_cast<std::size_t>(row) * film.columns + column;
          const int lower = places.lower[cell];
          if (lower != index && lower + 1 != index) continue;
          double share = lower == index ? 1.0 - places.upper_share[cell] : places.upper_share[cell];
          const float* cell_light = from.planes + cell * from.stride;
          if (share == 0.0 || std::all_of(cell_light, cell_light + width, [](float x) { return x == 0.0f; }))
            continue;
          any = true;
          double x_px = film.x0_px + (column + 0.5) * film.cell_width_px,
                 y_px = film.y0_px + (row + 0.5) * film.cell_height_px;
          if (!places.x_px.empty()) {
            x_px = places.x_px[cell];
            y_px = places.y_px[cell];
            share *= places.gain[cell];
          }
          splat_on_film_level(level, x_px, y_px, share * per_cell, cell_light, width, cells.data());
        }
    }
    return any;
  };
  for (std::size_t first = 0; first < levels_.size(); first += static_cast<std::size_t>(at_once)) {
    const std::size_t some = std::min<std::size_t>(at_once, levels_.size() - first);
    parallel_for(some, threads, [&](std::size_t i, int) {
      const FilmLevel& level = levels_[first + i];
      lit[i] = fill(level, static_cast<int>(first + i), buffers[i]);
      if (lit[i]) blur_level(level, width, buffers[i], scratch[i]);
    });
    for (std::size_t i = 0; i < some; ++i)
      if (lit[i]) add_film_level(levels_[first + i], buffers[i], film_, width, planes, threads);
  }
}

}  // namespace vegard::sim
