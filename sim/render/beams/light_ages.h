// How old the excitation is of the light that a sheet gives off at an instant.
//
// An excited atom shines after a while, exponentially distributed with its effective lifetime tau(h)
// (sim/light/excited_atom.h). So of a line's light at the altitude h the share exp(-a/tau) - exp(-b/tau) is
// by electrons that fell between a and b seconds ago. A sheet that changes in time is looked at in several
// such intervals of age: in the first, which is short beside any change, as it is at the instant, in each of
// the others at as many times as it has beams there. Each interval has height profiles of its own, those of
// the sheet times its share, and the shares add up to 1 at every altitude: light is moved in time, none is
// made or lost. A sheet that does not change has one age, and the profiles that it has anyway.
#pragma once

#include <vector>

#include "sim/light/height_profile.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

class LightAges {
 public:
  LightAges() = default;
  /// By emission.lag, the scene's lines and how soon each sheet changes; none where every point counts alike.
  /// What lasts longer than the last interval's beginning, half an hour to an hour (N(2D), of 520.0 nm),
  /// counts as that to twice that: so long nobody's scene describes the past of an arc.
  explicit LightAges(const Scene& scene);

  bool lags(int sheet) const { return count(sheet) > 1; }
  bool any() const;
  /// Of intervals; 1 if the sheet's light is all of its instant.
  int count(int sheet) const {
    return sheet < static_cast<int>(from_s_.size()) ? static_cast<int>(from_s_[sheet].size()) : 1;
  }
  double from_s(int sheet, int age) const { return from_s_[sheet][age]; }
  /// Of the last one infinite.
  double to_s(int sheet, int age) const;
  /// The age of a beam that stands at `place` of 0 to 1 in its interval; in the last one up to twice its
  /// start.
  double age_s(int sheet, int age, double place) const;

  /// Splits profiles, those that height_profiles() has of a scene with these sheets: the first interval's are
  /// in the place of the sheet's own, the others' behind all of them.
  void split(const Scene& scene, std::vector<HeightProfile>& profiles) const;

  /// Where the profiles of a sheet's interval begin among them.
  int first_profile(const Scene& scene, int sheet, int age) const;

  /// A line's rates of one profile of a sheet after the other ([altitude]) in every interval, one interval
  /// after the other: what split() makes of them.
  std::vector<float> split_rates(int sheet, double wavelength_nm, const std::vector<float>& rates) const;

 private:
  std::vector<std::vector<double>> from_s_;  ///< [sheet][interval]
};

}  // namespace vegard::sim
