#include "apps/commands/survey/local_processes.h"

#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <map>

#include "apps/options/standard_streams.h"
#include "apps/output/terminal.h"

namespace vegard::apps {
namespace {

constexpr int kNoProgram = 127;  // as shells have it

/// The number of the new process; -1 if there is none.
pid_t begin_call(const LocalCall& call) {
  std::vector<std::string> words = {"vegard"};
  words.insert(words.end(), call.words.begin(), call.words.end());
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  show_output();  // what is said so far is not to be said again by the copy
  const pid_t parent = ::getpid();
  const pid_t process = ::fork();
  if (process != 0) return process;
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (::getppid() != parent) ::_exit(kNoProgram);  // it died before it was listened to
  ::execv("/proc/self/exe", arguments.data());
  ::_exit(kNoProgram);
}

bool is_of_interruption(int exit_code) {
  return exit_code == interrupted || exit_code == terminated || exit_code == hung_up;
}

/// As the shell has it for a process that a signal has ended.
int code_of_status(int status) { return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status); }

}  // namespace

ExitCode run_processes(const std::vector<LocalCall>& calls, int at_a_time) {
  const std::atomic<bool>& stop = watch_for_interrupt();
  std::map<pid_t, std::size_t> at_work;
  std::size_t next = 0;
  int worst = good;
  bool was_told = false;
  constexpr useconds_t kPause_us = 50000;
  while (next < calls.size() || !at_work.empty()) {
    const bool goes_on = !stop.load() && !is_of_interruption(worst);
    if (goes_on && next < calls.size() && static_cast<int>(at_work.size()) < at_a_time) {
      const pid_t process = begin_call(calls[next]);
      if (process < 0) {
        tell("vegard: %s cannot be begun\n", calls[next].what.c_str());
        worst = worst == good ? static_cast<int>(internal_error) : worst;
        next = calls.size();
        continue;
      }
      at_work[process] = next++;
      continue;
    }
    if (!goes_on) {
      next = calls.size();
      if (!was_told)
        for (const auto& [process, call] : at_work) ::kill(process, SIGTERM);
      was_told = true;
      if (at_work.empty()) break;
    }
    int status = 0;
    // Not waited for: a signal is to be heard at once.
    const pid_t ended = ::waitpid(-1, &status, WNOHANG);
    const auto found = at_work.find(ended);
    if (found == at_work.end()) {
      ::usleep(kPause_us);
      continue;
    }
    const int code = code_of_status(status);
    if (code != good && !is_of_interruption(code))
      tell("vegard: %s ended with exit code %d\n", calls[found->second].what.c_str(), code);
    if (worst == good) worst = code;
    at_work.erase(found);
  }
  if (stop.load()) return interrupted;
  return static_cast<ExitCode>(worst);
}

ProgramEnd run_program(const std::vector<std::string>& words) {
  std::vector<std::string> copies = words;
  std::vector<char*> arguments;
  for (std::string& word : copies) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  int ends[2];
  if (::pipe(ends) != 0) return {kNoProgram, "no pipe can be made"};
  show_output();
  const pid_t process = ::fork();
  if (process == 0) {
    ::dup2(ends[1], STDOUT_FILENO);
    ::dup2(ends[1], STDERR_FILENO);
    ::close(ends[0]);
    ::close(ends[1]);
    ::execvp(arguments[0], arguments.data());
    ::_exit(kNoProgram);
  }
  ::close(ends[1]);
  ProgramEnd end;
  char block[4096];
  for (;;) {
    const ssize_t count = ::read(ends[0], block, sizeof block);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    end.words.append(block, static_cast<std::size_t>(count));
  }
  ::close(ends[0]);
  int status = 0;
  while (process > 0 && ::waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  end.exit_code = process > 0 ? code_of_status(status) : kNoProgram;
  return end;
}

}  // namespace vegard::apps
