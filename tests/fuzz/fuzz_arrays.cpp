// Any bytes as a file of arrays (HDF5, MATLAB, CDF, IDL's saves), a tar or a film: what is in it, the frames
// and the skymap that it may hold. A target of its own, since every HDF5 and MATLAB file costs a process.
#include <string>
#include <string_view>

#include "fit/photo/frames/frame_file.h"
#include "fit/photo/frames/store_kinds.h"
#include "fit/photo/photo.h"
#include "fit/photo/photo_defaults.h"
#include "fit/photo/photo_metadata.h"
#include "fit/photo/sky_map_file.h"
#include "sim/base/array/array_format.h"
#include "sim/base/file/tar_file.h"
#include "tests/fuzz/input_file.h"
#include "tests/fuzz/promise.h"
#include "tests/fuzz/target.h"

namespace {

using namespace vegard;
using tests::require;

void read_arrays(std::string_view bytes) {
  const auto file = sim::open_array_file("it", bytes);
  constexpr std::uint64_t kMaxNumbers = 1 << 20;
  for (const sim::StoredArray& array : file->arrays()) {
    require(!array.name.empty() && array.dims.size() <= sim::kMaxArrayDims);
    if (array.count() > kMaxNumbers) continue;
    if (array.kind == sim::ArrayKind::text)
      require(file->read_texts(array).size() == array.count());
    else
      require(file->read(array).size() == array.count() * sim::size_of(array.kind));
  }
}

/// Some of the frames as photographs, all of them passed through.
void read_frames(std::string_view bytes) {
  constexpr int kMaxTaken = 2;
  fit::FrameReader reader(bytes, "it");
  while (reader.next()) {
    const fit::FrameHead& head = reader.head();
    require(head.width_px > 0 && head.height_px > 0);
    if (head.number >= kMaxTaken) continue;
    fit::with_photo_defaults({},
                             fit::frame_metadata(head, reader.words(), "thg_l1_asf_gill_2014031006_v01.cdf"));
    const fit::Photo photo = fit::read_photo_bytes(reader.take(), "it", fit::Decoding::automatic);
    require(photo.linear.width == head.width_px && photo.linear.height == head.height_px);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  if (sim::is_tar(bytes) || fit::begins_as_video(bytes)) {
    tests::read_or_refused([&] { read_frames(bytes); });
    return 0;
  }
  if (sim::array_format(bytes) == nullptr) return 0;
  tests::read_or_refused([&] { read_arrays(bytes); });
  tests::read_or_refused([&] { read_frames(bytes); });
  const tests::InputFile file(bytes, "it");
  tests::read_or_refused([&] {
    const fit::SkyMapFile read = fit::read_sky_map(file.path("it"));
    require(read.map.width > 0 && read.map.azimuth_deg.size() == read.map.elevation_deg.size());
  });
  return 0;
}
