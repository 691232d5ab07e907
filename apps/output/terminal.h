// The terminal at which vegard runs: Ctrl-C as a flag that long work looks at, and text that is printed
// whole.
#pragma once

#include <atomic>
#include <string>

namespace vegard::apps {

/// From now on the first Ctrl-C only raises the flag, and a second one kills the program as if nothing had
/// been arranged. Further calls change nothing. The flag lives as long as the program.
const std::atomic<bool>& watch_for_interrupt();

/// Prints the text to the standard output, or throws Error(unwritable_output): "`what` cannot be written", as
/// when a disk is full.
void print_whole(const std::string& text, const std::string& what);

}  // namespace vegard::apps
