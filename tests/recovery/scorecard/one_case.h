// One scene of the scorecard, from the draw to its row.
#pragma once

#include <cstdint>
#include <string>

#include "sim/scene/structs/scene.h"
#include "tests/recovery/scorecard/card.h"

namespace vegard::scorecard {

struct CaseOptions {
  std::uint64_t set = 1;
  int threads = 1;
  int max_evaluations = 2000;
  bool from_truth = false;                           ///< start_at_truth() in place of wide_start()
  bool free_ends = false;                            ///< with_free_ends() of it
  std::string tables = sim::kDefaultEmissionTables;  ///< of truth and start
  bool is_lossless = false;                          ///< the photograph is a PNG, without JPEG's errors
  bool drawn_physics =
      false;  ///< the truth has other light than the tables: drawn coefficients of their modes
  /// Of the start: whether error bars contain the tables' uncertainty.
  sim::TablesUncertainty uncertainty = sim::TablesUncertainty::modes;
  std::string keep;  ///< folder for the photograph, the truth and the start; empty: none
};

/// Draws, photographs, fits and scores. A pure function of the set and the number, but for the seconds.
Row run_case(int scene, const CaseOptions& options);

/// Draws and photographs into options.keep only.
void make_case(int scene, const CaseOptions& options);

}  // namespace vegard::scorecard
