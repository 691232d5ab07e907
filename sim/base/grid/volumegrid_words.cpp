#include "sim/base/grid/volumegrid_words.h"

#include <charconv>
#include <cmath>
#include <cstdlib>

#include "sim/base/error.h"
#include "sim/base/file/input_file.h"

namespace vegard::sim {
namespace {

constexpr std::size_t kPiece = std::size_t{1} << 20, kLongestWord = 256;

bool is_blank(int c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' || c == '\f'; }

bool ends_word(int c) { return c < 0 || is_blank(c) || c == '[' || c == ']' || c == '"' || c == '#'; }

}  // namespace

VolumegridWords::VolumegridWords(const std::string& path) : path_(path), buffer_(kPiece) {
  if (const std::string problem = why_no_input(path); !problem.empty())
    throw error_here(problem).expected("a volumegrid's text");
  stream_.open(path, std::ios::binary);
  if (!stream_) throw error_here("it cannot be read").expected("a volumegrid's text");
}

Error VolumegridWords::error_here(const std::string& problem) const {
  const bool is_open = filled_ > 0;
  return unreadable(path_, problem).line(is_open ? word_line_ : 0);
}

bool VolumegridWords::fill() {
  stream_.read(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
  const auto count = static_cast<std::size_t>(stream_.gcount());
  if (stream_.bad()) throw error_here("it cannot be read to its end").expected("a file that may be read");
  if (count == 0) return false;  // at_ stays behind the last letter
  at_ = 0;
  filled_ = count;
  return true;
}

VolumegridWords::Kind VolumegridWords::next() {
  word_.clear();
  int c = peek();
  while (is_blank(c) || c == '#') {
    if (c == '#') {
      while (c >= 0 && c != '\n') {
        ++at_;
        c = peek();
      }
      continue;
    }
    if (c == '\n') ++line_;
    ++at_;
    c = peek();
  }
  word_line_ = line_;
  if (c < 0) return Kind::end;
  if (c == '[' || c == ']') {
    ++at_;
    word_ = static_cast<char>(c);
    return c == '[' ? Kind::open : Kind::close;
  }
  const auto add = [&] {
    if (word_.size() == kLongestWord)
      throw error_here("a word of more than 256 letters begins with '" + word_.substr(0, 20) + "'")
          .expected("numbers and names parted by blanks")
          .hint("is it a text?");
    word_ += static_cast<char>(c);
    ++at_;
    c = peek();
  };
  if (c == '"') {
    ++at_;
    c = peek();
    while (c != '"') {
      if (c < 0 || c == '\n') throw error_here("a \" is not closed in its line").expected("another \"");
      add();
    }
    ++at_;
    return Kind::text;
  }
  while (!ends_word(c)) add();
  return Kind::bare;
}

double VolumegridWords::number() const {
  const char* from = word_.data();
  const char* const to = from + word_.size();
  if (from != to && *from == '+') ++from;
  double value = 0.0;
  const auto [end, error] = std::from_chars(from, to, value);
  // Beyond a double's range: 0 or infinity, which only this one tells apart.
  if (error == std::errc::result_out_of_range && end == to) {
    value = std::strtod(word_.c_str(), nullptr);
    if (std::isfinite(value)) return value;
  }
  if (error != std::errc() || end != to || !std::isfinite(value))
    throw error_here("'" + word_ + "' is no number").expected("a finite number");
  return value;
}

}  // namespace vegard::sim
