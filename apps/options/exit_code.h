// The exit codes of `vegard`. The numbers are documented and part of the interface.
#pragma once

#include <string>
#include <vector>

#include "sim/base/error.h"

namespace vegard::apps {

enum ExitCode : int {
  good = 0,
  internal_error = 1,     ///< an error of vegard itself or of the machine: no memory, an unexpected exception
  bad_usage = 2,          ///< a wrong command line, an invalid scene, an output that exists
  unreadable_input = 3,   ///< a photograph, mask, scene or table that cannot be read
  not_converged = 4,      ///< the fit did not converge
  doubted = 5,            ///< the verdict on a converged fit is doubtful; a derivative differs
  unwritable_output = 6,  ///< an output that cannot be written
  hung_up = 129,          ///< SIGHUP: the terminal was closed
  interrupted = 130,      ///< Ctrl-C (SIGINT)
  terminated = 143,       ///< SIGTERM: from a batch system or at the end of a session
};

struct ExitMeaning {
  ExitCode code;
  const char* words;  ///< a sentence
};

/// All exit codes, for manuals.
const std::vector<ExitMeaning>& exit_meanings();

/// All exit codes in a paragraph, for --help.
std::string exit_code_help();

inline ExitCode exit_code_of(sim::ErrorKind kind) {
  switch (kind) {
    case sim::ErrorKind::usage:
    case sim::ErrorKind::scene:
    case sim::ErrorKind::existing_output:
      return bad_usage;
    case sim::ErrorKind::unreadable_input:
      return unreadable_input;
    case sim::ErrorKind::unwritable_output:
      return unwritable_output;
  }
  return internal_error;
}

}  // namespace vegard::apps
