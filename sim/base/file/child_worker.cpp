#include "sim/base/file/child_worker.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <new>
#include <utility>

#include "sim/base/error.h"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define VEGARD_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define VEGARD_SANITIZED 1
#endif
#endif

namespace vegard::sim {
namespace {

constexpr const char* kDamagedFile = "the file is damaged";

enum class Outcome : std::uint64_t { answer, error, no_memory };

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// All of it, or false where nobody reads any more.
bool send_all(int socket, const char* bytes, std::size_t count) {
  while (count > 0) {
    const ssize_t sent = ::send(socket, bytes, count, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return false;
    bytes += sent;
    count -= static_cast<std::size_t>(sent);
  }
  return true;
}

bool receive_all(int socket, char* to, std::size_t count) {
  while (count > 0) {
    const ssize_t got = ::recv(socket, to, count, 0);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    to += got;
    count -= static_cast<std::size_t>(got);
  }
  return true;
}

/// Returns the size of this process's address space.
std::uint64_t address_space_bytes() {
  unsigned long long pages = 0;
  if (std::FILE* file = std::fopen("/proc/self/statm", "r")) {
    if (std::fscanf(file, "%llu", &pages) != 1) pages = 0;
    std::fclose(file);
  }
  return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

void limit_memory([[maybe_unused]] std::uint64_t bytes) {
#ifndef VEGARD_SANITIZED
  if (const std::uint64_t has = address_space_bytes(); has > 0) {
    const rlimit limit{static_cast<rlim_t>(has + bytes), static_cast<rlim_t>(has + bytes)};
    ::setrlimit(RLIMIT_AS, &limit);
  }
#endif
}

/// The child is to end by itself and in silence, whatever this process has made of signals.
void become_a_worker(std::uint64_t memory_bytes) {
  for (const int signal : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGTRAP, SIGALRM, SIGPROF, SIGXCPU})
    ::signal(signal, SIG_DFL);
  // Signals that interrupt or end the parent are left to the parent: it ends the child, or finishes first,
  // and when it is gone the socket ends.
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) ::signal(signal, SIG_IGN);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  limit_memory(memory_bytes);
  if (const int nowhere = ::open("/dev/null", O_RDWR); nowhere >= 0)
    for (const int standard : {0, 1, 2}) ::dup2(nowhere, standard);
}

/// True if another process ended the child with this signal: neither libraries nor the limits here raise
/// these. A kernel without memory, and batch systems, send SIGKILL.
bool is_end_from_outside(int signal) {
  return signal == SIGKILL || signal == SIGQUIT || signal == SIGUSR1 || signal == SIGUSR2;
}

std::string error_text(const Error& error) {
  const ErrorDetails& details = error.details();
  return details.problem + '\0' + details.expected + '\0' + details.hint;
}

Error error_of(const std::string& file, const std::string& text) {
  const std::size_t first = text.find('\0'), second = text.find('\0', first + 1);
  return unreadable(file, text.substr(0, first))
      .expected(text.substr(first + 1, second - first - 1))
      .hint(text.substr(second + 1));
}

/// SIGPROF ends the child when it has worked for so long; 0: never.
void limit_work(double seconds) {
  itimerval limit{};
  limit.it_value.tv_sec = static_cast<time_t>(seconds);
  constexpr double kMicroseconds = 1e6;
  limit.it_value.tv_usec =
      static_cast<suseconds_t>((seconds - static_cast<double>(limit.it_value.tv_sec)) * kMicroseconds);
  ::setitimer(ITIMER_PROF, &limit, nullptr);
  // One that sleeps, on a lock that was held when it was forked, works for nothing and has to end as well.
  constexpr double kSleepingTo = 20.0;
  ::alarm(static_cast<unsigned>(std::ceil(kSleepingTo * seconds)));
}

/// Nothing may leave it: the stack above is the parent's, with files and locks that are not the child's to
/// end.
[[noreturn]] void serve(int socket, const ChildWorker::Answer& answer, double seconds) noexcept {
  for (;;) {
    std::uint64_t size = 0;
    if (!receive_all(socket, reinterpret_cast<char*>(&size), sizeof size)) ::_exit(0);
    Outcome outcome = Outcome::answer;
    std::string text;
    try {
      std::string request(static_cast<std::size_t>(size), '\0');
      if (!receive_all(socket, request.data(), request.size())) ::_exit(0);
      limit_work(seconds);
      text = answer(request);
    } catch (const Error& error) {
      outcome = Outcome::error;
      text = error_text(error);
    } catch (const std::bad_alloc&) {
      outcome = Outcome::no_memory;
      text.clear();
    } catch (...) {
      ::_exit(1);
    }
    limit_work(0.0);
    const std::uint64_t head[2] = {static_cast<std::uint64_t>(outcome), text.size()};
    if (!send_all(socket, reinterpret_cast<const char*>(head), sizeof head) ||
        !send_all(socket, text.data(), text.size()))
      ::_exit(0);
  }
}

}  // namespace

ChildWorker::ChildWorker(std::string name, std::string library, Answer answer, const ChildLimits& limits)
    : name_(std::move(name)), library_(std::move(library)), answer_(std::move(answer)), limits_(limits) {}

ChildWorker::~ChildWorker() { end(); }

void ChildWorker::end() {
  if (socket_ >= 0) ::close(socket_);
  socket_ = -1;
  if (process_ <= 0) return;
  ::kill(process_, SIGKILL);
  while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
}

Error ChildWorker::ended_for(const std::string& problem) {
  end();
  return unreadable(name_, problem);
}

void ChildWorker::start() {
  // No other child may come to hold the ends of this one's socket.
  static std::mutex one_at_a_time;
  const std::lock_guard<std::mutex> lock(one_at_a_time);
  int ends[2] = {-1, -1};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    throw ended_for(std::string("it cannot be read apart: ") + std::strerror(errno));
  const pid_t process = ::fork();
  if (process == 0) {
    ::close(ends[0]);
    become_a_worker(limits_.memory_bytes);
    serve(ends[1], answer_, limits_.seconds);
  }
  ::close(ends[1]);
  socket_ = ends[0];
  process_ = process;
  if (process < 0) throw ended_for(std::string("it cannot be read apart: ") + std::strerror(errno));
}

Error ChildWorker::ended_by_itself() {
  int status = 0;
  if (process_ > 0 && ::waitpid(process_, &status, 0) == process_) process_ = -1;
  const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  if (is_end_from_outside(signal))
    return ended_for("the process that reads it was killed (signal " + std::to_string(signal) +
                     "), which says nothing about the file")
        .hint("try again; a machine that runs out of memory kills so");
  const bool took_too_long = signal == SIGPROF || signal == SIGXCPU || signal == SIGALRM;
  return ended_for(std::string(kDamagedFile) + ": " + library_ +
                   (took_too_long ? " does not come to an end with it" : " fails on it"))
      .hint(kCopyAgain);
}

void ChildWorker::send(std::string_view bytes) {
  if (!send_all(socket_, bytes.data(), bytes.size())) throw ended_by_itself();
}

void ChildWorker::receive(char* to, std::size_t count, double until_s) {
  while (count > 0) {
    const double left_s = until_s - now_s();
    pollfd waited{socket_, POLLIN, 0};
    constexpr double kMilliseconds = 1000.0;
    const int ready = left_s > 0.0 ? ::poll(&waited, 1, static_cast<int>(left_s * kMilliseconds) + 1) : 0;
    if (ready < 0 && errno == EINTR) continue;
    if (ready <= 0)
      throw ended_for(std::string(kDamagedFile) + ": " + library_ + " does not come to an end with it")
          .hint(kCopyAgain);
    const ssize_t got = ::recv(socket_, to, count, 0);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) throw ended_by_itself();
    to += got;
    count -= static_cast<std::size_t>(got);
  }
}

std::string ChildWorker::ask(std::string_view request) {
  if (process_ <= 0) start();
  const std::uint64_t size = request.size();
  send({reinterpret_cast<const char*>(&size), sizeof size});
  send(request);
  constexpr double kSleepingTimes = 20.0;
  const double until_s = now_s() + kSleepingTimes * limits_.seconds;
  std::uint64_t head[2] = {};
  receive(reinterpret_cast<char*>(head), sizeof head, until_s);
  if (static_cast<Outcome>(head[0]) == Outcome::no_memory || head[1] > limits_.answer_bytes)
    throw ended_for("what it promises needs more memory than it may have")
        .hint("make it again in smaller parts, if it is sound");
  std::string answer(static_cast<std::size_t>(head[1]), '\0');
  receive(answer.data(), answer.size(), until_s);
  if (static_cast<Outcome>(head[0]) == Outcome::error) throw error_of(name_, answer);
  return answer;
}

}  // namespace vegard::sim
