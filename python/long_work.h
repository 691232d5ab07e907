// Runs long work in a thread of its own without the interpreter's lock, while the caller's thread calls a
// progress callback and checks for Ctrl-C.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>

namespace vegard::python {

namespace py = pybind11;

/// The argument of a progress callback.
struct Progress {
  std::string stage;
  double share = 0.0;           ///< 0 to 1, estimated
  int evaluations = 0;          ///< of a fit
  double chi2_per_value = 0.0;  ///< of a fit or a map; infinite or 0 where it is not known yet
};

class LongWork {
 public:
  /// `progress`: None, or a function that is called with a Progress, at most about twenty times per second;
  /// `stop`: None, or a threading.Event whose is_set() ends the work early. Throws py::type_error.
  LongWork(py::object progress, py::object stop);

  /// The flag that the work must check, and the function by which it reports progress; both for any thread.
  const std::atomic<bool>* stop() const { return &stop_; }
  void tell(Progress news);

  /// Runs work() in another thread. Throws what it throws; also what the callback raises, and
  /// KeyboardInterrupt, after the work has been told to stop and has ended.
  void run(const std::function<void()>& work);

  /// Whether the user's `stop`, or an exception in the caller's thread, has told the work to end.
  bool stopped() const { return stop_.load(); }

 private:
  void pass_on();

  py::object progress_, event_;
  std::atomic<bool> stop_{false};
  std::mutex mutex_;
  std::condition_variable ended_;
  std::optional<Progress> news_;
  bool done_ = false;
};

/// Runs work that returns a result.
template <class Result>
Result result_of(LongWork& long_work, const std::function<Result()>& work) {
  std::optional<Result> result;
  long_work.run([&] { result.emplace(work()); });
  return std::move(*result);
}

}  // namespace vegard::python
