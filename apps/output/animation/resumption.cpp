#include "apps/output/animation/resumption.h"

#include <filesystem>
#include <system_error>
#include <utility>

#include <nlohmann/json.hpp>

#include "fit/photo/composite_pictures.h"
#include "sim/base/error.h"
#include "sim/base/file/durable_rename.h"
#include "sim/base/file/input_file.h"
#include "sim/base/file/sha256.h"
#include "sim/base/file/whole_file.h"
#include "sim/base/version.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/scene/table/table_files.h"

namespace vegard::apps {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kManifest = "animation.json";

/// What to say if an entry of the manifest is not the same.
constexpr std::pair<const char*, const char*> kDifferences[] = {
    {"frames", "the names of the frames differ"},
    {"frames_per_second", "the frames per second differ"},
    {"seed", "the seed differs"},
    {"scene_sha256", "the scene differs"},
    {"pictures_sha256", "a file that the scene names differs"},
    {"tables_sha256", "a table that the scene names differs"},
    {"photograph", "--photograph differs"},
    {"bits", "the bits per channel differ"},
    {"quality", "the quality differs"},
    {"version", "the version of vegard differs"}};

/// The scene without what no frame depends on, or what the manifest has by itself.
sim::Scene as_frames_see(const sim::Scene& scene) {
  sim::Scene seen = scene;
  seen.time.frames = sim::Time().frames;
  seen.time.frames_per_second = sim::Time().frames_per_second;
  seen.fit = sim::Fit();
  return seen;
}

/// True for what manifest_text() has given, in this version or an older one.
bool is_manifest_of_frames(const std::string& text) {
  const Json json = Json::parse(text, nullptr, false);
  return json.is_object() && json.contains("frames") && json.contains("scene_sha256") &&
         json.contains("version");
}

/// Numbers of all frames that stand in the folder, whether wanted or not, finished or not.
std::set<int> frames_on_disk(const FrameNames& names) {
  std::set<int> found;
  std::error_code error;
  for (fs::directory_iterator entry(names.folder(), error), end; !error && entry != end;
       entry.increment(error))
    if (const std::optional<int> frame = names.frame_of(entry->path().filename().string()))
      found.insert(*frame);
  return found;
}

/// Throws unless a file may stand there.
void refuse_all_but_files(const std::string& file) {
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored)) sim::WholeFile(file, true);
}

/// Which of the wanted frames are whole. An empty file is none, and holds nothing that removing it could
/// lose.
std::set<int> finished_frames(const FrameNames& names, const std::set<int>& found,
                              const std::set<int>& wanted) {
  std::set<int> finished;
  for (const int frame : found) {
    if (wanted.count(frame) == 0) continue;
    const std::string file = names.file(frame);
    refuse_all_but_files(file);
    std::error_code error;
    if (!fs::is_empty(file, error)) {
      finished.insert(frame);
      continue;
    }
    fs::remove(file, error);
    if (error) throw sim::unwritable(file, error.value());
  }
  return finished;
}

/// What a process that was killed outright has left of the wanted frames. Those of other frames may be
/// another machine's, at work in the same folder; its processes are not known here.
void remove_orphans(const FrameNames& names, const std::set<int>& wanted) {
  std::vector<fs::path> orphans;
  std::error_code ignored;
  for (fs::directory_iterator entry(names.folder(), ignored), end; !ignored && entry != end;
       entry.increment(ignored)) {
    const std::optional<sim::Partial> partial = sim::partial_of(entry->path().filename().string());
    if (!partial || !sim::is_stale_partial(entry->path().string(), S_IFREG)) continue;
    const std::optional<int> frame = names.frame_of(partial->target);
    if (frame && wanted.count(*frame) != 0) orphans.push_back(entry->path());
  }
  for (const fs::path& orphan : orphans) fs::remove(orphan, ignored);
}

/// In what two manifests differ, in words.
std::string difference(const std::string& mine, const std::string& theirs) {
  const Json a = Json::parse(mine, nullptr, false), b = Json::parse(theirs, nullptr, false);
  if (!b.is_object()) return "is no manifest of frames";
  for (const auto& [key, words] : kDifferences)
    if (a.value(key, Json()) != b.value(key, Json())) return std::string("is of another animation: ") + words;
  return "is of another animation";
}

sim::Error other_animation(const std::string& file, const std::string& problem, const std::string& hint) {
  return sim::Error(sim::ErrorKind::existing_output, problem).file(file).hint(hint);
}

}  // namespace

std::string manifest_text(const sim::Scene& scene, double frames_per_second, const FrameNames& names,
                          const PictureOptions& picture) {
  Json json;
  json["frames"] = names.pattern();
  json["frames_per_second"] = frames_per_second;
  json["seed"] = scene.seed;
  json["scene_sha256"] = sim::sha256(sim::write_scene(as_frames_see(scene)));
  for (const std::string& file : fit::picture_files(scene))
    json["pictures_sha256"].push_back(sim::sha256_of_file(file));
  for (const auto& [path, sum] : sim::table_sums(scene)) json["tables_sha256"][path] = sum;
  if (picture.photograph) json["photograph"] = true;
  if (picture.bits) json["bits"] = *picture.bits;
  if (picture.quality) json["quality"] = *picture.quality;
  json["version"] = sim::version();
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::set<int> begin_or_resume(const FrameNames& names, const std::string& manifest,
                              const std::vector<int>& frames, bool overwrite, bool own_folder) {
  std::error_code error;
  fs::create_directories(names.folder(), error);
  if (error) throw sim::unwritable(names.folder(), error.value());

  const std::string file = names.companion(kManifest);
  const bool has_manifest = fs::exists(fs::symlink_status(file, error));
  const std::set<int> found = frames_on_disk(names);
  const std::set<int> wanted(frames.begin(), frames.end());
  const std::string found_manifest = sim::read_input(file).bytes;
  if (has_manifest && found_manifest == manifest) {
    remove_orphans(names, wanted);
    return finished_frames(names, found, wanted);
  }

  if (!overwrite) {
    const std::string hint = "use --overwrite to replace the frames, or choose another name";
    if (has_manifest) throw other_animation(file, difference(manifest, found_manifest), hint);
    if (!found.empty())
      throw other_animation(names.file(*found.begin()), "exists already, and nothing says of which animation",
                            hint);
  }
  if (has_manifest && !is_manifest_of_frames(found_manifest))
    throw other_animation(file, "is not replaced: it is no manifest of frames that vegard wrote",
                          "move it, or choose another name");
  if (own_folder && !has_manifest && !found.empty())
    throw other_animation(names.file(*found.begin()),
                          "is not replaced: no animation.json beside it says that it is vegard's",
                          "move it, or choose another name");
  for (const int frame : found)
    if (!own_folder && wanted.count(frame) == 0)
      throw other_animation(names.file(frame),
                            "is of another animation and not among the frames to be written",
                            "remove it, or choose another name");
  for (const int frame : found) refuse_all_but_files(names.file(frame));
  for (const int frame : found) {
    fs::remove(names.file(frame), error);
    if (error) throw sim::unwritable(names.file(frame), error.value());
  }
  remove_orphans(names, wanted);
  sim::write_whole(file, manifest, overwrite);
  return {};
}

void remove_beginning(const FrameNames& names, bool made_folder) {
  if (!frames_on_disk(names).empty()) return;
  std::error_code ignored;
  fs::remove(names.companion(kManifest), ignored);
  if (made_folder) fs::remove(names.folder(), ignored);
}

void remove_animation(const FrameNames& names, const std::vector<int>& frames) {
  std::error_code ignored;
  for (const int frame : frames) fs::remove(names.file(frame), ignored);
  if (!frames_on_disk(names).empty()) return;
  fs::remove(names.companion(kManifest), ignored);
  fs::remove(names.folder(), ignored);
}

}  // namespace vegard::apps
