// Any bytes as a photograph: what the file says of itself, its metadata, its pixels; and as a table of FITS.
#include <cmath>
#include <cstdlib>
#include <string_view>

#include "fit/photo/codec/image_walk.h"
#include "fit/photo/photo.h"
#include "sim/base/error.h"
#include "sim/base/picture/fits_io.h"
#include "sim/base/picture/picture_metadata.h"

namespace {

using namespace vegard;

void require(bool promise) {
  if (!promise) std::abort();
}

template <typename Use>
void refused_or(const Use& use) {
  try {
    use();
  } catch (const sim::Error& error) {
    require(error.kind() == sim::ErrorKind::unreadable_input);
    require(!error.details().problem.empty() && error.details().file == "folder/it");
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

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  sim::taken_utc(sim::picture_metadata_of(bytes));  // never throws
  refused_or([&] { fit::inspect_image_file(bytes, "folder/it"); });
  refused_or([&] { sim::read_fits_table(bytes, "folder/it"); });
  refused_or([&] { read_as(bytes, fit::Decoding::automatic); });
  return 0;
}
