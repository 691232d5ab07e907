#include "sim/base/array/array_format.h"

#include "sim/base/error.h"
#include "sim/base/file/input_file.h"

namespace vegard::sim {

const ArrayFormat* array_format(std::string_view beginning) {
  for (const ArrayFormat& format : kArrayFormats)
    if (format.is_format(beginning)) return &format;
  return nullptr;
}

const ArrayFormat* array_format_of(const std::string& path) {
  constexpr std::size_t kEnough = 1024;
  const InputFile begun = read_beginning(path, kEnough);
  return begun.problem.empty() ? array_format(begun.bytes) : nullptr;
}

std::unique_ptr<ArrayFile> open_array_file(const std::string& name, std::string_view bytes) {
  const ArrayFormat* const format = bytes.data() != nullptr ? array_format(bytes) : array_format_of(name);
  if (format != nullptr) return format->open(name, bytes);
  std::string known;
  for (const ArrayFormat& one : kArrayFormats)
    if (one.has_pictures) known += (known.empty() ? "" : ", ") + std::string(one.name);
  throw unreadable(name, "this is no file of arrays").expected(known);
}

}  // namespace vegard::sim
