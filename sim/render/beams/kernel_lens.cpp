// The kernel with any lens before the film. A file of its own: a plain pinhole, which most pictures have, is
// spared the lens's arithmetic, and two files compile side by side.
#include "sim/render/beams/kernel.h"

#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/render/beams/kernel_lens.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "sim/render/beams/falls-inl.h"
#include "sim/view/camera/lens-inl.h"

HWY_BEFORE_NAMESPACE();
namespace vegard::sim {
namespace HWY_NAMESPACE {

std::uint64_t LensUntil(const KernelScene& scene, const BeamGroup* groups, std::size_t count,
                        FallPhase phase) {
  return fall_until_phase<LensFilm>(scene, groups, count, phase);
}

std::uint64_t LensOnFilm(const KernelScene& scene, const BeamGroup* groups, std::size_t count,
                         std::int64_t* film) {
  return fall_on<LensFilm>(scene, groups, count, film);
}

std::uint64_t LensRecord(const KernelScene& scene, const BeamGroup* groups, std::size_t count,
                         SplatRecord& record) {
  return record_on<LensFilm>(scene, groups, count, record);
}

std::uint64_t LensReference(const KernelScene& scene, const BeamGroup* groups, std::size_t count,
                            double* film) {
  return fall_reference<LensFilm>(scene, groups, count, film);
}

std::uint64_t LensWithTangents(const KernelScene& scene, const SharedChain& shared, const BeamGroup* groups,
                               const GroupChain* chains, std::size_t count, std::int64_t* film,
                               TangentFilm& tangents) {
  return fall_tangents_of_lines<LensFilm, kMaxLines>(scene, shared, groups, chains, count, film, tangents);
}

}  // namespace HWY_NAMESPACE
}  // namespace vegard::sim
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vegard::sim {

HWY_EXPORT(LensUntil);
HWY_EXPORT(LensOnFilm);
HWY_EXPORT(LensRecord);
HWY_EXPORT(LensReference);
HWY_EXPORT(LensWithTangents);

std::uint64_t fall_on_film_by_lens(const KernelScene& scene, const BeamGroup* groups, std::size_t count,
                                   std::int64_t* film) {
  return HWY_DYNAMIC_DISPATCH(LensOnFilm)(scene, groups, count, film);
}

std::uint64_t fall_with_tangents_by_lens(const KernelScene& scene, const SharedChain& shared,
                                         const BeamGroup* groups, const GroupChain* chains, std::size_t count,
                                         std::int64_t* film, TangentFilm& tangents) {
  return HWY_DYNAMIC_DISPATCH(LensWithTangents)(scene, shared, groups, chains, count, film, tangents);
}

std::uint64_t fall_reference_by_lens(const KernelScene& scene, const BeamGroup* groups, std::size_t count,
                                     double* film) {
  return HWY_DYNAMIC_DISPATCH(LensReference)(scene, groups, count, film);
}

std::uint64_t fall_until_by_lens(const KernelScene& scene, const BeamGroup* groups, std::size_t count,
                                 FallPhase phase) {
  return HWY_DYNAMIC_DISPATCH(LensUntil)(scene, groups, count, phase);
}

std::uint64_t record_splats_by_lens(const KernelScene& scene, const BeamGroup* groups, std::size_t count,
                                    SplatRecord& record) {
  return HWY_DYNAMIC_DISPATCH(LensRecord)(scene, groups, count, record);
}

}  // namespace vegard::sim
#endif
