// What a fit has recovered of a scene of which the truth is known.
#pragma once

#include <string>
#include <vector>

#include "fit/answer/fit_result.h"
#include "tests/recovery/scorecard/card.h"
#include "tests/recovery/scorecard/truth.h"

namespace vegard::scorecard {

/// How near to the truth counts as recovered.
struct Criteria {
  static constexpr double kEnergy = 0.15;    ///< relative
  static constexpr double kDistance = 0.03;  ///< relative, of the nearest point
  static constexpr double kBearing_deg = 2.0;
  static constexpr double kWavelength = 0.10;  ///< relative; asked only where so many waves are in view:
  static constexpr double kWavesInView = 1.5;
  static constexpr double kThickness = 0.30;  ///< relative, of the sine's amplitude
  static constexpr double kBorder_km = 3.0;   ///< of the verdict by quantity, not of the recovery
};

/// Which of "E0", "distance", "bearing", "wavelength", "amplitude" a sheet misses.
std::vector<std::string> missed_criteria(const SheetRow& sheet);

/// How many wavelengths of a sheet's sine cross the picture: those field lines count that are in it anywhere
/// between 100 and 200 km.
double waves_in_view(const sim::Scene& scene, int sheet);

/// The row of a fit that was started with `start`, its time still 0. Sheets have no names in a picture: of
/// two, the assignment is taken that is nearer to the truth, with E0, distance and bearing in units of their
/// criteria.
Row score(const Truth& truth, const sim::Scene& start, const fit::FitResult& result);

/// Markdown: recovered by class, criteria, verdict against recovery, coverage, cost, and the failures one by
/// one. What counts as recovered is worked out again from the numbers.
std::string summary(const std::vector<Row>& rows);

}  // namespace vegard::scorecard
