// The results of a survey for one frame.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "fit/survey/survey.h"

namespace vegard::fit {

/// A number with its error and whether to believe it.
struct SurveyQuantity {
  int item = 0;      ///< of several of a kind, from 1: a border's trace; 0: there is one
  std::string name;  ///< "lowest elevation", "sheet.main.energy_kev"
  std::string unit;
  std::optional<double> value;  ///< none where it is unconstrained
  std::optional<double> sigma;
  std::optional<std::string> trust;   ///< as fit/answer/trust.h names it; none where it was not assessed
  std::optional<std::string> reason;  ///< why there is no value, or why it is not to be trusted
};

struct WorkAnswer {
  SurveyWork work = SurveyWork::border;
  /// Of a filter: what is seen, as fit/survey/filter/sky_trees.h names it. Of a fit: "good", "doubtful",
  /// "failed". Of a border and of profiles: "good", or "none" if there is none. Of a map: "good", "doubtful".
  /// "refused": the work could not be done, `words` says why.
  std::string verdict;
  std::optional<std::string> words;
  std::optional<std::string> start;  ///< of a fit: "full", "warm"
  std::optional<double> chi2_per_dof;
  std::optional<std::int64_t> seed;
  std::vector<double> free_values;  ///< of a fit, exactly: where the next frame starts
  std::vector<SurveyQuantity> quantities;
};

/// `filtered`: the filter has found no arc in it, and nothing else was done.
enum class FrameStatus { done, skipped, missing, unreadable, filtered };
inline constexpr std::array kFrameStatuses = {FrameStatus::done, FrameStatus::skipped, FrameStatus::missing,
                                              FrameStatus::unreadable, FrameStatus::filtered};
/// "done", "skipped", "missing", "unreadable", "filtered".
const char* frame_status_name(FrameStatus status);

struct FrameAnswer {
  int frame = 0, block = 0;  ///< numbers of the plan, from 0
  std::string camera;
  std::string file;  ///< as the plan has it
  double time_s = 0.0;
  FrameStatus status = FrameStatus::done;
  std::optional<std::string> reason;  ///< of any other status
  std::optional<std::string> sha256, decoding;
  std::vector<WorkAnswer> works;  ///< of a frame that is done, or filtered
};

}  // namespace vegard::fit
