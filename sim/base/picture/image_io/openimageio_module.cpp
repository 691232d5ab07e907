#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cstring>
#include <optional>

#include "sim/base/module.h"
#include "sim/base/picture/image_io/picture_codecs.h"

namespace vegard::sim {
namespace {

OIIO::TypeDesc type_of(PixelType type) {
  switch (type) {
    case PixelType::uint8:
      return OIIO::TypeDesc::UINT8;
    case PixelType::uint16:
      return OIIO::TypeDesc::UINT16;
    case PixelType::float32:
      break;
  }
  return OIIO::TypeDesc::FLOAT;
}

void apply(const CodecSettings& settings, OIIO::ImageSpec& spec) {
  for (const auto& [name, value] : settings) {
    if (const auto* whole = std::get_if<int>(&value)) spec.attribute(name, *whole);
    if (const auto* number = std::get_if<float>(&value)) spec.attribute(name, *number);
    if (const auto* text = std::get_if<std::string>(&value)) spec.attribute(name, *text);
    if (const auto* four = std::get_if<std::array<float, 4>>(&value))
      spec.attribute(name, OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 4), four->data());
  }
}

class Decoder : public PictureDecoder {
 public:
  /// False if it cannot be opened.
  bool open(const std::string& format, const std::string& path, const std::string_view* bytes,
            const CodecSettings& settings, OpenProblem& problem) {
    input_ = OIIO::ImageInput::create(format);
    if (!input_) {
      problem = {true, OIIO::geterror()};
      return false;
    }
    OIIO::ImageSpec spec, wish;
    apply(settings, wish);
    bool good = true;
    if (bytes != nullptr) good = input_->set_ioproxy(&memory_.emplace(bytes->data(), bytes->size()));
    if (!good || !input_->open(path, spec, wish)) {
      problem = {false, input_->geterror()};
      return false;
    }
    describe(spec);
    return true;
  }

  const PictureLayout& layout() const override { return layout_; }

  bool read(int channels, PixelType type, void* to, std::string& problem) override {
    // A file cut short may be read with "success" and an error string beside it.
    const bool good = input_->read_image(0, 0, 0, channels, type_of(type), to) && !input_->has_error();
    if (!good) problem = input_->geterror();
    return good;
  }

 private:
  void describe(const OIIO::ImageSpec& spec) {
    layout_.x = spec.x;
    layout_.y = spec.y;
    layout_.width = spec.width;
    layout_.height = spec.height;
    layout_.full_x = spec.full_x;
    layout_.full_y = spec.full_y;
    layout_.full_width = spec.full_width;
    layout_.full_height = spec.full_height;
    layout_.channels = spec.nchannels;
    layout_.channel_names = spec.channelnames;
    layout_.alpha_channel = spec.alpha_channel;
    layout_.deep = spec.deep;
    layout_.floating = spec.format.is_floating_point();
    layout_.unassociated_alpha = spec.get_int_attribute("oiio:UnassociatedAlpha") != 0;
    layout_.orientation = spec.get_int_attribute("Orientation", 1);
    for (const auto& attribute : spec.extra_attribs)
      if (attribute.type() == OIIO::TypeDesc::STRING)
        layout_.texts.emplace_back(attribute.name().string(), attribute.get_string());
  }

  std::optional<OIIO::Filesystem::IOMemReader> memory_;
  std::unique_ptr<OIIO::ImageInput> input_;  // after the memory from which it reads
  PictureLayout layout_;
};

std::unique_ptr<PictureDecoder> open(const std::string& format, const std::string& path,
                                     const std::string_view* bytes, const CodecSettings& settings,
                                     OpenProblem& problem) {
  auto decoder = std::make_unique<Decoder>();
  if (!decoder->open(format, path, bytes, settings, problem)) return nullptr;
  return decoder;
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

std::string encode(const std::string& file_name, const PictureLayout& layout, PixelType type,
                   const CodecSettings& settings, const void* pixels, std::string& problem) {
  OIIO::ImageSpec spec(layout.width, layout.height, layout.channels, type_of(type));
  if (!layout.channel_names.empty()) spec.channelnames = layout.channel_names;
  apply(settings, spec);
  const auto output = OIIO::ImageOutput::create(file_name);
  if (!output) {
    problem = "no encoder: " + OIIO::geterror();
    return {};
  }
  OIIO::Filesystem::IOVecOutput memory;
  const bool good = output->set_ioproxy(&memory) && output->open(file_name, spec) &&
                    output->write_image(spec.format, pixels) && output->close();
  // OpenImageIO 2.4 says "failed TIFFWriteCustomDirectory() of the Exif data" of every TIFF, sound as they
  // are, so that an error string beside success is put to the proof instead of being believed or ignored.
  const bool doubted = output->has_error();
  const std::string message = output->geterror();
  if (!good || (doubted && !decodes_to(file_name, memory.buffer(), spec, pixels))) {
    problem = "cannot be encoded: " + message;
    return {};
  }
  return {memory.buffer().begin(), memory.buffer().end()};
}

std::string libraries() { return std::string(OIIO::get_string_attribute("library_list")); }

/// Called once, before any other use of the library.
const OpenImageIo* table() {
  // Without the library's own threads.
  OIIO::attribute("threads", 1);
  OIIO::attribute("exr_threads", -1);  // no pool: 0 and 1 both make one
  static const OpenImageIo functions{open, encode, libraries};
  return &functions;
}

}  // namespace
}  // namespace vegard::sim

VEGARD_MODULE(vegard::sim::table());
