#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <utility>
#include <vector>

#include "sim/base/error.h"
#include "sim/base/file/input_file.h"
#include "sim/base/module.h"
#include "sim/base/picture/image_io.h"
#include "sim/base/picture/image_io/library.h"
#include "sim/base/picture/whole_picture.h"
#include "sim/base/text.h"

namespace vegard::sim {

ImageFormat image_format(const std::string& path) {
  const std::string extension = lowered_extension(path);
  if (extension == ".exr") return ImageFormat::exr;
  if (extension == ".png") return ImageFormat::png;
  if (extension == ".tif" || extension == ".tiff") return ImageFormat::tiff;
  if (extension == ".jpg" || extension == ".jpeg") return ImageFormat::jpeg;
  throw failure(ErrorKind::usage, path, "unknown image format '" + extension + "'",
                ".exr, .png, .tif or .jpg");
}

namespace {

/// The indices of the picture's R, G, B or Y, and A among the file's channels.
struct PictureChannels {
  std::vector<std::string> names;
  std::vector<int> of_file;
};

PictureChannels picture_channels(const PictureLayout& layout, bool by_name, const std::string& path) {
  PictureChannels found;
  const auto take = [&](const char* name, int channel) {
    found.names.emplace_back(name);
    found.of_file.push_back(channel);
  };
  const auto named = [&](const char* name) {
    const auto at = std::find(layout.channel_names.begin(), layout.channel_names.end(), name);
    return at == layout.channel_names.end() ? -1 : static_cast<int>(at - layout.channel_names.begin());
  };
  int alpha = layout.alpha_channel;
  if (by_name) {
    alpha = named("A");
    if (named("R") >= 0 && named("G") >= 0 && named("B") >= 0) {
      for (const char* name : {"R", "G", "B"}) take(name, named(name));
    } else if (named("Y") >= 0) {
      take("Y", named("Y"));
    } else if (layout.channels == 1) {
      alpha = -1;
      take("Y", 0);
    } else {
      throw failure(ErrorKind::unreadable_input, path, "has no colour", "channels R, G, B or Y");
    }
  } else {
    std::vector<int> colours;
    for (int c = 0; c < layout.channels; ++c)
      if (c != alpha) colours.push_back(c);
    if (colours.empty()) throw failure(ErrorKind::unreadable_input, path, "has no colour");
    if (colours.size() < 3) {
      take("Y", colours[0]);
    } else {
      take("R", colours[0]);
      take("G", colours[1]);
      take("B", colours[2]);
    }
  }
  if (alpha >= 0) take("A", alpha);
  return found;
}

/// Only of the formats whose decoders do not say it themselves.
bool is_whole(const std::string& path, ImageFormat format) {
  if (format != ImageFormat::png && format != ImageFormat::jpeg) return true;
  const std::string bytes = input_bytes(path, "a picture", kMaxPictureBytes);
  return format == ImageFormat::png ? png_is_whole(bytes) : jpeg_is_whole(bytes);
}

/// EXIF 2.3, tag 274: the stored place of the pixel (x, y) of the upright picture.
std::pair<int, int> stored_place(int orientation, int x, int y, int stored_width, int stored_height) {
  if (orientation >= 5) std::swap(x, y);
  const bool right_to_left = orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8;
  const bool upwards = orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7;
  return {right_to_left ? stored_width - 1 - x : x, upwards ? stored_height - 1 - y : y};
}

}  // namespace

PictureFile read_picture(const std::string& path) {
  const auto unreadable = [&](const std::string& problem, const std::string& expected = {}) {
    return failure(ErrorKind::unreadable_input, path, problem, expected);
  };
  check_is_file(path);
  ImageFormat format{};
  try {
    format = image_format(path);
  } catch (const Error& error) {
    throw unreadable(error.details().problem, error.details().expected);
  }
  if (format == ImageFormat::exr) check_exr_file(path);
  if (!is_whole(path, format)) throw unreadable("is truncated, damaged or not what its name says");
  const std::map<ImageFormat, std::string> decoders = {{ImageFormat::exr, "EXR"},
                                                       {ImageFormat::png, "png"},
                                                       {ImageFormat::tiff, "tiff"},
                                                       {ImageFormat::jpeg, "jpeg"}};
  // By name, as in read_exr().
  const CodecSettings settings = {
      {"oiio:UnassociatedAlpha", 1}};  // else integers are multiplied while sRGB-encoded
  OpenProblem problem;
  const auto input = format == ImageFormat::exr ? open_exr(path, nullptr, problem)
                                                : module_functions<OpenImageIo>().open(
                                                      decoders.at(format), path, nullptr, settings, problem);
  if (!input) throw unreadable("cannot be read as " + decoders.at(format) + ": " + problem.words);
  PictureLayout layout = input->layout();
  if (layout.deep) throw unreadable("is a deep EXR, which has no single value per pixel");
  check_size(layout, path);
  const PictureChannels channels = picture_channels(layout, format == ImageFormat::exr, path);

  std::vector<float> stored(static_cast<std::size_t>(layout.width) * layout.height * layout.channels);
  if (!input->read(layout.channels, PixelType::float32, stored.data(), problem.words))
    throw unreadable("is truncated or damaged: " + problem.words);
  // Black, and transparent where there is an alpha, outside of the data window.
  if (format == ImageFormat::exr) stored = framed(std::move(stored), layout, 0.0f, path);

  PictureFile file;
  file.floating = layout.floating;
  file.colour_times_alpha = channels.names.back() == "A" && !layout.unassociated_alpha;
  const int orientation = layout.orientation;
  const bool turned = orientation >= 5 && orientation <= 8;
  file.image =
      Image(turned ? layout.height : layout.width, turned ? layout.width : layout.height, channels.names);
  for (int y = 0; y < file.image.height; ++y) {
    for (int x = 0; x < file.image.width; ++x) {
      const auto [from_x, from_y] = stored_place(orientation, x, y, layout.width, layout.height);
      const std::size_t from = (static_cast<std::size_t>(from_y) * layout.width + from_x) * layout.channels;
      for (int c = 0; c < file.image.channels(); ++c) {
        const float value = stored[from + channels.of_file[c]];
        if (!std::isfinite(value)) throw unreadable("holds values that are no finite numbers");
        file.image.at(x, y, c) = value;
      }
    }
  }
  return file;
}

}  // namespace vegard::sim
