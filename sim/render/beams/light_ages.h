// How old the excitation is of the light that a sheet gives off at an instant.
//
// A sheet that changes in time is looked at in several intervals of age (age_intervals.h): in the first as it
// is at the instant, in each of the others at as many times as it has beams there. Each interval has height
// profiles of its own, those of the sheet times its share. A sheet that does not change has one age, and the
// profiles that it has anyway.
#pragma once

#include <vector>

#include "sim/light/height_profile.h"
#include "sim/render/beams/age_intervals.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

class LightAges {
 public:
  LightAges() = default;
  /// By emission.lag, the scene's lines and how soon each sheet changes; none where every point counts alike.
  explicit LightAges(const Scene& scene);

  bool lags(int sheet) const { return count(sheet) > 1; }
  bool any() const;
  /// Of intervals; 1 if the sheet's light is all of its instant.
  int count(int sheet) const {
    return sheet < static_cast<int>(of_sheet_.size()) ? of_sheet_[sheet].count() : 1;
  }
  double from_s(int sheet, int age) const { return of_sheet_[sheet].from_s(age); }
  double to_s(int sheet, int age) const { return of_sheet_[sheet].to_s(age); }
  /// The age of a beam that stands at `place` of 0 to 1 in its interval.
  double age_s(int sheet, int age, double place) const { return of_sheet_[sheet].age_s(age, place); }

  /// Splits profiles, those that height_profiles() has of a scene with these sheets: the first interval's are
  /// in the place of the sheet's own, the others' behind all of them.
  void split(const Scene& scene, std::vector<HeightProfile>& profiles) const;

  /// Where the profiles of a sheet's interval begin among them.
  int first_profile(const Scene& scene, int sheet, int age) const;

  /// A line's rates of one profile of a sheet after the other ([altitude]) in every interval, one interval
  /// after the other: what split() makes of them.
  std::vector<float> split_rates(int sheet, double wavelength_nm, const std::vector<float>& rates) const;

 private:
  std::vector<AgeIntervals> of_sheet_;
};

}  // namespace vegard::sim
