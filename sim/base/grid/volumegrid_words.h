// The words of pbrt's scene text, from a file of any length: brackets, "strings", and numbers or names.
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

  /// Goes to the next word and says what it is. Comments and blanks are passed over. Throws
  /// Error(unreadable_input) for a string that does not end in its line, and for a word beyond 256 letters.
  Kind next();

  /// The word that next() has found: of a string what is between the quotes. Until the next call.
  const std::string& word() const { return word_; }
  int line() const { return word_line_; }  ///< where it begins, from 1

  /// Throws Error(unreadable_input) with file and the word's line.
  [[noreturn]] void refuse(const std::string& problem, const std::string& expected,
                           const std::string& hint = {}) const;

  /// The word as a finite number. Refuses what is none.
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
