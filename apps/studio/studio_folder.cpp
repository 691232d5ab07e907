#include "apps/studio/studio_folder.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <map>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/options/refusals.h"
#include "sim/base/error.h"
#include "sim/base/file/whole_file.h"

namespace vegard::apps {
namespace {

namespace files = std::filesystem;

constexpr int kDeepest = 3;
constexpr std::size_t kMostListed = 2000;

std::string lower_end(const std::string& name) {
  std::string end = files::path(name).extension().string();
  std::transform(end.begin(), end.end(), end.begin(), [](unsigned char c) { return std::tolower(c); });
  return end;
}

bool is_photograph(const std::string& name) {
  static const std::vector<std::string> ends = {
      ".jpg", ".jpeg", ".png", ".tif", ".tiff", ".heic", ".heif", ".webp", ".fits", ".fit", ".fts",  ".exr",
      ".cr2", ".cr3",  ".nef", ".arw", ".dng",  ".raf",  ".orf",  ".rw2",  ".pgm",  ".ppm", ".avif", ".jp2"};
  return std::find(ends.begin(), ends.end(), lower_end(name)) != ends.end();
}

/// Whether a path is inside of the folder, or the folder itself.
bool is_below(const files::path& path, const files::path& folder) {
  const auto ends = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
  return ends.first == folder.end();
}

bool is_hidden(const files::path& name) {
  return std::any_of(name.begin(), name.end(),
                     [](const files::path& part) { return part.string().substr(0, 1) == "."; });
}

}  // namespace

StudioFolder::StudioFolder() : folder_(files::canonical(files::current_path()).string()) {}

std::string StudioFolder::path_of(const std::string& name) const {
  std::error_code trouble;
  const files::path wanted = name;
  if (name.empty() || wanted.is_absolute() || is_hidden(wanted) || name.find('\0') != std::string::npos)
    return {};
  const files::path real = files::canonical(files::path(folder_) / wanted, trouble);
  return trouble || !is_below(real, folder_) ? std::string() : real.string();
}

std::string StudioFolder::name_of(const std::string& word) const {
  std::error_code trouble;
  const files::path real = files::canonical(word, trouble);
  return trouble || !is_below(real, folder_) ? std::string() : real.lexically_relative(folder_).string();
}

std::string StudioFolder::listing_json() const {
  std::error_code trouble;
  std::multimap<files::file_time_type, nlohmann::ordered_json, std::greater<>> found;
  auto place =
      files::recursive_directory_iterator(folder_, files::directory_options::skip_permission_denied, trouble);
  for (; !trouble && place != files::recursive_directory_iterator() && found.size() < kMostListed;
       place.increment(trouble)) {
    const files::path path = place->path();
    const std::string name = path.lexically_relative(folder_).string();
    std::error_code unknown;
    const bool is_folder = place->is_directory(unknown);
    const bool is_run = is_folder && files::exists(path / "report.html", unknown);
    // What is in a run belongs to it.
    if (is_folder && (is_run || is_hidden(path.filename()) || place.depth() + 1 >= kDeepest))
      place.disable_recursion_pending();
    const std::string kind = is_hidden(path.filename())                 ? ""
                             : is_run                                   ? "run"
                             : !is_folder && is_photograph(name)        ? "photograph"
                             : !is_folder && lower_end(name) == ".toml" ? "scene"
                                                                        : "";
    if (kind.empty()) continue;
    nlohmann::ordered_json entry = {{"name", name}, {"kind", kind}};
    if (is_run) {
      entry["has"] = nlohmann::ordered_json::array();
      for (const char* part : {"stars.csv", "measure.json", "together.json", "map.json"})
        if (files::exists(path / part, unknown)) entry["has"].push_back(part);
    }
    found.emplace(files::last_write_time(path, unknown), entry);
  }
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const auto& [time, entry] : found) list.push_back(entry);
  return list.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::string StudioFolder::put(
    const std::string& name,
    const std::function<bool(const std::function<bool(const char*, std::size_t)>&)>& receive) const {
  const files::path wanted = files::path(name).filename();
  const bool is_bad =
      wanted.empty() || is_hidden(wanted) || wanted.string().size() > 200 ||
      std::any_of(name.begin(), name.end(), [](unsigned char c) { return c < 32 || c == 127 || c == '\\'; });
  if (is_bad)
    throw usage_error("the studio", "'" + name + "' is no name for a file",
                      "a name without folders, as aurora.jpg");
  std::string chosen = wanted.string();
  for (int number = 2; files::exists(files::path(folder_) / chosen); ++number)
    chosen = fmt::format("{}_{}{}", wanted.stem().string(), number, wanted.extension().string());
  sim::WholeFile file((files::path(folder_) / chosen).string());
  std::ofstream stream(file.temporary(), std::ios::binary);
  const bool came = receive([&](const char* bytes, std::size_t count) {
    stream.write(bytes, static_cast<std::streamsize>(count));
    return stream.good();
  });
  stream.close();
  if (!came || !stream)
    throw sim::Error(sim::ErrorKind::unwritable_output, "not all of it came, or could be written")
        .file(chosen);
  file.commit();
  return chosen;
}

bool stays_inside(const std::string& word) {
  // A value may stand behind "=", in quotes or between commas.
  std::string part;
  const auto is_outside = [](const std::string& p) {
    if (!p.empty() && p.front() == '/') return true;
    const files::path path = p;
    return std::find(path.begin(), path.end(), "..") != path.end();
  };
  for (const char c : word + "=") {
    if (c != '=' && c != '"' && c != '\'' && c != ',' && c != '[' && c != ' ') {
      part += c;
      continue;
    }
    if (is_outside(part)) return false;
    part.clear();
  }
  return true;
}

std::string content_type(const std::string& name) {
  static const std::map<std::string, std::string> types = {{".html", "text/html; charset=utf-8"},
                                                           {".css", "text/css; charset=utf-8"},
                                                           {".js", "text/javascript; charset=utf-8"},
                                                           {".svg", "image/svg+xml"},
                                                           {".png", "image/png"},
                                                           {".jpg", "image/jpeg"},
                                                           {".jpeg", "image/jpeg"},
                                                           {".webp", "image/webp"},
                                                           {".avif", "image/avif"},
                                                           {".json", "application/json"},
                                                           {".csv", "text/plain; charset=utf-8"},
                                                           {".toml", "text/plain; charset=utf-8"}};
  const auto found = types.find(lower_end(name));
  return found != types.end() ? found->second : "application/octet-stream";
}

}  // namespace vegard::apps
