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

  Tell() = default;  ///< nobody hears
  explicit Tell(Hear hear) : hear_(std::move(hear)) {}

  void operator()(const std::string& line, Tone tone = Tone::plain) const {
    if (hear_) hear_(line, tone);
  }

  /// A text of whole lines.
  void lines(const std::string& text) const {
    for (std::size_t begin = 0, end = 0; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1)
      (*this)(text.substr(begin, end - begin));
  }

 private:
  Hear hear_;
};

/// An error about the option `key` of the stage's command.
inline sim::Error usage_error(const std::string& key, const std::string& problem, const std::string& expected,
                              const std::string& hint = {}) {
  return sim::Error(sim::ErrorKind::usage, problem).key(key).expected(expected).hint(hint);
}

}  // namespace vegard::fit
