#include "sim/scene/rows/value_words.h"

#include <charconv>
#include <cmath>
#include <system_error>

namespace vegard::sim {

std::string real_text(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
  std::string text(digits, end);
  // "3" would be read back as an integer.
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

std::string short_real_text(double value) {
  char digits[32];
  const bool is_whole = std::floor(value) == value && std::abs(value) < 1e15;
  const auto end =
      is_whole ? std::to_chars(digits, digits + sizeof digits, value, std::chars_format::fixed).ptr
               : std::to_chars(digits, digits + sizeof digits, value, std::chars_format::general, 6).ptr;
  return std::string(digits, end);
}

std::string quoted_text(std::string_view text) {
  static const char hex[] = "0123456789ABCDEF";
  std::string quoted = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      quoted += '\\';
      quoted += c;
    } else if (byte < 0x20 || byte == 0x7f) {
      quoted += "\\u00";
      quoted += hex[byte >> 4];
      quoted += hex[byte & 15];
    } else {
      quoted += c;
    }
  }
  return quoted + '"';
}

}  // namespace vegard::sim
