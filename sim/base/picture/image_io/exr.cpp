#include <OpenImageIO/filesystem.h>

#include <algorithm>
#include <cassert>
#include <filesystem>
#include <set>
#include <string_view>
#include <system_error>
#include <vector>

#include "sim/base/error.h"
#include "sim/base/file/input_file.h"
#include "sim/base/file/whole_file.h"
#include "sim/base/picture/image_io.h"
#include "sim/base/picture/image_io/library.h"
#include "sim/base/picture/whole_picture.h"

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

  OIIO::ImageSpec spec(width, height, static_cast<int>(names.size()), OIIO::TypeDesc::FLOAT);
  spec.channelnames = names;
  spec.attribute("compression", "zip");
  spec.attribute("DateTime", exif_time(value_or_empty(attributes, "DateTime")));
  ImageAttributes own = attributes;
  // One of EXR's own: how many cd m^-2 a value of 1 in R, G and B is.
  if (const auto white = own.find("whiteLuminance"); white != own.end()) {
    spec.attribute("whiteLuminance", std::stof(white->second));
    own.erase(white);
  }
  describe_in_own_keys(spec, own);
  return encode("image.exr", name, spec, pixels);
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
ExrFile read(const std::string& path, OIIO::Filesystem::IOProxy* memory) {
  const auto unreadable = [&](const std::string& problem) {
    return failure(ErrorKind::unreadable_input, path, problem);
  };
  // By name, so that a picture in another format that happens to be called .exr is not read as something
  // else.
  const auto input = OIIO::ImageInput::create("openexr");
  OIIO::ImageSpec spec;
  const std::string stand_in = memory != nullptr ? "image.exr" : path;
  const auto words = [&](const std::string& text) { return with_name(text, stand_in, path); };
  const bool in_memory = input && memory != nullptr && input->set_ioproxy(memory);
  if (!input || (memory != nullptr && !in_memory) || !input->open(stand_in, spec)) {
    throw unreadable("cannot be read as EXR: " + words(input ? input->geterror() : OIIO::geterror()));
  }
  if (spec.deep) throw unreadable("is a deep EXR, which has no single value per pixel");
  check_size(spec, path);

  ExrFile result;
  result.image = Image(spec.width, spec.height, spec.channelnames);
  // A file cut short may be read with "success" and an error string beside it.
  const bool complete =
      input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, result.image.data.data());
  if (!complete || input->has_error())
    throw unreadable("is truncated or damaged: " + words(input->geterror()));

  const std::string_view prefix(own_prefix);
  for (const auto& attribute : spec.extra_attribs) {
    const std::string key = attribute.name().string();
    if (attribute.type() != OIIO::TypeDesc::STRING) continue;
    if (key.compare(0, prefix.size(), prefix) == 0) {
      result.attributes[key.substr(prefix.size())] = attribute.get_string();
    } else if (key == "ImageDescription" || (key == "DateTime" && attribute.get_string() != unknown_time)) {
      result.attributes[key] = attribute.get_string();
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
  configure_library();
  check_exr_file(path);
  return read(path, nullptr);
}

ExrFile read_exr_bytes(std::string_view bytes, const std::string& name) {
  configure_library();
  if (begins_as_exr(bytes)) check_exr_header(bytes, bytes.size(), name);
  OIIO::Filesystem::IOMemReader memory(bytes.data(), bytes.size());
  return read(name, &memory);
}

}  // namespace vegard::sim
