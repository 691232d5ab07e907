#include "fit/photo/frames/imager_name.h"

#include <regex>

#include "sim/base/utc_time.h"

namespace vegard::fit {
namespace {

constexpr std::size_t kLongestName = 255;

/// "20140310", "0603" as "2014-03-10T06:03:00", minutes and seconds as far as they are there.
std::string iso_of_digits(const std::string& day, std::string clock) {
  clock.resize(6, '0');
  return day.substr(0, 4) + "-" + day.substr(4, 2) + "-" + day.substr(6, 2) + "T" + clock.substr(0, 2) + ":" +
         clock.substr(2, 2) + ":" + clock.substr(4, 2);
}

}  // namespace

std::optional<ImagerName> imager_name(const std::string& file_name) {
  static const std::regex kPicture(
      R"((\d{8})_(\d{6})_(\d{6})_([a-z0-9]{3,5})_([a-z][a-z0-9-]*)_(\d{1,6})ms_([a-z0-9-]+)\.png)");
  static const std::regex kFrames(
      R"((\d{8})_(\d{2}(?:\d{2})?)_([a-z0-9]{3,5})_([a-z][a-z0-9-]*)_([a-z0-9-]+)\.(?:pgm(?:\.gz)?|h5|png\.tar))");
  if (file_name.size() > kLongestName) return std::nullopt;
  std::smatch part;
  ImagerName found;
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
  if (!metadata.site) metadata.site = name->site;
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
