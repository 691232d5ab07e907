#include "sim/base/picture/image_io/library.h"

#include <OpenImageIO/filesystem.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <mutex>
#include <utility>
#include <vector>

#include "sim/base/error.h"
#include "sim/base/file/input_file.h"
#include "sim/base/picture/image_io.h"
#include "sim/base/picture/pixel_limit.h"

namespace vegard::sim {
namespace {

constexpr std::uint64_t largest_value_count = std::uint64_t{1} << 30;  // 4 GiB of floats

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

}  // namespace

void configure_library() {
  static std::once_flag once;
  std::call_once(once, [] {
    OIIO::attribute("threads", 1);
    OIIO::attribute("exr_threads", -1);  // no pool: 0 and 1 both make one
  });
}

std::string with_name(std::string words, const std::string& stand_in, const std::string& name) {
  for (std::size_t at = words.find(stand_in); at != std::string::npos;
       at = words.find(stand_in, at + name.size()))
    words.replace(at, stand_in.size(), name);
  return words;
}

Error failure(ErrorKind kind, const std::string& name, std::string problem, std::string expected) {
  return Error(kind, std::move(problem)).file(name).expected(std::move(expected));
}

void check_is_file(const std::string& path) {
  if (const std::string problem = why_no_input(path); !problem.empty())
    throw failure(ErrorKind::unreadable_input, path, problem);
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
  check_pixel_limit(spec.width, spec.height, path);
}

std::string decoder_version(const std::string& format) {
  // "openexr:OpenEXR 3.1.5;raw:libraw 0.20.2-Release;..."
  const std::string all = ";" + std::string(OIIO::get_string_attribute("library_list"));
  const std::size_t at = all.find(";" + format + ":");
  if (at == std::string::npos) return {};
  const std::size_t begin = at + format.size() + 2;
  std::string words = all.substr(begin, all.find(';', begin) - begin);
  if (words.compare(0, 6, "libraw") == 0) words.replace(0, 6, "LibRaw");
  return words;
}

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
    throw failure(ErrorKind::unwritable_output, name,
                  "cannot be encoded: " + with_name(message, file_name, name));
  }
  return {memory.buffer().begin(), memory.buffer().end()};
}

std::string image_library_version() {
  const int version = OIIO::openimageio_version();  // what runs, not what was compiled against
  return std::to_string(version / 10000) + "." + std::to_string(version / 100 % 100) + "." +
         std::to_string(version % 100);
}

MemoryFile::MemoryFile(std::string_view bytes, const std::string& name)
    : descriptor_(::memfd_create("image", MFD_CLOEXEC)) {
  while (descriptor_ >= 0 && !bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) break;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  if (descriptor_ >= 0 && bytes.empty()) return;
  if (descriptor_ >= 0) ::close(descriptor_);
  throw failure(ErrorKind::unreadable_input, name, "there is not enough memory for this file");
}

MemoryFile::~MemoryFile() { ::close(descriptor_); }

std::string MemoryFile::path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

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

}  // namespace vegard::sim
