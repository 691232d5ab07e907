// Work in a child process, for libraries that trust the content of files. Debian's libhdf5 crashes on some
// damaged files (docs/validation.md has the figures); in a child process, a crash is reported like any other
// damage of the file.
//
// The child is a copy of this process (fork) with a memory limit and without standard output and error. It
// answers one request after another until the worker is destroyed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "sim/base/error.h"

namespace vegard::sim {

struct ChildLimits {
  /// Memory in addition to that of this process; no limit under sanitizers, which reserve terabytes.
  std::uint64_t memory_bytes = std::uint64_t{1} << 31;
  std::size_t answer_bytes = std::size_t{1} << 30;
  /// CPU time for one answer. The limit of elapsed time is twenty times as long.
  double seconds = 6.0;
};

class ChildWorker {
 public:
  /// Answers a request. It only runs in the child and may keep files open between requests. ask() throws the
  /// sim::Error that it throws; std::bad_alloc means that the memory limit was reached.
  using Answer = std::function<std::string(std::string_view request)>;

  /// `name` is the file, `library` ("HDF5") the library, both for messages.
  ChildWorker(std::string name, std::string library, Answer answer, const ChildLimits& limits = {});
  ~ChildWorker();
  ChildWorker(const ChildWorker&) = delete;
  ChildWorker& operator=(const ChildWorker&) = delete;

  /// Returns the child's answer. Throws the child's sim::Error, or Error(unreadable_input) if the child
  /// crashed, took too long or reached the memory limit; ask() must not be called again then. If another
  /// process killed the child, the message says so.
  std::string ask(std::string_view request);

 private:
  void start();
  void end();
  /// Ends the child and returns Error(unreadable_input).
  Error ended_for(const std::string& problem);
  /// The same where the child has ended by itself.
  Error ended_by_itself();
  void send(std::string_view bytes);
  void receive(char* to, std::size_t count, double until_s);

  std::string name_, library_;
  Answer answer_;
  ChildLimits limits_;
  int socket_ = -1;
  int process_ = -1;
};

}  // namespace vegard::sim
