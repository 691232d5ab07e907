// The terminal at which vegard runs: Ctrl-C and its like as a flag that long work looks at, or as an end at
// once.
#pragma once

#include <atomic>

#include "apps/options/exit_code.h"

namespace vegard::apps {

/// From now on the first Ctrl-C (SIGINT), SIGTERM or SIGHUP only raises the flag, and a second one of the
/// same kind kills the program as if nothing had been arranged. A hangup that was ignored when the program
/// began (nohup) stays ignored. Further calls change nothing. The flag lives as long as the program.
const std::atomic<bool>& watch_for_interrupt();

/// For commands of seconds, which do not look at a flag: from now on the first of these signals deletes the
/// files that are not finished and ends the program, with the exit code that goes with it. A hangup that was
/// ignored stays ignored.
void end_at_once_when_interrupted();

/// What an interrupted command is to end with: `interrupted`, `terminated` or `hung_up`, by the first signal.
ExitCode exit_code_of_interruption();

}  // namespace vegard::apps
