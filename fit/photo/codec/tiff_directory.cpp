#include "fit/photo/codec/tiff_directory.h"

namespace vegard::fit {

void check_strips_are_inside(const TiffDirectory& directory, std::size_t file_size, const std::string& file) {
  using namespace tiff_tag;
  const bool tiled = directory.values(kTileOffsets, 1).has_value();
  const auto offsets = directory.values(tiled ? kTileOffsets : kStripOffsets);
  const auto counts = directory.values(tiled ? kTileBytes : kStripBytes);
  if (!directory.inside()) throw_truncated(file, "the list of its TIFF strips lies beyond the end");
  if (!offsets || offsets->empty()) throw_damaged(file, "a TIFF without a picture in it");
  for (std::size_t i = 0; i < offsets->size(); ++i) {
    const std::uint64_t begin = (*offsets)[i];
    const std::uint64_t length = counts && i < counts->size() ? (*counts)[i] : 1;
    if (begin > file_size || length > file_size - begin)
      throw_truncated(file, "TIFF strip " + std::to_string(i + 1) + " of " + std::to_string(offsets->size()) +
                                " reaches beyond the end");
  }
}

}  // namespace vegard::fit
