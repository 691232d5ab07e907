// Intervals of the age of the excitation at the time of emission, and the share of a line's light in each.
//
// An excited atom emits after a random time, exponentially distributed with its effective lifetime tau(h)
// (sim/light/excited_atom.h). So the share exp(-a/tau) - exp(-b/tau) of a line's light at the altitude h is
// excited by electrons that fell between a and b seconds ago. The intervals' lengths double, from one that is
// short compared with any change of the precipitation to one that is older than nearly all of the light. The
// shares add up to 1 at every altitude: light is moved in time, but none is made or lost.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "sim/light/height_profile.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Share of each line's light, [line][altitude of a HeightProfile], from 0 to 1.
using LightShare = std::vector<std::vector<float>>;

class AgeIntervals {
 public:
  /// A single interval with all of the light.
  AgeIntervals() = default;
  /// Intervals for the light of the scene's lines up to `top_km`, where the precipitation changes in
  /// `change_s` (infinite: never). The last interval begins at an age of at most half an hour to an hour (as
  /// for N(2D), 520.0 nm); older light is taken as one to two times that old, since no scene describes an
  /// arc's past for so long.
  AgeIntervals(const Scene& scene, double top_km, double change_s);

  int count() const { return static_cast<int>(from_s_.size()); }
  double from_s(int age) const { return from_s_[age]; }
  /// Returns the end of an interval; infinite for the last one.
  double to_s(int age) const {
    return age + 1 < count() ? from_s_[age + 1] : std::numeric_limits<double>::infinity();
  }
  /// Returns the age at `place`, from 0 to 1, of an interval, evenly in the logarithm; the last interval is
  /// taken to end at twice its start. Returns 0 in the first interval, which is short compared with all
  /// changes.
  double age_s(int age, double place) const;

  /// Returns the shares of the light of the scene's lines, [interval].
  std::vector<LightShare> shares() const;
  /// Returns the shares of one line, [interval][altitude of a HeightProfile].
  std::vector<std::vector<float>> shares_of(double wavelength_nm) const;

 private:
  std::vector<float> share(std::size_t line, int age) const;

  std::vector<double> from_s_{0.0};
  std::vector<double> lines_nm_;                  ///< of the scene
  std::vector<std::vector<double>> lifetimes_s_;  ///< [line][altitude]; empty for a prompt line
};

/// Multiplies a profile's rates, and their derivatives, by a share.
void take_share(const LightShare& share, HeightProfile& profile);

}  // namespace vegard::sim
