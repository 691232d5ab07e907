// The levels' splat and books, instantiated for the instruction set that this file is compiled for; and
// point-like light through the kernel.
#include "sim/render/beams/kernel.h"
#include "sim/render/beams/levels-inl.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

#include "sim/light/excited_atom.h"
#include "sim/render/beams/beams.h"
#include "sim/render/beams/kernel_scene.h"
#include "sim/scene/lines/emission_lines.h"

namespace vegard::sim::levels_test {
namespace {

struct Moments {
  double total = 0.0, x = 0.0, y = 0.0, xx = 0.0, yy = 0.0;  ///< the means, and the variances about them
};

Moments moments_of(const Image& picture) {
  Moments m;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const double light = picture.at(x, y, 0);
      m.total += light;
      m.x += light * (x + 0.5);
      m.y += light * (y + 0.5);
    }
  m.x /= m.total;
  m.y /= m.total;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const double light = picture.at(x, y, 0) / m.total;
      m.xx += light * (x + 0.5 - m.x) * (x + 0.5 - m.x);
      m.yy += light * (y + 0.5 - m.y) * (y + 0.5 - m.y);
    }
  return m;
}

void add_units(const BlurLevel& level, const std::vector<std::int64_t>& units, Image& picture) {
  std::vector<float> cells;
  for (const std::int64_t u : units) cells.push_back(static_cast<float>(u / kFilmUnitsPerRayleigh));
  add_level(level, cells, picture, 0, 1);
}

TEST(LevelLadder, SharesKeepTheTotalAndTheVariance) {
  const std::vector<BlurLevel> levels = level_ladder(100, 80, 60.0);
  std::vector<float> variances;
  for (const BlurLevel& level : levels) variances.push_back(static_cast<float>(level.variance_px2));
  EXPECT_EQ(variances.front(), 0.0f);
  EXPECT_GE(variances.back(), 60.0f * 60.0f);
  const int count = static_cast<int>(variances.size());
  for (double v = 0.0; v < 3600.0; v = 1.07 * v + 0.01) {
    const LevelShare share = level_share(variances.data(), count, static_cast<float>(v));
    ASSERT_GE(share.lower, 0);
    ASSERT_LT(share.lower + 1, count);
    ASSERT_GE(share.upper_share, 0.0f);
    ASSERT_LE(share.upper_share, 1.0f);
    const double kept =
        variances[share.lower] * (1.0 - share.upper_share) + variances[share.lower + 1] * share.upper_share;
    ASSERT_NEAR(kept, v, 1e-5 * (v + 1.0));
  }
  const LevelShare beyond = level_share(variances.data(), count, 1e9f);
  EXPECT_EQ(beyond.lower, count - 2);
  EXPECT_EQ(beyond.upper_share, 1.0f);
}

TEST(LevelLadder, EveryLevelSpreadsAPointByItsVarianceWhereverItLies) {
  constexpr int kSize = 241;
  for (const BlurLevel& level : level_ladder(kSize, kSize, 20.0)) {
    // The ladder's widths to within its kernels' cut at 4 sigma, which takes 0.1 % of the variance.
    const double steps = level.variance_px2 > 0.0 ? std::log2(level.variance_px2 / (0.71 * 0.71)) : 0.0;
    EXPECT_NEAR(steps, std::round(steps), 0.01);
    for (const double offset : {0.0, 0.31, 0.5, 1.77, 5.2}) {
      const double x = 0.5 * kSize + offset, y = 0.5 * kSize - 0.7 * offset;
      std::vector<std::int64_t> units(level.cells(), 0);
      HWY_NAMESPACE::splat_on_level(level.film, static_cast<float>(x), static_cast<float>(y),
                                    1000.0 * kFilmUnitsPerRayleigh, units.data());
      Image picture(kSize, kSize, {"light"});
      add_units(level, units, picture);
      const Moments m = moments_of(picture);
      // Kernels in float, and the picture's sampling of a smooth curve: all below a ten thousandth.
      EXPECT_NEAR(m.total, 1000.0, 0.1);
      EXPECT_NEAR(m.x, x, 1e-3 * (1.0 + std::sqrt(level.variance_px2)));
      EXPECT_NEAR(m.y, y, 1e-3 * (1.0 + std::sqrt(level.variance_px2)));
      const auto of_splat = [&](double place) {  // f (1 - f), of which 1/6 is not in the books
        const double f = place - 0.5 - std::floor(place - 0.5);
        return level.smooth() ? -1.0 / 6.0 : f * (1.0 - f);
      };
      const double allowed = 1e-3 * level.variance_px2 + 1e-4;
      EXPECT_NEAR(m.xx, level.variance_px2 + (level.smooth() ? 1.0 / 6.0 : of_splat(x)), allowed);
      EXPECT_NEAR(m.yy, level.variance_px2 + (level.smooth() ? 1.0 / 6.0 : of_splat(y)), allowed);
      if (!level.smooth()) continue;
      // And the shape is a Gaussian's: the splines are boxes summed, which at 1.4 cells to the width leaves a
      // flatter top, by 1.5 % of the peak.
      const double v = level.variance_px2 + 1.0 / 6.0, peak = 1000.0 / (2.0 * std::acos(-1.0) * v);
      double worst = 0.0;
      for (int j = 0; j < kSize; ++j)
        for (int i = 0; i < kSize; ++i) {
          const double r2 = std::pow(i + 0.5 - x, 2) + std::pow(j + 0.5 - y, 2);
          worst = std::max(worst, std::abs(picture.at(i, j, 0) - peak * std::exp(-0.5 * r2 / v)));
        }
      EXPECT_LT(worst, 0.02 * peak) << std::sqrt(v) << " pixels";
    }
  }
}

/// A vertical beam due north that shines within a kilometre of one altitude only.
class PointLight {
 public:
  PointLight(double altitude_km, double azimuth_of_camera_deg) {
    scene.seed = 5;
    scene.camera.width = 480;
    scene.camera.height = 480;
    scene.camera.hfov_deg = 60.0;
    scene.camera.azimuth_deg = azimuth_of_camera_deg;
    scene.camera.elevation_deg = 40.0;
    scene.field.inclination_deg = 90.0;
    scene.emission.lines = {630.0};
    scene.blur.width_deg = {0.0};
    Sheet sheet;
    sheet.center_km = {0.0, 250.0};
    sheet.length_km = 0.1;
    sheet.layers = 1;
    sheet.beams = 1;
    sheet.width_km = 0.01;
    sheet.thickness_km = 0.0;
    sheet.loss_cone_deg = 0.0;
    sheet.pitch_step_rad = 0.0;
    sheet.path_step = 0.0005;
    scene.sheets = {sheet};
    profiles = height_profiles(scene);
    for (int a = 0; a < HeightProfile::kAltitudes; ++a) {
      const double h = HeightProfile::kBottomKm + a * HeightProfile::kStepKm;
      profiles[0].rate[static_cast<std::size_t>(a) * profiles[0].stride] =
          std::abs(h - altitude_km) < 0.6 ? 1e9f : 0.0f;
    }
    film.columns = film.rows = 480;
  }

  std::vector<BeamGroup> groups(const FilmGeometry& on) const {
    const BeamLayout layout(scene, 0.0);
    PackedChunk packed;
    layout.pack(scene, layout.chunks().front(),
                kernel_scene(scene, scene.sheets[0], scene.sheets[0].path_step, on, profiles), packed);
    return packed.groups;
  }

  Image plain() const {
    std::vector<std::int64_t> units(480 * 480 * 4, 0);
    const KernelScene kernel =
        kernel_scene(scene, scene.sheets[0], scene.sheets[0].path_step, film, profiles);
    const std::vector<BeamGroup> fallen = groups(film);
    fall_on_film(kernel, fallen.data(), fallen.size(), units.data());
    Image picture(480, 480, {"light"});
    for (std::size_t i = 0; i < picture.data.size(); ++i)
      picture.data[i] = static_cast<float>(units[4 * i] / kFilmUnitsPerRayleigh);
    return picture;
  }

  Image spread(const SpreadProfile& spread, EastNorth wind_m_s = {}) const {
    const std::vector<BlurLevel> levels = level_ladder(480, 480, 100.0);
    FilmGeometry seen;
    seen.x0_px = seen.y0_px = -400.0;
    seen.columns = seen.rows = 1280;
    KernelLevels kernel_levels;
    kernel_levels.lifetime_s = spread.lifetime_s.data();
    kernel_levels.variance_km2 = spread.variance_km2.data();
    kernel_levels.wind_enu_km_s[0] = 1e-3 * wind_m_s.east;
    kernel_levels.wind_enu_km_s[1] = 1e-3 * wind_m_s.north;
    kernel_levels.count = static_cast<int>(levels.size());
    std::vector<FilmGeometry> films;
    std::vector<float> variances;
    std::vector<std::vector<std::int64_t>> units;
    std::vector<std::int64_t*> cells;
    for (const BlurLevel& level : levels) {
      films.push_back(level.film);
      variances.push_back(static_cast<float>(level.variance_px2));
      units.emplace_back(level.cells(), 0);
    }
    for (auto& of_level : units) cells.push_back(of_level.data());
    kernel_levels.films = films.data();
    kernel_levels.variance_px2 = variances.data();
    const KernelScene kernel =
        kernel_scene(scene, scene.sheets[0], scene.sheets[0].path_step, seen, profiles);
    const std::vector<BeamGroup> fallen = groups(seen);
    fall_on_levels(kernel, kernel_levels, fallen.data(), fallen.size(), cells.data());
    Image picture(480, 480, {"light"});
    for (std::size_t l = 0; l < levels.size(); ++l) add_units(levels[l], units[l], picture);
    return picture;
  }

  Scene scene;
  FilmGeometry film;
  std::vector<HeightProfile> profiles;
};

const EmissionLine& red() { return *find_emission_line(630.0); }

/// The light's place in the camera's frame, km; the Earth is round.
void place_in_camera(const PointLight& light, double altitude_km, double to[3]) {
  const double north = light.scene.sheets[0].center_km.north;
  // Beams are parallel to the observer's vertical here: the same distance to the north at every altitude.
  const double up = std::sqrt(std::pow(kEarthRadiusKm + altitude_km, 2) - north * north) - kEarthRadiusKm;
  const CameraView<double> view = camera_view(light.scene.camera);
  for (int i = 0; i < 3; ++i) to[i] = view.camera_from_enu[i][1] * north + view.camera_from_enu[i][2] * up;
}

TEST(FallOnLevels, GivesAPointTheVarianceOfItsAtomsAndKeepsItsLight) {
  for (const double altitude_km : {180.0, 250.0, 330.0}) {
    for (const double azimuth_deg : {0.0, 17.0}) {
      const PointLight light(altitude_km, azimuth_deg);
      const SpreadProfile spread = spread_profile(red(), 0.0);
      const Moments before = moments_of(light.plain()), after = moments_of(light.spread(spread));
      double place[3];
      place_in_camera(light, altitude_km, place);
      const double focal = camera_view(light.scene.camera).lens.focal_px;
      const double x = place[0] / place[2], y = place[1] / place[2], scale = focal / place[2];
      const auto a = static_cast<std::size_t>((altitude_km - 80.0) / HeightProfile::kStepKm);
      const double expected = spread.variance_km2[a] * scale * scale * (1.0 + 0.5 * (x * x + y * y));
      // The light's kilometre of altitude changes the variance by some per cent about its middle; the kernels
      // end at 4 sigma, of which the books know. 1 % is left for the sum.
      EXPECT_NEAR(after.total / before.total, 1.0, 1e-3) << altitude_km;
      EXPECT_NEAR(after.x, before.x, 0.02 + 1e-3 * std::sqrt(expected));
      EXPECT_NEAR(after.y, before.y, 0.02 + 1e-2 * std::sqrt(expected));
      EXPECT_NEAR((after.xx - before.xx) / expected, 1.0, 0.015) << altitude_km << " km at " << azimuth_deg;
      EXPECT_NEAR((after.yy - before.yy) / expected, 1.0, 0.015) << altitude_km << " km at " << azimuth_deg;
    }
  }
}

TEST(FallOnLevels, WithoutLifetimeIsTheOrdinaryFilm) {
  const PointLight light(250.0, 5.0);
  SpreadProfile none;
  none.lifetime_s.assign(HeightProfile::kAltitudes, 0.0f);
  none.variance_km2.assign(HeightProfile::kAltitudes, 0.0f);
  const Image plain = light.plain(), spread = light.spread(none, {300.0, -200.0});
  const float brightest = *std::max_element(plain.data.begin(), plain.data.end());
  ASSERT_GT(brightest, 0.0f);
  // Films of other sizes: a float's rounding of the place, and so of the shares of the four cells.
  for (std::size_t i = 0; i < plain.data.size(); ++i)
    ASSERT_NEAR(spread.data[i], plain.data[i], 1e-3f * brightest) << i;
}

TEST(FallOnLevels, MovesTheLightWithTheWind) {
  constexpr double kAltitude = 250.0;
  const PointLight light(kAltitude, 0.0);
  SpreadProfile drift;
  drift.lifetime_s.assign(HeightProfile::kAltitudes, 30.0f);
  drift.variance_km2.assign(HeightProfile::kAltitudes, 0.0f);
  const Moments before = moments_of(light.plain());
  const Moments east = moments_of(light.spread(drift, {500.0, 0.0}));
  const Moments north = moments_of(light.spread(drift, {0.0, 500.0}));
  double place[3];
  place_in_camera(light, kAltitude, place);
  const CameraView<double> view = camera_view(light.scene.camera);
  const double carried_km = 15.0;
  EXPECT_NEAR(east.x - before.x, view.lens.focal_px * carried_km / place[2], 0.02);
  EXPECT_NEAR(east.y, before.y, 0.02);
  EXPECT_NEAR(east.total / before.total, std::hypot(1.0, carried_km / std::hypot(place[1], place[2])), 1e-3)
      << "r / Z^3 grows with the distance at the same depth";
  const double moved[2] = {place[1] + view.camera_from_enu[1][1] * carried_km,
                           place[2] + view.camera_from_enu[2][1] * carried_km};
  EXPECT_NEAR(north.y - before.y, view.lens.focal_px * (moved[0] / moved[1] - place[1] / place[2]), 0.02);
  const double r = std::hypot(place[1], place[2]), moved_r = std::hypot(moved[0], moved[1]);
  EXPECT_NEAR(north.total / before.total, moved_r / r * std::pow(place[2] / moved[1], 3), 1e-3);
}

}  // namespace
}  // namespace vegard::sim::levels_test
