// What `vegard` tells the shell. The numbers are documented and part of the interface.
#pragma once

#include <string>
#include <vector>

#include "sim/base/error.h"

namespace vegard::apps {

enum ExitCode : int {
  good = 0,
  internal_error = 1,  ///< a fault of vegard itself or of the machine: no memory, an exception nobody foresaw
  bad_usage = 2,       ///< wrong words on the command line, a bad scene, an output that exists
  unreadable_input = 3,  ///< a photograph, mask, scene or table that cannot be read
  not_converged = 4,     ///< the fit did not converge
  doubted = 5,  ///< the fit converged to an answer that the verdict doubts; a derivative that differs
  unwritable_output = 6,  ///< an output that cannot be written
  hung_up = 129,          ///< SIGHUP: the terminal was closed
  interrupted = 130,      ///< Ctrl-C (SIGINT)
  terminated = 143,       ///< SIGTERM: a batch system or the end of a session
};

struct ExitMeaning {
  ExitCode code;
  const char* words;  ///< a sentence
};

/// All of them, for manuals.
const std::vector<ExitMeaning>& exit_meanings();

/// A paragraph of them, for --help.
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
