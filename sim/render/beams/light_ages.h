// Splits the light that a sheet emits at an instant by the age of its excitation.
//
// A sheet that changes in time is evaluated in several intervals of age (AgeIntervals): in the first one
// at the instant, in each of the others at as many past times as there are beams for it. Each interval has
// its own height profiles: those of the sheet times the interval's share. A sheet that does not change has
// one interval with the sheet's profiles.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "sim/light/height_profile.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

// Intervals of the age of the excitation at the time of emission, and the share of a line's light in each.
//
// An excited atom emits after a random time, exponentially distributed with its effective lifetime tau(h)
// (sim/light/excited_atom.h). So the share exp(-a/tau) - exp(-b/tau) of a line's light at the altitude h is
// excited by electrons that fell between a and b seconds ago. The intervals' lengths double, from one that is
// short compared with any change of the precipitation to one that is older than nearly all of the light. The
// shares add up to 1 at every altitude: light is moved in time, but none is made or lost.

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
void multiply_by_share(const LightShare& share, HeightProfile& profile);

class LightAges {
 public:
  LightAges() = default;
  /// The intervals depend on emission.lag, the scene's lines and how fast each sheet changes; there is only
  /// one if film.weight is "unit".
  explicit LightAges(const Scene& scene);

  bool lags(int sheet) const { return count(sheet) > 1; }
  bool any() const;
  /// Returns the number of intervals; 1 if the sheet's light has no lag.
  int count(int sheet) const {
    return sheet < static_cast<int>(of_sheet_.size()) ? of_sheet_[sheet].count() : 1;
  }
  double from_s(int sheet, int age) const { return of_sheet_[sheet].from_s(age); }
  double to_s(int sheet, int age) const { return of_sheet_[sheet].to_s(age); }
  /// Returns the age of a beam at `place`, from 0 to 1, in its interval.
  double age_s(int sheet, int age, double place) const { return of_sheet_[sheet].age_s(age, place); }

  /// Splits `profiles`, which height_profiles() has made for a scene with these sheets: those of the first
  /// interval replace the sheet's own, those of the others are appended.
  void split(const Scene& scene, std::vector<HeightProfile>& profiles) const;

  /// Returns the index of the first of these profiles for a sheet's interval.
  int first_profile(const Scene& scene, int sheet, int age) const;

  /// Splits the rates of one line as split() does. `rates` has one profile ([altitude]) of the sheet after
  /// the other; the result has this list for one interval after the other.
  std::vector<float> split_rates(int sheet, double wavelength_nm, const std::vector<float>& rates) const;

 private:
  std::vector<AgeIntervals> of_sheet_;
};

}  // namespace vegard::sim
