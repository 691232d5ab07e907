// What the stages of a measurement say while they work.
#pragma once

#include <functional>
#include <string>
#include <utility>

#include "sim/base/error.h"

namespace vegard::fit {

/// Passes on the findings of a stage, a line each, as soon as they are known.
class Tell {
 public:
  enum class Tone { plain, doubtful };
  using Hear = std::function<void(const std::string& line, Tone tone)>;

  /// Of work that takes long: what it is, and how much of it is done, 0 to 1. Any thread may call it.
  using Follow = std::function<void(const std::string& work, double share)>;

  Tell() = default;  ///< nobody hears
  explicit Tell(Hear hear, Follow follow = {}) : hear_(std::move(hear)), follow_(std::move(follow)) {}

  void operator()(const std::string& line, Tone tone = Tone::plain) const {
    if (hear_) hear_(line, tone);
  }

  void progress(const std::string& work, double share) const {
    if (follow_) follow_(work, share);
  }
  /// The same as a function of the share alone.
  std::function<void(double)> progress_of(const std::string& work) const {
    if (!follow_) return {};
    return [follow = follow_, work](double share) { follow(work, share); };
  }

  /// A text of whole lines.
  void lines(const std::string& text) const {
    for (std::size_t begin = 0, end = 0; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1)
      (*this)(text.substr(begin, end - begin));
  }

 private:
  Hear hear_;
  Follow follow_;
};

/// An error about the option `key` of the stage's command.
inline sim::Error usage_error(const std::string& key, const std::string& problem, const std::string& expected,
                              const std::string& hint = {}) {
  return sim::Error(sim::ErrorKind::usage, problem).key(key).expected(expected).hint(hint);
}

}  // namespace vegard::fit
