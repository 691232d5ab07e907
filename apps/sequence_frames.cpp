#include "apps/sequence_frames.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "apps/usage_error.h"
#include "sim/base/error.h"

namespace vegard::apps {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(sim::ErrorKind kind, const std::string& problem, const std::string& file, int line,
                       const std::string& expected) {
  sim::ErrorDetails details;
  details.problem = problem;
  details.file = file;
  details.line = line;
  if (file.empty()) details.key = "--photos";
  details.expected = expected;
  throw sim::Error(kind, details);
}

std::vector<ListedPhoto> read_list(const std::string& list) {
  std::ifstream stream(list);
  if (!stream) fail(sim::ErrorKind::unreadable_input, "there is no such list", list, 0, "a text file");
  std::vector<ListedPhoto> photos;
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    std::istringstream words(line);
    std::string file, time, more;
    words >> file >> time >> more;
    if (file.empty() || file[0] == '#') continue;
    ListedPhoto photo{(fs::path(list).parent_path() / file).string(), NAN};
    std::size_t used = 0;
    try {
      if (!time.empty()) photo.time_s = std::stod(time, &used);
    } catch (const std::exception&) {
      used = std::string::npos;
    }
    if (used != time.size() || !more.empty() || (!time.empty() && !std::isfinite(photo.time_s)))
      fail(sim::ErrorKind::unreadable_input, "'" + line + "' cannot be understood", list, number,
           "FILE or FILE TIME_S");
    photos.push_back(photo);
  }
  if (photos.empty())
    fail(sim::ErrorKind::unreadable_input, "the list names no photograph", list, 0,
         "lines of FILE or FILE TIME_S");
  return photos;
}

}  // namespace

std::vector<ListedPhoto> listed_photos(const std::vector<std::string>& words, const std::string& key) {
  std::vector<ListedPhoto> listed;
  if (words.size() == 1 && fs::path(words[0]).extension() == ".txt")
    listed = read_list(words[0]);
  else
    for (const std::string& word : words) listed.push_back({word, NAN});
  if (listed.empty()) throw usage_error(key, "no photograph is named", "images, or a list of them");
  return listed;
}

std::vector<SequencePhoto> sequence_photos(const std::vector<std::string>& words, const sim::Scene& scene) {
  const std::vector<ListedPhoto> listed = listed_photos(words, "--photos");
  std::vector<SequencePhoto> photos;
  std::set<std::string> names;
  for (const ListedPhoto& one : listed) {
    SequencePhoto photo{fs::path(one.file).stem().string(), one.file, one.time_s};
    if (std::isnan(photo.time_s))
      photo.time_s = scene.time.start_s + static_cast<double>(photos.size()) / scene.time.frames_per_second;
    if (!names.insert(photo.name).second)
      fail(sim::ErrorKind::usage, "two photographs are called '" + photo.name + "'", "", 0,
           "a name of its own for each");
    photos.push_back(photo);
  }
  return photos;
}

}  // namespace vegard::apps
