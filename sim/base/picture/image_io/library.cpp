#include "sim/base/picture/image_io/library.h"

#include <OpenImageIO/oiioversion.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <utility>
#include <vector>

#include "sim/base/error.h"
#include "sim/base/file/input_file.h"
#include "sim/base/module.h"
#include "sim/base/picture/image_io.h"
#include "sim/base/picture/pixel_limit.h"

namespace vegard::sim {
namespace {

constexpr std::uint64_t largest_value_count = std::uint64_t{1} << 30;  // 4 GiB of floats

}  // namespace

std::string with_name(std::string words, const std::string& stand_in, const std::string& name) {
  for (std::size_t at = words.find(stand_in); at != std::string::npos;
       at = words.find(stand_in, at + name.size()))
    words.replace(at, stand_in.size(), name);
  return words;
}

Error failure(ErrorKind kind, const std::string& name, std::string problem, std::string expected) {
  return Error(kind, std::move(problem)).file(name).expected(std::move(expected));
}

void check_is_file(const std::string& path) {
  if (const std::string problem = why_no_input(path); !problem.empty())
    throw failure(ErrorKind::unreadable_input, path, problem);
}

void check_size(const PictureLayout& layout, const std::string& path) {
  const auto unreadable = [&](const std::string& problem) {
    return failure(ErrorKind::unreadable_input, path, problem);
  };
  if (layout.width < 1 || layout.height < 1 || layout.channels < 1) throw unreadable("has no pixels");
  const std::uint64_t row_values =
      static_cast<std::uint64_t>(layout.width) * static_cast<std::uint64_t>(layout.channels);
  if (row_values > largest_value_count / static_cast<std::uint64_t>(layout.height)) {
    throw unreadable("says that it holds " + std::to_string(layout.width) + " x " +
                     std::to_string(layout.height) + " pixels, more than can be read");
  }
  check_pixel_limit(layout.width, layout.height, path);
}

std::vector<float> framed(std::vector<float> data_window, PictureLayout& layout, float outside,
                          const std::string& path) {
  const PictureLayout data = layout;
  layout.x = layout.full_x;
  layout.y = layout.full_y;
  layout.width = layout.full_width;
  layout.height = layout.full_height;
  if (data.x == layout.x && data.y == layout.y && data.width == layout.width && data.height == layout.height)
    return data_window;
  check_size(layout, path);
  const auto channels = static_cast<std::size_t>(layout.channels);
  std::vector<float> frame(channels * static_cast<std::size_t>(layout.width) * layout.height, outside);
  const int left = std::max(data.x, layout.x), right = std::min(data.x + data.width, layout.x + layout.width);
  const int top = std::max(data.y, layout.y),
            bottom = std::min(data.y + data.height, layout.y + layout.height);
  if (left >= right) return frame;
  for (int y = top; y < bottom; ++y) {
    const std::size_t from = (static_cast<std::size_t>(y - data.y) * data.width + (left - data.x)) * channels,
                      to = (static_cast<std::size_t>(y - layout.y) * layout.width + (left - layout.x)) *
                           channels;
    std::copy_n(data_window.begin() + static_cast<std::ptrdiff_t>(from),
                channels * static_cast<std::size_t>(right - left),
                frame.begin() + static_cast<std::ptrdiff_t>(to));
  }
  return frame;
}

std::unique_ptr<PictureDecoder> open_exr(const std::string& path, const std::string_view* bytes,
                                         OpenProblem& problem) {
  problem = {};
  std::unique_ptr<PictureDecoder> decoder = module_functions<OpenExr>().open(path, bytes, problem);
  if (decoder || !problem.no_decoder) return decoder;
  return module_functions<OpenImageIo>().open("openexr", path, bytes, {}, problem);
}

std::string decoder_version(const std::string& format) {
  const std::string all = ";" + module_functions<OpenImageIo>().libraries();
  const std::size_t at = all.find(";" + format + ":");
  if (at == std::string::npos) return {};
  const std::size_t begin = at + format.size() + 2;
  std::string words = all.substr(begin, all.find(';', begin) - begin);
  if (words.compare(0, 6, "libraw") == 0) words.replace(0, 6, "LibRaw");
  return words;
}

std::string encode(const std::string& file_name, const std::string& name, const PictureLayout& layout,
                   PixelType type, const CodecSettings& settings, const void* pixels) {
  std::string problem;
  std::string bytes =
      module_functions<OpenImageIo>().encode(file_name, layout, type, settings, pixels, problem);
  if (!problem.empty())
    throw failure(ErrorKind::unwritable_output, name, with_name(problem, file_name, name));
  return bytes;
}

std::string image_library_version() {
  return std::to_string(OIIO_VERSION_MAJOR) + "." + std::to_string(OIIO_VERSION_MINOR) + "." +
         std::to_string(OIIO_VERSION_PATCH);
}

MemoryFile::MemoryFile(std::string_view bytes, const std::string& name)
    : descriptor_(::memfd_create("image", MFD_CLOEXEC)) {
  while (descriptor_ >= 0 && !bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) break;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  if (descriptor_ >= 0 && bytes.empty()) return;
  if (descriptor_ >= 0) ::close(descriptor_);
  throw failure(ErrorKind::unreadable_input, name, "there is not enough memory for this file");
}

MemoryFile::~MemoryFile() { ::close(descriptor_); }

std::string MemoryFile::path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

std::string exif_time(std::string time) {
  if (time.empty()) return unknown_time;
  if (time.size() >= 19 && time[4] == '-' && time[7] == '-' && (time[10] == 'T' || time[10] == ' ')) {
    time.resize(19);
    time[4] = time[7] = ':';
    time[10] = ' ';
  }
  return time;
}

std::string value_or_empty(const ImageAttributes& attributes, const std::string& key) {
  const auto found = attributes.find(key);
  return found == attributes.end() ? std::string() : found->second;
}

std::string description_of(const ImageAttributes& attributes) {
  std::string text = value_or_empty(attributes, "ImageDescription");
  for (const auto& [key, value] : attributes) {
    if (key == "DateTime" || key == "ImageDescription" || value.empty()) continue;
    if (!text.empty()) text += '\n';
    text += key;
    text += '=';
    text += value;
  }
  return text;
}

}  // namespace vegard::sim
