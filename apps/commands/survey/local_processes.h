// Runs other processes on this machine: several of this program, and other programs that a survey needs.
#pragma once

#include <string>
#include <vector>

#include "apps/options/exit_code.h"

namespace vegard::apps {

/// A call of this program: its arguments, without its name.
struct LocalCall {
  std::string what;  ///< "shard 3/7", for messages
  std::vector<std::string> words;
};

/// Runs all calls in their order, at most `at_a_time` at once, and reports which have failed. Returns the
/// first exit code that is not 0. Once one process, or this program, has been interrupted, no more are
/// started, and the running ones are told to end. They end as well if this program is killed.
ExitCode run_processes(const std::vector<LocalCall>& calls, int at_a_time);

/// The output of another program, on both streams, and its exit code; 127: there is no such program.
struct ProgramEnd {
  int exit_code = 0;
  std::string words;
};
/// Runs a program of the system, given by its name, and waits for it.
ProgramEnd run_program(const std::vector<std::string>& words);

}  // namespace vegard::apps
