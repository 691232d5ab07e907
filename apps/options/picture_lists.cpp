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
#include "fit/survey/survey.h"
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
    ListedPhoto photo{(fs::path(list).parent_path() / file).string(), NAN, {}, {}};
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

/// The pictures of a folder, not of those in it, by their names.
std::vector<std::string> pictures_of_folder(const std::string& folder, const std::string& key) {
  std::vector<std::string> found;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename().string(), lower = sim::lowered(name);
    std::error_code of_entry;
    if (name[0] == '.' || entry->is_directory(of_entry)) continue;
    const auto& endings = fit::picture_endings();
    if (std::any_of(endings.begin(), endings.end(),
                    [&](const std::string& ending) { return sim::ends_with(lower, ending); }))
      found.push_back((fs::path(folder) / name).string());
  }
  if (error) throw sim::unreadable(folder, error.message());
  if (found.empty())
    throw usage_error(key, "there is no picture in the folder " + folder,
                      "files with the endings of pictures, .jpg, .png, .fits …");
  std::sort(found.begin(), found.end());
  return found;
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

std::optional<fit::PictureTimes> from_names(const std::vector<ListedPhoto>& photos) {
  constexpr const char* kTable = "a table that says when each was taken";
  std::vector<double> told;
  std::string without, zoned, zoneless;
  for (const ListedPhoto& photo : photos) {
    const std::string name = file_name_of(photo.file);
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
    told.push_back(time->utc_s() + photo.stream.seconds.value_or(0.0));
  }
  if (told.empty()) return std::nullopt;
  if (told.size() < photos.size())
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
  const std::string& clock = metadata.front().sources.clock;
  const std::string source =
      clock == sim::PictureSources().clock ? clock + " (EXIF, in a zone that it does not name)" : clock;
  return fit::PictureTimes{Kind::clock, *seconds,
                           source + ", from " + sim::utc_text(first).substr(0, 19) + " on"};
}

bool are_of_one_film(const std::vector<ListedPhoto>& photos) {
  const std::string film = fit::file_of_frame(photos.front().file);
  return std::all_of(photos.begin(), photos.end(), [&](const ListedPhoto& photo) {
    return photo.stream.seconds && fit::file_of_frame(photo.file) == film;
  });
}

std::vector<double> film_seconds(const std::vector<ListedPhoto>& photos, double from) {
  std::vector<double> seconds;
  for (const ListedPhoto& photo : photos) seconds.push_back(from + *photo.stream.seconds);
  return seconds;
}

fit::PictureTimes from_start_and_step(const std::vector<ListedPhoto>& photos, const GivenTimes& given) {
  fit::PictureTimes times;
  times.kind = given.start_s ? Kind::utc : Kind::clock;
  const double start_s = given.start_s.value_or(0.0);
  times.source = given.start_s ? "--start" : "--step";
  if (given.start_s && given.step_s) times.source += " and --step";
  if (given.step_s) {
    for (std::size_t i = 0; i < photos.size(); ++i)
      times.seconds.push_back(start_s + *given.step_s * static_cast<double>(i));
    return times;
  }
  if (!are_of_one_film(photos))
    throw usage_error("--start", "the pictures are not the frames of one film, which has a clock",
                      "--step with the seconds from one picture to the next");
  times.source += " and the film's clock";
  times.seconds = film_seconds(photos, start_s - *photos.front().stream.seconds);
  return times;
}

/// When it was taken; a frame's file has been gone through for it already.
sim::PictureMetadata metadata_of_listed(const ListedPhoto& photo) {
  if (!photo.time && !photo.stream.seconds) return fit::photo_metadata(photo.file);
  sim::PictureMetadata metadata;
  if (photo.time) {
    metadata.header_time_utc = photo.time->utc;
    metadata.sources.header_time = photo.time->source;
  }
  if (!photo.stream.clock.empty()) {
    metadata.taken_local = photo.stream.clock;
    metadata.sources.clock = photo.stream.clock_source;
  }
  return metadata;
}

/// Without a table or a list.
fit::PictureTimes from_files(const std::vector<ListedPhoto>& listed) {
  std::vector<sim::PictureMetadata> metadata;
  for (const ListedPhoto& photo : listed) metadata.push_back(metadata_of_listed(photo));
  if (const auto times = from_metadata(metadata)) return *times;
  if (const auto times = from_names(listed)) return *times;
  if (are_of_one_film(listed)) {
    const sim::PictureMetadata& first = metadata.front();
    const std::string clock = first.taken_local ? first.sources.clock + ", from " + *first.taken_local
                                                : "the film's clock, from its first frame";
    return {Kind::clock, film_seconds(listed, -*listed.front().stream.seconds), clock + " on"};
  }
  if (const auto times = from_clocks(metadata)) return *times;
  fit::PictureTimes times;
  times.source = "not known; pictures in the order given";
  times.seconds.resize(listed.size());
  std::iota(times.seconds.begin(), times.seconds.end(), 0.0);
  return times;
}

}  // namespace

std::vector<ListedPhoto> listed_photos(const std::vector<std::string>& words, const std::string& key) {
  std::vector<ListedPhoto> listed;
  if (words.size() == 1 && fs::path(words[0]).extension() == ".txt")
    listed = read_list(words[0]);
  else
    for (const std::string& word : words) {
      std::error_code ignored;
      if (!fs::is_directory(word, ignored)) {
        listed.push_back({word, NAN, {}, {}});
        continue;
      }
      for (const std::string& picture : pictures_of_folder(word, key))
        listed.push_back({picture, NAN, {}, {}});
    }
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
      pictures.push_back({picture.name, one.time_s, picture.time, picture.stream});
  }
  return pictures;
}

std::vector<SequencePhoto> sequence_photos(const std::vector<std::string>& words, const sim::Scene& scene) {
  const std::vector<ListedPhoto> listed = listed_photos(words, "--photos");
  std::vector<SequencePhoto> photos;
  std::set<std::string> names;
  const bool frames_tell_time =
      std::all_of(listed.begin(), listed.end(), [](const ListedPhoto& one) { return one.time.has_value(); });
  const bool is_film = are_of_one_film(listed);
  for (const ListedPhoto& one : listed) {
    SequencePhoto photo{fit::stem_of_picture(one.file), one.file, one.time_s};
    if (std::isnan(photo.time_s))
      photo.time_s = scene.time.start_s +
                     (frames_tell_time ? one.time->seconds - listed.front().time->seconds
                      : is_film        ? *one.stream.seconds - *listed.front().stream.seconds
                                       : static_cast<double>(photos.size()) / scene.time.frames_per_second);
    if (!names.insert(photo.name).second)
      throw usage_error("--photos", "two photographs are called '" + photo.name + "'",
                        "a name of its own for each");
    photos.push_back(photo);
  }
  return photos;
}

TimedPictures timed_pictures(const std::vector<std::string>& words, const GivenTimes& given) {
  const std::vector<ListedPhoto> listed = listed_photos(words, "IMAGE");
  TimedPictures pictures;
  std::vector<double> told;
  for (const ListedPhoto& one : listed) {
    pictures.files.push_back(one.file);
    if (!std::isnan(one.time_s)) told.push_back(one.time_s);
  }
  if (pictures.files.size() < 2)
    throw usage_error("IMAGE", "one picture has no course in time", "two pictures at least");
  if (!given.table.empty() && (given.start_s || given.step_s))
    throw usage_error("--times", "--start and --step say the times already", "one of both");
  if (given.start_s || given.step_s) {
    pictures.times = from_start_and_step(listed, given);
  } else if (!given.table.empty()) {
    pictures.times = from_table(pictures.files, given.table);
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
