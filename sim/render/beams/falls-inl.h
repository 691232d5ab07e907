// Lets beams fall and adds their light to a film, for any lens: values, records and derivatives.
#if defined(VEGARD_SIM_RENDER_FALLS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VEGARD_SIM_RENDER_FALLS_INL_H_
#undef VEGARD_SIM_RENDER_FALLS_INL_H_
#else
#define VEGARD_SIM_RENDER_FALLS_INL_H_
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <type_traits>

#include "sim/base/number/dual-inl.h"
#include "sim/base/number/lanes-inl.h"
#include "sim/render/beams/kernel_types.h"
#include "sim/render/beams/reference-inl.h"
#include "sim/render/beams/samples-inl.h"
#include "sim/view/film/splat-inl.h"
#include "sim/view/film/tangent_film.h"

HWY_BEFORE_NAMESPACE();
namespace vegard::sim {
namespace HWY_NAMESPACE {

constexpr int kMaxLines = 8;  // on one film

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

/// Where the samples of a block go: computes for sixteen samples at a time what splat_from_profile computes
/// for one. Entries are undefined where the light is 0.
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

/// Returns a thread's block. This is a separate function so that there is only one block for each kLocals:
/// thread_local objects take stack space in every thread, used or not.
template <int kLocals>
SampleBlock<float, kLocals>& block_of_thread() {
  static thread_local SampleBlock<float, kLocals> block;
  return block;
}

/// Passes every block with visible samples to `take`.
template <template <class> class Film, bool kSee = true, class Take>
HWY_INLINE std::uint64_t fall_values(const KernelScene& scene, const BeamGroup* groups, std::size_t count,
                                     const Take& take) {
  SampleMaker<Film, Pack, Pack, Pack, Pack, 0> maker(scene);
  SampleBlock<float, 0>& block = block_of_thread<0>();
  std::uint64_t points = 0;
  for (std::size_t g = 0; g < count; ++g) {
    const float* profile = scene.profiles[groups[g].profile].rate.data();
    maker.begin(groups[g]);
    while (maker.template next_block<kSee>(block, points)) take(block, profile);
  }
  return points;
}

template <template <class> class Film, int kQuartets>
std::uint64_t fall_and_splat(const KernelScene& scene, const BeamGroup* groups, std::size_t count,
                             std::int64_t* film) {
  constexpr int kStride = 4 * kQuartets;
  static thread_local BlockPlaces places;
  const int columns = scene.film.columns;
  return fall_values<Film>(
      scene, groups, count, [&](const SampleBlock<float, 0>& block, const float* profile) {
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
            std::int64_t* cell = film + static_cast<std::ptrdiff_t>(places.cell[step][beam]) * kStride;
            if (shares.right == 0.0f)  // most of them, on a film with ramps
              splat_in_column<kQuartets>(shares, columns, cell, lines);
            else
              splat<kQuartets>(shares, columns, cell, lines);
          }
        }
      });
}

template <template <class> class Film, int kQuartets>
std::uint64_t fall_and_record(const KernelScene& scene, const BeamGroup* groups, std::size_t count,
                              SplatRecord& record) {
  return fall_values<Film>(
      scene, groups, count, [&](const SampleBlock<float, 0>& block, const float* profile) {
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

/// Does the part of fall_on_film before the film without any result.
template <template <class> class Film>
std::uint64_t fall_until_phase(const KernelScene& scene, const BeamGroup* groups, std::size_t count,
                               FallPhase phase) {
  if (phase == FallPhase::path)
    return fall_values<Film, false>(scene, groups, count, [](const SampleBlock<float, 0>&, const float*) {});
  static thread_local BlockPlaces places;
  return fall_values<Film>(scene, groups, count, [&](const SampleBlock<float, 0>& block, const float*) {
    places.find(block, scene.film.columns);
  });
}

template <template <class> class Film>
std::uint64_t fall_on(const KernelScene& scene, const BeamGroup* groups, std::size_t count,
                      std::int64_t* film) {
  return scene.profiles[0].stride == 4 ? fall_and_splat<Film, 1>(scene, groups, count, film)
                                       : fall_and_splat<Film, 2>(scene, groups, count, film);
}

template <template <class> class Film>
std::uint64_t record_on(const KernelScene& scene, const BeamGroup* groups, std::size_t count,
                        SplatRecord& record) {
  return scene.profiles[0].stride == 4 ? fall_and_record<Film, 1>(scene, groups, count, record)
                                       : fall_and_record<Film, 2>(scene, groups, count, record);
}

/// Converts derivatives with respect to a group's local inputs to those with respect to the free parameters
/// by the chain rule, once per number.
template <int kLocals>
class Expansion {
 public:
  Expansion(const SharedChain& shared, const int* inputs) {
    for (int k = beam_inputs; k < kLocals; ++k) rows_[k] = one_hot(shared.parameter_of_local[inputs[k]]);
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

/// The local inputs whose derivatives the kernel carries, at most kMaxCarried: first the beams' own, then the
/// shared ones that are free, then others, so that any number of leading ones can be used.
class CarriedInputs {
 public:
  explicit CarriedInputs(const SharedChain& shared) {
    for (int k = 0; k < local_inputs; ++k)
      if (k < beam_inputs || shared.parameter_of_local[k] >= 0) inputs_[needed_++] = k;
    int count = needed_;
    for (int k = beam_inputs; k < local_inputs; ++k)
      if (shared.parameter_of_local[k] < 0) inputs_[count++] = k;
  }
  const int* inputs() const { return inputs_; }
  int needed() const { return needed_; }

 private:
  int inputs_[local_inputs], needed_ = 0;
};

template <template <class> class Film, class P, class C, class F, int kLocals, int kLines>
std::uint64_t fall_tangents(const KernelScene& scene, const SharedChain& shared, const CarriedInputs& carried,
                            const BeamGroup* groups, const GroupChain* chains, std::size_t count,
                            std::int64_t* film, TangentFilm& tangents) {
  SampleMaker<Film, Pack, P, C, F, kLocals> maker(scene, carried.inputs());
  SampleBlock<float, kLocals>& block = block_of_thread<kLocals>();
  Expansion<kLocals> expand(shared, carried.inputs());
  std::uint64_t points = 0;
  constexpr int kStride = kLines <= 4 ? 4 : 8;  // as in the profiles
  const auto cell_at = [&](int column, int row) {
    constexpr int kTile = TangentFilm::kTileColumns;
    const std::ptrdiff_t in_tile = static_cast<std::ptrdiff_t>(row) * kTile + column % kTile;
    return tangents.tile(column / kTile) + in_tile * kLines * kTangentWidth;
  };
  constexpr std::ptrdiff_t kRowPitch = TangentFilm::kTileColumns * kLines * kTangentWidth;
  const bool off_ramps = scene.film.ramp_px > 0.0;  // where the column does not move with anything
  for (std::size_t g = 0; g < count; ++g) {
    const HeightProfile& profile = scene.profiles[groups[g].profile];
    const Wide by_energy = Expansion<kLocals>::one_hot(shared.parameter_of_energy[groups[g].profile]);
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
          if (off_ramps && column.v == static_cast<float>(static_cast<int>(column.v)))
            splat_tangents_in_column<kLines>(column, row, of_line, kRowPitch, cell_at);
          else
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
template <template <class> class Film, int kLines>
std::uint64_t fall_tangents_of_lines(const KernelScene& scene, const SharedChain& shared,
                                     const BeamGroup* groups, const GroupChain* chains, std::size_t count,
                                     std::int64_t* film, TangentFilm& tangents) {
  if constexpr (kLines > 1) {
    if (tangents.lines() < kLines)
      return fall_tangents_of_lines<Film, kLines - 1>(scene, shared, groups, chains, count, film, tangents);
  }
  const CarriedInputs carried(shared);
  const auto fall = [&](auto position, auto common, auto axes, auto locals) {
    return fall_tangents<Film, decltype(position), decltype(common), decltype(axes), locals.value, kLines>(
        scene, shared, carried, groups, chains, count, film, tangents);
  };
  const auto fall_with = [&](auto locals) {
    using All = LaneDual<Pack, locals.value>;
    return fall(All(), All(), All(), locals);
  };
  using Beams = LaneDual<Pack, beam_inputs>;
  constexpr std::integral_constant<int, beam_inputs> of_beams{};
  if (carried.needed() > 6) return fall_with(std::integral_constant<int, kMaxCarried>());
  if (carried.needed() > 4) return fall_with(std::integral_constant<int, 6>());
  if (carried.needed() > beam_inputs) return fall_with(std::integral_constant<int, 4>());
  if (scene.beams_own_field) return fall(Beams(), Pack(), Beams(), of_beams);
  return fall(Beams(), Pack(), Pack(), of_beams);
}

}  // namespace HWY_NAMESPACE
}  // namespace vegard::sim
HWY_AFTER_NAMESPACE();

#endif
