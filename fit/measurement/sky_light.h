// Light in the sky of a known camera: the stages that `vegard border` and `vegard map` run.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "fit/border/border.h"
#include "fit/map/curtains/curtains.h"
#include "fit/map/curtains/map_verdicts.h"
#include "fit/map/map_result.h"
#include "fit/measurement/words.h"
#include "fit/photo/photo.h"
#include "fit/photo/photo_facts.h"
#include "fit/report/border/border_run.h"
#include "fit/report/map_run.h"
#include "fit/search/file_journal.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// Takes values from the photograph's metadata into the scene which neither its file nor `changed`, paths
/// that were set after it was read, give. Tells what was taken and what the user should note. Throws
/// Error(unreadable_input), Error(scene).
std::vector<PhotoFact> take_from_photograph(sim::Scene& scene, const std::string& photo,
                                            const std::set<std::string>& changed, const Tell& tell);

/// Traces the border, writes its run directory and tells what it found. Throws as trace_border() and
/// write_border_run() do, with the scene's place.
Border traced_border(const sim::Scene& scene, const Photo& photo, const BorderSettings& settings,
                     const std::string& directory, bool overwrite, const BorderRunFacts& facts,
                     const Tell& tell);

/// What a map's journal belongs to.
JournalSubject subject_of_map(const MapOptions& options, const sim::Scene& scene,
                              const std::vector<Photo>& photos);

struct PhotoMap {
  MapResult result;
  std::vector<Curtain> curtains;
  std::vector<QuantityVerdict> verdicts;

  bool is_good() const;
};

/// map_photos() with a journal, which is removed where that throws sim::Error: there is nothing to go on
/// with. The options' progress is told that the work has ended by its destruction. Throws as map_photos()
/// does, with the scene's place.
PhotoMap mapped_photos(const sim::Scene& scene, const std::vector<Photo>& photos, MapOptions options,
                       FileJournal& journal);

/// Writes the map's directory and tells the verdicts. `facts` are completed by what the map says. Throws as
/// write_map_run() does; a finished map's journal may be dropped afterwards.
void write_map(const PhotoMap& map, const std::vector<Photo>& photos, const std::string& directory,
               bool overwrite, MapRunFacts facts, const Tell& tell);

}  // namespace vegard::fit
