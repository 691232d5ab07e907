// The results of a survey for one frame.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "fit/survey/survey.h"

namespace vegard::fit {

/// A number with its error and its trust.
struct SurveyQuantity {
  int item = 0;      ///< number from 1 among several of a kind (a border's traces); 0: there is only one
  std::string name;  ///< "lowest elevation", "sheet.main.energy_kev"
  std::string unit;
  std::optional<double> value;  ///< none if it is unconstrained
  std::optional<double> sigma;
  std::optional<std::string> trust;   ///< a name of fit/answer/trust.h; none if it was not assessed
  std::optional<std::string> reason;  ///< why there is no value, or why it is not trusted
};

struct WorkAnswer {
  SurveyWork work = SurveyWork::border;
  /// For a filter: the sky's class (fit/survey/filter/sky_trees.h). For a fit: "good", "doubtful", "failed".
  /// For a border and for profiles: "good", or "none" if nothing was found. For a map: "good", "doubtful".
  /// For any work: "refused" if it could not be done; `words` has the reason.
  std::string verdict;
  std::optional<std::string> words;
  std::optional<std::string> start;  ///< of a fit: "full" (a search) or "warm" (from the previous frame)
  std::optional<double> chi2_per_dof;
  std::optional<std::int64_t> seed;
  std::vector<double> free_values;  ///< of a fit, exact; the next frame's fit starts there
  std::vector<SurveyQuantity> quantities;
};

/// `filtered`: the filter found no arc in the frame, so that no other work was done.
enum class FrameStatus { done, skipped, missing, unreadable, filtered };
inline constexpr std::array kFrameStatuses = {FrameStatus::done, FrameStatus::skipped, FrameStatus::missing,
                                              FrameStatus::unreadable, FrameStatus::filtered};
/// "done", "skipped", "missing", "unreadable", "filtered".
const char* frame_status_name(FrameStatus status);

struct FrameAnswer {
  int frame = 0, block = 0;  ///< numbers in the plan, from 0
  std::string camera;
  std::string file;  ///< as the plan has it
  double time_s = 0.0;
  FrameStatus status = FrameStatus::done;
  std::optional<std::string> reason;  ///< of a status other than done
  std::optional<std::string> sha256, decoding;
  std::vector<WorkAnswer> works;  ///< of a frame that is done, or filtered
};

}  // namespace vegard::fit
