#include "fit/photo/frames/frame_store.h"

#include "fit/photo/frames/array_frames.h"
#include "sim/base/array/array_format.h"
#include "sim/base/file/input_file.h"
#include "sim/base/file/tar_file.h"

namespace vegard::fit {
namespace {

constexpr std::size_t kBeginning = 1024;

struct StoreKind {
  bool (*is_kind)(std::string_view beginning);
  std::unique_ptr<FrameStore> (*open)(const std::string& name, std::string_view bytes);
};

constexpr StoreKind kStoreKinds[] = {
    {[](std::string_view beginning) {
       const sim::ArrayFormat* const format = sim::array_format(beginning);
       return format != nullptr && format->has_pictures;
     },
     [](const std::string& name, std::string_view bytes) {
       return array_frames(sim::open_array_file(name, bytes));
     }},
    {sim::is_tar, tar_frames},
};

const StoreKind* kind_of_beginning(std::string_view beginning) {
  for (const StoreKind& kind : kStoreKinds)
    if (kind.is_kind(beginning)) return &kind;
  return nullptr;
}

const StoreKind* kind_of_file(const std::string& file) {
  const sim::InputFile begun = sim::read_beginning(file, kBeginning);
  return begun.problem.empty() ? kind_of_beginning(begun.bytes) : nullptr;
}

}  // namespace

std::unique_ptr<FrameStore> frame_store(const std::string& name, std::string_view bytes) {
  const StoreKind* const kind = bytes.data() != nullptr ? kind_of_beginning(bytes) : kind_of_file(name);
  return kind == nullptr ? nullptr : kind->open(name, bytes);
}

bool has_frame_store(const std::string& file) { return kind_of_file(file) != nullptr; }

}  // namespace vegard::fit
