// Compiled once for every instruction set that is worth it; chosen when the program runs.
#include "sim/render_kernel.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <new>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/render_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "sim/base/dual-inl.h"
#include "sim/base/lanes-inl.h"
#include "sim/emit/aurora/fall-inl.h"
#include "sim/view/project-inl.h"
#include "sim/view/splat-inl.h"
#include "sim/view/splat_tangents-inl.h"

HWY_BEFORE_NAMESPACE();
namespace vegard::sim {
namespace HWY_NAMESPACE {

constexpr int kBlockSteps = 32;
constexpr int kMostLines = 8;  // on one film

/// Samples of a group for kBlockSteps steps, ready for the film. kLocals derivatives go with every number.
template <class S, int kLocals>
struct SampleBlock {
  S column[kBlockSteps][1 + kLocals][kGroup];
  S row[kBlockSteps][1 + kLocals][kGroup];
  S light[kBlockSteps][1 + kLocals][kGroup];     ///< 0 where there is nothing to see
  S altitude[kBlockSteps][1 + kLocals][kGroup];  ///< in steps of the height profile above its bottom
  int first_step, end_step;                      ///< there is nothing to see outside these
};

// Numbers with kLocals derivatives, in and out of arrays.
template <class L, int kLocals>
using LaneDual = Dual<L, Tangents<L, kLocals>>;

template <class L>
HWY_INLINE void fetch(const GroupNumber& from, int first, L& to) {
  to = LaneTraits<L>::load(from.value + first);
}
template <class L, int kLocals>
HWY_INLINE void fetch(const GroupNumber& from, int first, LaneDual<L, kLocals>& to) {
  to.v = LaneTraits<L>::load(from.value + first);
  for (int k = 0; k < kLocals; ++k) to.d.t[k] = LaneTraits<L>::load(from.tangent[k] + first);
}
template <class L>
HWY_INLINE void spread(const LocalDual& from, L& to) {
  to = L(from.v);
}
template <class L, int kLocals>
HWY_INLINE void spread(const LocalDual& from, LaneDual<L, kLocals>& to) {
  to.v = L(from.v);
  for (int k = 0; k < kLocals; ++k) to.d.t[k] = L(from.d.t[k]);
}
template <class L, class S>
HWY_INLINE void keep(const L& from, S (*to)[kGroup], int first) {
  LaneTraits<L>::store(from, to[0] + first);
}
template <class L, int kLocals, class S>
HWY_INLINE void keep(const LaneDual<L, kLocals>& from, S (*to)[kGroup], int first) {
  LaneTraits<L>::store(from.v, to[0] + first);
  for (int k = 0; k < kLocals; ++k) LaneTraits<L>::store(from.d.t[k], to[1 + k] + first);
}
/// A number that is zero, with its derivatives, outside the mask.
template <class L, class M>
HWY_INLINE L only_where(M mask, const L& x) {
  return select(mask, x, L(0.0f));
}
template <class L, int kLocals, class M>
HWY_INLINE LaneDual<L, kLocals> only_where(M mask, const LaneDual<L, kLocals>& x) {
  LaneDual<L, kLocals> r;
  r.v = select(mask, x.v, L(0.0f));
  for (int k = 0; k < kLocals; ++k) r.d.t[k] = select(mask, x.d.t[k], L(0.0f));
  return r;
}

/// The chain from beams to samples. L: lane type; P: positions; C: what all beams share.
template <class L, class P, class C, int kLocals>
class SampleMaker {
 public:
  using Traits = LaneTraits<L>;
  using Block = SampleBlock<typename Traits::Scalar, kLocals>;

  explicit SampleMaker(const KernelScene& scene) : scene_(scene) {
    for (int i = 0; i < 3; ++i) {
      spread(scene.fall.along[i], frame_.along[i]);
      spread(scene.fall.across1[i], frame_.across1[i]);
      spread(scene.fall.across2[i], frame_.across2[i]);
      for (int j = 0; j < 3; ++j)
        spread(scene.view.camera_from_enu[i][j], film_.camera.camera_from_enu[i][j]);
    }
    spread(scene.deflection.loss_cone_rad, deflection_.loss_cone_rad);
    spread(scene.deflection.pitch_step_rad, deflection_.pitch_step_rad);
    deflection_.law = scene.deflection.law;
    deflection_.path_step = scene.deflection.path_step;
    spread(scene.view.focal_px, film_.camera.focal_px);
    const FilmGeometry& g = scene.film;
    film_.column_scale = L(1.0 / g.cell_width_px);
    film_.row_scale = L(1.0 / g.cell_height_px);
    film_.column_offset = L((scene.center_x_px - g.x0_px) / g.cell_width_px - 0.5);
    film_.row_offset = L((scene.center_y_px - g.y0_px) / g.cell_height_px - 0.5);
    film_.per_cell_area = L(1.0f) / L(g.cell_width_px * g.cell_height_px);
    philox_keys(scene.seed, keys_);
    const double focal = scene.view.focal_px.v;
    left_ = (g.x0_px - g.cell_width_px - scene.center_x_px) / focal;
    right_ = (g.x0_px + (g.columns + 1) * g.cell_width_px - scene.center_x_px) / focal;
    top_ = (g.y0_px - g.cell_height_px - scene.center_y_px) / focal;
    bottom_ = (g.y0_px + (g.rows + 1) * g.cell_height_px - scene.center_y_px) / focal;
    stray_ =
        1.25 * (std::abs(scene.deflection.loss_cone_rad.v) + std::abs(scene.deflection.pitch_step_rad.v));
  }

  void begin(const BeamGroup& group) {
    for (int first = 0, part = 0; first < kGroup; first += Traits::lanes(), ++part) {
      P start[3], length;
      for (int i = 0; i < 3; ++i) fetch(group.start_in_enu_km[i], first, start[i]);
      fetch(group.length_km, first, length);
      fetch(group.vertical, first, vertical_[part]);
      flux_[part] = Traits::load(group.flux_km2_mw_m2 + first) * L(0.1f);
      end_[part] = Traits::load(group.end_of_path + first);
      beams_[part].start(start, length, Traits::load_indices(group.index + first), group.layer_address,
                         keys_);
      find_stretch_in_view(start, value_of(length), part);
    }
  }

  /// Fills a block; false when every beam has come to its end or can no more be seen. Adds to `points` those
  /// on a path.
  bool next_block(Block& block, std::uint64_t& points) {
    bool alive = false;
    block.first_step = kBlockSteps;
    block.end_step = 0;
    for (int first = 0, part = 0; first < kGroup; first += Traits::lanes(), ++part) {
      for (int step = 0; step < kBlockSteps; step += 2) {
        FallenPoint<L, P> fallen[2];
        beams_[part].next_two(frame_, deflection_, keys_, fallen);
        for (int i = 0; i < 2; ++i) {
          const L t = fallen[i].t;
          points += static_cast<std::uint64_t>(count(t <= end_[part]));
          alive |= !none(t <= last_in_view_[part]);
          if (none(first_in_view_[part] <= t && t <= last_in_view_[part])) {
            Traits::store(L(0.0f), block.light[step + i][0] + first);
            continue;
          }
          block.first_step = std::min(block.first_step, step + i);
          block.end_step = std::max(block.end_step, step + i + 1);
          see(fallen[i], part, first, step + i, block);
        }
      }
    }
    return alive;
  }

 private:
  /// The stretch of the path outside of which a beam surely misses the film. A point strays from the straight
  /// line by no more than its path times the pitch angle; the film's four edges are planes through the
  /// camera.
  HWY_INLINE void find_stretch_in_view(const P start_in_enu_km[3], L length_km, int part) {
    const L slack_km(0.05f);  // far above the rounding of floats
    L start[3], way[3];
    for (int i = 0; i < 3; ++i) {
      const auto* row = scene_.view.camera_from_enu[i];
      start[i] = way[i] = L(0.0f);
      for (int j = 0; j < 3; ++j) {
        start[i] = start[i] + value_of(start_in_enu_km[j]) * L(row[j].v);
        way[i] = way[i] + length_km * L(row[j].v * scene_.fall.along[j].v);
      }
    }
    L first(0.0f), last = end_[part];
    const auto keep_inside = [&](int axis, double edge, double side) {
      const L outward(side), depth(-side * edge), length(std::sqrt(1.0 + edge * edge));
      const L beyond = start[axis] * outward + start[2] * depth - slack_km * length;
      const L grow = way[axis] * outward + way[2] * depth - length_km * L(stray_) * length;
      const L crossing = L(0.0f) - beyond / select(grow < L(0.0f), grow, L(-1e-30f));
      const L leaving = L(0.0f) - beyond / select(L(0.0f) < grow, grow, L(1e-30f));
      const auto outside = L(0.0f) < beyond;
      first = select(outside && first < crossing, crossing, first);
      last = select(beyond <= L(0.0f) && leaving < last, leaving, last);
    };
    keep_inside(0, left_, -1.0);
    keep_inside(0, right_, 1.0);
    keep_inside(1, top_, -1.0);
    keep_inside(1, bottom_, 1.0);
    first_in_view_[part] = first;
    last_in_view_[part] = last;
  }

  HWY_INLINE void see(const FallenPoint<L, P>& point, int part, int first, int step, Block& block) {
    auto in_front = L(0.0f) < L(1.0f);
    SeenPoint<P> seen = see_point<L>(film_, point.position_in_enu_km, in_front);
    const P above = (altitude_km(point.position_in_enu_km, L(scene_.observer_altitude_km)) -
                     L(static_cast<float>(HeightProfile::kBottomKm))) *
                    L(static_cast<float>(1.0 / HeightProfile::kStepKm));
    const L h = value_of(above);
    if (scene_.nearest_cell) {
      seen.column = P(round_to_nearest(value_of(seen.column)));
      seen.row = P(round_to_nearest(value_of(seen.row)));
    }
    const L x = value_of(seen.column), y = value_of(seen.row);
    const auto on_path = point.t <= end_[part];
    const L last_column(static_cast<float>(scene_.film.columns - 1)),
        last_row(static_cast<float>(scene_.film.rows - 1));
    const auto visible = on_path && in_front && L(0.0f) <= x && x < last_column && L(0.0f) <= y &&
                         y < last_row && L(0.0f) <= h &&
                         h < L(static_cast<float>(HeightProfile::kAltitudes - 1));
    const P geometry = scene_.unit_weight
                           ? P(L(1.0f))
                           : point.stretch_km * vertical_[part] * seen.per_steradian_cell * flux_[part];
    keep(seen.column, block.column[step], first);
    keep(seen.row, block.row[step], first);
    keep(only_where(visible, geometry), block.light[step], first);
    keep(above, block.altitude[step], first);
  }

  const KernelScene& scene_;
  PhiloxKeys keys_;
  FallFrame<C> frame_;
  Deflection<C> deflection_;
  FilmView<L, C> film_;
  FallingBeams<L, P, C> beams_[kGroup];
  P vertical_[kGroup];
  L flux_[kGroup], end_[kGroup], first_in_view_[kGroup], last_in_view_[kGroup];
  double left_, right_, top_, bottom_;  ///< edges of the film and a cell more, as tangents
  double stray_;                        ///< from the straight line, as a fraction of the path
};

/// The light of a sample: a straight line between two rows of the height profile.
template <int kQuartets>
struct RowLight {
  const float* row;
  float above, scale;
  HWY_INLINE hn::Vec<FourFloats> operator()(int q) const {
    const FourFloats d;
    const auto here = hn::LoadU(d, row + 4 * q), next = hn::LoadU(d, row + 4 * (kQuartets + q));
    const auto rate = hn::Add(here, hn::Mul(hn::Sub(next, here), hn::Set(d, above)));
    return hn::Mul(rate, hn::Set(d, scale));
  }
};

template <int kQuartets>
HWY_INLINE RowLight<kQuartets> light_at(float altitude, float scale, const float* profile) {
  const int below = static_cast<int>(altitude);
  return {profile + static_cast<std::ptrdiff_t>(below) * 4 * kQuartets, altitude - static_cast<float>(below),
          scale};
}

template <int kQuartets>
HWY_INLINE void splat_from_profile(float column, float row, float light, float altitude, const float* profile,
                                   int film_columns, std::int64_t* film) {
  splat<kQuartets>(column, row, film_columns, film,
                   light_at<kQuartets>(altitude, light * static_cast<float>(kFilmUnitsPerRayleigh), profile));
}

/// Where the samples of a block go: what splat_from_profile works out for one sample, for sixteen at a time.
/// Nothing in it means anything where the light is 0.
struct BlockPlaces {
  HWY_ALIGN std::int32_t cell[kBlockSteps][kGroup], profile_row[kBlockSteps][kGroup];
  HWY_ALIGN float left[kBlockSteps][kGroup], right[kBlockSteps][kGroup];
  HWY_ALIGN float upper[kBlockSteps][kGroup], lower[kBlockSteps][kGroup];
  HWY_ALIGN float above_row[kBlockSteps][kGroup], light[kBlockSteps][kGroup];

  HWY_INLINE void find(const SampleBlock<float, 0>& block, int film_columns) {
    const FloatTag d;
    const IntTag i;
    const auto one = hn::Set(d, 1.0f), units = hn::Set(d, static_cast<float>(kFilmUnitsPerRayleigh));
    const auto width = hn::Set(i, film_columns);
    for (int step = block.first_step; step < block.end_step; ++step) {
      for (int first = 0; first < kGroup; first += static_cast<int>(hn::Lanes(d))) {
        const auto split = [&](const float* number, float* fraction) {
          const auto x = hn::LoadU(d, number + first);
          const auto whole = hn::ConvertTo(i, x);
          hn::StoreU(hn::Sub(x, hn::ConvertTo(d, whole)), d, fraction + first);
          return whole;
        };
        const auto column = split(block.column[step][0], right[step]);
        const auto row = split(block.row[step][0], lower[step]);
        hn::StoreU(split(block.altitude[step][0], above_row[step]), i, profile_row[step] + first);
        hn::StoreU(hn::Add(hn::Mul(row, width), column), i, cell[step] + first);
        hn::StoreU(hn::Sub(one, hn::LoadU(d, right[step] + first)), d, left[step] + first);
        hn::StoreU(hn::Sub(one, hn::LoadU(d, lower[step] + first)), d, upper[step] + first);
        hn::StoreU(hn::Mul(hn::LoadU(d, block.light[step][0] + first), units), d, light[step] + first);
      }
    }
  }
};

/// Gives every block with something to see to `take`.
template <class Take>
HWY_INLINE std::uint64_t fall_values(const KernelScene& scene, const BeamGroup* groups, std::size_t count,
                                     const Take& take) {
  SampleMaker<Pack, Pack, Pack, 0> maker(scene);
  static thread_local SampleBlock<float, 0> block;
  std::uint64_t points = 0;
  for (std::size_t g = 0; g < count; ++g) {
    const float* profile = scene.profiles[groups[g].sheet].rate.data();
    maker.begin(groups[g]);
    while (maker.next_block(block, points)) take(block, profile);
  }
  return points;
}

template <int kQuartets>
std::uint64_t fall_and_splat(const KernelScene& scene, const BeamGroup* groups, std::size_t count,
                             std::int64_t* film) {
  constexpr int kStride = 4 * kQuartets;
  static thread_local BlockPlaces places;
  const int columns = scene.film.columns;
  return fall_values(scene, groups, count, [&](const SampleBlock<float, 0>& block, const float* profile) {
    places.find(block, columns);
    for (int beam = 0; beam < kGroup; ++beam) {
      for (int step = block.first_step; step < block.end_step; ++step) {
        const float light = places.light[step][beam];
        if (light == 0.0f) continue;
        const RowLight<kQuartets> lines{
            profile + static_cast<std::ptrdiff_t>(places.profile_row[step][beam]) * kStride,
            places.above_row[step][beam], light};
        const Shares shares{places.left[step][beam], places.right[step][beam], places.upper[step][beam],
                            places.lower[step][beam]};
        splat<kQuartets>(shares, columns,
                         film + static_cast<std::ptrdiff_t>(places.cell[step][beam]) * kStride, lines);
      }
    }
  });
}

template <int kQuartets>
std::uint64_t fall_and_record(const KernelScene& scene, const BeamGroup* groups, std::size_t count,
                              SplatRecord& record) {
  return fall_values(scene, groups, count, [&](const SampleBlock<float, 0>& block, const float* profile) {
    for (int beam = 0; beam < kGroup; ++beam) {
      for (int step = block.first_step; step < block.end_step; ++step) {
        const float light = block.light[step][0][beam];
        if (light == 0.0f) continue;
        const auto lines = light_at<kQuartets>(block.altitude[step][0][beam], light, profile);
        float weights[4 * kQuartets];
        for (int q = 0; q < kQuartets; ++q) hn::StoreU(lines(q), FourFloats(), weights + 4 * q);
        record.column.push_back(block.column[step][0][beam]);
        record.row.push_back(block.row[step][0][beam]);
        record.weights.insert(record.weights.end(), weights, weights + 4 * kQuartets);
      }
    }
  });
}

std::uint64_t FallOnFilm(const KernelScene& scene, const BeamGroup* groups, std::size_t count,
                         std::int64_t* film) {
  return scene.profiles[0].stride == 4 ? fall_and_splat<1>(scene, groups, count, film)
                                       : fall_and_splat<2>(scene, groups, count, film);
}

std::uint64_t RecordSplats(const KernelScene& scene, const BeamGroup* groups, std::size_t count,
                           SplatRecord& record) {
  return scene.profiles[0].stride == 4 ? fall_and_record<1>(scene, groups, count, record)
                                       : fall_and_record<2>(scene, groups, count, record);
}

std::uint64_t FallReference(const KernelScene& scene, const BeamGroup* groups, std::size_t count,
                            double* film) {
  SampleMaker<double, double, double, 0> maker(scene);
  static thread_local SampleBlock<double, 0> block;
  std::uint64_t points = 0;
  for (std::size_t g = 0; g < count; ++g) {
    const HeightProfile& profile = scene.profiles[groups[g].sheet];
    maker.begin(groups[g]);
    while (maker.next_block(block, points)) {
      for (int beam = 0; beam < kGroup; ++beam) {
        for (int step = block.first_step; step < block.end_step; ++step) {
          const double light = block.light[step][0][beam], altitude = block.altitude[step][0][beam];
          const double column = block.column[step][0][beam], row = block.row[step][0][beam];
          if (light == 0.0) continue;
          const int below = static_cast<int>(altitude), c = static_cast<int>(column),
                    r = static_cast<int>(row);
          for (int l = 0; l < profile.lines; ++l) {
            const double here = profile.rate[below * profile.stride + l];
            const double next = profile.rate[(below + 1) * profile.stride + l];
            const double emission = (here + (next - here) * (altitude - below)) * light;
            double* cell =
                film + (static_cast<std::ptrdiff_t>(r) * scene.film.columns + c) * profile.stride + l;
            double* under = cell + static_cast<std::ptrdiff_t>(scene.film.columns) * profile.stride;
            cell[0] += emission * (1 - (column - c)) * (1 - (row - r));
            cell[profile.stride] += emission * (column - c) * (1 - (row - r));
            under[0] += emission * (1 - (column - c)) * (row - r);
            under[profile.stride] += emission * (column - c) * (row - r);
          }
        }
      }
    }
  }
  return points;
}

/// From a group's local inputs to the free parameters: the chain rule, once per number.
template <int kLocals>
class Expansion {
 public:
  Expansion(const SharedChain& shared) {
    for (int k = beam_inputs; k < kLocals; ++k) rows_[k] = one_hot(shared.parameter_of_local[k]);
  }
  static HWY_INLINE Wide one_hot(int parameter) {
    HWY_ALIGN float row[kTangentWidth] = {};
    if (parameter >= 0) row[parameter] = 1.0f;
    return Wide::load(row);
  }
  HWY_INLINE void of_beam(const GroupChain& chain, int beam) {
    rows_[foot_east] = Wide::load(chain.foot_east[beam]);
    rows_[foot_north] = Wide::load(chain.foot_north[beam]);
  }
  HWY_INLINE WideDual operator()(const float (*number)[kGroup], int beam) const {
    Wide d = rows_[0] * number[1][beam];
    for (int k = 1; k < kLocals; ++k) d = d + rows_[k] * number[1 + k][beam];
    return {number[0][beam], d};
  }

 private:
  Wide rows_[kLocals];
};

template <class P, class C, int kLocals, int kLines>
std::uint64_t fall_tangents(const KernelScene& scene, const SharedChain& shared, const BeamGroup* groups,
                            const GroupChain* chains, std::size_t count, std::int64_t* film,
                            TangentFilm& tangents) {
  SampleMaker<Pack, P, C, kLocals> maker(scene);
  static thread_local SampleBlock<float, kLocals> block;
  Expansion<kLocals> expand(shared);
  std::uint64_t points = 0;
  constexpr int kStride = kLines <= 4 ? 4 : 8;  // as in the profiles
  const auto cell_at = [&](int column, int row) {
    constexpr int kTile = TangentFilm::kTileColumns;
    const std::ptrdiff_t in_tile = static_cast<std::ptrdiff_t>(row) * kTile + column % kTile;
    return tangents.tile(column / kTile) + in_tile * kLines * kTangentWidth;
  };
  constexpr std::ptrdiff_t kRowPitch = TangentFilm::kTileColumns * kLines * kTangentWidth;
  for (std::size_t g = 0; g < count; ++g) {
    const HeightProfile& profile = scene.profiles[groups[g].sheet];
    const Wide by_energy = Expansion<kLocals>::one_hot(shared.parameter_of_energy[groups[g].sheet]);
    maker.begin(groups[g]);
    while (maker.next_block(block, points)) {
      for (int beam = 0; beam < kGroup; ++beam) {
        expand.of_beam(chains[g], beam);
        const Wide by_log_flux = Wide::load(chains[g].log_flux[beam]);
        for (int step = block.first_step; step < block.end_step; ++step) {
          const float seen = block.light[step][0][beam];
          if (seen == 0.0f) continue;
          const WideDual column = expand(block.column[step], beam), row = expand(block.row[step], beam);
          const WideDual altitude = expand(block.altitude[step], beam);
          WideDual light = expand(block.light[step], beam);
          light.d = light.d + by_log_flux * seen;
          const int below = static_cast<int>(altitude.v);
          const float above = altitude.v - static_cast<float>(below);
          const float* rate = profile.rate.data() + static_cast<std::ptrdiff_t>(below) * kStride;
          const float* by_ln_energy =
              profile.d_rate_d_ln_energy.data() + static_cast<std::ptrdiff_t>(below) * kStride;
          WideDual of_line[kLines];
          for (int l = 0; l < kLines; ++l) {
            const float slope = rate[kStride + l] - rate[l];
            const float grow = by_ln_energy[l] + (by_ln_energy[kStride + l] - by_ln_energy[l]) * above;
            const WideDual emission(rate[l] + slope * above, altitude.d * slope + by_energy * grow);
            of_line[l] = emission * light;
          }
          splat_tangents<kLines>(column, row, of_line, kRowPitch, cell_at);
          splat_from_profile<kStride / 4>(column.v, row.v, seen, altitude.v, profile.rate.data(),
                                          scene.film.columns, film);
        }
      }
    }
  }
  return points;
}

/// The number of lines is fixed when the program is compiled, so that a cell's tangents are added in one go.
template <int kLines>
std::uint64_t fall_tangents_of_lines(const KernelScene& scene, const SharedChain& shared,
                                     const BeamGroup* groups, const GroupChain* chains, std::size_t count,
                                     std::int64_t* film, TangentFilm& tangents) {
  if constexpr (kLines > 1) {
    if (tangents.lines() < kLines)
      return fall_tangents_of_lines<kLines - 1>(scene, shared, groups, chains, count, film, tangents);
  }
  if (shared.only_beam_inputs) {
    using P = LaneDual<Pack, beam_inputs>;
    return fall_tangents<P, Pack, beam_inputs, kLines>(scene, shared, groups, chains, count, film, tangents);
  }
  using P = LaneDual<Pack, local_inputs>;
  return fall_tangents<P, P, local_inputs, kLines>(scene, shared, groups, chains, count, film, tangents);
}

std::uint64_t FallWithTangents(const KernelScene& scene, const SharedChain& shared, const BeamGroup* groups,
                               const GroupChain* chains, std::size_t count, std::int64_t* film,
                               TangentFilm& tangents) {
  return fall_tangents_of_lines<kMostLines>(scene, shared, groups, chains, count, film, tangents);
}

template <int kQuartets>
void splat_all(const FilmGeometry& geometry, const float* column, const float* row, const float* weights,
               std::size_t points, std::int64_t* film) {
  const FourFloats d;
  const auto units = hn::Set(d, static_cast<float>(kFilmUnitsPerRayleigh));
  for (std::size_t i = 0; i < points; ++i) {
    const float* light = weights + i * 4 * kQuartets;
    splat<kQuartets>(column[i], row[i], geometry.columns, film,
                     [&](int q) { return hn::Mul(hn::LoadU(d, light + 4 * q), units); });
  }
}

void SplatAll(const FilmGeometry& geometry, int stride, const float* column, const float* row,
              const float* weights, std::size_t points, std::int64_t* film) {
  if (stride == 4)
    splat_all<1>(geometry, column, row, weights, points, film);
  else
    splat_all<2>(geometry, column, row, weights, points, film);
}

const char* InstructionSet() { return hwy::TargetName(HWY_TARGET); }

}  // namespace HWY_NAMESPACE
}  // namespace vegard::sim
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vegard::sim {

HWY_EXPORT(FallOnFilm);
HWY_EXPORT(RecordSplats);
HWY_EXPORT(FallReference);
HWY_EXPORT(FallWithTangents);
HWY_EXPORT(SplatAll);
HWY_EXPORT(InstructionSet);

std::uint64_t fall_on_film(const KernelScene& scene, const BeamGroup* groups, std::size_t count,
                           std::int64_t* film) {
  return HWY_DYNAMIC_DISPATCH(FallOnFilm)(scene, groups, count, film);
}

std::uint64_t fall_on_film_reference(const KernelScene& scene, const BeamGroup* groups, std::size_t count,
                                     double* film) {
  return HWY_DYNAMIC_DISPATCH(FallReference)(scene, groups, count, film);
}

std::uint64_t fall_on_film_with_tangents(const KernelScene& scene, const SharedChain& shared,
                                         const BeamGroup* groups, const GroupChain* chains, std::size_t count,
                                         std::int64_t* film, TangentFilm& tangents) {
  return HWY_DYNAMIC_DISPATCH(FallWithTangents)(scene, shared, groups, chains, count, film, tangents);
}

std::uint64_t record_splats(const KernelScene& scene, const BeamGroup* groups, std::size_t count,
                            SplatRecord& record) {
  return HWY_DYNAMIC_DISPATCH(RecordSplats)(scene, groups, count, record);
}

void splat_on_film(const FilmGeometry& geometry, int stride, const float* column, const float* row,
                   const float* weights, std::size_t points, std::int64_t* film) {
  HWY_DYNAMIC_DISPATCH(SplatAll)(geometry, stride, column, row, weights, points, film);
}

const char* kernel_instruction_set() { return HWY_DYNAMIC_DISPATCH(InstructionSet)(); }

TangentFilm::TangentFilm(int columns, int rows, int lines)
    : columns_(columns), rows_(rows), lines_(lines), tiles_((columns + kTileColumns - 1) / kTileColumns) {}

void TangentFilm::Free::operator()(float* p) const { std::free(p); }

void TangentFilm::make_tile(int index) {
  const std::size_t floats = static_cast<std::size_t>(rows_) * kTileColumns * lines_ * kTangentWidth;
  void* memory = std::aligned_alloc(64, floats * sizeof(float));
  if (memory == nullptr) throw std::bad_alloc();
  tiles_[index].reset(static_cast<float*>(memory));
  std::fill_n(tiles_[index].get(), floats, 0.0f);
}

}  // namespace vegard::sim
#endif
