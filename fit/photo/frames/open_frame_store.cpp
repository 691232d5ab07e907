#include "fit/photo/frames/frame_store.h"
#include "fit/photo/frames/store_kinds.h"

#include <filesystem>
#include <system_error>

#include "fit/photo/frames/array_frames.h"
#include "sim/base/array/array_format.h"
#include "sim/base/file/input_file.h"
#include "sim/base/file/tar_file.h"
#include "sim/base/text.h"

namespace vegard::fit {
namespace {

constexpr std::size_t kBeginning = 1024;

struct StoreKind {
  bool (*is_kind)(std::string_view beginning);
  std::unique_ptr<FrameStore> (*open)(const std::string& name, std::string_view bytes);
  /// Of a kind whose files may also be single pictures: are there frames in it? Null: in any.
  bool (*holds_frames)(const std::string& name, std::string_view bytes) = nullptr;
};

bool begins_as_tiff(std::string_view beginning) {
  using namespace std::string_view_literals;
  for (const std::string_view start : {"II\x2a\0"sv, "MM\0\x2a"sv, "II\x2b\0"sv, "MM\0\x2b"sv})
    if (sim::starts_with(beginning, start)) return true;
  return false;
}

constexpr StoreKind kStoreKinds[] = {
    {[](std::string_view beginning) {
       const sim::ArrayFormat* const format = sim::array_format(beginning);
       return format != nullptr && format->has_pictures;
     },
     [](const std::string& name, std::string_view bytes) {
       std::string array;
       const std::string path = bytes.data() != nullptr ? name : path_of_frames(name, &array);
       return array_frames(sim::open_array_file(path, bytes), array);
     }},
    {sim::is_tar, tar_frames},
    {begins_as_tiff, tiff_pages, holds_tiff_pages},
    {[](std::string_view beginning) { return sim::starts_with(beginning, "SIMPLE  ="); }, fits_images,
     holds_fits_images},
    {begins_as_video, video_frames},
};

const StoreKind* kind_of(std::string_view beginning, const std::string& name, std::string_view bytes) {
  for (const StoreKind& kind : kStoreKinds)
    if (kind.is_kind(beginning))
      return kind.holds_frames == nullptr || kind.holds_frames(name, bytes) ? &kind : nullptr;
  return nullptr;
}

const StoreKind* kind_of_file(const std::string& name) {
  const std::string path = path_of_frames(name);
  const sim::InputFile begun = sim::read_beginning(path, kBeginning);
  return begun.problem.empty() ? kind_of(begun.bytes, path, {}) : nullptr;
}

}  // namespace

std::unique_ptr<FrameStore> frame_store(const std::string& name, std::string_view bytes) {
  const StoreKind* const kind = bytes.data() != nullptr ? kind_of(bytes, name, bytes) : kind_of_file(name);
  return kind == nullptr ? nullptr : kind->open(name, bytes);
}

std::string path_of_frames(const std::string& name, std::string* array) {
  const std::size_t mark = name.rfind('#');
  std::error_code ignored;
  if (mark == std::string::npos || mark == 0 || mark + 1 == name.size() ||
      std::filesystem::exists(name, ignored))
    return name;
  const std::string path = name.substr(0, mark);
  const sim::ArrayFormat* const format =
      std::filesystem::is_regular_file(path, ignored) ? sim::array_format_of(path) : nullptr;
  if (format == nullptr || !format->has_pictures) return name;
  if (array != nullptr) *array = name.substr(mark + 1);
  return path;
}

bool has_frame_store(const std::string& file) { return kind_of_file(file) != nullptr; }

}  // namespace vegard::fit
