// Splits the light that a sheet emits at an instant by the age of its excitation.
//
// A sheet that changes in time is evaluated in several intervals of age (age_intervals.h): in the first one
// at the instant, in each of the others at as many past times as there are beams for it. Each interval has
// its own height profiles: those of the sheet times the interval's share. A sheet that does not change has
// one interval with the sheet's profiles.
#pragma once

#include <vector>

#include "sim/light/height_profile.h"
#include "sim/render/beams/age_intervals.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

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
