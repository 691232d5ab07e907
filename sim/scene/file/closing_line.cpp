#include "sim/scene/file/closing_line.h"

namespace vegard::sim {
namespace {

constexpr std::string_view kPromise = "# This file ends with the line \"# end\"; without it, it was cut.\n";
constexpr std::string_view kClosingLine = "\n# end\n";

}  // namespace

std::string with_closing_line(const std::string& toml) {
  std::string closed = std::string(kPromise) + toml;
  if (closed.back() == '\n') closed.pop_back();
  return closed + std::string(kClosingLine);
}

bool lacks_closing_line(std::string_view toml) {
  return toml.find(kPromise.substr(0, kPromise.size() - 1)) != std::string_view::npos &&
         toml.find("\n# end") == std::string_view::npos;
}

}  // namespace vegard::sim
