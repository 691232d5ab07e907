// The terminal at which vegard runs: Ctrl-C as a flag that long work looks at.
#pragma once

#include <atomic>

namespace vegard::apps {

/// From now on the first Ctrl-C only raises the flag, and a second one kills the program as if nothing had
/// been arranged. Further calls change nothing. The flag lives as long as the program.
const std::atomic<bool>& watch_for_interrupt();

}  // namespace vegard::apps
