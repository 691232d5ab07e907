#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStdIO.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfTestFile.h>
#include <strings.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <exception>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <tuple>

#include "sim/base/module.h"
#include "sim/base/picture/image_io/picture_codecs.h"

namespace vegard::sim {
namespace {

constexpr int kNoThreads = 0;  // but the one that calls

class BytesToRead : public Imf::IStream {
 public:
  BytesToRead(std::string_view bytes, const std::string& name) : IStream(name.c_str()), bytes_(bytes) {}

  bool read(char to[], int count) override {
    if (static_cast<std::size_t>(count) > bytes_.size() - at_)
      throw std::runtime_error("the file ends within its data");
    std::memcpy(to, bytes_.data() + at_, static_cast<std::size_t>(count));
    at_ += static_cast<std::size_t>(count);
    return at_ < bytes_.size();
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t at) override { at_ = std::min<std::uint64_t>(at, bytes_.size()); }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
};

class BytesToWrite : public Imf::OStream {
 public:
  BytesToWrite() : OStream("image.exr") {}

  void write(const char from[], int count) override {
    const std::size_t end = at_ + static_cast<std::size_t>(count);
    if (end > bytes.size()) bytes.resize(end);
    std::memcpy(bytes.data() + at_, from, static_cast<std::size_t>(count));
    at_ = end;
  }
  std::uint64_t tellp() override { return at_; }
  void seekp(std::uint64_t at) override { at_ = static_cast<std::size_t>(at); }

  std::string bytes;

 private:
  std::size_t at_ = 0;
};

/// The place of a channel in the order that OpenImageIO has: by layer, the colours of each first, then by
/// name.
std::tuple<std::string, std::size_t, std::string> place_of(const std::string& channel) {
  static constexpr const char* kFirst[] = {"R",    "Red",  "G",  "Green", "B",     "Blue", "Y",
                                           "real", "imag", "A",  "Alpha", "AR",    "RA",   "AG",
                                           "GA",   "AB",   "BA", "Z",     "Depth", "Zback"};
  const std::size_t dot = channel.rfind('.');
  const std::string layer = dot == std::string::npos ? "" : channel.substr(0, dot + 1),
                    name = dot == std::string::npos ? channel : channel.substr(dot + 1);
  const auto first = std::find_if(std::begin(kFirst), std::end(kFirst),
                                  [&](const char* one) { return strcasecmp(one, name.c_str()) == 0; });
  return {layer, static_cast<std::size_t>(first - std::begin(kFirst)), name};
}

bool is_plain(const Imf::ChannelList& channels) {
  for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
    const Imf::Channel& one = channel.channel();
    if (one.type == Imf::UINT || one.xSampling != 1 || one.ySampling != 1) return false;
  }
  return true;
}

class Decoder : public PictureDecoder {
 public:
  /// False if it cannot be opened.
  bool open(const std::string& path, const std::string_view* bytes, OpenProblem& problem) {
    if (bytes != nullptr)
      stream_ = std::make_unique<BytesToRead>(*bytes, path);
    else
      stream_ = std::make_unique<Imf::StdIFStream>(path.c_str());
    bool is_tiled = false, is_deep = false, has_parts = false;
    if (!Imf::isOpenExrFile(*stream_, is_tiled, is_deep, has_parts)) {
      problem = {false, "it does not begin as an EXR"};
      return false;
    }
    problem.no_decoder = is_deep || has_parts;
    if (problem.no_decoder) return false;
    input_.emplace(*stream_, kNoThreads);
    problem.no_decoder = !is_plain(input_->header().channels());
    if (problem.no_decoder) return false;
    describe(input_->header());
    return true;
  }

  const PictureLayout& layout() const override { return layout_; }

  bool read(int channels, PixelType type, void* to, std::string& problem) override {
    if (type != PixelType::float32) {
      problem = "an EXR is read as floats";
      return false;
    }
    const std::size_t pixel = static_cast<std::size_t>(channels) * sizeof(float);
    const Imath::Box2i window = input_->header().dataWindow();
    try {
      Imf::FrameBuffer frame;
      for (int c = 0; c < channels; ++c)
        frame.insert(layout_.channel_names[static_cast<std::size_t>(c)],
                     Imf::Slice::Make(Imf::FLOAT, static_cast<float*>(to) + c, window, pixel,
                                      pixel * static_cast<std::size_t>(layout_.width)));
      input_->setFrameBuffer(frame);
      input_->readPixels(window.min.y, window.max.y);
    } catch (const std::exception& error) {
      problem = error.what();
      return false;
    }
    return true;
  }

 private:
  void describe(const Imf::Header& header) {
    const Imath::Box2i data = header.dataWindow(), frame = header.displayWindow();
    layout_.x = data.min.x;
    layout_.y = data.min.y;
    layout_.width = data.max.x - data.min.x + 1;
    layout_.height = data.max.y - data.min.y + 1;
    layout_.full_x = frame.min.x;
    layout_.full_y = frame.min.y;
    layout_.full_width = frame.max.x - frame.min.x + 1;
    layout_.full_height = frame.max.y - frame.min.y + 1;
    layout_.floating = true;
    for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel)
      layout_.channel_names.emplace_back(channel.name());
    layout_.channels = static_cast<int>(layout_.channel_names.size());
    std::sort(layout_.channel_names.begin(), layout_.channel_names.end(),
              [](const std::string& a, const std::string& b) { return place_of(a) < place_of(b); });
    for (auto attribute = header.begin(); attribute != header.end(); ++attribute) {
      const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute.attribute());
      if (text == nullptr) continue;
      std::string name = attribute.name();
      if (name == "capDate") name = "DateTime";
      if (name == "comments") name = "ImageDescription";
      layout_.texts.emplace_back(std::move(name), text->value());
    }
  }

  std::unique_ptr<Imf::IStream> stream_;
  std::optional<Imf::InputFile> input_;  // after the stream from which it reads
  PictureLayout layout_;
};

std::unique_ptr<PictureDecoder> open(const std::string& path, const std::string_view* bytes,
                                     OpenProblem& problem) {
  auto decoder = std::make_unique<Decoder>();
  try {
    if (decoder->open(path, bytes, problem)) return decoder;
  } catch (const std::exception& error) {
    problem = {false, error.what()};
  }
  return nullptr;
}

std::string encode(const PictureLayout& layout, const CodecSettings& settings, const float* pixels,
                   std::string& problem) {
  BytesToWrite file;
  try {
    Imf::Header header(layout.width, layout.height);
    for (const auto& [name, value] : settings) {
      if (const auto* number = std::get_if<float>(&value)) header.insert(name, Imf::FloatAttribute(*number));
      if (const auto* text = std::get_if<std::string>(&value))
        header.insert(name, Imf::StringAttribute(*text));
    }
    const std::size_t pixel = static_cast<std::size_t>(layout.channels) * sizeof(float);
    Imf::FrameBuffer frame;
    for (int c = 0; c < layout.channels; ++c) {
      const std::string& name = layout.channel_names[static_cast<std::size_t>(c)];
      header.channels().insert(name, Imf::Channel(Imf::FLOAT));
      frame.insert(name, Imf::Slice::Make(Imf::FLOAT, pixels + c, header.dataWindow(), pixel,
                                          pixel * static_cast<std::size_t>(layout.width)));
    }
    Imf::OutputFile output(file, header, kNoThreads);
    output.setFrameBuffer(frame);
    output.writePixels(layout.height);
  } catch (const std::exception& error) {
    problem = error.what();
    return {};
  }
  return std::move(file.bytes);
}

constexpr OpenExr functions{open, encode};

}  // namespace
}  // namespace vegard::sim

VEGARD_MODULE(&vegard::sim::functions);
