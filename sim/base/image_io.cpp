#include "sim/base/image_io.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cassert>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string_view>
#include <utility>

#include "sim/base/error.h"
#include "sim/base/whole_file.h"
#include "sim/base/whole_picture.h"

namespace vegard::sim {
namespace {

/// EXIF's way to say that the time is unknown. Without a DateTime OpenImageIO stamps the clock's into EXR and
/// TIFF.
const char* const unknown_time = "    :  :     :  :  ";
const char* const own_prefix = "vegard:";
/// libjpeg ends the whole process with "Bogus marker length" above 65 533 bytes; EXIF shares them with other
/// entries.
constexpr std::size_t jpeg_description_limit = 30000;
/// libjpeg ends the process here too.
constexpr int jpeg_size_limit = 65500;
constexpr std::uint64_t largest_value_count = std::uint64_t{1} << 30;  // 4 GiB of floats

void configure_library() {
  static std::once_flag once;
  std::call_once(once, [] {
    OIIO::attribute("threads", 1);
    OIIO::attribute("exr_threads", -1);  // no pool: 0 and 1 both make one
  });
}

Error failure(ErrorKind kind, const std::string& name, std::string problem, std::string expected = {}) {
  ErrorDetails details;
  details.file = name;
  details.problem = std::move(problem);
  details.expected = std::move(expected);
  return Error(kind, details);
}

/// "2019-09-05T10:11:12Z" as EXIF has it; anything of another shape as it is.
std::string exif_time(std::string time) {
  if (time.empty()) return unknown_time;
  if (time.size() >= 19 && time[4] == '-' && time[7] == '-' && (time[10] == 'T' || time[10] == ' ')) {
    time.resize(19);
    time[4] = time[7] = ':';
    time[10] = ' ';
  }
  return time;
}

std::string value_or_empty(const ImageAttributes& attributes, const std::string& key) {
  const auto found = attributes.find(key);
  return found == attributes.end() ? std::string() : found->second;
}

/// All attributes but the time as lines of one text.
std::string description_of(const ImageAttributes& attributes) {
  std::string text = value_or_empty(attributes, "ImageDescription");
  for (const auto& [key, value] : attributes) {
    if (key == "DateTime" || key == "ImageDescription" || value.empty()) continue;
    if (!text.empty()) text += '\n';
    text += key;
    text += '=';
    text += value;
  }
  return text;
}

void describe_in_own_keys(OIIO::ImageSpec& spec, const ImageAttributes& attributes) {
  for (const auto& [key, value] : attributes) {
    if (key == "DateTime" || value.empty()) continue;
    spec.attribute(key == "ImageDescription" ? key : own_prefix + key, value);
  }
}

void describe_in_one_text(OIIO::ImageSpec& spec, const std::string& text) {
  // OpenImageIO 2.4 ends the process over an empty text in a JPEG: "encode_iptc_iim_one_tag: Assertion".
  if (!text.empty()) spec.attribute("ImageDescription", text);
}

bool decodes_to(const std::string& file_name, const std::vector<unsigned char>& bytes,
                const OIIO::ImageSpec& spec, const void* pixels) {
  OIIO::Filesystem::IOMemReader reader(bytes.data(), bytes.size());
  const auto input = OIIO::ImageInput::open(file_name, nullptr, &reader);
  if (!input) return false;
  const OIIO::ImageSpec& found = input->spec();
  if (found.width != spec.width || found.height != spec.height || found.nchannels != spec.nchannels)
    return false;
  std::vector<unsigned char> decoded(spec.image_bytes());
  return input->read_image(0, 0, 0, spec.nchannels, spec.format, decoded.data()) && !input->has_error() &&
         std::memcmp(decoded.data(), pixels, decoded.size()) == 0;
}

/// The whole file in memory. Encoders that write to a disk themselves do not all look at what their last,
/// buffered bytes came to; WholeFile does.
std::string encode(const std::string& file_name, const std::string& name, const OIIO::ImageSpec& spec,
                   const void* pixels) {
  configure_library();
  const auto output = OIIO::ImageOutput::create(file_name);
  if (!output) throw failure(ErrorKind::unwritable_output, name, "no encoder: " + OIIO::geterror());
  OIIO::Filesystem::IOVecOutput memory;
  const bool good = output->set_ioproxy(&memory) && output->open(file_name, spec) &&
                    output->write_image(spec.format, pixels) && output->close();
  // OpenImageIO 2.4 says "failed TIFFWriteCustomDirectory() of the Exif data" of every TIFF, sound as they
  // are, so that an error string beside success is put to the proof instead of being believed or ignored.
  const bool doubted = output->has_error();
  const std::string message = output->geterror();
  if (!good || (doubted && !decodes_to(file_name, memory.buffer(), spec, pixels))) {
    throw failure(ErrorKind::unwritable_output, name, "cannot be encoded: " + message);
  }
  return {memory.buffer().begin(), memory.buffer().end()};
}

template <typename Step>
std::vector<Step> quantised(const Image& encoded) {
  constexpr double largest = std::numeric_limits<Step>::max();
  std::vector<Step> steps(encoded.data.size());
  std::transform(encoded.data.begin(), encoded.data.end(), steps.begin(), [](float value) {
    if (!(value > 0.0f)) return Step{0};
    // Exact in double before the rounding: 24 bits times 16.
    return static_cast<Step>(std::floor(std::min(1.0, static_cast<double>(value)) * largest + 0.5));
  });
  return steps;
}

void check_display(ImageFormat format, const Image& encoded, int bits, int jpeg_quality,
                   const std::string& name) {
  const auto refuse = [&](const char* problem, const char* expected) {
    throw failure(ErrorKind::usage, name, problem, expected);
  };
  if (format == ImageFormat::exr) refuse("EXR is not a display format", ".png, .tif or .jpg");
  if (bits != 8 && bits != 16) refuse("no such number of bits per channel", "8 or 16");
  if (format == ImageFormat::jpeg) {
    if (bits != 8) refuse("JPEG cannot hold 16 bits per channel", "8, or .png or .tif");
    if (jpeg_quality < 1 || jpeg_quality > 100) refuse("no such JPEG quality", "1 to 100");
    if (encoded.width > jpeg_size_limit || encoded.height > jpeg_size_limit) {
      refuse("too large for a JPEG", "at most 65500 pixels a side");
    }
  }
}

void check_is_file(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored))
    throw failure(ErrorKind::unreadable_input, path, "there is no such file");
  if (!std::filesystem::is_regular_file(path, ignored))
    throw failure(ErrorKind::unreadable_input, path, "is not a file");
}

void check_size(const OIIO::ImageSpec& spec, const std::string& path) {
  const auto unreadable = [&](const std::string& problem) {
    return failure(ErrorKind::unreadable_input, path, problem);
  };
  if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1) throw unreadable("has no pixels");
  const std::uint64_t row_values =
      static_cast<std::uint64_t>(spec.width) * static_cast<std::uint64_t>(spec.nchannels);
  if (row_values > largest_value_count / static_cast<std::uint64_t>(spec.height)) {
    throw unreadable("says that it holds " + std::to_string(spec.width) + " x " +
                     std::to_string(spec.height) + " pixels, more than can be read");
  }
}

/// Where in the file's channels the picture's R, G, B or Y, and A are.
struct PictureChannels {
  std::vector<std::string> names;
  std::vector<int> of_file;
};

PictureChannels picture_channels(const OIIO::ImageSpec& spec, bool by_name, const std::string& path) {
  PictureChannels found;
  const auto take = [&](const char* name, int channel) {
    found.names.emplace_back(name);
    found.of_file.push_back(channel);
  };
  const auto named = [&](const char* name) {
    const auto at = std::find(spec.channelnames.begin(), spec.channelnames.end(), name);
    return at == spec.channelnames.end() ? -1 : static_cast<int>(at - spec.channelnames.begin());
  };
  int alpha = spec.alpha_channel;
  if (by_name) {
    alpha = named("A");
    if (named("R") >= 0 && named("G") >= 0 && named("B") >= 0) {
      for (const char* name : {"R", "G", "B"}) take(name, named(name));
    } else if (named("Y") >= 0) {
      take("Y", named("Y"));
    } else if (spec.nchannels == 1) {
      alpha = -1;
      take("Y", 0);
    } else {
      throw failure(ErrorKind::unreadable_input, path, "has no colour", "channels R, G, B or Y");
    }
  } else {
    std::vector<int> colours;
    for (int c = 0; c < spec.nchannels; ++c)
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
  std::ifstream file(path, std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(file), {});
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

ImageFormat image_format(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension == ".exr") return ImageFormat::exr;
  if (extension == ".png") return ImageFormat::png;
  if (extension == ".tif" || extension == ".tiff") return ImageFormat::tiff;
  if (extension == ".jpg" || extension == ".jpeg") return ImageFormat::jpeg;
  throw failure(ErrorKind::usage, path, "unknown image format '" + extension + "'",
                ".exr, .png, .tif or .jpg");
}

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
  describe_in_own_keys(spec, attributes);
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

ExrFile read_exr(const std::string& path) {
  configure_library();
  const auto unreadable = [&](const std::string& problem) {
    return failure(ErrorKind::unreadable_input, path, problem);
  };
  check_is_file(path);
  // By name, so that a picture in another format that happens to be called .exr is not read as something
  // else.
  const auto input = OIIO::ImageInput::create("openexr");
  OIIO::ImageSpec spec;
  if (!input || !input->open(path, spec)) {
    throw unreadable("cannot be read as EXR: " + (input ? input->geterror() : OIIO::geterror()));
  }
  if (spec.deep) throw unreadable("is a deep EXR, which has no single value per pixel");
  check_size(spec, path);

  ExrFile result;
  result.image = Image(spec.width, spec.height, spec.channelnames);
  // A file cut short may be read with "success" and an error string beside it.
  const bool complete =
      input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, result.image.data.data());
  if (!complete || input->has_error()) throw unreadable("is truncated or damaged: " + input->geterror());

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

PictureFile read_picture(const std::string& path) {
  configure_library();
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
  if (!is_whole(path, format)) throw unreadable("is truncated, damaged or not what its name says");
  const std::map<ImageFormat, std::string> decoders = {{ImageFormat::exr, "openexr"},
                                                       {ImageFormat::png, "png"},
                                                       {ImageFormat::tiff, "tiff"},
                                                       {ImageFormat::jpeg, "jpeg"}};
  // By name, as in read_exr().
  const auto input = OIIO::ImageInput::create(decoders.at(format));
  OIIO::ImageSpec spec, wish;
  wish.attribute("oiio:UnassociatedAlpha", 1);  // else integers are multiplied while sRGB-encoded
  if (!input || !input->open(path, spec, wish)) {
    throw unreadable("cannot be read as " + decoders.at(format) + ": " +
                     (input ? input->geterror() : OIIO::geterror()));
  }
  if (spec.deep) throw unreadable("is a deep EXR, which has no single value per pixel");
  check_size(spec, path);
  const PictureChannels channels = picture_channels(spec, format == ImageFormat::exr, path);

  std::vector<float> stored(static_cast<std::size_t>(spec.width) * spec.height * spec.nchannels);
  // A file cut short may be read with "success" and an error string beside it.
  const bool complete = input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, stored.data());
  if (!complete || input->has_error()) throw unreadable("is truncated or damaged: " + input->geterror());

  PictureFile file;
  file.floating = spec.format.is_floating_point();
  file.colour_times_alpha =
      channels.names.back() == "A" && spec.get_int_attribute("oiio:UnassociatedAlpha") == 0;
  const int orientation = spec.get_int_attribute("Orientation", 1);
  const bool turned = orientation >= 5 && orientation <= 8;
  file.image = Image(turned ? spec.height : spec.width, turned ? spec.width : spec.height, channels.names);
  for (int y = 0; y < file.image.height; ++y) {
    for (int x = 0; x < file.image.width; ++x) {
      const auto [from_x, from_y] = stored_place(orientation, x, y, spec.width, spec.height);
      const std::size_t from = (static_cast<std::size_t>(from_y) * spec.width + from_x) * spec.nchannels;
      for (int c = 0; c < file.image.channels(); ++c) {
        const float value = stored[from + channels.of_file[c]];
        if (!std::isfinite(value)) throw unreadable("holds values that are no finite numbers");
        file.image.at(x, y, c) = value;
      }
    }
  }
  return file;
}

std::string encode_display(ImageFormat format, const Image& encoded, int bits, int jpeg_quality,
                           const ImageAttributes& attributes, const std::string& name) {
  assert(!encoded.empty() && (encoded.channels() == 1 || encoded.channels() == 3));
  check_display(format, encoded, bits, jpeg_quality, name);

  OIIO::ImageSpec spec(encoded.width, encoded.height, encoded.channels(),
                       bits == 8 ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::UINT16);
  spec.attribute("DateTime", exif_time(value_or_empty(attributes, "DateTime")));
  std::string file_name;
  if (format == ImageFormat::png) {
    file_name = "image.png";
    spec.attribute("oiio:ColorSpace", "sRGB");
    describe_in_own_keys(spec, attributes);
  } else if (format == ImageFormat::tiff) {
    // No colour space here: OpenImageIO 2.4 makes EXIF data of it and then, writing to memory, a file that
    // none can read.
    file_name = "image.tif";
    spec.attribute("compression", "zip");
    describe_in_one_text(spec, description_of(attributes));
  } else {
    file_name = "image.jpg";
    spec.attribute("oiio:ColorSpace", "sRGB");
    spec.attribute("CompressionQuality", jpeg_quality);
    spec.attribute("jpeg:subsampling", "4:4:4");  // aurorae are thin coloured lines
    describe_in_one_text(spec, description_of(attributes).substr(0, jpeg_description_limit));
  }
  if (bits == 8) return encode(file_name, name, spec, quantised<std::uint8_t>(encoded).data());
  return encode(file_name, name, spec, quantised<std::uint16_t>(encoded).data());
}

void write_display(const std::string& path, const Image& encoded, int bits, int jpeg_quality,
                   const ImageAttributes& attributes, bool overwrite) {
  const ImageFormat format = image_format(path);
  check_display(format, encoded, bits, jpeg_quality, path);
  WholeFile file(path, overwrite);
  file.write(encode_display(format, encoded, bits, jpeg_quality, attributes, path));
  file.commit();
}

std::string image_library_version() {
  const int version = OIIO::openimageio_version();  // what runs, not what was compiled against
  return std::to_string(version / 10000) + "." + std::to_string(version / 100 % 100) + "." +
         std::to_string(version % 100);
}

}  // namespace vegard::sim
