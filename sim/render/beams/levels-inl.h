// Adds samples to the films of a ladder of blurs: computes the place of their light after the atoms'
// lifetime, the width of its spread, and its shares of two levels.
#if defined(VEGARD_SIM_RENDER_LEVELS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VEGARD_SIM_RENDER_LEVELS_INL_H_
#undef VEGARD_SIM_RENDER_LEVELS_INL_H_
#else
#define VEGARD_SIM_RENDER_LEVELS_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "sim/base/number/constants.h"
#include "sim/render/beams/kernel_types.h"
#include "sim/render/beams/samples-inl.h"
#include "sim/view/film/level_ladder.h"

HWY_BEFORE_NAMESPACE();
namespace vegard::sim {
namespace HWY_NAMESPACE {

/// Place, spread and light of sixteen samples after the motion of the atoms. Entries are undefined where the
/// light is 0.
struct SpreadSamples {
  HWY_ALIGN float x_px[kGroup], y_px[kGroup], variance_px2[kGroup], light[kGroup];
};

/// Motion of the excited atoms, from the samples of SampleMaker. A sample does not hold its distance; it
/// follows from direction and altitude.
class AtomDrift {
 public:
  AtomDrift(const KernelScene& scene, const KernelLevels& levels) : scene_(scene), levels_(levels) {
    for (int i = 0; i < 3; ++i) {
      up_[i] = static_cast<float>(scene.view.camera_from_enu[i][2].v);
      double wind = 0.0;
      for (int j = 0; j < 3; ++j) wind += scene.view.camera_from_enu[i][j].v * levels.wind_enu_km_s[j];
      wind_km_s_[i] = static_cast<float>(wind);
      blows_ = blows_ || wind != 0.0;
    }
    focal_px_ = static_cast<float>(scene.view.lens.focal_px.v);
    center_x_px_ = scene.view.lens.principal_x_px.v;
    center_y_px_ = scene.view.lens.principal_y_px.v;
    const FilmGeometry& film = scene.film;
    x_offset_px_ = static_cast<float>(film.x0_px + 0.5 - center_x_px_);
    y_offset_px_ = static_cast<float>(film.y0_px + 0.5 - center_y_px_);
  }

  HWY_INLINE void follow(const SampleBlock<float, 0>& block, int step, const BeamGroup& group,
                         SpreadSamples& out) const {
    HWY_ALIGN float lifetime[kGroup], variance[kGroup], altitude[kGroup];
    for (int beam = 0; beam < kGroup; ++beam) {
      const bool lit = block.light[step][0][beam] != 0.0f;
      altitude[beam] = lit ? stands_at(block.altitude[step][0][beam], group, beam) : 0.0f;
      const int row = std::clamp(static_cast<int>(altitude[beam] + 0.5f), 0, HeightProfile::kAltitudes - 1);
      lifetime[beam] = levels_.lifetime_s[row];
      variance[beam] = levels_.variance_km2[row];
    }
    const Pack one(1.0f), half(0.5f), focal(focal_px_);
    const Pack observer(static_cast<float>(scene_.observer_altitude_km));
    const Pack from_centre = observer + Pack(scene_.sphere_km);
    for (int first = 0; first < kGroup; first += LaneTraits<Pack>::lanes()) {
      const auto load = [first](const float* from) { return Pack(hn::LoadU(FloatTag(), from + first)); };
      const auto store = [first](Pack p, float* to) { LaneTraits<Pack>::store(p, to + first); };
      const Pack tx = (load(block.column[step][0]) + Pack(x_offset_px_)) / focal;
      const Pack ty = (load(block.row[step][0]) + Pack(y_offset_px_)) / focal;
      const Pack slant = square_root(one + tx * tx + ty * ty);
      const Pack sine = (tx * Pack(up_[0]) + ty * Pack(up_[1]) + Pack(up_[2])) / slant;  // of the elevation
      // range^2 + 2 range b = c, from the triangle of observer, point and the Earth's centre.
      const Pack above =
          load(altitude) * Pack(HeightProfile::kStepKm) + (Pack(HeightProfile::kBottomKm) - observer);
      const Pack b = from_centre * sine, c = above * (from_centre + from_centre + above);
      const Pack depth = c / (b + square_root(b * b + c)) / slant;
      Pack x = tx, y = ty, z = depth, light = load(block.light[step][0]);
      if (blows_) {
        const Pack time = load(lifetime);
        z = depth + time * Pack(wind_km_s_[2]);
        const auto in_front = Pack(1.0f) < z;
        z = select(in_front, z, one);
        x = (tx * depth + time * Pack(wind_km_s_[0])) / z;
        y = (ty * depth + time * Pack(wind_km_s_[1])) / z;
        // The light of a volume in its cell is proportional to r / Z^3 (sim/view/camera/lens-inl.h).
        const Pack nearer = depth / z;
        if (!scene_.unit_weight) light = light * nearer * nearer * (square_root(one + x * x + y * y) / slant);
        light = select(in_front, light, Pack(0.0f));
      }
      store(x * focal + Pack(center_x_px_), out.x_px);
      store(y * focal + Pack(center_y_px_), out.y_px);
      // Off the axis a pinhole draws the sphere as an ellipse: f/Z across, f/Z sqrt(1 + tan^2) outwards. The
      // mean of the two variances is used for both.
      const Pack scale = focal / z;
      store(load(variance) * scale * scale * (one + half * (x * x + y * y)), out.variance_px2);
      store(light, out.light);
    }
  }

 private:
  /// Returns the altitude of a sample, in steps of the height profile, from that at which the profile is
  /// read.
  static HWY_INLINE float stands_at(float read_at, const BeamGroup& group, int beam) {
    if (!group.reads_elsewhere) return read_at;
    const double read_km = HeightProfile::kBottomKm + static_cast<double>(read_at) * HeightProfile::kStepKm;
    return static_cast<float>((altitude_of_read_km(group, beam, read_km) - HeightProfile::kBottomKm) /
                              HeightProfile::kStepKm);
  }

  const KernelScene& scene_;
  const KernelLevels& levels_;
  float up_[3], wind_km_s_[3], focal_px_, x_offset_px_, y_offset_px_;
  double center_x_px_, center_y_px_;
  bool blows_ = false;
};

/// The nearest integer, good for |x| < 2^51: adding 1.5 * 2^52 leaves it in the low bits of the double.
HWY_INLINE std::int64_t nearest_integer(double x) {
  constexpr double kMagic = 6755399441055744.0;
  const double sum = x + kMagic;
  std::int64_t bits, magic_bits;
  std::memcpy(&bits, &sum, sizeof bits);
  std::memcpy(&magic_bits, &kMagic, sizeof magic_bits);
  return bits - magic_bits;
}

/// Adds light (in film units) at a place of the picture to a level's film: with the quadratic B-spline to 3 x
/// 3 cells if these are larger than a pixel, otherwise bilinearly to 2 x 2. Light that is not completely on
/// the film is too far from the picture to matter and is dropped.
HWY_INLINE void splat_on_level(const FilmGeometry& film, float x_px, float y_px, double light,
                               std::int64_t* cells) {
  const double cell_px = film.cell_width_px;
  const double column = (x_px - film.x0_px) / cell_px - 0.5, row = (y_px - film.y0_px) / cell_px - 0.5;
  const bool smooth = cell_px > 1.0;
  const double least = smooth ? 0.5 : 0.0, most = smooth ? 1.5 : 1.0;
  if (!(column >= least && row >= least && column < film.columns - most && row < film.rows - most)) return;
  const int taps = smooth ? 3 : 2;
  const auto weigh = [smooth](double place, int& first, double weight[3]) {
    if (smooth) {
      const int centre = static_cast<int>(place + 0.5);
      const double t = place - centre;
      first = centre - 1;
      weight[0] = 0.5 * (0.5 - t) * (0.5 - t);
      weight[1] = 0.75 - t * t;
      weight[2] = 0.5 * (0.5 + t) * (0.5 + t);
    } else {
      first = static_cast<int>(place);
      weight[1] = place - first;
      weight[0] = 1.0 - weight[1];
    }
  };
  int left, top;
  double across[3], down[3];
  weigh(column, left, across);
  weigh(row, top, down);
  for (int r = 0; r < taps; ++r) {
    std::int64_t* cell = cells + static_cast<std::ptrdiff_t>(top + r) * film.columns + left;
    for (int c = 0; c < taps; ++c) cell[c] += nearest_integer(light * down[r] * across[c]);
  }
}

inline std::uint64_t fall_and_spread(const KernelScene& scene, const KernelLevels& levels,
                                     const BeamGroup* groups, std::size_t count, std::int64_t* const* films) {
  SampleMaker<PinholeFilm, Pack, Pack, Pack, Pack, 0> maker(scene);
  static thread_local SampleBlock<float, 0> block;
  const AtomDrift way(scene, levels);
  SpreadSamples samples;
  std::uint64_t points = 0;
  for (std::size_t g = 0; g < count; ++g) {
    const HeightProfile& profile = scene.profiles[groups[g].profile];
    maker.begin(groups[g]);
    while (maker.next_block(block, points)) {
      for (int step = block.first_step; step < block.end_step; ++step) {
        way.follow(block, step, groups[g], samples);
        for (int beam = 0; beam < kGroup; ++beam) {
          if (samples.light[beam] == 0.0f) continue;
          const float altitude = block.altitude[step][0][beam];
          const int below = static_cast<int>(altitude);
          const float* rate = profile.rate.data() + static_cast<std::ptrdiff_t>(below) * profile.stride;
          const float emission =
              rate[0] + (rate[profile.stride] - rate[0]) * (altitude - static_cast<float>(below));
          const double light = static_cast<double>(samples.light[beam] * emission) * kFilmUnitsPerRayleigh;
          const LevelShare share = level_share(levels.variance_px2, levels.count, samples.variance_px2[beam]);
          const double upper = light * share.upper_share;
          const auto splat_on = [&](int level, double amount) {
            if (amount > 0.0)
              splat_on_level(levels.films[level], samples.x_px[beam], samples.y_px[beam], amount,
                             films[level]);
          };
          splat_on(share.lower, light - upper);
          splat_on(share.lower + 1, upper);
        }
      }
    }
  }
  return points;
}

}  // namespace HWY_NAMESPACE
}  // namespace vegard::sim
HWY_AFTER_NAMESPACE();

#endif
