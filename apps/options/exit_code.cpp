#include "apps/options/exit_code.h"

namespace vegard::apps {

const std::vector<ExitMeaning>& exit_meanings() {
  static const std::vector<ExitMeaning> all = {
      {good, "All went well."},
      {internal_error, "A fault of the program or of the machine."},
      {bad_usage, "Wrong usage, a bad scene, or an output that exists."},
      {unreadable_input, "A photograph, mask, scene or table that cannot be read."},
      {not_converged, "The fit did not converge, or none of its light is in view."},
      {doubted,
       "The answer is doubtful or incomplete, or nothing was found; the message and the report say why."},
      {unwritable_output, "An output that cannot be written."},
      {hung_up, "Interrupted: the terminal was closed."},
      {interrupted, "Interrupted by Ctrl-C."},
      {terminated, "Interrupted by SIGTERM."}};
  return all;
}

std::string exit_code_help() {
  std::string text = "Exit codes:";
  for (const ExitMeaning& exit : exit_meanings())
    text += "\n  " + std::to_string(exit.code) + std::string(exit.code < 100 ? 4 : 2, ' ') + exit.words;
  return text;
}

}  // namespace vegard::apps
