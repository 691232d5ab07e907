// Compiled once for every instruction set that is worth it; chosen when the program runs. Lane by lane the
// same operations in the same order, so that all give the same bits.
#include "sim/render/ground/ground_light.h"

#include <cstddef>
#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/render/ground/ground_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace vegard::sim {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, kGroundEnergies>;
using Vector = hn::Vec<Tag>;
constexpr std::size_t kLanes = hn::MaxLanes(Tag());
constexpr std::size_t kParts = kGroundEnergies / kLanes;

/// All energies of a cell.
struct Energies {
  Vector part[kParts];
};

HWY_INLINE Energies load(const float* from) {
  Energies e;
  for (std::size_t p = 0; p < kParts; ++p) e.part[p] = hn::LoadU(Tag(), from + p * kLanes);
  return e;
}

HWY_INLINE Energies fill(float value) {
  Energies e;
  for (std::size_t p = 0; p < kParts; ++p) e.part[p] = hn::Set(Tag(), value);
  return e;
}

HWY_INLINE Energies times(const Energies& a, const Energies& b) {
  Energies e;
  for (std::size_t p = 0; p < kParts; ++p) e.part[p] = hn::Mul(a.part[p], b.part[p]);
  return e;
}

HWY_INLINE Energies plus(const Energies& a, const Energies& b) {
  Energies e;
  for (std::size_t p = 0; p < kParts; ++p) e.part[p] = hn::Add(a.part[p], b.part[p]);
  return e;
}

HWY_INLINE void store(const Energies& e, float* to) {
  for (std::size_t p = 0; p < kParts; ++p) hn::StoreU(e.part[p], Tag(), to + p * kLanes);
}

/// Returns the sum, added in the same order with every instruction set.
HWY_INLINE float sum_of(const Energies& e) {
  float lane[kGroundEnergies];
  store(e, lane);
  for (int half = kGroundEnergies / 2; half > 0; half /= 2)
    for (int i = 0; i < half; ++i) lane[i] += lane[i + half];
  return lane[0];
}

HWY_INLINE float km(const SightStretch& s) {
  return static_cast<float>(s.length) * static_cast<float>(kSightUnitKm);
}

template <int kLines>
HWY_INLINE void sum_lines(const SightLines& lines, const GroundRates& rates, const float* flux,
                          std::size_t first, std::size_t last, float* light, int first_line) {
  for (std::size_t ray = first; ray < last; ++ray) {
    Energies sum[kLines];
    for (Energies& s : sum) s = fill(0.0f);
    for (std::size_t i = lines.first[ray]; i < lines.first[ray + 1]; ++i) {
      const SightStretch stretch = lines.stretch[i];
      const Energies share =
          times(load(flux + std::size_t{stretch.cell} * kGroundEnergies), fill(km(stretch)));
      const float* rate =
          rates.rate + (std::size_t{stretch.bin} * rates.lines + first_line) * kGroundEnergies;
      for (int line = 0; line < kLines; ++line)
        sum[line] = plus(sum[line], times(load(rate + line * kGroundEnergies), share));
    }
    for (int line = 0; line < kLines; ++line)
      light[ray * rates.lines + first_line + line] = sum_of(sum[line]);
  }
}

template <int kLines>
HWY_INLINE void spread_lines(const SightLines& lines, const GroundRates& rates, const float* light,
                             std::size_t first, std::size_t last, float* flux, int first_line) {
  for (std::size_t ray = first; ray < last; ++ray) {
    Energies of_line[kLines];
    for (int line = 0; line < kLines; ++line)
      of_line[line] = fill(light[ray * rates.lines + first_line + line]);
    if (lines.first[ray] == lines.first[ray + 1]) continue;
    // A ray is often in one cell for some stretches: its sum is written when the ray leaves it.
    float* cell = flux + std::size_t{lines.stretch[lines.first[ray]].cell} * kGroundEnergies;
    Energies in_cell = load(cell);
    for (std::size_t i = lines.first[ray]; i < lines.first[ray + 1]; ++i) {
      const SightStretch stretch = lines.stretch[i];
      const float* rate =
          rates.rate + (std::size_t{stretch.bin} * rates.lines + first_line) * kGroundEnergies;
      Energies sum = times(load(rate), of_line[0]);
      for (int line = 1; line < kLines; ++line)
        sum = plus(sum, times(load(rate + line * kGroundEnergies), of_line[line]));
      float* const there = flux + std::size_t{stretch.cell} * kGroundEnergies;
      if (there != cell) {
        store(in_cell, cell);
        cell = there;
        in_cell = load(cell);
      }
      in_cell = plus(in_cell, times(sum, fill(km(stretch))));
    }
    store(in_cell, cell);
  }
}

void SumLight(const SightLines& lines, const GroundRates& rates, const float* flux, std::size_t first,
              std::size_t last, float* light) {
  int line = 0;
  for (; line + 3 <= rates.lines; line += 3) sum_lines<3>(lines, rates, flux, first, last, light, line);
  if (rates.lines - line == 2) sum_lines<2>(lines, rates, flux, first, last, light, line);
  if (rates.lines - line == 1) sum_lines<1>(lines, rates, flux, first, last, light, line);
}

void SpreadLight(const SightLines& lines, const GroundRates& rates, const float* light, std::size_t first,
                 std::size_t last, float* flux) {
  int line = 0;
  for (; line + 3 <= rates.lines; line += 3) spread_lines<3>(lines, rates, light, first, last, flux, line);
  if (rates.lines - line == 2) spread_lines<2>(lines, rates, light, first, last, flux, line);
  if (rates.lines - line == 1) spread_lines<1>(lines, rates, light, first, last, flux, line);
}

}  // namespace HWY_NAMESPACE
}  // namespace vegard::sim
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vegard::sim {

HWY_EXPORT(SumLight);
HWY_EXPORT(SpreadLight);

void sum_light(const SightLines& lines, const GroundRates& rates, const float* flux, std::size_t first,
               std::size_t last, float* light) {
  HWY_DYNAMIC_DISPATCH(SumLight)(lines, rates, flux, first, last, light);
}

void spread_light(const SightLines& lines, const GroundRates& rates, const float* light, std::size_t first,
                  std::size_t last, float* flux) {
  HWY_DYNAMIC_DISPATCH(SpreadLight)(lines, rates, light, first, last, flux);
}

}  // namespace vegard::sim
#endif
