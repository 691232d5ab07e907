#include <algorithm>
#include <cassert>
#include <filesystem>
#include <limits>
#include <set>
#include <string_view>
#include <system_error>
#include <vector>

#include "sim/base/error.h"
#include "sim/base/file/input_file.h"
#include "sim/base/file/whole_file.h"
#include "sim/base/module.h"
#include "sim/base/picture/image_io.h"
#include "sim/base/picture/image_io/library.h"
#include "sim/base/picture/whole_picture.h"
#include "sim/base/text.h"

namespace vegard::sim {

std::string encode_exr(const std::vector<const Image*>& images, const ImageAttributes& attributes,
                       const std::string& name) {
  assert(!images.empty() && !images.front()->empty());
  const int width = images.front()->width, height = images.front()->height;
  std::vector<std::string> names;
  for (const Image* image : images) {
    assert(image->width == width && image->height == height);
    names.insert(names.end(), image->channel_names.begin(), image->channel_names.end());
  }
  assert(std::set<std::string>(names.begin(), names.end()).size() == names.size());

  std::vector<float> joined;
  const float* pixels = images.front()->data.data();
  if (images.size() > 1) {
    joined.reserve(static_cast<std::size_t>(width) * height * names.size());
    for (std::size_t pixel = 0; pixel < static_cast<std::size_t>(width) * height; ++pixel) {
      for (const Image* image : images) {
        const auto first = image->data.begin() + static_cast<std::ptrdiff_t>(pixel * image->channels());
        joined.insert(joined.end(), first, first + image->channels());
      }
    }
    pixels = joined.data();
  }

  PictureLayout layout;
  layout.width = width;
  layout.height = height;
  layout.channels = static_cast<int>(names.size());
  layout.channel_names = names;
  CodecSettings settings = {{"capDate", exif_time(value_or_empty(attributes, "DateTime"))}};
  ImageAttributes own = attributes;
  // One of EXR's own: how many cd m^-2 a value of 1 in R, G and B is.
  if (const auto white = own.find("whiteLuminance"); white != own.end()) {
    settings.emplace_back("whiteLuminance", std::stof(white->second));
    own.erase(white);
  }
  // "comments", as "capDate", is a name of OpenEXR's own (its file layout, standard attributes).
  for (const auto& [key, value] : own)
    if (key != "DateTime" && !value.empty())
      settings.emplace_back(key == "ImageDescription" ? "comments" : own_prefix + key, value);
  std::string problem;
  std::string bytes = module_functions<OpenExr>().encode(layout, settings, pixels, problem);
  if (!problem.empty()) throw failure(ErrorKind::unwritable_output, name, "cannot be encoded: " + problem);
  return bytes;
}

void write_exr(const std::string& path, const std::vector<const Image*>& images,
               const ImageAttributes& attributes, bool overwrite) {
  if (image_format(path) != ImageFormat::exr) {
    throw failure(ErrorKind::usage, path, "linear images are written as EXR", ".exr");
  }
  WholeFile file(path, overwrite);
  file.write(encode_exr(images, attributes, path));
  file.commit();
}

void write_exr(const std::string& path, const Image& image, const ImageAttributes& attributes,
               bool overwrite) {
  write_exr(path, std::vector<const Image*>{&image}, attributes, overwrite);
}

namespace {

/// True if the first bytes are those of an EXR; for any other file the library says that it is none.
bool begins_as_exr(std::string_view bytes) { return bytes.substr(0, 4) == "\x76\x2f\x31\x01"; }

/// `memory`: the bytes, if they are not to be read from `path`.
ExrFile read(const std::string& path, const std::string_view* memory) {
  const auto unreadable = [&](const std::string& problem) {
    return failure(ErrorKind::unreadable_input, path, problem);
  };
  const std::string stand_in = memory != nullptr ? "image.exr" : path;
  const auto words = [&](const std::string& text) { return with_name(text, stand_in, path); };
  OpenProblem problem;
  const auto input = open_exr(stand_in, memory, problem);
  if (!input) throw unreadable("cannot be read as EXR: " + words(problem.words));
  PictureLayout layout = input->layout();
  if (layout.deep) throw unreadable("is a deep EXR, which has no single value per pixel");
  check_size(layout, path);

  ExrFile result;
  result.image = Image(layout.width, layout.height, layout.channel_names);
  if (!input->read(layout.channels, PixelType::float32, result.image.data.data(), problem.words))
    throw unreadable("is truncated or damaged: " + words(problem.words));
  // The frame is the display window ("Technical Introduction to OpenEXR"): NaN where there are no data.
  result.image.data =
      framed(std::move(result.image.data), layout, std::numeric_limits<float>::quiet_NaN(), path);
  result.image.width = layout.width;
  result.image.height = layout.height;

  const std::string_view prefix(own_prefix);
  for (const auto& [key, text] : layout.texts) {
    if (key.compare(0, prefix.size(), prefix) == 0) {
      result.attributes[key.substr(prefix.size())] = text;
    } else if (key == "ImageDescription" || (key == "DateTime" && text != unknown_time)) {
      result.attributes[key] = text;
    } else if (const std::string word = lowered(key); word == "unit" || word == "units" || word == "bunit") {
      // The one attribute of other programs that counts: in which unit the values are.
      result.attributes.emplace("declared unit", text);
    }
  }
  return result;
}

}  // namespace

void check_exr_file(const std::string& path) {
  check_is_file(path);
  const InputFile beginning = read_beginning(path, kMaxTextBytes);
  if (!beginning.problem.empty()) throw failure(ErrorKind::unreadable_input, path, beginning.problem);
  std::error_code gone;
  const std::uintmax_t size = std::filesystem::file_size(path, gone);
  if (gone) throw failure(ErrorKind::unreadable_input, path, gone.message());
  if (begins_as_exr(beginning.bytes)) check_exr_header(beginning.bytes, static_cast<std::size_t>(size), path);
}

ExrFile read_exr(const std::string& path) {
  check_exr_file(path);
  return read(path, nullptr);
}

ExrFile read_exr_bytes(std::string_view bytes, const std::string& name) {
  if (begins_as_exr(bytes)) check_exr_header(bytes, bytes.size(), name);
  return read(name, &bytes);
}

}  // namespace vegard::sim
