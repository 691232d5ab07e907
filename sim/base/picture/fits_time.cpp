#include "sim/base/picture/fits_time.h"

#include <map>

#include "sim/base/text.h"
#include "sim/base/utc_time.h"

namespace vegard::sim {
namespace {

constexpr std::size_t kFitsCard = 80, kKey = 8;

/// The texts of the first header by their keywords, as far as the bytes reach.
std::map<std::string_view, std::string_view> texts_of(std::string_view bytes) {
  std::map<std::string_view, std::string_view> texts;
  for (; bytes.size() >= kFitsCard; bytes.remove_prefix(kFitsCard)) {
    const std::string_view key = trimmed(bytes.substr(0, kKey), " "),
                           value = bytes.substr(kKey, kFitsCard - kKey);
    if (key == "END") break;
    const std::size_t begin = value.find('\'');
    if (value.substr(0, 2) != "= " || begin == std::string_view::npos) continue;
    const std::size_t end = value.find('\'', begin + 1);
    if (end != std::string_view::npos)
      texts.emplace(key, trimmed(value.substr(begin + 1, end - begin - 1), " "));
  }
  return texts;
}

}  // namespace

std::optional<FitsTime> fits_time(std::string_view bytes) {
  if (bytes.substr(0, kKey + 1) != "SIMPLE  =") return std::nullopt;
  const auto texts = texts_of(bytes);
  const auto text = [&](const char* key) {
    const auto found = texts.find(key);
    return std::string(found == texts.end() ? std::string_view() : found->second);
  };
  const std::string scale = text("TIMESYS");
  if (!scale.empty() && scale != "UTC" && scale != "UT" && scale != "GMT") return std::nullopt;
  for (const auto& [day, time] : {std::pair{"DATE-OBS", "TIME-OBS"}, std::pair{"OBSDATE", "OBSSTART"}}) {
    if (const auto whole = utc_seconds(text(day))) return FitsTime{utc_text(*whole), day};
    if (const auto both = utc_seconds(text(day) + "T" + text(time)))
      return FitsTime{utc_text(*both), std::string(day) + " and " + time};
  }
  return std::nullopt;
}

}  // namespace vegard::sim
