// What the stages of the search share: trials and short descents by the coarse model, and the record of the
// best point.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fit/search/fit_options.h"
#include "fit/search/journal.h"
#include "fit/search/lateral_offsets.h"

namespace vegard::fit {

/// The photographs' terms of the cost, with the coarse and with the full model.
struct SearchModels {
  std::vector<CostTerm> coarse, full;
};

/// A point of the search: values of all free numbers, and chi2 by the coarse model.
struct Trial {
  std::vector<double> values;
  double chi2 = 0.0;
};
void sort_by_chi2(std::vector<Trial>& trials);

/// Whether trials and descents change a number. The coefficients of free-form profiles stay as they are until
/// the polish: they would make up for whatever a trial has wrong.
bool is_searched(const FreeNumber& number);

/// Returns the indices of the free numbers that belong.
std::vector<std::size_t> indices(const std::vector<FreeNumber>& free, bool (*belongs)(const FreeNumber&));

/// Returns point `i` of a seeded low-discrepancy sequence (Roberts' R_d, additive recurrence) in the unit
/// cube of `dimensions` dimensions.
std::vector<double> even_point(int i, int dimensions, std::uint64_t seed);

class CoarseSearch {
 public:
  /// All arguments must outlive it.
  CoarseSearch(const sim::Scene& scene, const std::vector<FreeNumber>& free, const SearchModels& models,
               const FitOptions& options, EvaluationLog& log, std::vector<TraceRow>& trace);

  const sim::Scene& scene() const { return scene_; }
  const std::vector<FreeNumber>& free() const { return free_; }
  /// Indices of the free numbers that are searched.
  const std::vector<std::size_t>& searched() const { return searched_; }
  bool exhausted() const { return log_.exhausted(); }

  /// The cost by the coarse model, of all free numbers.
  const ProfileCost& cost() const { return coarse_; }
  /// Evaluates the coarse model; chi2 is 1e300 where that fails.
  Trial tried(const std::vector<double>& values) const;
  /// The scene at some values of the free numbers.
  sim::Scene scene_at(const std::vector<double>& values) const;
  std::vector<std::vector<LateralOffset>> offsets_at(const std::vector<double>& values);
  /// A short descent of some of the free numbers, with the coarse model.
  Trial descended(const Trial& from, const std::vector<std::size_t>& which, const std::string& stage);
  /// A descent of all free numbers with the full model, as a step of the journal. `share`: of the fit, done.
  Descent polished(const Trial& from, const std::string& stage, double share);
  /// Evaluates the full model at the user's start and begins the trace with it.
  double chi2_at_start(const std::vector<double>& start);

  /// Trials found by a step of the journal, so many or more.
  std::vector<Trial> step(const std::string& name, std::size_t least,
                          const std::function<std::vector<Trial>()>& work);
  /// Reports progress; `share` of the fit is done.
  void tell(const std::string& stage, double share) const;
  /// Adds a stage's best trial to the trace.
  void record(const Trial& trial, const std::string& stage);

 private:
  void note(const std::vector<double>& values, double chi2, bool full);
  std::vector<PhaseAnchor> anchors(const std::vector<FreeNumber>& free, const std::vector<int>& moved,
                                   const std::vector<double>& values) const;
  std::optional<sim::Prior> weak_prior(const FreeNumber& n) const;

  const sim::Scene& scene_;
  const std::vector<FreeNumber>& free_;
  const SearchModels& models_;
  const FitOptions& options_;
  EvaluationLog& log_;
  std::vector<TraceRow>& trace_;
  const ProfileCost coarse_, full_;
  const std::vector<std::size_t> searched_;
};

/// Factor on the amplitude of a sine for which its sheet is all but straight.
inline constexpr double kNearlyStraight = 0.1;

/// Tries distances, bearings and energies of the sheets about the start and descends from the best. A sine
/// with the wrong phase would turn the bearing, so the sheets are all but straight meanwhile.
Trial best_overall(CoarseSearch& coarse, const Trial& start);

/// Returns trials of footprints nearer and farther, with more energy and less, best first.
std::vector<Trial> other_footprints(CoarseSearch& coarse, const Trial& from);

}  // namespace vegard::fit
