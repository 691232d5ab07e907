#include "fit/photo/frames/open_frame_store.h"

#include "fit/photo/frames/array_frames.h"
#include "fit/photo/frames/tar_frames.h"
#include "sim/base/array/array_format.h"
#include "sim/base/file/input_file.h"
#include "sim/base/file/tar_file.h"

namespace vegard::fit {
namespace {

constexpr std::size_t kBeginning = 1024;

enum class StoreKind { none, arrays, tar };

StoreKind kind_of_beginning(std::string_view beginning) {
  const sim::ArrayFormat* const format = sim::array_format(beginning);
  if (format != nullptr && format->has_pictures) return StoreKind::arrays;
  return sim::is_tar(beginning) ? StoreKind::tar : StoreKind::none;
}

StoreKind kind_of_file(const std::string& file) {
  const sim::InputFile begun = sim::read_beginning(file, kBeginning);
  return begun.problem.empty() ? kind_of_beginning(begun.bytes) : StoreKind::none;
}

}  // namespace

std::unique_ptr<FrameStore> frame_store(const std::string& name, std::string_view bytes) {
  switch (bytes.data() != nullptr ? kind_of_beginning(bytes) : kind_of_file(name)) {
    case StoreKind::arrays:
      return array_frames(sim::open_array_file(name, bytes));
    case StoreKind::tar:
      return tar_frames(name, bytes);
    case StoreKind::none:
      break;
  }
  return nullptr;
}

bool has_frame_store(const std::string& file) { return kind_of_file(file) != StoreKind::none; }

}  // namespace vegard::fit
