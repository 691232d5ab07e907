#include "apps/output/terminal.h"

#include <csignal>

namespace vegard::apps {
namespace {

std::atomic<bool> raised{false};
// Only then may a signal handler touch it.
static_assert(std::atomic<bool>::is_always_lock_free);

void raise_flag(int) { raised.store(true); }

}  // namespace

const std::atomic<bool>& watch_for_interrupt() {
  static const bool arranged = [] {
    struct sigaction action = {};
    action.sa_handler = raise_flag;
    // RESETHAND: the second Ctrl-C finds the default again. RESTART: writes under way are not cut short.
    action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
    sigemptyset(&action.sa_mask);
    return sigaction(SIGINT, &action, nullptr) == 0;
  }();
  static_cast<void>(arranged);
  return raised;
}

}  // namespace vegard::apps
