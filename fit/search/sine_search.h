// The search for the wavelength, amplitude and phase of sheets, by which chi2 has many minima.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "fit/search/coarse_search.h"

namespace vegard::fit {

/// Indices among the free numbers; -1 for a number that is not free.
struct SineNumbers {
  int wavelength = -1, phase = -1, thickness = -1;
};
SineNumbers sine_numbers(const std::vector<FreeNumber>& free, int sheet);

/// Sets `values` of the free numbers to a sine found from a sheet's lateral offsets: its wavelength,
/// amplitude and phase, and its straight line as centre and bearing. `start` is the scene that the free
/// numbers change.
void take_sine(const sim::Scene& start, const std::vector<FreeNumber>& free, const SineThroughOffsets& found,
               int sheet, std::vector<double>& values);

/// Whether two points are in one valley of chi2: wavelengths within 5 %, phases within a sixth of a turn, and
/// footprints at like distances.
bool in_one_valley(const sim::Scene& scene, const std::vector<FreeNumber>& free, const std::vector<double>& a,
                   const std::vector<double>& b);

class SineSearch {
 public:
  explicit SineSearch(CoarseSearch& coarse);

  /// Trials of the sheets' sines from their offsets; none where the bands do not show enough of a sheet.
  std::vector<Trial> by_lateral_offsets(const Trial& straight);
  /// Trials of wavelength and phase, sheet by sheet, from a sheet that is all but straight. The wavelengths'
  /// steps are as fine as the phase at the far end of the arc asks for; the seed shifts their origin.
  std::vector<Trial> scan(const Trial& from);
  /// Sheets that stand one behind the other take each other's waves in the first trials. So pairs exchange
  /// their sines, each sheet's sine is looked for again with the others as they were found, and what explains
  /// the picture better goes to the front of `ends`, until no sheet gives way. `qualifier` ends the names of
  /// the journal's steps.
  void search_again(std::vector<Trial>& ends, const std::string& qualifier = {});
  /// Whether, of several sheets, one has an amplitude that has gone to its lower limit.
  bool has_lost_a_sine(const std::vector<double>& values) const;

 private:
  SineNumbers sine_of(int sheet) const;
  /// Sheets whose sines are to be found.
  std::vector<int> waved_sheets() const;
  /// Wavelengths between which a sheet's sine is looked for.
  std::pair<double, double> wavelengths_of(const SineNumbers& sine, int sheet,
                                           const std::vector<double>& values) const;
  /// All combinations of the sheets' sines through their offsets from straight lines.
  std::vector<std::vector<double>> starts_through_offsets(const Trial& straight,
                                                          const std::vector<int>& waved);
  /// Moves the sines to the offsets that remain.
  void correct_sines(const Trial& straight, const std::vector<int>& waved, std::vector<double>& values);
  void scan_phases(const std::vector<double>& base, const SineNumbers& sine, double shift,
                   std::vector<double> values, std::vector<Trial>& trials);
  /// The sine of given wavelength that fits best, to first order: w sin(x + phase) = a sin x + b cos x is
  /// linear in a and b, so two Jacobians of a nearly straight sheet, with phases 0 and a quarter turn, give a
  /// and b together with the steps of everything else but the wavelength. One evaluation then tells what the
  /// trial is worth.
  Trial best_sine(std::vector<double> values, const SineNumbers& sine);
  /// A descent from where two sheets have each other's sine; none where these are not free in both.
  std::vector<Trial> with_sines_exchanged(const Trial& from, int first, int second, const std::string& stage);
  /// Descents from where one sheet has another sine, best first: through its lateral offsets when it is all
  /// but straight, and as it shows about the sine that it has.
  std::vector<Trial> with_another_sine(const Trial& from, int sheet, const std::string& stage);

  CoarseSearch& coarse_;
  const sim::Scene& scene_;
  const std::vector<FreeNumber>& free_;
};

}  // namespace vegard::fit
