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

HWY_INLINE Energies load(const GroundNumbers& from) {
  Energies e;
  for (std::size_t p = 0; p < kParts; ++p) e.part[p] = hn::Load(Tag(), from.of_energy + p * kLanes);
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

HWY_INLINE Energies minus(const Energies& a, const Energies& b) {
  Energies e;
  for (std::size_t p = 0; p < kParts; ++p) e.part[p] = hn::Sub(a.part[p], b.part[p]);
  return e;
}

HWY_INLINE void store(const Energies& e, GroundNumbers& to) {
  for (std::size_t p = 0; p < kParts; ++p) hn::Store(e.part[p], Tag(), to.of_energy + p * kLanes);
}

/// Returns the sum, added in the same order with every instruction set.
HWY_INLINE float sum_of(const Energies& e) {
  GroundNumbers lane;
  store(e, lane);
  for (int half = kGroundEnergies / 2; half > 0; half /= 2)
    for (int i = 0; i < half; ++i) lane.of_energy[i] += lane.of_energy[i + half];
  return lane.of_energy[0];
}

/// The light below the end of a ray's last stretch, which is mostly where the next one begins.
template <int kLines>
class Rising {
 public:
  HWY_INLINE Rising(const LightBelow& light, int first_line) : light_(light), first_line_(first_line) {}

  /// The light of a stretch of a vertical column.
  HWY_INLINE void rise(const SightStretch& stretch, Energies (&gained)[kLines]) {
    if (stretch.from != level_)
      for (int line = 0; line < kLines; ++line) below_[line] = load(at(stretch.from)[line]);
    for (int line = 0; line < kLines; ++line) {
      const Energies above = load(at(stretch.to)[line]);
      gained[line] = minus(above, below_[line]);
      below_[line] = above;
    }
    level_ = stretch.to;
  }

 private:
  HWY_INLINE const GroundNumbers* at(int level) const {
    return light_.below + static_cast<std::size_t>(level) * light_.lines + first_line_;
  }

  const LightBelow& light_;
  const int first_line_;
  int level_ = -1;
  Energies below_[kLines];
};

template <int kLines>
HWY_INLINE void sum_lines(const SightLines& lines, const LightBelow& light_below, const GroundNumbers* flux,
                          std::size_t first, std::size_t last, float* light, int first_line) {
  for (std::size_t ray = first; ray < last; ++ray) {
    Energies sum[kLines], gained[kLines];
    for (Energies& s : sum) s = fill(0.0f);
    Rising<kLines> rising(light_below, first_line);
    for (std::size_t i = lines.first[ray]; i < lines.first[ray + 1]; ++i) {
      const SightStretch& stretch = lines.stretch[i];
      const Energies share = times(load(flux[stretch.cell]), fill(stretch.km_per_km));
      rising.rise(stretch, gained);
      for (int line = 0; line < kLines; ++line) sum[line] = plus(sum[line], times(gained[line], share));
    }
    for (int line = 0; line < kLines; ++line)
      light[ray * light_below.lines + first_line + line] = sum_of(sum[line]);
  }
}

template <int kLines>
HWY_INLINE void spread_lines(const SightLines& lines, const LightBelow& light_below, const float* light,
                             std::size_t first, std::size_t last, GroundNumbers* flux, int first_line) {
  for (std::size_t ray = first; ray < last; ++ray) {
    Energies of_line[kLines], gained[kLines];
    for (int line = 0; line < kLines; ++line)
      of_line[line] = fill(light[ray * light_below.lines + first_line + line]);
    Rising<kLines> rising(light_below, first_line);
    for (std::size_t i = lines.first[ray]; i < lines.first[ray + 1]; ++i) {
      const SightStretch& stretch = lines.stretch[i];
      rising.rise(stretch, gained);
      Energies sum = times(gained[0], of_line[0]);
      for (int line = 1; line < kLines; ++line) sum = plus(sum, times(gained[line], of_line[line]));
      GroundNumbers& there = flux[stretch.cell];
      store(plus(load(there), times(sum, fill(stretch.km_per_km))), there);
    }
  }
}

void SumLight(const SightLines& lines, const LightBelow& below, const GroundNumbers* flux, std::size_t first,
              std::size_t last, float* light) {
  int line = 0;
  for (; line + 3 <= below.lines; line += 3) sum_lines<3>(lines, below, flux, first, last, light, line);
  if (below.lines - line == 2) sum_lines<2>(lines, below, flux, first, last, light, line);
  if (below.lines - line == 1) sum_lines<1>(lines, below, flux, first, last, light, line);
}

void SpreadLight(const SightLines& lines, const LightBelow& below, const float* light, std::size_t first,
                 std::size_t last, GroundNumbers* flux) {
  int line = 0;
  for (; line + 3 <= below.lines; line += 3) spread_lines<3>(lines, below, light, first, last, flux, line);
  if (below.lines - line == 2) spread_lines<2>(lines, below, light, first, last, flux, line);
  if (below.lines - line == 1) spread_lines<1>(lines, below, light, first, last, flux, line);
}

}  // namespace HWY_NAMESPACE
}  // namespace vegard::sim
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vegard::sim {

HWY_EXPORT(SumLight);
HWY_EXPORT(SpreadLight);

void sum_light(const SightLines& lines, const LightBelow& light_below, const GroundNumbers* flux,
               std::size_t first, std::size_t last, float* light) {
  HWY_DYNAMIC_DISPATCH(SumLight)(lines, light_below, flux, first, last, light);
}

void spread_light(const SightLines& lines, const LightBelow& light_below, const float* light,
                  std::size_t first, std::size_t last, GroundNumbers* flux) {
  HWY_DYNAMIC_DISPATCH(SpreadLight)(lines, light_below, light, first, last, flux);
}

}  // namespace vegard::sim
#endif
