// Compiled once for every instruction set that is worth it; chosen when the program runs.
#include "sim/render/beams/kernel.h"

#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/render/beams/kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "sim/base/number/dual-inl.h"
#include "sim/base/number/lanes-inl.h"
#include "sim/render/beams/falls-inl.h"
#include "sim/render/beams/points-inl.h"

HWY_BEFORE_NAMESPACE();
namespace vegard::sim {
namespace HWY_NAMESPACE {

std::uint64_t FallUntil(const KernelScene& scene, const BeamGroup* groups, std::size_t count,
                        FallPhase phase) {
  return fall_until_phase<PinholeFilm>(scene, groups, count, phase);
}

std::uint64_t FallOnFilm(const KernelScene& scene, const BeamGroup* groups, std::size_t count,
                         std::int64_t* film) {
  return fall_on<PinholeFilm>(scene, groups, count, film);
}

std::uint64_t RecordSplats(const KernelScene& scene, const BeamGroup* groups, std::size_t count,
                           SplatRecord& record) {
  return record_on<PinholeFilm>(scene, groups, count, record);
}

std::uint64_t FallReference(const KernelScene& scene, const BeamGroup* groups, std::size_t count,
                            double* film) {
  return fall_reference<PinholeFilm>(scene, groups, count, film);
}

void ListPoints(const KernelScene& scene, const BeamGroup* groups, std::size_t count, EmissionPoints& out) {
  list_every_point(scene, groups, count, out);
}

std::uint64_t FallWithTangents(const KernelScene& scene, const SharedChain& shared, const BeamGroup* groups,
                               const GroupChain* chains, std::size_t count, std::int64_t* film,
                               TangentFilm& tangents) {
  return fall_tangents_of_lines<PinholeFilm, kMaxLines>(scene, shared, groups, chains, count, film, tangents);
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

HWY_EXPORT(FallUntil);
HWY_EXPORT(FallOnFilm);
HWY_EXPORT(RecordSplats);
HWY_EXPORT(FallReference);
HWY_EXPORT(ListPoints);
HWY_EXPORT(FallWithTangents);
HWY_EXPORT(SplatAll);
HWY_EXPORT(InstructionSet);

std::uint64_t fall_on_film(const KernelScene& scene, const BeamGroup* groups, std::size_t count,
                           std::int64_t* film) {
  if (!scene.plain_pinhole) return fall_on_film_by_lens(scene, groups, count, film);
  return HWY_DYNAMIC_DISPATCH(FallOnFilm)(scene, groups, count, film);
}

std::uint64_t fall_until(const KernelScene& scene, const BeamGroup* groups, std::size_t count,
                         FallPhase phase) {
  if (!scene.plain_pinhole) return fall_until_by_lens(scene, groups, count, phase);
  return HWY_DYNAMIC_DISPATCH(FallUntil)(scene, groups, count, phase);
}

std::uint64_t fall_on_film_reference(const KernelScene& scene, const BeamGroup* groups, std::size_t count,
                                     double* film) {
  if (!scene.plain_pinhole) return fall_reference_by_lens(scene, groups, count, film);
  return HWY_DYNAMIC_DISPATCH(FallReference)(scene, groups, count, film);
}

void list_points(const KernelScene& scene, const BeamGroup* groups, std::size_t count, EmissionPoints& out) {
  HWY_DYNAMIC_DISPATCH(ListPoints)(scene, groups, count, out);
}

std::uint64_t fall_on_film_with_tangents(const KernelScene& scene, const SharedChain& shared,
                                         const BeamGroup* groups, const GroupChain* chains, std::size_t count,
                                         std::int64_t* film, TangentFilm& tangents) {
  if (!scene.plain_pinhole)
    return fall_with_tangents_by_lens(scene, shared, groups, chains, count, film, tangents);
  return HWY_DYNAMIC_DISPATCH(FallWithTangents)(scene, shared, groups, chains, count, film, tangents);
}

std::uint64_t record_splats(const KernelScene& scene, const BeamGroup* groups, std::size_t count,
                            SplatRecord& record) {
  if (!scene.plain_pinhole) return record_splats_by_lens(scene, groups, count, record);
  return HWY_DYNAMIC_DISPATCH(RecordSplats)(scene, groups, count, record);
}

void splat_on_film(const FilmGeometry& geometry, int stride, const float* column, const float* row,
                   const float* weights, std::size_t points, std::int64_t* film) {
  HWY_DYNAMIC_DISPATCH(SplatAll)(geometry, stride, column, row, weights, points, film);
}

const char* kernel_instruction_set() { return HWY_DYNAMIC_DISPATCH(InstructionSet)(); }

}  // namespace vegard::sim
#endif
