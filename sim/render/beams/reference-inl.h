// The reference with which tests compare the kernel: the same samples in double precision, added to the film
// one by one.
#if defined(VEGARD_SIM_RENDER_REFERENCE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VEGARD_SIM_RENDER_REFERENCE_INL_H_
#undef VEGARD_SIM_RENDER_REFERENCE_INL_H_
#else
#define VEGARD_SIM_RENDER_REFERENCE_INL_H_
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

#include "sim/render/beams/samples-inl.h"

HWY_BEFORE_NAMESPACE();
namespace vegard::sim {
namespace HWY_NAMESPACE {

template <template <class> class Film>
inline std::uint64_t fall_reference(const KernelScene& scene, const BeamGroup* groups, std::size_t count,
                                    double* film) {
  SampleMaker<Film, double, double, double, double, 0> maker(scene);
  static thread_local SampleBlock<double, 0> block;
  std::uint64_t points = 0;
  for (std::size_t g = 0; g < count; ++g) {
    const HeightProfile& profile = scene.profiles[groups[g].profile];
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

}  // namespace HWY_NAMESPACE
}  // namespace vegard::sim
HWY_AFTER_NAMESPACE();

#endif
