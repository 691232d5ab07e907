// Dual numbers over lane types, compiled once per instruction set. See sim/base/number/dual_body.h.
#if defined(VEGARD_SIM_BASE_DUAL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VEGARD_SIM_BASE_DUAL_INL_H_
#undef VEGARD_SIM_BASE_DUAL_INL_H_
#else
#define VEGARD_SIM_BASE_DUAL_INL_H_
#endif

#include "sim/base/number/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace vegard::sim {
namespace HWY_NAMESPACE {

#define VEGARD_INLINE HWY_INLINE
#include "sim/base/number/dual_body.h"
#undef VEGARD_INLINE

}  // namespace HWY_NAMESPACE
}  // namespace vegard::sim
HWY_AFTER_NAMESPACE();

#endif
