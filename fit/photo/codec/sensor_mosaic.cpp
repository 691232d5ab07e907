#include "fit/photo/codec/sensor_mosaic.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "sim/base/error.h"
#include "sim/base/text.h"

namespace vegard::fit {
namespace sensor_mosaic {

std::string word_of(const std::map<std::string, std::string>& words, const char* key) {
  const auto found = words.find(key);
  return found == words.end() ? std::string() : std::string(sim::trimmed(found->second, " "));
}

std::string uppered(std::string text) {
  for (char& c : text)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return text;
}

/// A whole number modulo 2; 0 for none.
int odd_offset(const std::map<std::string, std::string>& words, const char* key, const std::string& file) {
  const std::string text = word_of(words, key);
  if (text.empty()) return 0;
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  constexpr double kMax = 1e6;
  if (end == text.c_str() || value != std::floor(value) || !(std::abs(value) < kMax))
    throw sim::unreadable(file, std::string(key) + " is '" + text + "'")
        .key(key)
        .expected("a whole number of pixels");
  return static_cast<int>(value) & 1;
}

bool is_pattern(const std::string& text) {
  std::string sorted = text;
  std::sort(sorted.begin(), sorted.end());
  // The greens stand across from each other.
  return sorted == "BGGR" && (text[0] == text[3] || text[1] == text[2]);
}

/// What cameras without a mosaic write into COLORTYP or BAYERPAT.
bool is_none(const std::string& text) {
  for (const char* none :
       {"", "MONO", "MONOCHROME", "NONE", "GRAY", "GREY", "RGB", "COLOR", "COLOUR", "BGR", "0"})
    if (text == none) return true;
  return false;
}

}  // namespace sensor_mosaic

std::optional<SensorMosaic> fits_mosaic(const std::map<std::string, std::string>& words, int height,
                                        const std::string& file) {
  using namespace sensor_mosaic;
  const char* key = "BAYERPAT";
  std::string pattern = uppered(word_of(words, key));
  if (is_none(pattern)) {
    key = "COLORTYP";
    pattern = uppered(word_of(words, key));
  }
  if (is_none(pattern)) return std::nullopt;
  constexpr std::string_view kBayer = "BAYER_";
  if (sim::starts_with(pattern, kBayer)) pattern.erase(0, kBayer.size());
  if (!is_pattern(pattern))
    throw sim::unreadable(file, std::string("it is a mosaic of the filters '") + pattern + "'")
        .key(key)
        .expected("RGGB, BGGR, GRBG or GBRG")
        .hint("demosaic it first, by the camera's own program");
  const std::string order = uppered(word_of(words, "ROWORDER"));
  const bool by_file = order.empty();
  const int across = odd_offset(words, "XBAYROFF", file),
            down = odd_offset(words, "YBAYROFF", file) + (by_file ? height - 1 : 0);
  SensorMosaic mosaic;
  mosaic.name = pattern;
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 2; ++x) {
      // Rows that are stored upside down count backwards, which is the same modulo 2.
      const char filter = pattern[static_cast<std::size_t>(2 * ((y + down) & 1) + ((x + across) & 1))];
      mosaic.colours[static_cast<std::size_t>(2 * y + x)] = filter == 'R' ? 0 : filter == 'G' ? 1 : 2;
    }
  return mosaic;
}

void demosaic(const SensorMosaic& mosaic, PictureCodes& codes) {
  const int width = codes.width, height = codes.height;
  std::vector<float> made(3 * static_cast<std::size_t>(width) * height);
  std::vector<std::uint8_t> usable(made.size(), 0);
  const auto is_full = [&](std::size_t site) {
    const float value = codes.value(site);
    if (!codes.usable.empty() && codes.usable[site] == 0) return true;
    return !std::isfinite(value) || (!codes.floating && value >= codes.white);
  };
  std::vector<char> full(static_cast<std::size_t>(width) * height);
  for (std::size_t site = 0; site < full.size(); ++site) full[site] = static_cast<char>(is_full(site));
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      double sum[3] = {};
      int sites[3] = {};
      bool spoilt[3] = {};
      const auto add = [&](int u, int v) {
        const std::size_t site = static_cast<std::size_t>(v) * width + u;
        const int c = mosaic.colour(u, v);
        sum[c] += codes.value(site);
        ++sites[c];
        spoilt[c] = spoilt[c] || full[site] != 0;
      };
      const int own = mosaic.colour(x, y);
      add(x, y);
      for (int v = std::max(0, y - 1); v <= std::min(height - 1, y + 1); ++v)
        for (int u = std::max(0, x - 1); u <= std::min(width - 1, x + 1); ++u)
          if (mosaic.colour(u, v) != own) add(u, v);
      const std::size_t to = 3 * (static_cast<std::size_t>(y) * width + x);
      for (std::size_t c = 0; c < 3; ++c) {
        made[to + c] = sites[c] > 0 ? static_cast<float>(sum[c] / sites[c]) : 0.0f;
        usable[to + c] = sites[c] > 0 && !spoilt[c];
      }
    }
  codes.values = std::move(made);
  codes.usable = std::move(usable);
  codes.bytes.reset();
  codes.channels = 3;
  codes.kind += ", " + mosaic.name + " mosaic, bilinear";
}

}  // namespace vegard::fit
