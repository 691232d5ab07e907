// A tokeniser for pbrt's scene text, for files of any length: brackets, "strings", and numbers or names.
#pragma once

#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "sim/base/error.h"

namespace vegard::sim {

class VolumegridWords {
 public:
  enum class Kind { end, open, close, text, bare };

  /// Throws Error(unreadable_input) if the file cannot be opened.
  explicit VolumegridWords(const std::string& path);

  /// Goes to the next word and returns its kind. Comments and blanks are skipped. Throws
  /// Error(unreadable_input) for a string that does not end in its line, and for a word of more than 256
  /// letters.
  Kind next();

  /// Returns the word that next() has found, a string without its quotes. Valid until the next call.
  const std::string& word() const { return word_; }
  int line() const { return word_line_; }  ///< line of the word's beginning, from 1

  /// Returns Error(unreadable_input) with file and the word's line.
  Error error_here(const std::string& problem) const;

  /// Returns the word as a finite number; throws error_here() if it is none.
  double number() const;

 private:
  int peek() {
    if (at_ == filled_ && !fill()) return -1;
    return static_cast<unsigned char>(buffer_[at_]);
  }
  bool fill();

  std::string path_;
  std::ifstream stream_;
  std::vector<char> buffer_;
  std::size_t at_ = 0, filled_ = 0;
  std::string word_;
  int line_ = 1, word_line_ = 1;
};

}  // namespace vegard::sim
