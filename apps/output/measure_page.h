// The report of `vegard measure`: the result of each stage, its trust, and what is missing.
#pragma once

#include <string>
#include <vector>

#include "fit/answer/trust.h"

namespace vegard::apps {

/// One stage on the way from the photograph to the answer.
struct MeasureStage {
  std::string title;  ///< "Where the camera points"
  fit::Trust trust = fit::Trust::unconstrained;
  std::string found;               ///< a sentence or two
  std::string lacking;             ///< what is missing and what would help; may be empty
  std::string command;             ///< the command that does the same alone; empty if there is none
  std::string words;               ///< the output of that command
  int exit_code = 0;               ///< exit code of that command
  std::vector<std::string> files;  ///< files that it has written in the run directory
};

struct Measurement {
  std::string photo;    ///< the file's name, without its folder
  std::string command;  ///< vegard's command line
  fit::Trust trust = fit::Trust::unconstrained;
  std::vector<std::string> answer;    ///< the answer in a few sentences
  std::vector<std::string> pictures;  ///< files of the run to show first
  std::vector<MeasureStage> stages;
};

/// Returns the page, which shows pictures in its own folder. The same measurement gives the same bytes.
std::string measure_page(const Measurement& measurement);

std::string measure_json(const Measurement& measurement);

}  // namespace vegard::apps
