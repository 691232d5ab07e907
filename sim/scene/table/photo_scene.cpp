#include "sim/scene/table/photo_scene.h"

#include <algorithm>
#include <map>
#include <set>

#include "sim/base/error.h"
#include "sim/scene/emitters/emitter_kinds.h"
#include "sim/scene/rows/complaint.h"
#include "sim/scene/rows/decoding_word.h"
#include "sim/scene/rows/parameter_rules.h"
#include "sim/scene/table/emission_folder.h"
#include "sim/scene/table/free_entry_keys.h"
#include "sim/scene/table/parameter_declarations.h"
#include "sim/scene/table/parameter_id.h"
#include "sim/scene/table/parameter_table.h"
#include "sim/scene/table/table_files.h"
#include "sim/scene/table/value_check.h"

namespace vegard::sim {
namespace {

const char* const kLines = "emission.lines";

Origin origin_of(const Scene& scene, const PhotoEntry& entry, const std::string& key) {
  return {scene.file, entry.line, std::string(free_table) + "." + photo_key + (key.empty() ? "" : "." + key)};
}

/// What steers the search as a whole is no matter of one photograph; a table's file would not be found again
/// beside a written scene.
void refuse_common_keys(const Scene& scene, const PhotoEntry& entry, const ParameterPath& path,
                        const std::string& value) {
  const Origin origin = origin_of(scene, entry, std::string(photo_set_key) + "." + path.text);
  const Declaration& declaration = declaration_of(*path.row);
  if (!declaration.of_all_photos.empty())
    throw scene_error({path.text + " is no matter of a single photograph",
                       "a path that a photograph may differ in", declaration.of_all_photos},
                      origin);
  const std::string text = value.size() > 2 ? value.substr(1, value.size() - 2) : "";
  if ((declaration.names_table && is_table_file(text)) ||
      (declaration.names_folder && !are_built_in_tables(text)))
    throw scene_error({"a table in a file cannot be set for a single photograph",
                       "the name of what is built in", "set " + path.text + " of the scene"},
                      origin);
}

template <class Code>
void with_entrys_line(const Scene& scene, const PhotoEntry& entry, const Code& code) {
  try {
    code();
  } catch (const Error& error) {
    const ErrorDetails& details = error.details();
    const std::string whose =
        details.problem.find("photograph '") != 0 ? "photograph '" + entry.name + "': " : "";
    throw Error(error)
        .problem(whose + details.problem)
        .file(scene.file)
        .line(details.line == 0 ? entry.line : details.line);
  }
}

/// To the photograph's site, what is given about the scene's.
void carry_all(const Scene& scene, Scene& of_photo) {
  const Station station = station_of_photo(scene, of_photo);
  for (Sheet& sheet : of_photo.sheets) station.carry(sheet);
  if (station.is_elsewhere()) let_emitters_stay(scene.site, of_photo);
}

std::set<ParameterId> set_by(const Scene& scene, const PhotoEntry& entry) {
  std::set<ParameterId> ids;
  for (const auto& [path, value] : entry.set)
    for (const ParameterPath& p : resolve(scene, path)) ids.insert(p.id);
  return ids;
}

/// A number that is free for all photographs is none that one of them has for itself.
void check_shared_free(const Scene& scene, const PhotoEntry& entry, const Scene& own) {
  const std::set<ParameterId> alone = set_by(own, entry);
  for (const FreeParameter& free : scene.fit.free) {
    if (!free.photo.empty() || free.path.empty()) continue;
    for (const ParameterPath& path : resolve(scene, free.path))
      if (alone.count(path.id) > 0)
        throw scene_error(
            {"free for all photographs, but '" + entry.name + "' sets it for itself",
             "shared by all or a matter of each", "give the entry of fit.free photo = \"NAME\""},
            {scene.file, free.line, path.text});
  }
}

/// Of fit.free what belongs to the photograph alone, as if there were no other, and no ties, which may be to
/// what is shared.
void leave_only_own(const PhotoEntry& entry, Scene& own) {
  std::vector<FreeParameter>& free = own.fit.free;
  free.erase(
      std::remove_if(free.begin(), free.end(), [&](const FreeParameter& f) { return f.photo != entry.name; }),
      free.end());
  for (FreeParameter& f : free) f.photo.clear();
  own.fit.tied.clear();
}

/// What stands in the observer's sky is not carried over to another site.
void refuse_sky_elsewhere(const Scene& scene, const PhotoEntry& entry, const Scene& of_photo) {
  if (!station_of_photo(scene, of_photo).is_elsewhere()) return;
  const Origin origin = origin_of(scene, entry, photo_set_key);
  Scene there = of_photo;
  for (const EmitterKind& kind : emitter_kinds()) {
    if (!is_in_scene(kind, of_photo)) continue;
    if (kind.stay_at != nullptr) {
      if (const auto complaint = kind.stay_at(there, scene.site)) throw scene_error(*complaint, origin);
      continue;
    }
    const std::string what = kind.repeated.empty() ? "[" + kind.table + "]" : "[[" + kind.table + "]]";
    throw scene_error({"taken from another site, where the scene's " + what +
                           " would be elsewhere: only aurora and volumes on the ground are carried over",
                       "photographs of it from one site", "leave the site out of the photograph's set"},
                      origin);
  }
}

void check_one(const Scene& scene, const PhotoEntry& entry) {
  with_entrys_line(scene, entry, [&] {
    Scene at_home = scene_of_photo_in_site_frame(scene, entry);
    leave_only_own(entry, at_home);
    validate(at_home);
    check_shared_free(scene, entry, at_home);
    Scene there = at_home;
    there.fit.free.clear();
    refuse_sky_elsewhere(scene, entry, at_home);
    carry_all(scene, there);
    validate(there);
  });
}

}  // namespace

Scene scene_of_photo_in_site_frame(const Scene& scene, const PhotoEntry& entry) {
  Scene own = scene;
  own.fit.photos.clear();
  own.fit.radars.clear();
  with_entrys_line(scene, entry, [&] {
    // Lines first: others are lists with an element for each of them.
    for (const bool lines : {true, false})
      for (const auto& [path, value] : entry.set) {
        if ((path == kLines) != lines) continue;
        if (path == std::string(free_table) + "." + free_key)
          throw scene_error(
              {"fit.free is no matter of a single photograph", "a path that a photograph may differ in",
               "give entries of fit.free photo = \"" + entry.name + "\""},
              origin_of(scene, entry, photo_set_key));
        refuse_common_keys(scene, entry, resolve(own, path).front(), value);
        set_from_text(own, path, value);
      }
  });
  return own;
}

void let_emitters_stay(const Site& home, Scene& of_photo) {
  for (const EmitterKind& kind : emitter_kinds())
    if (kind.stay_at != nullptr && is_in_scene(kind, of_photo)) kind.stay_at(of_photo, home);
}

Station station_of_photo(const Scene& scene, const Scene& of_photo) {
  return Station(scene.site, of_photo.site, scene.body.radius_km);
}

Scene scene_of_photo(const Scene& scene, const PhotoEntry& entry) {
  Scene own = scene_of_photo_in_site_frame(scene, entry);
  leave_only_own(entry, own);
  carry_all(scene, own);
  return own;
}

const PhotoEntry* find_photo(const Scene& scene, const std::string& name) {
  for (const PhotoEntry& entry : scene.fit.photos)
    if (entry.name == name) return &entry;
  return nullptr;
}

void check_photos(const Scene& scene) {
  std::map<std::string, int> line_of_name;
  for (const PhotoEntry& entry : scene.fit.photos) {
    if (entry.file.empty())
      throw scene_error({"the photograph has no file", "file = \"the name of an image\"", ""},
                        origin_of(scene, entry, ""));
    // It becomes part of the names of files.
    if (entry.name.find_first_of("/\\") != std::string::npos || entry.name.empty() || entry.name[0] == '.')
      throw scene_error(
          {"'" + entry.name + "' cannot be part of a file's name", "a name without slashes", ""},
          origin_of(scene, entry, "name"));
    const auto [earlier, is_new] = line_of_name.emplace(entry.name, entry.line);
    if (!is_new)
      throw scene_error(
          {"two photographs are called '" + entry.name + "'" +
               (earlier->second > 0 ? ", the first in line " + std::to_string(earlier->second) : ""),
           "a name of its own for each photograph",
           "a photograph without a name is called by its file's name without its ending"},
          origin_of(scene, entry, "name"));
    if (!entry.decoding.empty())
      if (const auto complaint = decoding_complaint(entry.decoding))
        throw scene_error(*complaint, origin_of(scene, entry, "decoding"));
  }
  for (const PhotoEntry& entry : scene.fit.photos) check_one(scene, entry);
}

}  // namespace vegard::sim
