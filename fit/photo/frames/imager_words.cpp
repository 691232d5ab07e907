#include "fit/photo/frames/imager_words.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <initializer_list>
#include <regex>

#include "sim/base/text.h"
#include "sim/base/utc_time.h"

namespace vegard::fit {
namespace {

constexpr const char* kExposureOptions = "Exposure options";

using Word = ImagerWords::value_type;

/// The last word of the first of these keys that there is.
const Word* word_of_keys(const ImagerWords& words, std::initializer_list<const char*> keys) {
  for (const char* key : keys) {
    const auto found = std::find_if(words.rbegin(), words.rend(), [&](const Word& word) {
      return sim::lowered(word.first) == sim::lowered(key);
    });
    if (found != words.rend()) return &*found;
  }
  return nullptr;
}

std::optional<std::string> text_of_keys(const ImagerWords& words, std::initializer_list<const char*> keys) {
  const Word* word = word_of_keys(words, keys);
  return word != nullptr && !word->second.empty() ? std::optional<std::string>(word->second) : std::nullopt;
}

std::string source_of(const Word& word, const std::string& kind) { return kind + " \"" + word.first + "\""; }

/// A number at the beginning of `text`, and nothing that only a damaged file holds.
std::optional<double> leading_number(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  constexpr double kLargest = 1e9;
  return end != text.c_str() && std::abs(value) <= kLargest ? std::optional<double>(value) : std::nullopt;
}

/// Returns a number of the word "WIDTH=512 HEIGHT=256 MSEC=999".
std::optional<double> option_number(const ImagerWords& words, const std::string& name) {
  const Word* options = word_of_keys(words, {kExposureOptions});
  if (options == nullptr) return std::nullopt;
  const std::string text = " " + options->second;
  const std::size_t at = text.find(" " + name + "=");
  return at == std::string::npos ? std::nullopt : leading_number(text.substr(at + name.size() + 2));
}

struct Exposure {
  double seconds = 0.0;
  std::string source;
};

std::optional<Exposure> exposure_of(const ImagerWords& words, const std::string& kind) {
  constexpr double kMilliseconds = 1e-3;
  if (const auto ms = option_number(words, "MSEC"); ms && *ms > 0.0)
    return Exposure{*ms * kMilliseconds, source_of(*word_of_keys(words, {kExposureOptions}), kind)};
  // TREx RGB: "320.0 ms".
  const Word* asked = word_of_keys(words, {"subframe_requested_exposure", "Effective image exposure"});
  if (asked == nullptr || asked->second.find(" ms") == std::string::npos) return std::nullopt;
  const auto ms = leading_number(asked->second);
  return ms && *ms > 0.0 ? std::optional<Exposure>({*ms * kMilliseconds, source_of(*asked, kind)})
                         : std::nullopt;
}

void take_place(const ImagerWords& words, const std::string& kind, sim::PictureMetadata& metadata) {
  const Word* latitude =
      word_of_keys(words, {"Geodetic latitude", "Geographic latitude", "site_latitude", "geodetic_latitude"});
  const Word* longitude = word_of_keys(
      words, {"Geodetic longitude", "Geographic longitude", "site_longitude", "geodetic_longitude"});
  if (latitude == nullptr || longitude == nullptr) return;
  const auto north = leading_number(latitude->second);
  auto east = leading_number(longitude->second);
  constexpr double kHalfTurn_deg = 180.0, kTurn_deg = 360.0, kPole_deg = 90.0;
  if (east && *east > kHalfTurn_deg) *east -= kTurn_deg;
  if (!north || !east || std::abs(*north) > kPole_deg || std::abs(*east) > kHalfTurn_deg) return;
  metadata.latitude_deg = north;
  metadata.longitude_deg = east;
  metadata.sources.latitude = source_of(*latitude, kind);
  metadata.sources.longitude = source_of(*longitude, kind);
  const Word* altitude = word_of_keys(words, {"Geodetic altitude", "Geographic altitude"});
  const auto up = altitude != nullptr ? leading_number(altitude->second) : std::nullopt;
  constexpr double kLowest_m = -500.0, kHighest_m = 9000.0;
  if (!up || *up < kLowest_m || *up > kHighest_m) return;
  metadata.altitude_m = up;
  metadata.sources.altitude = source_of(*altitude, kind);
}

constexpr std::size_t kLongestName = 255;

/// "20140310", "0603" as "2014-03-10T06:03:00", minutes and seconds as far as they are there.
std::string iso_of_digits(const std::string& day, std::string clock) {
  clock.resize(6, '0');
  return day.substr(0, 4) + "-" + day.substr(4, 2) + "-" + day.substr(6, 2) + "T" + clock.substr(0, 2) + ":" +
         clock.substr(2, 2) + ":" + clock.substr(4, 2);
}

}  // namespace

ImagerWords imager_words(std::string_view header) {
  ImagerWords words;
  while (!header.empty()) {
    const std::string_view line = header.substr(0, header.find('\n'));
    header.remove_prefix(std::min(header.size(), line.size() + 1));
    if (line.substr(0, 2) != "#\"") continue;
    const std::size_t end = line.find('"', 2);
    if (end == std::string_view::npos) continue;
    words.emplace_back(line.substr(2, end - 2), sim::trimmed(line.substr(end + 1)));
  }
  return words;
}

ImagerWords with_words_of_file(const ImagerWords& own, const ImagerWords& first) {
  ImagerWords all;
  for (const Word& word : first)
    if (word_of_keys(own, {word.first.c_str()}) == nullptr) all.push_back(word);
  all.insert(all.end(), own.begin(), own.end());
  return all;
}

std::optional<ImagerTime> imager_time(const ImagerWords& words, const std::string& kind) {
  const Word* word = word_of_keys(words, {"Image request start", "image_request_start_timestamp"});
  if (word == nullptr) return std::nullopt;
  std::string text = word->second;
  constexpr std::string_view kZone = " UTC";
  if (sim::ends_with(text, kZone)) text.erase(text.size() - kZone.size());
  const auto time = sim::civil_time(text);
  if (!time) return std::nullopt;
  ImagerTime found;
  found.utc = sim::iso_text(*time) + "Z";
  const auto seconds = sim::utc_seconds(found.utc);
  if (!seconds) return std::nullopt;
  found.seconds = *seconds;
  found.source = source_of(*word, kind);
  return found;
}

std::optional<double> imager_exposure_s(const ImagerWords& words) {
  const auto exposure = exposure_of(words, kPgmComment);
  return exposure ? std::optional<double>(exposure->seconds) : std::nullopt;
}

std::string contradicted_size(const ImagerWords& words, int width_px, int height_px) {
  const auto width = option_number(words, "WIDTH"), height = option_number(words, "HEIGHT");
  if (!width || !height) return {};
  if (*width == width_px && *height == height_px) return {};
  const double across = *width / std::max(1.0, option_number(words, "XBIN").value_or(1.0));
  const double down = *height / std::max(1.0, option_number(words, "YBIN").value_or(1.0));
  const double times = std::floor(across / width_px);
  if (times >= 1.0 && std::floor(across) == times * width_px && std::floor(down) == times * height_px)
    return {};
  return "its comments tell of a picture of " + word_of_keys(words, {kExposureOptions})->second;
}

sim::PictureMetadata imager_metadata(const ImagerWords& words, int width_px, int height_px,
                                     const std::string& kind) {
  sim::PictureMetadata metadata;
  metadata.width_px = width_px;
  metadata.height_px = height_px;
  if (const auto time = imager_time(words, kind)) {
    metadata.header_time_utc = time->utc;
    metadata.sources.header_time = time->source;
  }
  take_place(words, kind, metadata);
  if (const auto exposure = exposure_of(words, kind)) {
    metadata.exposure_s = exposure->seconds;
    metadata.sources.exposure = exposure->source;
  }
  metadata.model = text_of_keys(words, {"Imager model", "Camera model", "imager_model"});
  metadata.imager = text_of_keys(words, {"Imager unique ID", "imager_unique_id"});
  metadata.site = text_of_keys(words, {"Site unique ID", "site_unique_id"});
  metadata.mode = text_of_keys(words, {"Mode unique ID", "Mode UID", "mode_unique_id"});
  return metadata;
}

std::optional<ImagerName> imager_name(const std::string& file_name) {
  static const std::regex kPicture(
      R"((\d{8})_(\d{6})_(\d{6})_([a-z0-9]{3,5})_([a-z][a-z0-9-]*)_(\d{1,6})ms_([a-z0-9-]+)\.png)");
  static const std::regex kFrames(
      R"((\d{8})_(\d{2}(?:\d{2})?)_([a-z0-9]{3,5})_([a-z][a-z0-9-]*)_([a-z0-9-]+)\.(?:pgm(?:\.gz)?|h5|png\.tar))");
  static const std::regex kKeo(R"(([A-Z]\d{4}[A-Z0-9]*)_(\d{4}-\d{2}-\d{2})_(\d{2})-(\d{2})-(\d{2})\.img)");
  if (file_name.size() > kLongestName) return std::nullopt;
  std::smatch part;
  ImagerName found;
  if (std::regex_match(file_name, part, kKeo)) {
    found.utc = part[2].str() + "T" + part[3].str() + ":" + part[4].str() + ":" + part[5].str() + "Z";
    const auto taken_s = sim::utc_seconds(found.utc);
    if (!taken_s) return std::nullopt;
    found.begin_s = *taken_s;
    found.imager = part[1];
    // The line in ångström behind the wheel's letter: W8446B18.
    found.mode = found.imager.substr(1, 3) + "." + found.imager.substr(4, 1) + " nm";
    return found;
  }
  if (std::regex_match(file_name, part, kPicture)) {
    found.utc = iso_of_digits(part[1], part[2]) + "." + part[3].str() + "Z";
    found.site = part[4];
    found.imager = part[5];
    found.exposure_s = 1e-3 * std::stod(part[6]);
    found.mode = part[7];
    const auto seconds = sim::utc_seconds(found.utc);
    if (!seconds || !(*found.exposure_s > 0.0)) return std::nullopt;
    found.begin_s = *seconds;
    return found;
  }
  if (!std::regex_match(file_name, part, kFrames)) return std::nullopt;
  const auto seconds = sim::utc_seconds(iso_of_digits(part[1], part[2]) + "Z");
  if (!seconds) return std::nullopt;
  constexpr double kMinute_s = 60.0, kHour_s = 3600.0;
  constexpr std::size_t kMinuteDigits = 4;
  found.begin_s = *seconds;
  found.lasts_s = part[2].length() == kMinuteDigits ? kMinute_s : kHour_s;
  found.site = part[3];
  found.imager = part[4];
  found.mode = part[5];
  return found;
}

void add_imager_name(const std::string& file_name, sim::PictureMetadata& metadata) {
  const auto name = imager_name(file_name);
  if (!name) return;
  if (!metadata.site && !name->site.empty()) metadata.site = name->site;
  if (!metadata.imager) metadata.imager = name->imager;
  if (!metadata.mode) metadata.mode = name->mode;
  constexpr const char* kSource = "the file's name";
  if (!name->utc.empty() && !sim::taken_utc(metadata) && !metadata.taken_local) {
    metadata.header_time_utc = name->utc;
    metadata.sources.header_time = kSource;
  }
  if (name->exposure_s && !metadata.exposure_s) {
    metadata.exposure_s = name->exposure_s;
    metadata.sources.exposure = kSource;
  }
}

std::string contradicted_time(const std::string& file_name, const sim::PictureMetadata& metadata) {
  const auto name = imager_name(file_name);
  if (!name || !metadata.header_time_utc) return {};
  const auto taken = sim::utc_seconds(*metadata.header_time_utc);
  constexpr double kLoose_s = 10.0;
  if (!taken || (*taken > name->begin_s - kLoose_s && *taken < name->begin_s + name->lasts_s + kLoose_s))
    return {};
  return "the file's name is of " + sim::utc_text(name->begin_s) + ", but its header says " +
         *metadata.header_time_utc;
}

}  // namespace vegard::fit
