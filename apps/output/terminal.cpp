#include "apps/output/terminal.h"

#include <unistd.h>

#include <csignal>

#include "sim/base/file/durable_rename.h"
#include "sim/base/quiet_decoder.h"

namespace vegard::apps {
namespace {

std::atomic<bool> raised{false};
std::atomic<int> first_signal{0};
// Only then may a signal handler touch them.
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

void raise_flag(int signal) {
  int none = 0;
  first_signal.compare_exchange_strong(none, signal);
  // With the terminal go those who read from us: what is said to nobody is not to kill us while we tidy up.
  if (signal == SIGHUP) std::signal(SIGPIPE, SIG_IGN);
  raised.store(true);
}

ExitCode code_of_signal(int signal) {
  return signal == SIGHUP ? hung_up : signal == SIGTERM ? terminated : interrupted;
}

/// Calls nothing that a signal handler may not call.
void end_at_once(int signal) {
  sim::delete_unfinished_files();
  std::signal(SIGPIPE, SIG_IGN);
  constexpr char words[] = "vegard: interrupted\n";
  static_cast<void>(::write(sim::error_stream(), words, sizeof words - 1) == 0);
  ::_exit(code_of_signal(signal));
}

bool watch_for(int signal, void (*handler)(int) = raise_flag) {
  struct sigaction action = {};
  action.sa_handler = handler;
  // RESETHAND: the second finds the default again. RESTART: writes under way are not cut short.
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  sigemptyset(&action.sa_mask);
  return sigaction(signal, &action, nullptr) == 0;
}

bool is_ignored(int signal) {
  struct sigaction action = {};
  return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

}  // namespace

const std::atomic<bool>& watch_for_interrupt() {
  static const bool arranged = [] {
    if (!is_ignored(SIGHUP)) watch_for(SIGHUP);
    watch_for(SIGTERM);
    return watch_for(SIGINT);  // the last: who waits for it to be caught finds the others caught as well
  }();
  static_cast<void>(arranged);
  return raised;
}

void end_at_once_when_interrupted() {
  if (!is_ignored(SIGHUP)) watch_for(SIGHUP, end_at_once);
  watch_for(SIGTERM, end_at_once);
  watch_for(SIGINT, end_at_once);
}

ExitCode exit_code_of_interruption() { return code_of_signal(first_signal.load()); }

}  // namespace vegard::apps
