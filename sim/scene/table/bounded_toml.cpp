#include "sim/scene/table/bounded_toml.h"

#include <vector>

#include "sim/base/error.h"
#include "sim/base/file/input_file.h"
#include "sim/base/text.h"

namespace vegard::sim {
namespace {

/// Goes through a text once. It need not know whether the text is valid: of what is not, it counts no less.
class TomlScan {
 public:
  explicit TomlScan(std::string_view text) : text_(text) {}

  std::optional<TomlExcess> excess() {
    if (text_.size() > kMaxTomlBytes) return TomlExcess{"it is larger than " + bytes_text(kMaxTomlBytes), 0};
    while (at_ < text_.size() && problem_.empty()) {
      switch (text_[at_]) {
        case '"':
        case '\'':
          pass_text();
          break;
        case '#':
          while (at_ < text_.size() && text_[at_] != '\n') ++at_;
          break;
        default:
          take(text_[at_]);
      }
    }
    if (problem_.empty()) end_key(at_);
    if (problem_.empty()) return {};
    return TomlExcess{problem_, line_};
  }

 private:
  /// A text, also of three quotes, as a whole; lines in it count. One that is not closed ends with its line.
  void pass_text() {
    const char quote = text_[at_];
    const bool is_long = text_.substr(at_, 3) == std::string(3, quote);
    const std::string_view end = text_.substr(at_, is_long ? 3 : 1);
    at_ += end.size();
    while (at_ < text_.size()) {
      if (text_[at_] == '\n') {
        if (!is_long) return;
        ++line_;
      }
      if (quote == '"' && text_[at_] == '\\' && at_ + 1 < text_.size() && text_[at_ + 1] != '\n') {
        at_ += 2;
      } else if (text_.substr(at_, end.size()) == end) {
        at_ += end.size();
        return;
      } else {
        ++at_;
      }
    }
  }

  void take(char c) {
    switch (c) {
      case '.':
        if (++parts_ > kMaxTomlDepth) problem_ = "a key has more than " + most() + " parts";
        break;
      case '=':
        end_key(at_);
        if (problem_.empty()) begin(true);
        break;
      case '[':
      case '{':
        // At the beginning of a line "[" begins the name of a table, as long as any key; else an array.
        if (open_.empty() && !in_value_ && c == '[') {
          begin(false);
          break;
        }
        open_.push_back(c);
        if (open_.size() > kMaxTomlDepth)
          problem_ = "arrays and tables are nested more than " + most() + " deep";
        begin(c == '[');
        break;
      case ']':
      case '}':
        end_key(at_);
        if (!open_.empty()) open_.pop_back();
        begin(true);
        break;
      case ',':
        begin(open_.empty() || open_.back() == '[');
        break;
      case '\n':
        end_key(at_);
        if (!problem_.empty()) return;  // in this line
        ++line_;
        if (open_.empty()) begin(false);
        break;
      default:
        break;
    }
    ++at_;
  }

  /// What follows is a key, or a value.
  void begin(bool in_value) {
    in_value_ = in_value;
    parts_ = 1;
    key_begin_ = at_ + 1;
  }

  void end_key(std::size_t end) {
    if (in_value_) return;
    const std::string_view key = trimmed(text_.substr(key_begin_, end - key_begin_));
    if (key.size() > kMaxTomlKeyBytes && key[0] != '#')
      problem_ = "a key is longer than " + std::to_string(kMaxTomlKeyBytes) + " bytes";
  }

  static std::string most() { return std::to_string(kMaxTomlDepth); }

  std::string_view text_;
  std::size_t at_ = 0, key_begin_ = 0;
  int line_ = 1, parts_ = 1;
  bool in_value_ = false;
  std::vector<char> open_;  ///< brackets that are not closed yet
  std::string problem_;
};

/// Nothing if the line is 0.
std::string_view lines_before(int line, std::string_view text) {
  std::size_t end = 0;
  for (int before = 1; before < line; ++before) end = text.find('\n', end) + 1;
  return text.substr(0, end);
}

}  // namespace

std::optional<TomlExcess> toml_excess(std::string_view text) { return TomlScan(text).excess(); }

toml::table parse_toml(const std::string& text, const std::string& file) {
  if (const auto excess = toml_excess(text)) {
    // What is no TOML at all, such as a picture, is reported where it begins.
    try {
      static_cast<void>(toml::parse(lines_before(excess->line, text), file));
    } catch (const toml::parse_error& error) {
      // In the last line it may be that an array or a text is not at its end there.
      if (static_cast<int>(error.source().begin.line) < excess->line - 1) throw;
    }
    throw Error(ErrorKind::scene, excess->problem).file(file).line(excess->line).expected("a TOML file");
  }
  return toml::parse(text, file);
}

}  // namespace vegard::sim
