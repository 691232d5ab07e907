// Other processes on this machine: several of this program, and programs that a survey is handed to.
#pragma once

#include <string>
#include <vector>

#include "apps/options/exit_code.h"

namespace vegard::apps {

/// A call of this program: its words, without its name.
struct LocalCall {
  std::string what;  ///< "shard 3/7", for messages
  std::vector<std::string> words;
};

/// Runs all of them, at most so many at a time, in their order. Says which have failed. The first exit code
/// that is not 0; once one has been interrupted, or this process is, no more are begun, and those at work are
/// told to end. They end as well if this process is killed.
ExitCode run_processes(const std::vector<LocalCall>& calls, int at_a_time);

/// What another program has said, on both of its outputs, and how it ended. An exit code of 127: there is no
/// such program.
struct ProgramEnd {
  int exit_code = 0;
  std::string words;
};
/// Runs a program of the system, by its name, and waits for it.
ProgramEnd run_program(const std::vector<std::string>& words);

}  // namespace vegard::apps
