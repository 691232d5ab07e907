// Work in a process of its own: for libraries that trust what a file says. Debian's libhdf5 crashes on some
// damaged files (docs/validation.md has the figures); here that ends a child, and is reported like any other
// damage.
//
// The child is a copy of this process (fork) with a limit of memory, without standard output and error. It
// answers one request after another until the worker is destroyed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace vegard::sim {

struct ChildLimits {
  /// Beyond what this process has; not kept under sanitizers, whose own memory is terabytes.
  std::uint64_t memory_bytes = std::uint64_t{1} << 31;
  std::size_t answer_bytes = std::size_t{1} << 30;
  /// Of work for one answer. What sleeps is waited for twenty times as long.
  double seconds = 6.0;
};

class ChildWorker {
 public:
  /// Runs in the child alone, and keeps what it opens from one request to the next. What it throws as
  /// sim::Error is thrown by ask(); std::bad_alloc means that the limit of memory was met.
  using Answer = std::function<std::string(std::string_view request)>;

  /// `name`: of the file, for messages; `library`: "HDF5".
  ChildWorker(std::string name, std::string library, Answer answer, const ChildLimits& limits = {});
  ~ChildWorker();
  ChildWorker(const ChildWorker&) = delete;
  ChildWorker& operator=(const ChildWorker&) = delete;

  /// Throws sim::Error(unreadable_input) as the child did, or if it crashed, took too long or asked for more
  /// memory than it may have; it is not to be asked again then. That somebody else has killed it is reported
  /// as that, and not as damage.
  std::string ask(std::string_view request);

 private:
  void start();
  void end();
  [[noreturn]] void refuse(const std::string& problem, const std::string& hint = {});
  void send(std::string_view bytes);
  void receive(char* to, std::size_t count, double until_s);
  [[noreturn]] void refuse_end();

  std::string name_, library_;
  Answer answer_;
  ChildLimits limits_;
  int socket_ = -1;
  int process_ = -1;
};

}  // namespace vegard::sim
