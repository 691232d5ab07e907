// Handles Ctrl-C and similar signals: as a flag that long work checks, or by ending the program at once.
#pragma once

#include <atomic>

#include "apps/options/exit_code.h"

namespace vegard::apps {

/// From now on the first Ctrl-C (SIGINT), SIGTERM or SIGHUP only raises the flag, and a second one of the
/// same kind ends the program as by default. A SIGHUP that was ignored when the program began (nohup) stays
/// ignored. Further calls have no effect. The flag exists as long as the program.
const std::atomic<bool>& watch_for_interrupt();

/// For short commands that do not check a flag: from now on the first of these signals deletes unfinished
/// files and ends the program with the exit code for that signal. A SIGHUP that was ignored stays ignored.
void end_at_once_when_interrupted();

/// The exit code of an interrupted command: `interrupted`, `terminated` or `hung_up`, by the first signal.
ExitCode exit_code_of_interruption();

}  // namespace vegard::apps
