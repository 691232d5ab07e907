#include "fit/survey/survey_frames.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <sstream>
#include <system_error>
#include <tuple>

#include "sim/base/error.h"
#include "sim/base/file/input_file.h"
#include "sim/base/file/sha256.h"
#include "sim/base/utc_time.h"

namespace vegard::fit {
namespace {

namespace fs = std::filesystem;

/// A list of 670 000 frames has 60 MB.
constexpr std::size_t kMostListBytes = 1u << 30;

bool has_ending(const std::string& name, const std::vector<std::string>& endings) {
  std::string lower = name;
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return std::any_of(endings.begin(), endings.end(), [&](const std::string& ending) {
    return lower.size() > ending.size() &&
           lower.compare(lower.size() - ending.size(), ending.size(), ending) == 0;
  });
}

/// "a/./b//c" as "a/b/c", so that a name is the same however it was come by.
std::string plain_path(const std::string& path) { return fs::path(path).lexically_normal().generic_string(); }

double time_of_name(const std::string& frame, const std::string& file, int line) {
  const std::string name = fs::path(frame_reference(frame).file).filename().string();
  if (const auto seconds = sim::utc_seconds_in_name(name)) return *seconds;
  sim::ErrorDetails details;
  details.problem = "the name of '" + name + "' tells no time";
  details.file = file;
  details.line = line;
  details.expected = "a date and a time, as in 20190301_221000.png, taken for UTC";
  details.hint =
      "a list (.txt) with lines FRAME TIME says when each was taken; 'endings' leaves other files out";
  throw sim::Error(sim::ErrorKind::unreadable_input, details);
}

/// A line of a list: the frame, and the time after its last blank, if that is one. Names may have blanks.
struct ListLine {
  std::string frame, time;
};
ListLine list_line(std::string line) {
  const auto trim = [](std::string& text) {
    text.erase(text.find_last_not_of(" \t\r") + 1);
    text.erase(0, std::min(text.find_first_not_of(" \t\r"), text.size()));
  };
  trim(line);
  if (line.empty() || line[0] == '#') return {};
  const std::size_t blank = line.find_last_of(" \t");
  if (blank == std::string::npos) return {line, {}};
  ListLine found{line.substr(0, blank), line.substr(blank + 1)};
  trim(found.frame);
  // A date and a time with a blank between are two words.
  const std::size_t before = found.frame.find_last_of(" \t");
  if (before != std::string::npos && sim::has_form(found.frame.substr(before + 1), "0000-00-00")) {
    found.time = found.frame.substr(before + 1) + "T" + found.time;
    found.frame.erase(before);
    trim(found.frame);
  }
  if (sim::utc_seconds(found.time)) return found;
  return {line, {}};
}

void take_list(const Survey& survey, const std::string& name, ListedFrames& all) {
  const std::string place = survey.place(name);
  const std::string bytes = sim::input_bytes(place, "a list of frames", kMostListBytes);
  const std::string folder = fs::path(name).parent_path().string();
  std::istringstream stream(bytes);
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    const ListLine words = list_line(line);
    if (words.frame.empty()) continue;
    const double time_s =
        words.time.empty() ? time_of_name(words.frame, place, number) : *sim::utc_seconds(words.time);
    all.frames.push_back({plain_path((fs::path(folder) / words.frame).string()), time_s, {}});
  }
  all.sources.push_back({name, sim::sha256(bytes)});
}

void take_folder(const Survey& survey, const SurveyCamera& camera, const std::string& name,
                 ListedFrames& all) {
  const std::string place = survey.place(name);
  std::vector<std::string> found;
  std::error_code error;
  fs::recursive_directory_iterator entry(place, fs::directory_options::skip_permission_denied, error);
  for (const fs::recursive_directory_iterator end; !error && entry != end; entry.increment(error)) {
    const std::string file = entry->path().filename().string();
    std::error_code of_entry;
    if (file[0] == '.') {
      if (entry->is_directory(of_entry)) entry.disable_recursion_pending();
      continue;
    }
    if (has_ending(file, camera.endings) && !entry->is_directory(of_entry))
      found.push_back(fs::path(entry->path()).lexically_relative(place).generic_string());
  }
  if (error) sim::refuse_file(sim::ErrorKind::unreadable_input, place, "cannot be read: " + error.message());
  std::sort(found.begin(), found.end());
  std::string names;
  for (const std::string& file : found) {
    names += file + "\n";
    all.frames.push_back({plain_path((fs::path(name) / file).string()),
                          time_of_name(file, (fs::path(place) / file).string(), 0),
                          {}});
  }
  all.sources.push_back({name, sim::sha256(names)});
}

/// The frames that a skip's list names, as they are called here.
std::set<std::string> names_in_list(const Survey& survey, const std::string& list, std::string& sha256) {
  const std::string bytes = sim::input_bytes(survey.place(list), "a list of frames", kMostListBytes);
  sha256 = sim::sha256(bytes);
  std::set<std::string> names;
  std::istringstream stream(bytes);
  for (std::string line; std::getline(stream, line);) {
    const ListLine words = list_line(line);
    if (!words.frame.empty()) names.insert(plain_path((fs::path(list).parent_path() / words.frame).string()));
  }
  return names;
}

void mark_skipped(const Survey& survey, const SurveyCamera& camera, ListedFrames& all) {
  for (const SurveySkip& skip : survey.skips) {
    if (!skip.camera.empty() && skip.camera != camera.name) continue;
    std::set<std::string> names;
    if (!skip.list.empty()) {
      FrameSource source{skip.list, {}};
      names = names_in_list(survey, skip.list, source.sha256);
      all.sources.push_back(source);
    }
    for (ListedFrame& frame : all.frames)
      if (frame.skip.empty() && skip.period.has(frame.time_s) &&
          (skip.list.empty() || names.count(frame.file) != 0 ||
           names.count(frame_reference(frame.file).file) != 0))
        frame.skip = skip.reason;
  }
}

}  // namespace

ListedFrames survey_frames(const Survey& survey, const SurveyCamera& camera) {
  ListedFrames all;
  for (const std::string& name : camera.frames) {
    const std::string place = survey.place(name);
    std::error_code error;
    if (fs::path(name).extension() == ".txt") {
      take_list(survey, name, all);
    } else if (fs::is_directory(place, error)) {
      take_folder(survey, camera, name, all);
    } else {
      const std::string problem = sim::why_no_input(frame_reference(place).file);
      if (!problem.empty())
        throw sim::Error(
            sim::ErrorKind::unreadable_input,
            {problem, place, 0, {}, "a folder, a list (.txt) or a frame", "named by " + survey.file});
      all.frames.push_back({plain_path(name), time_of_name(name, place, 0), {}});
    }
  }
  const auto by_time = [](const ListedFrame& a, const ListedFrame& b) {
    return std::tie(a.time_s, a.file) < std::tie(b.time_s, b.file);
  };
  std::sort(all.frames.begin(), all.frames.end(), by_time);
  const auto same = [](const ListedFrame& a, const ListedFrame& b) {
    return a.file == b.file && a.time_s == b.time_s;
  };
  all.frames.erase(std::unique(all.frames.begin(), all.frames.end(), same), all.frames.end());
  if (all.frames.empty()) {
    sim::ErrorDetails details;
    details.problem = "camera '" + camera.name + "' has no frame in its folders and lists";
    details.file = survey.file;
    details.line = camera.line;
    details.key = "camera.frames";
    details.expected = "files with the endings of pictures";
    details.hint = "'endings' names others";
    throw sim::Error(sim::ErrorKind::scene, details);
  }
  mark_skipped(survey, camera, all);
  return all;
}

}  // namespace vegard::fit
