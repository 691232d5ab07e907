#include "sim/base/file/csv_text.h"

#include <fmt/format.h>

#include <cmath>

namespace vegard::sim {

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + "\"";
}

std::string csv_number(double value) { return std::isfinite(value) ? fmt::format("{}", value) : ""; }

std::string csv_comment(const std::string& words) {
  std::string line = "# " + words;
  for (char& c : line)
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  return line + "\n";
}

}  // namespace vegard::sim
