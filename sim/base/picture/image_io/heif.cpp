#include "sim/base/error.h"
#include "sim/base/picture/coded_picture.h"

#include "sim/base/picture/image_io/library.h"
#include "sim/base/picture/pixel_limit.h"

namespace vegard::sim {

CodedPicture read_heif(std::string_view bytes, const std::string& name) {
  configure_library();
  const auto unreadable = [&](const std::string& problem) {
    return failure(ErrorKind::unreadable_input, name, problem, "a sound HEIC or HEIF picture");
  };
  const MemoryFile file(bytes, name);
  const auto input = OIIO::ImageInput::create("heif");
  if (!input) {
    OIIO::geterror();
    throw unreadable("HEIC is not read by this build of OpenImageIO");
  }
  OIIO::ImageSpec spec;
  // The library's words name the file by which the bytes go, which helps nobody.
  if (!input->open(file.path(), spec)) {
    input->geterror();
    throw unreadable("this HEIC picture cannot be decoded");
  }
  check_pixel_limit(spec.width, spec.height, name);
  if (spec.nchannels < 3) throw unreadable("this HEIC picture has no red, green and blue");
  CodedPicture picture;
  picture.width = spec.width;
  picture.height = spec.height;
  picture.library = decoder_version("heif");
  std::vector<std::uint8_t> read;
  try {
    read.resize(static_cast<std::size_t>(spec.width) * spec.height * spec.nchannels);
    picture.codes.resize(static_cast<std::size_t>(spec.width) * spec.height * 3);
  } catch (const std::bad_alloc&) {
    throw failure(ErrorKind::unreadable_input, name, "there is not enough memory for its pixels");
  }
  const bool good = input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT8, read.data());
  if (!good || input->has_error()) {
    input->geterror();
    throw unreadable("this HEIC picture is truncated or damaged");
  }
  for (std::size_t pixel = 0; pixel < picture.codes.size() / 3; ++pixel)
    for (int c = 0; c < 3; ++c) picture.codes[3 * pixel + c] = read[pixel * spec.nchannels + c];
  return picture;
}

}  // namespace vegard::sim
