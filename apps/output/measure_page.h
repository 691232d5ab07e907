// The report of `vegard measure`: what each stage has found, how sure it is, and what is lacking.
#pragma once

#include <string>
#include <vector>

#include "fit/answer/trust.h"

namespace vegard::apps {

/// One stage from the photograph to the answer.
struct MeasureStage {
  std::string title;  ///< "Where the camera points"
  fit::Trust trust = fit::Trust::unconstrained;
  std::string found;               ///< a sentence or two
  std::string lacking;             ///< what is missing and what would help; may be empty
  std::string command;             ///< that does the same by itself; empty if there is none
  std::string words;               ///< what that command said
  int exit_code = 0;               ///< of that command
  std::vector<std::string> files;  ///< that it has written, inside of the run
};

struct Measurement {
  std::string photo;    ///< the file's name, without its folder
  std::string command;  ///< vegard's command line
  fit::Trust trust = fit::Trust::unconstrained;
  std::vector<std::string> answer;    ///< the answer in a few sentences
  std::vector<std::string> pictures;  ///< files of the run to show first
  std::vector<MeasureStage> stages;
};

/// The page; it shows pictures of the folder that it stands in. The same measurement gives the same bytes.
std::string measure_page(const Measurement& measurement);

std::string measure_json(const Measurement& measurement);

}  // namespace vegard::apps
