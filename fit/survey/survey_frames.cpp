#include "fit/survey/survey_plan.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>
#include <sstream>
#include <system_error>
#include <tuple>

#include "fit/photo/frames/frame_file.h"
#include "fit/photo/frames/frame_name.h"
#include "fit/photo/frames/imager_words.h"
#include "sim/base/error.h"
#include "sim/base/file/input_file.h"
#include "sim/base/file/sha256.h"
#include "sim/base/text.h"
#include "sim/base/utc_time.h"

namespace vegard::fit {
namespace {

namespace fs = std::filesystem;

/// A list of 670 000 frames has 60 MB.
constexpr std::size_t kMaxListBytes = 1u << 30;

bool has_ending(const std::string& name, const std::vector<std::string>& endings) {
  const std::string lower = sim::lowered(name);
  return std::any_of(endings.begin(), endings.end(), [&](const std::string& ending) {
    return lower.size() > ending.size() && sim::ends_with(lower, ending);
  });
}

/// Returns "a/./b//c" as "a/b/c", so that a file has one name whichever way it was given.
std::string plain_path(const std::string& path) { return fs::path(path).lexically_normal().generic_string(); }

/// Returns the time that a file's name tells; none if it tells no time.
std::optional<sim::TimeInName> time_by_name(const std::string& name) {
  const auto imager = imager_name(name);
  return imager ? sim::TimeInName{imager->begin_s, 0, {}} : sim::time_in_name(name);
}

double time_of_name(const std::string& frame, const std::string& file, int line) {
  const std::string name = fs::path(frame_reference(frame).file).filename().string();
  const auto time = time_by_name(name);
  if (time && time->unclear.empty()) return time->utc_s();
  constexpr const char* kList =
      "a list (.txt) with lines FRAME TIME says when each was taken; 'endings' leaves other files out";
  if (time)
    throw sim::unreadable(file,
                          "the time in the name of '" + name + "' is not clear: '" + time->unclear + "'")
        .line(line)
        .expected("UTC, or an offset from it: 20190301_231000+0100.png")
        .hint(kList);
  throw sim::unreadable(file, "the name of '" + name + "' has no time")
      .line(line)
      .expected("a date and a time, as in 20190301_221000.png, taken for UTC")
      .hint(kList);
}

/// Returns whether a file may hold many frames, which its name does not tell: such files alone are opened.
bool may_have_frames(const std::string& file) {
  static const std::vector<std::string> endings = {".pgm",  ".ppm", ".pgm.gz", ".ppm.gz", ".h5",
                                                   ".hdf5", ".mat", ".cdf",    ".tar",    ".mp4",
                                                   ".m4v",  ".mov", ".avi",    ".mkv",    ".webm"};
  return has_ending(file, endings);
}

/// Where a frame, or a file of them, was named.
struct Mention {
  std::string file;  ///< to be named to the user
  int line = 0;      ///< of a list; 0: of none
};

/// By the survey's start and step; none where it gives no start.
std::optional<double> given_time_s(const SurveyCamera& camera, std::size_t number, const Mention& mention) {
  if (!camera.start_s) return std::nullopt;
  if (!(camera.step_s > 0.0))
    throw sim::unreadable(mention.file, "it follows another frame, and its time is not known")
        .line(mention.line)
        .expected("'start' alone for the frames of one film")
        .hint("'step_s' says the seconds from one frame to the next");
  return *camera.start_s + camera.step_s * static_cast<double>(number);
}

/// When a frame of a film was taken. The clock that the container may have is told, not believed.
double time_of_film_frame(const FrameHead& frame, const std::string& name, const Mention& mention) {
  const std::string plain = fs::path(name).filename().string();
  const auto begin = time_by_name(plain);
  if (begin && begin->unclear.empty()) return begin->utc_s() + *frame.stream.seconds;
  const std::string clock =
      frame.stream.clock.empty() ? "" : "; " + frame.stream.clock_source + " says " + frame.stream.clock;
  throw sim::unreadable(mention.file, "nothing says for sure when the film '" + plain + "' was taken" + clock)
      .line(mention.line)
      .expected("'start' of the camera, or the time of its first frame in the film's name");
}

/// Returns when one frame of a file was taken: the time that it tells itself, or that of the file's name if
/// it is the only frame or that of a film.
double time_of_frame(const FrameHead& frame, bool is_only, const std::string& name, const Mention& mention) {
  if (frame.time) return frame.time->seconds;
  if (frame.stream.seconds) return time_of_film_frame(frame, name, mention);
  if (is_only) return time_of_name(name, mention.file, mention.line);
  throw sim::unreadable(mention.file, "frame " + std::to_string(frame.number) + " of '" +
                                          fs::path(name).filename().string() + "' has no time")
      .line(mention.line)
      .expected("the words of an imager, #\"Image request start\"")
      .hint("a list (.txt) with lines FILE#NUMBER TIME says when each was taken");
}

/// Takes a file of frames as its frames, path#0, path#1, …, as far as it can be read; where it is damaged one
/// more stands for the rest, so that it is reported. Returns false for a file that holds no frames, or is not
/// there.
bool take_frames_of_file(const Survey& survey, const SurveyCamera& camera, const std::string& name,
                         const Mention& mention, ListedFrames& all) {
  const std::string place = survey.place(name);
  if (!may_have_frames(name) || !sim::why_no_input(place).empty()) return false;
  std::vector<FrameHead> heads;
  bool is_damaged = false;
  try {
    FrameReader reader(place);
    while (reader.next()) heads.push_back(reader.head());
  } catch (const sim::Error&) {
    is_damaged = true;
  }
  if (heads.empty()) return false;
  const std::string frame = plain_path(name);
  const bool is_only_film = all.frames.empty() && heads.front().stream.seconds;
  const auto time_s = [&](const FrameHead& head) {
    if (camera.start_s && camera.step_s == 0.0 && is_only_film) return *camera.start_s + *head.stream.seconds;
    const auto given_s = given_time_s(camera, all.frames.size(), mention);
    return given_s ? *given_s : time_of_frame(head, heads.size() == 1, name, mention);
  };
  if (heads.size() == 1 && !is_damaged) {
    all.frames.push_back({frame, time_s(heads[0]), {}});
    return true;
  }
  for (const FrameHead& head : heads)
    all.frames.push_back({name_of_frame(frame, head.number), time_s(head), {}});
  if (is_damaged)
    all.frames.push_back(
        {name_of_frame(frame, static_cast<int>(heads.size())), all.frames.back().time_s, {}});
  return true;
}

/// A line of a list: the frame, and the time after its last blank, if that is a time. Names may have blanks.
struct ListLine {
  std::string frame, time;
};
ListLine list_line(std::string line) {
  const auto trim = [](std::string& text) { text = std::string(sim::trimmed(text)); };
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

/// The time of a frame that does not tell it itself.
double time_of_picture(const SurveyCamera& camera, const std::string& frame, const Mention& mention,
                       const ListedFrames& all) {
  const auto given_s = given_time_s(camera, all.frames.size(), mention);
  return given_s ? *given_s : time_of_name(frame, mention.file, mention.line);
}

void take_list(const Survey& survey, const SurveyCamera& camera, const std::string& name, ListedFrames& all) {
  const std::string place = survey.place(name);
  const std::string bytes = sim::input_bytes(place, "a list of frames", kMaxListBytes);
  const std::string folder = fs::path(name).parent_path().string();
  std::istringstream stream(bytes);
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    const ListLine words = list_line(line);
    if (words.frame.empty()) continue;
    const std::string frame = (fs::path(folder) / words.frame).string();
    if (words.time.empty() && take_frames_of_file(survey, camera, frame, {place, number}, all)) continue;
    const double time_s = words.time.empty() ? time_of_picture(camera, words.frame, {place, number}, all)
                                             : *sim::utc_seconds(words.time);
    all.frames.push_back({plain_path(frame), time_s, {}});
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
  if (error) throw sim::unreadable(place, "cannot be read: " + error.message());
  std::sort(found.begin(), found.end());
  std::string names;
  for (const std::string& file : found) {
    names += file + "\n";
    const std::string frame = (fs::path(name) / file).string(), path = (fs::path(place) / file).string();
    if (!take_frames_of_file(survey, camera, frame, {path, 0}, all))
      all.frames.push_back({plain_path(frame), time_of_picture(camera, file, {path, 0}, all), {}});
  }
  all.sources.push_back({name, sim::sha256(names)});
}

/// Returns the frames that a skip's list names, with the names that the survey gives them.
std::set<std::string> names_in_list(const Survey& survey, const std::string& list, std::string& sha256) {
  const std::string bytes = sim::input_bytes(survey.place(list), "a list of frames", kMaxListBytes);
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
      PlanInput source{skip.list, {}};
      names = names_in_list(survey, skip.list, source.sha256);
      all.sources.push_back(source);
    }
    for (PlannedFrame& frame : all.frames)
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
      take_list(survey, camera, name, all);
    } else if (fs::is_directory(place, error)) {
      take_folder(survey, camera, name, all);
    } else {
      const std::string problem = sim::why_no_input(frame_reference(place).file);
      if (!problem.empty())
        throw sim::unreadable(place, problem)
            .expected("a folder, a list (.txt) or a frame")
            .hint("named by " + survey.file);
      if (!take_frames_of_file(survey, camera, name, {place, 0}, all))
        all.frames.push_back({plain_path(name), time_of_picture(camera, name, {place, 0}, all), {}});
    }
  }
  const auto by_time = [](const PlannedFrame& a, const PlannedFrame& b) {
    // Frames of one file go by their number, not as text.
    const FrameReference one = frame_reference(a.file), other = frame_reference(b.file);
    return std::tie(a.time_s, one.file, one.number, a.file) <
           std::tie(b.time_s, other.file, other.number, b.file);
  };
  std::sort(all.frames.begin(), all.frames.end(), by_time);
  const auto same = [](const PlannedFrame& a, const PlannedFrame& b) {
    return a.file == b.file && a.time_s == b.time_s;
  };
  all.frames.erase(std::unique(all.frames.begin(), all.frames.end(), same), all.frames.end());
  if (all.frames.empty())
    throw sim::Error(sim::ErrorKind::scene,
                     "camera '" + camera.name + "' has no frame in its folders and lists")
        .file(survey.file)
        .line(camera.line)
        .key("camera.frames")
        .expected("files with the endings of pictures")
        .hint("'endings' names others");
  mark_skipped(survey, camera, all);
  return all;
}

}  // namespace vegard::fit
