// Intervals of the age that excitation has by the time it shines, and what of a line's light is that old.
//
// An excited atom shines after a while, exponentially distributed with its effective lifetime tau(h)
// (sim/light/excited_atom.h). So of a line's light at the altitude h the share exp(-a/tau) - exp(-b/tau) is
// by electrons that fell between a and b seconds ago. Intervals double from one that is short beside any
// change of what falls to one that is longer than nearly all of the light lasts; the shares add up to 1 at
// every altitude: light is moved in time, none is made or lost.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "sim/light/height_profile.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// [line][altitude of a HeightProfile] From 0 to 1.
using LightShare = std::vector<std::vector<float>>;

class AgeIntervals {
 public:
  /// One interval, which has all of the light.
  AgeIntervals() = default;
  /// For the light of the scene's lines up to an altitude, where what falls becomes something else in
  /// `change_s` (infinite: never). What lasts longer than the last interval's beginning, half an hour to an
  /// hour (N(2D), of 520.0 nm), counts as that to twice that: so long no scene describes the past of an arc.
  AgeIntervals(const Scene& scene, double top_km, double change_s);

  int count() const { return static_cast<int>(from_s_.size()); }
  double from_s(int age) const { return from_s_[age]; }
  /// Infinite for the last one.
  double to_s(int age) const {
    return age + 1 < count() ? from_s_[age + 1] : std::numeric_limits<double>::infinity();
  }
  /// The age at `place`, from 0 to 1, in its interval, evenly in the logarithm; in the last one up to twice
  /// its start. 0 in the first one, whose light is taken as of its end: it is short beside what changes.
  double age_s(int age, double place) const;

  /// [interval] What of the light of the scene's lines is by electrons of that age.
  std::vector<LightShare> shares() const;
  /// [interval][altitude of a HeightProfile] The same of one of them.
  std::vector<std::vector<float>> shares_of(double wavelength_nm) const;

 private:
  std::vector<float> share(std::size_t line, int age) const;

  std::vector<double> from_s_{0.0};
  std::vector<double> lines_nm_;                  ///< of the scene
  std::vector<std::vector<double>> lifetimes_s_;  ///< [line][altitude]; empty for a prompt line
};

/// Multiplies a profile's rates, and their derivatives.
void take_share(const LightShare& share, HeightProfile& profile);

}  // namespace vegard::sim
