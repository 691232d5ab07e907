// Long work: in a thread of its own without the interpreter's lock, while the caller's thread hears of
// progress and looks for Ctrl-C.
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

/// What a callback hears.
struct Progress {
  std::string stage;
  double share = 0.0;           ///< 0 to 1, a guess
  int evaluations = 0;          ///< of a fit
  double chi2_per_value = 0.0;  ///< of a fit or a map; infinite or 0 where it is not known yet
};

class LongWork {
 public:
  /// `progress`: None, or called with a Progress, at most some twenty times a second; `stop`: None, or a
  /// threading.Event whose is_set() ends the work early. Throws py::type_error.
  LongWork(py::object progress, py::object stop);

  /// For the work to ask, and to tell, from any thread.
  const std::atomic<bool>* stop() const { return &stop_; }
  void tell(Progress news);

  /// work() in another thread. Throws what it throws; what the callback raises, and KeyboardInterrupt, after
  /// the work has been told to stop and has ended.
  void run(const std::function<void()>& work);

  /// Whether the user's `stop` has ended it.
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

/// The same of work that has a result.
template <class Result>
Result result_of(LongWork& long_work, const std::function<Result()>& work) {
  std::optional<Result> result;
  long_work.run([&] { result.emplace(work()); });
  return std::move(*result);
}

}  // namespace vegard::python
