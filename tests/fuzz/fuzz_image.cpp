// Any bytes as a photograph, or as a file of frames: what the file says of itself, its metadata, its pixels;
// as a table of FITS; and, where they begin as such files do, as a map of angles and a picture that a scene
// names.
#include <cmath>
#include <string_view>
#include <utility>

#include "fit/photo/codec/picture_format.h"
#include "fit/photo/direction_map_file.h"
#include "fit/photo/frames/frame_file.h"
#include "fit/photo/photo.h"
#include "fit/photo/photo_defaults.h"
#include "fit/photo/photo_metadata.h"
#include "sim/base/error.h"
#include "sim/base/picture/fits_io.h"
#include "sim/base/picture/image_io.h"
#include "sim/base/picture/picture_metadata.h"
#include "tests/fuzz/input_file.h"
#include "tests/fuzz/promise.h"
#include "tests/fuzz/target.h"

namespace {

using namespace vegard;
using tests::require;

template <typename Use>
void refused_or(const Use& use) {
  try {
    use();
  } catch (const sim::Error& error) {
    require(error.kind() == sim::ErrorKind::unreadable_input);
    require(!error.details().problem.empty() && error.details().file.rfind("folder/it", 0) == 0);
  }
}

void read_as(std::string_view bytes, const fit::Decoding& decoding) {
  const fit::Photo photo = fit::read_photo_bytes(bytes, "folder/it", decoding);
  const std::size_t pixels = static_cast<std::size_t>(photo.linear.width) * photo.linear.height;
  require(pixels > 0 && photo.linear.data.size() == 3 * pixels && photo.usable.size() == 3 * pixels);
  for (const float value : photo.linear.data) require(std::isfinite(value));
  require(std::isfinite(fit::file_step(photo)) && fit::file_step(photo) >= 0.0);
  require(std::isfinite(fit::code_step(photo, 0.5)));
}

/// Some of the frames as photographs, all of them passed through.
void read_frames(std::string_view bytes) {
  constexpr int kMaxTaken = 3;
  fit::FrameReader reader(bytes, "folder/it");
  std::uint64_t end = 0;
  while (reader.next()) {
    const fit::FrameHead& head = reader.head();
    require(head.offset == end && head.bytes > 0 && head.width_px > 0 && head.height_px > 0);
    end = head.offset + head.bytes;
    if (head.number >= kMaxTaken) continue;
    const sim::PictureMetadata metadata =
        fit::frame_metadata(head, reader.words(), "20140310_0603_gill_themis19_full.pgm.gz");
    require(metadata.width_px == head.width_px);
    fit::with_photo_defaults({}, metadata);
    const std::string frame = reader.take();
    require(frame.size() == head.bytes);
    const fit::Photo photo = fit::read_photo_bytes(frame, "folder/it", fit::Decoding::automatic);
    require(photo.linear.width == head.width_px && photo.linear.height == head.height_px);
  }
}

/// In blocks of about two by three pixels, as a fit reads large photographs.
void read_averaged(std::string_view bytes) {
  const fit::ImageFile image = fit::inspect_image_file(bytes, "folder/it");
  if (image.width < 2 || image.height < 3) return;
  sim::PictureSize from{static_cast<int>(image.width), static_cast<int>(image.height)};
  if (image.orientation >= 5) std::swap(from.width, from.height);
  const fit::Averaging averaging{from, {(from.width + 1) / 2, (from.height + 2) / 3}};
  const fit::Photo photo =
      fit::read_photo_bytes(bytes, "folder/it", fit::Decoding::automatic, nullptr, averaging);
  require(photo.usable.size() == photo.linear.data.size());
  for (const float value : photo.linear.data) require(std::isfinite(value));
}

/// An ending under which the bytes are read as angles; empty for formats that hold none.
const char* ending_of_angles(std::string_view bytes) {
  if (bytes.substr(0, 6) == "SIMPLE") return ".fits";
  if (bytes.substr(0, 4) == "\x76\x2f\x31\x01") return ".exr";
  const std::string_view order = bytes.substr(0, 2);
  return order == "II" || order == "MM" ? ".tif" : "";
}

void read_as_file(std::string_view bytes) {
  const std::string ending = ending_of_angles(bytes);
  if (ending.empty()) return;
  const tests::InputFile file(bytes, "it" + ending);
  const std::string path = file.path("it" + ending);
  tests::read_or_refused([&] {
    const sim::DirectionMap map = fit::read_direction_map(path, path);
    require(map.width > 0 && map.azimuth_deg.size() == map.elevation_deg.size());
  });
  if (ending != ".fits")
    tests::read_or_refused([&] {
      const sim::PictureFile picture = sim::read_picture(path);
      require(picture.image.data.size() ==
              picture.image.channel_names.size() * picture.image.width * picture.image.height);
    });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  sim::taken_utc(sim::picture_metadata_of(bytes));  // never throws
  refused_or([&] { fit::inspect_image_file(bytes, "folder/it"); });
  refused_or([&] { sim::read_fits_table(bytes, "folder/it"); });
  refused_or([&] { read_as(bytes, fit::Decoding::automatic); });
  refused_or([&] { read_averaged(bytes); });
  refused_or([&] { read_frames(bytes); });
  read_as_file(bytes);
  return 0;
}
