#include "sim/base/picture/coded_picture.h"
#include "sim/base/error.h"
#include "sim/base/picture/image_io/library.h"
#include "sim/base/picture/pixel_limit.h"

namespace vegard::sim {
namespace {

/// The settings that OpenImageIO 2.4 hands on to LibRaw and that change a number.
OIIO::ImageSpec settings() {
  OIIO::ImageSpec wish;
  wish.attribute("raw:ColorSpace", "raw");
  wish.attribute("raw:Demosaic", "linear");
  wish.attribute("raw:auto_bright", 0);
  wish.attribute("raw:use_camera_wb", 0);
  wish.attribute("raw:use_auto_wb", 0);
  wish.attribute("raw:use_camera_matrix", 0);
  const float gains[4] = {1.0f, 1.0f, 1.0f, 1.0f};
  wish.attribute("raw:user_mul", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 4), gains);
  wish.attribute("raw:adjust_maximum_thr", 0.0f);  // else the white level follows the brightest pixel
  wish.attribute("raw:HighlightMode", 0);
  wish.attribute("raw:fbdd_noiserd", 0);
  wish.attribute("raw:max_raw_memory_mb", 4096);
  return wish;
}

}  // namespace

CodedPicture read_camera_raw(std::string_view bytes, const std::string& name) {
  configure_library();
  const auto unreadable = [&](const std::string& problem) {
    return failure(ErrorKind::unreadable_input, name, problem, "a sound file of a camera that LibRaw knows");
  };
  const MemoryFile file(bytes, name);
  const auto input = OIIO::ImageInput::create("raw");
  if (!input) {
    OIIO::geterror();
    throw unreadable("camera raw files are not read by this build of OpenImageIO");
  }
  OIIO::ImageSpec spec;
  // The library's words name the file by which the bytes go, which helps nobody.
  if (!input->open(file.path(), spec, settings())) {
    input->geterror();
    throw unreadable("this camera raw file cannot be read");
  }
  check_pixel_limit(spec.width, spec.height, name);
  if (spec.nchannels != 3) throw unreadable("this camera raw file has no red, green and blue");
  CodedPicture picture;
  picture.width = spec.width;
  picture.height = spec.height;
  picture.bits = 16;
  picture.library = decoder_version("raw");
  try {
    picture.codes.resize(static_cast<std::size_t>(spec.width) * spec.height * 3);
  } catch (const std::bad_alloc&) {
    throw failure(ErrorKind::unreadable_input, name, "there is not enough memory for its pixels");
  }
  const bool good = input->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT16, picture.codes.data());
  if (!good || input->has_error()) {
    input->geterror();
    throw unreadable("this camera raw file is truncated or damaged");
  }
  return picture;
}

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
