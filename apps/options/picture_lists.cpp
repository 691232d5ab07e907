#include "apps/options/picture_lists.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <numeric>
#include <set>
#include <sstream>

#include "apps/options/file_names.h"
#include "apps/options/refusals.h"
#include "fit/photo/frames/frame_name.h"
#include "fit/photo/frames/picture_bytes.h"
#include "fit/photo/photo_metadata.h"
#include "sim/base/error.h"
#include "sim/base/file/input_file.h"
#include "sim/base/picture/picture_metadata.h"
#include "sim/base/text.h"
#include "sim/base/utc_time.h"

namespace vegard::apps {
namespace {

namespace fs = std::filesystem;

std::vector<ListedPhoto> read_list(const std::string& list) {
  std::istringstream stream(sim::input_bytes(list, "a text file"));
  std::vector<ListedPhoto> photos;
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    std::istringstream words(line);
    std::string file, time, more;
    words >> file >> time >> more;
    if (file.empty() || file[0] == '#') continue;
    ListedPhoto photo{(fs::path(list).parent_path() / file).string(), NAN, {}};
    std::size_t used = 0;
    try {
      if (!time.empty()) photo.time_s = std::stod(time, &used);
    } catch (const std::exception&) {
      used = std::string::npos;
    }
    if (used != time.size() || !more.empty() || (!time.empty() && !std::isfinite(photo.time_s)))
      throw sim::unreadable(list, "'" + line + "' cannot be understood")
          .line(number)
          .expected("FILE or FILE TIME_S");
    photos.push_back(photo);
  }
  if (photos.empty())
    throw sim::unreadable(list, "the list names no photograph").expected("lines of FILE or FILE TIME_S");
  return photos;
}

namespace fs = std::filesystem;
using Kind = fit::PictureTimes::Kind;

std::string trimmed(const std::string& text) { return std::string(sim::trimmed(text)); }

std::optional<double> plain_number(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// Times by the names of the pictures.
struct TimeTable {
  Kind kind = Kind::utc;
  std::map<std::string, double> seconds;
};

TimeTable read_times(const std::string& file) {
  std::istringstream stream(sim::input_bytes(file, "lines of FILE,TIME"));
  TimeTable table;
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    line = trimmed(line);
    if (line.empty() || line[0] == '#' || (table.seconds.empty() && line == "file,time")) continue;
    const auto comma = line.find_last_of(",;\t");
    const std::string name = comma == std::string::npos ? "" : file_name_of(trimmed(line.substr(0, comma)));
    const std::string time = comma == std::string::npos ? "" : trimmed(line.substr(comma + 1));
    const std::optional<double> utc = sim::utc_seconds(time), seconds = plain_number(time);
    if (name.empty() || (!utc && !seconds))
      throw sim::unreadable(file, "'" + line + "' cannot be understood")
          .line(number)
          .expected("FILE,TIME, the time in ISO 8601 or seconds");
    const Kind kind = utc ? Kind::utc : Kind::clock;
    if (table.seconds.empty()) table.kind = kind;
    if (kind != table.kind)
      throw sim::unreadable(file, "some times are dates and some are seconds")
          .line(number)
          .expected("one kind");
    if (!table.seconds.emplace(name, utc ? *utc : *seconds).second)
      throw sim::unreadable(file, "'" + name + "' has a time already")
          .line(number)
          .expected("one line for each picture");
  }
  return table;
}

fit::PictureTimes from_table(const std::vector<std::string>& files, const std::string& times_file) {
  const TimeTable table = read_times(times_file);
  fit::PictureTimes times;
  times.kind = table.kind;
  times.source = "table " + file_name_of(times_file);
  for (const std::string& file : files) {
    const auto found = table.seconds.find(file_name_of(file));
    if (found == table.seconds.end())
      throw sim::unreadable(times_file, "it has no time for " + file_name_of(file))
          .expected("a line FILE,TIME for each picture");
    times.seconds.push_back(found->second);
  }
  return times;
}

/// Seconds of every text; nothing unless each tells a time, and no two the same (a clock that counts whole
/// seconds cannot tell a burst's pictures apart).
std::optional<std::vector<double>> distinct_seconds(const std::vector<std::optional<std::string>>& texts) {
  std::vector<double> all;
  for (const auto& text : texts) {
    const std::optional<double> seconds = text ? sim::utc_seconds(*text) : std::nullopt;
    if (!seconds) return std::nullopt;
    all.push_back(*seconds);
  }
  if (std::set<double>(all.begin(), all.end()).size() != all.size()) return std::nullopt;
  return all;
}

/// What the files say themselves, in UTC.
std::optional<fit::PictureTimes> from_metadata(const std::vector<sim::PictureMetadata>& metadata) {
  std::vector<std::optional<std::string>> texts;
  std::set<std::string> sources;
  for (const sim::PictureMetadata& one : metadata) {
    texts.push_back(sim::taken_utc(one));
    sources.insert(one.header_time_utc ? one.sources.header_time : "EXIF");
  }
  const auto seconds = distinct_seconds(texts);
  if (!seconds) return std::nullopt;
  std::string source = "the files' own";
  for (const std::string& one : sources) source += (one == *sources.begin() ? " (" : "; ") + one;
  return fit::PictureTimes{Kind::utc, *seconds, source + ")"};
}

std::optional<fit::PictureTimes> from_names(const std::vector<std::string>& files) {
  constexpr const char* kTable = "a table that says when each was taken";
  std::vector<double> told;
  std::string without, zoned, zoneless;
  for (const std::string& file : files) {
    const std::string name = file_name_of(file);
    const std::optional<sim::TimeInName> time = sim::time_in_name(name);
    if (!time) {
      if (without.empty()) without = name;
      continue;
    }
    if (!time->unclear.empty())
      throw usage_error("--times",
                        "the time in the name of " + name + " is not clear: '" + time->unclear + "'",
                        std::string("names in UTC or with an offset, +0100; or ") + kTable);
    (time->offset_minutes ? zoned : zoneless) = name;
    told.push_back(time->utc_s());
  }
  if (told.empty()) return std::nullopt;
  if (told.size() < files.size())
    throw usage_error("--times", "the name of " + without + " has no time, others have", kTable);
  if (!zoned.empty() && !zoneless.empty())
    throw usage_error("--times", "the name of " + zoned + " tells its zone, that of " + zoneless + " none",
                      kTable);
  return fit::PictureTimes{
      Kind::utc, told,
      zoned.empty() ? "the files' names, taken for UTC" : "the files' names, by their zones"};
}

/// By the cameras' clocks, of no known zone.
std::optional<fit::PictureTimes> from_clocks(const std::vector<sim::PictureMetadata>& metadata) {
  std::vector<std::optional<std::string>> texts;
  for (const sim::PictureMetadata& one : metadata) texts.push_back(one.taken_local);
  auto seconds = distinct_seconds(texts);
  if (!seconds) return std::nullopt;
  const double first = *std::min_element(seconds->begin(), seconds->end());
  for (double& one : *seconds) one -= first;
  return fit::PictureTimes{Kind::clock, *seconds,
                           "the camera's clock (EXIF, in a zone that it does not name), from " +
                               sim::utc_text(first).substr(0, 19) + " on"};
}

/// When it was taken; a frame's file has been gone through for it already.
sim::PictureMetadata metadata_of_listed(const ListedPhoto& photo) {
  if (!photo.time) return fit::photo_metadata(photo.file);
  sim::PictureMetadata metadata;
  metadata.header_time_utc = photo.time->utc;
  metadata.sources.header_time = photo.time->source;
  return metadata;
}

/// Without a table or a list.
fit::PictureTimes from_files(const std::vector<ListedPhoto>& listed) {
  std::vector<std::string> files;
  std::vector<sim::PictureMetadata> metadata;
  for (const ListedPhoto& photo : listed) {
    files.push_back(photo.file);
    metadata.push_back(metadata_of_listed(photo));
  }
  if (const auto times = from_metadata(metadata)) return *times;
  if (const auto times = from_names(files)) return *times;
  if (const auto times = from_clocks(metadata)) return *times;
  fit::PictureTimes times;
  times.source = "not known; pictures in the order given";
  times.seconds.resize(files.size());
  std::iota(times.seconds.begin(), times.seconds.end(), 0.0);
  return times;
}

}  // namespace

std::vector<ListedPhoto> listed_photos(const std::vector<std::string>& words, const std::string& key) {
  std::vector<ListedPhoto> listed;
  if (words.size() == 1 && fs::path(words[0]).extension() == ".txt")
    listed = read_list(words[0]);
  else
    for (const std::string& word : words) listed.push_back({word, NAN, {}});
  if (listed.empty()) throw usage_error(key, "no photograph is named", "images, or a list of them");
  std::vector<ListedPhoto> pictures;
  for (const ListedPhoto& one : listed) {
    const std::vector<fit::NamedPicture> in_it = fit::pictures_in(one.file);
    if (in_it.size() > 1 && !std::isnan(one.time_s))
      throw usage_error(key,
                        "the list has one time for the " + std::to_string(in_it.size()) + " frames of " +
                            file_name_of(one.file),
                        "no time, or a line for each: FILE#0 TIME_S");
    for (const fit::NamedPicture& picture : in_it)
      pictures.push_back({picture.name, one.time_s, picture.time});
  }
  return pictures;
}

std::vector<SequencePhoto> sequence_photos(const std::vector<std::string>& words, const sim::Scene& scene) {
  const std::vector<ListedPhoto> listed = listed_photos(words, "--photos");
  std::vector<SequencePhoto> photos;
  std::set<std::string> names;
  const bool frames_tell_time =
      std::all_of(listed.begin(), listed.end(), [](const ListedPhoto& one) { return one.time.has_value(); });
  for (const ListedPhoto& one : listed) {
    SequencePhoto photo{fit::stem_of_picture(one.file), one.file, one.time_s};
    if (std::isnan(photo.time_s))
      photo.time_s = scene.time.start_s +
                     (frames_tell_time ? one.time->seconds - listed.front().time->seconds
                                       : static_cast<double>(photos.size()) / scene.time.frames_per_second);
    if (!names.insert(photo.name).second)
      throw usage_error("--photos", "two photographs are called '" + photo.name + "'",
                        "a name of its own for each");
    photos.push_back(photo);
  }
  return photos;
}

TimedPictures timed_pictures(const std::vector<std::string>& words, const std::string& times_file) {
  const std::vector<ListedPhoto> listed = listed_photos(words, "IMAGE");
  TimedPictures pictures;
  std::vector<double> told;
  for (const ListedPhoto& one : listed) {
    pictures.files.push_back(one.file);
    if (!std::isnan(one.time_s)) told.push_back(one.time_s);
  }
  if (pictures.files.size() < 2)
    throw usage_error("IMAGE", "a keogram of one picture is a profile", "two pictures at least");
  if (!times_file.empty()) {
    pictures.times = from_table(pictures.files, times_file);
  } else if (told.size() == listed.size()) {
    pictures.times = {Kind::clock, told, "the list " + file_name_of(words.front())};
  } else if (!told.empty()) {
    throw usage_error("IMAGE", "the list has times of some pictures and not of others", "all, or none");
  } else {
    pictures.times = from_files(listed);
  }
  std::vector<std::size_t> order(pictures.files.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const std::vector<double> seconds = pictures.times.seconds;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return seconds[a] < seconds[b]; });
  const std::vector<std::string> files = pictures.files;
  for (std::size_t i = 0; i < order.size(); ++i) {
    pictures.files[i] = files[order[i]];
    pictures.times.seconds[i] = seconds[order[i]];
  }
  return pictures;
}

}  // namespace vegard::apps
