// Several processes of this program on this machine.
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

}  // namespace vegard::apps
