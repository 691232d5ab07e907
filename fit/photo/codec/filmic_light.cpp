#include "fit/photo/codec/filmic_light.h"

#include <string>

#include "sim/base/text.h"
#include "sim/scene/table/parameter_table.h"
#include "sim/view/colour/colour.h"
#include "sim/view/sensor/filmic_tone.h"

namespace vegard::fit {
namespace filmic_light {

class FilmicTable : public LightTable {
 public:
  explicit FilmicTable(sim::Primaries primaries)
      : tone_(primaries),
        to_srgb_(sim::product(sim::rgb_from_xyz(sim::Primaries::srgb),
                              sim::inverse(sim::rgb_from_xyz(primaries)))),
        is_srgb_(primaries == sim::Primaries::srgb) {}

  void to_light(const float* encoded, float* light, std::size_t pixels) const override {
    for (std::size_t i = 0; i < 3 * pixels; i += 3) {
      sim::Vector3 rgb;
      for (std::size_t c = 0; c < 3; ++c) rgb[c] = sim::srgb_decode(encoded[i + c]);
      rgb = tone_.light(rgb);
      if (!is_srgb_) rgb = sim::product(to_srgb_, rgb);
      for (std::size_t c = 0; c < 3; ++c) light[i + c] = static_cast<float>(rgb[c]);
    }
  }

  /// What other tones show as white. A step of 8 bits is up to five times as wide at white as with sRGB, and
  /// wider above.
  float brightest() const override { return 1.0f; }

 private:
  sim::FilmicTone tone_;
  sim::Matrix3 to_srgb_;
  bool is_srgb_;
};

constexpr std::string_view kWords = "filmic, primaries ";

}  // namespace filmic_light

std::string_view filmic_words(std::string_view description) {
  constexpr std::string_view kKey = "encoding=";
  for (std::size_t at = 0; at < description.size();) {
    const std::size_t end = std::min(description.find('\n', at), description.size());
    const std::string_view line = description.substr(at, end - at);
    if (sim::starts_with(line, kKey)) return line.substr(kKey.size());
    at = end + 1;
  }
  return {};
}

void declare_filmic(std::string_view words, DeclaredLight& light) {
  using namespace filmic_light;
  if (!sim::starts_with(words, kWords)) return;
  const std::string name = std::string(words.substr(kWords.size(), words.find('\0') - kWords.size()));
  for (const sim::Primaries primaries :
       {sim::Primaries::srgb, sim::Primaries::smpte_c, sim::Primaries::rec2020, sim::Primaries::acescg}) {
    if (sim::word_of(primaries) != name) continue;
    light.words.push_back("encoding filmic, primaries " + name);
    light.source = "its encoding";
    light.problem.clear();
    light.to_srgb.reset();
    light.curve =
        LightCurve{false, std::make_shared<const sim::ToneCurve>(sim::ToneCurve::filmic()), "filmic"};
    light.table = std::make_shared<FilmicTable>(primaries);
    return;
  }
}

}  // namespace vegard::fit
