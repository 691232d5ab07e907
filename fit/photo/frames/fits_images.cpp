#include <algorithm>
#include <cstdlib>
#include <utility>
#include <vector>

#include "fit/photo/frames/frame_store.h"
#include "fit/photo/frames/store_kinds.h"
#include "sim/base/file/byte_stream.h"
#include "sim/base/picture/fits_header.h"
#include "sim/base/picture/fits_time.h"
#include "sim/base/text.h"
#include "sim/base/utc_time.h"

// Images in several parts of one FITS file, of the size of the first: each is a frame, with the keywords of
// its own header and those of the first header that it lacks. Parts whose EXTNAME says that they hold the
// errors, the weights or the faulty pixels of another are none. A frame becomes a FITS file of its own.

namespace vegard::fit {
namespace fits_images_of {

std::string word_of(const sim::FitsPart& part, const std::string& key) {
  const auto found = part.words.find(key);
  return found == part.words.end() ? std::string() : found->second;
}

struct Size {
  long long width = 0, height = 0, planes = 1;
  bool operator==(const Size& other) const {
    return width == other.width && height == other.height && planes == other.planes;
  }
};

Size size_of(const sim::FitsPart& part) {
  const std::string axis = word_of(part, "ZIMAGE") == "T" ? "ZNAXIS" : "NAXIS";
  const auto length = [&](const char* number) {
    const std::string text = word_of(part, axis + number);
    return text.empty() ? 1LL : std::atoll(text.c_str());
  };
  return {length("1"), length("2"), length("3")};
}

bool is_beside_another(const sim::FitsPart& part) {
  const std::string name = sim::lowered(word_of(part, "EXTNAME"));
  for (const char* beside : {"err", "error", "errors", "dq", "mask", "weight", "wht", "var", "variance",
                             "uncert", "uncertainty", "bpm", "ivar", "sigma", "rms"})
    if (name == beside) return true;
  return false;
}

std::vector<sim::FitsPart> frames_of(const std::vector<sim::FitsPart>& parts) {
  std::vector<sim::FitsPart> frames;
  for (const sim::FitsPart& part : parts)
    if (part.is_image && !is_beside_another(part) &&
        (frames.empty() || size_of(part) == size_of(frames.front())))
      frames.push_back(part);
  return frames;
}

class FitsImages : public FrameStore {
 public:
  FitsImages(const std::string& name, std::string_view bytes)
      : file_(name, bytes), parts_(sim::fits_parts(file_)), frames_(frames_of(parts_)) {}

  std::size_t size() const override { return frames_.size(); }
  std::string word_kind() const override { return "FITS"; }

  StoredFrame frame(std::size_t number) override {
    const Size size = size_of(frames_[number]);
    StoredFrame frame;
    frame.width_px = size.width;
    frame.height_px = size.height;
    frame.channels = size.planes == 3 ? 3 : 1;
    const bool is_first = frames_[number].begin == 0;
    const std::string header =
        is_first ? file_.bytes(0, parts_.front().data) : first_header() + header_of(frames_[number]);
    if (const auto time = sim::fits_time(header))
      if (const auto seconds = sim::utc_seconds(time->utc))
        frame.time = ImagerTime{time->utc, *seconds, "FITS " + time->key};
    return frame;
  }

  std::string picture(std::size_t number) override {
    const sim::FitsPart& part = frames_[number];
    const std::string own = file_.bytes(part.begin, part.end - part.begin);
    return part.begin == 0 ? own : first_header() + own;
  }

 private:
  std::string header_of(const sim::FitsPart& part) const {
    return file_.bytes(part.begin, part.data - part.begin);
  }

  /// The first header without its data, if an extension is to follow it.
  std::string first_header() const {
    constexpr std::size_t kCard = 80;
    std::string header = file_.bytes(0, parts_.front().data);
    if (!parts_.front().is_image) return header;
    std::string bare;
    const auto put = [&](std::string card) {
      card.resize(kCard, ' ');
      bare += card;
    };
    put("SIMPLE  =                    T");
    put("BITPIX  =                    8");
    put("NAXIS   =                    0");
    for (std::size_t at = 0; at + kCard <= header.size(); at += kCard) {
      const std::string card = header.substr(at, kCard), key(sim::trimmed(card.substr(0, 8)));
      if (key == "END") break;
      const bool is_of_data = sim::starts_with(key, "NAXIS") || key == "SIMPLE" || key == "BITPIX" ||
                              key == "BZERO" || key == "BSCALE" || key == "BLANK" || key == "DATAMAX" ||
                              key == "DATAMIN" || key == "CHECKSUM" || key == "DATASUM";
      if (!is_of_data) put(card);
    }
    put("END");
    constexpr std::size_t kBlock = 2880;
    bare.resize((bare.size() + kBlock - 1) / kBlock * kBlock, ' ');
    return bare;
  }

  sim::RandomBytes file_;
  std::vector<sim::FitsPart> parts_;
  std::vector<sim::FitsPart> frames_;
};

}  // namespace fits_images_of

bool holds_fits_images(const std::string& name, std::string_view bytes) {
  const sim::RandomBytes file(name, bytes);
  return fits_images_of::frames_of(sim::fits_parts(file)).size() > 1;
}

std::unique_ptr<FrameStore> fits_images(const std::string& name, std::string_view bytes) {
  return std::make_unique<fits_images_of::FitsImages>(name, bytes);
}

}  // namespace vegard::fit
