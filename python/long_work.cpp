#include "python/long_work.h"

#include <chrono>
#include <exception>
#include <thread>

#include "python/bindings.h"

namespace vegard::python {
namespace {

constexpr std::chrono::milliseconds kBetweenLooks(50);

}  // namespace

LongWork::LongWork(py::object progress, py::object stop)
    : progress_(std::move(progress)), event_(std::move(stop)) {
  if (!progress_.is_none() && PyCallable_Check(progress_.ptr()) == 0)
    throw py::type_error("progress is neither None nor callable");
  if (!event_.is_none() && !py::hasattr(event_, "is_set"))
    throw py::type_error("stop is neither None nor has it is_set(), as a threading.Event has");
}

void LongWork::tell(Progress news) {
  const std::lock_guard<std::mutex> lock(mutex_);
  news_ = std::move(news);
}

void LongWork::pass_on() {
  std::optional<Progress> news;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    news.swap(news_);
  }
  if (news && !progress_.is_none()) progress_(*news);
}

void LongWork::run(const std::function<void()>& work) {
  std::exception_ptr failure;
  std::thread worker([&] {
    try {
      work();
    } catch (...) {
      failure = std::current_exception();
    }
    const std::lock_guard<std::mutex> lock(mutex_);
    done_ = true;
    ended_.notify_all();
  });
  try {
    for (bool done = false; !done;) {
      {
        const py::gil_scoped_release others_may_run;
        std::unique_lock<std::mutex> lock(mutex_);
        done = ended_.wait_for(lock, kBetweenLooks, [this] { return done_; });
      }
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (!event_.is_none() && event_.attr("is_set")().cast<bool>()) stop_ = true;
      pass_on();
    }
  } catch (...) {
    stop_ = true;
    {
      const py::gil_scoped_release others_may_run;
      worker.join();
    }
    throw;
  }
  worker.join();
  if (failure) std::rethrow_exception(failure);
}

void bind_long_work(py::module_& m) {
  py::class_<Progress>(m, "Progress", "How far long work is; what a `progress` callback is called with.")
      .def_readonly("stage", &Progress::stage, "What is being done, in words (str).")
      .def_readonly("share", &Progress::share, "Finished share of the work, 0 to 1: a guess (float).")
      .def_readonly("evaluations", &Progress::evaluations, "Evaluations of a fit's residuals so far (int).")
      .def_readonly(
          "chi2_per_value", &Progress::chi2_per_value,
          "The best chi2 of a fit over its degrees of freedom, of a map over its values (float); infinite or "
          "0 where it is not known yet.");
}

}  // namespace vegard::python
