#include "sim/base/picture/coded_picture.h"
#include "sim/base/error.h"
#include "sim/base/module.h"
#include "sim/base/picture/image_io/library.h"
#include "sim/base/picture/pixel_limit.h"

namespace vegard::sim {
namespace {

/// The settings that OpenImageIO 2.4 hands on to LibRaw and that change a number.
CodecSettings settings() {
  return {{"raw:ColorSpace", std::string("raw")},
          {"raw:Demosaic", std::string("linear")},
          {"raw:auto_bright", 0},
          {"raw:use_camera_wb", 0},
          {"raw:use_auto_wb", 0},
          {"raw:use_camera_matrix", 0},
          {"raw:user_mul", std::array<float, 4>{1.0f, 1.0f, 1.0f, 1.0f}},
          {"raw:adjust_maximum_thr", 0.0f},  // else the white level follows the brightest pixel
          {"raw:HighlightMode", 0},
          {"raw:fbdd_noiserd", 0},
          {"raw:max_raw_memory_mb", 4096}};
}

}  // namespace

CodedPicture read_camera_raw(std::string_view bytes, const std::string& name) {
  const auto unreadable = [&](const std::string& problem) {
    return failure(ErrorKind::unreadable_input, name, problem, "a sound file of a camera that LibRaw knows");
  };
  const MemoryFile file(bytes, name);
  OpenProblem problem;
  const auto input = module_functions<OpenImageIo>().open("raw", file.path(), nullptr, settings(), problem);
  // The library's words name the file by which the bytes go, which helps nobody.
  if (!input)
    throw unreadable(problem.no_decoder ? "camera raw files are not read by this build of OpenImageIO"
                                        : "this camera raw file cannot be read");
  const PictureLayout& layout = input->layout();
  check_pixel_limit(layout.width, layout.height, name);
  if (layout.channels != 3) throw unreadable("this camera raw file has no red, green and blue");
  CodedPicture picture;
  picture.width = layout.width;
  picture.height = layout.height;
  picture.bits = 16;
  picture.library = decoder_version("raw");
  try {
    picture.codes.resize(static_cast<std::size_t>(layout.width) * layout.height * 3);
  } catch (const std::bad_alloc&) {
    throw failure(ErrorKind::unreadable_input, name, "there is not enough memory for its pixels");
  }
  if (!input->read(3, PixelType::uint16, picture.codes.data(), problem.words))
    throw unreadable("this camera raw file is truncated or damaged");
  return picture;
}

CodedPicture read_heif(std::string_view bytes, const std::string& name) {
  const auto unreadable = [&](const std::string& problem) {
    return failure(ErrorKind::unreadable_input, name, problem, "a sound HEIC or HEIF picture");
  };
  const MemoryFile file(bytes, name);
  OpenProblem problem;
  const auto input = module_functions<OpenImageIo>().open("heif", file.path(), nullptr, {}, problem);
  // The library's words name the file by which the bytes go, which helps nobody.
  if (!input)
    throw unreadable(problem.no_decoder ? "HEIC is not read by this build of OpenImageIO"
                                        : "this HEIC picture cannot be decoded");
  const PictureLayout& layout = input->layout();
  check_pixel_limit(layout.width, layout.height, name);
  if (layout.channels < 3) throw unreadable("this HEIC picture has no red, green and blue");
  CodedPicture picture;
  picture.width = layout.width;
  picture.height = layout.height;
  picture.library = decoder_version("heif");
  std::vector<std::uint8_t> read;
  try {
    read.resize(static_cast<std::size_t>(layout.width) * layout.height * layout.channels);
    picture.codes.resize(static_cast<std::size_t>(layout.width) * layout.height * 3);
  } catch (const std::bad_alloc&) {
    throw failure(ErrorKind::unreadable_input, name, "there is not enough memory for its pixels");
  }
  if (!input->read(layout.channels, PixelType::uint8, read.data(), problem.words))
    throw unreadable("this HEIC picture is truncated or damaged");
  for (std::size_t pixel = 0; pixel < picture.codes.size() / 3; ++pixel)
    for (int c = 0; c < 3; ++c) picture.codes[3 * pixel + c] = read[pixel * layout.channels + c];
  return picture;
}

}  // namespace vegard::sim
