#include "fit/photo/photo_metadata.h"

#include <filesystem>

#include "fit/photo/frames/imager_words.h"
#include "fit/photo/taken_time.h"
#include "sim/base/utc_time.h"

namespace vegard::fit {
namespace {

/// The time of a name that says its zone, where nothing else tells the time in UTC.
void add_zoned_name(const std::string& file_name, sim::PictureMetadata& metadata) {
  const std::optional<sim::TimeInName> name = sim::time_in_name(file_name);
  if (!name || !name->offset_minutes || !taken_time(metadata).utc.empty()) return;
  metadata.header_time_utc = sim::utc_text(name->utc_s());
  metadata.sources.header_time = "the file's name";
}

void compare_with_name(const std::string& file, sim::PictureMetadata& metadata) {
  const std::string name = std::filesystem::path(file).filename().string();
  add_imager_name(name, metadata);
  add_zoned_name(name, metadata);
  const std::string contradiction =
      imager_name(name) ? contradicted_time(name, metadata) : contradicted_by_name(name, metadata);
  if (!contradiction.empty()) metadata.contradictions.push_back(contradiction);
}

}  // namespace

sim::PictureMetadata photo_metadata(const std::string& name) {
  const FrameName wanted = frame_name(name);
  if (wanted.is_chosen() || is_frame_file(wanted.file)) {
    const PictureBytes picture = read_picture_bytes(name);
    return frame_metadata(*picture.frame, picture.words, wanted.file);
  }
  sim::PictureMetadata metadata = sim::read_picture_metadata(wanted.file);
  if (const std::string begun = beginning_of_packed_fits(wanted.file); !begun.empty())
    metadata = sim::picture_metadata_of(begun);
  compare_with_name(wanted.file, metadata);
  return metadata;
}

sim::PictureMetadata frame_metadata(const FrameHead& head, const ImagerWords& words,
                                    const std::string& file) {
  sim::PictureMetadata metadata = imager_metadata(words, head.width_px, head.height_px, head.word_kind);
  if (!metadata.header_time_utc && head.time) {
    metadata.header_time_utc = head.time->utc;
    metadata.sources.header_time = head.time->source;
  }
  if (!head.stream.clock.empty()) {
    metadata.taken_local = head.stream.clock;
    metadata.sources.clock = head.stream.clock_source;
  }
  // The name of a film tells when its first frame was taken.
  if (head.stream.seconds.value_or(0.0) > 0.0) return metadata;
  compare_with_name(file, metadata);
  return metadata;
}

}  // namespace vegard::fit
