// Like sim/render/beams/kernel.cpp, compiled once for every instruction set that is worth it.
#include "sim/render/beams/kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/render/beams/kernel_levels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "sim/render/beams/levels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace vegard::sim {
namespace HWY_NAMESPACE {

std::uint64_t FallOnLevels(const KernelScene& scene, const KernelLevels& levels, const BeamGroup* groups,
                           std::size_t count, std::int64_t* const* films) {
  return fall_and_spread(scene, levels, groups, count, films);
}

}  // namespace HWY_NAMESPACE
}  // namespace vegard::sim
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vegard::sim {

HWY_EXPORT(FallOnLevels);

std::uint64_t fall_on_levels(const KernelScene& scene, const KernelLevels& levels, const BeamGroup* groups,
                             std::size_t count, std::int64_t* const* films) {
  return HWY_DYNAMIC_DISPATCH(FallOnLevels)(scene, levels, groups, count, films);
}

}  // namespace vegard::sim
#endif
