#include "sim/base/file/short_path.h"

namespace vegard::sim {

std::string short_path(const std::string& path, bool one_sheet) {
  if (!one_sheet || path.compare(0, 6, "sheet.") != 0) return path;
  const std::size_t dot = path.find('.', 6);
  return dot == std::string::npos ? path : path.substr(dot + 1);
}

}  // namespace vegard::sim
