#include "fit/measurement/sky_light.h"

#include <algorithm>
#include <utility>

#include "fit/map/map_fit.h"
#include "fit/measurement/main_border.h"
#include "fit/photo/scene_photos.h"
#include "sim/base/error.h"
#include "sim/base/file/number_text.h"
#include "sim/base/file/sha256.h"
#include "sim/base/version.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/scene/structs/line_of.h"
#include "sim/scene/table/table_files.h"

namespace vegard::fit {

std::vector<PhotoFact> take_from_photograph(sim::Scene& scene, const std::string& photo,
                                            const std::set<std::string>& changed, const Tell& tell) {
  PhotoDefaults defaults = taken_from_photograph(scene, photo, changed);
  for (const PhotoFact& fact : defaults.taken) tell("from the photograph: " + fact_text(fact));
  for (const std::string& note : defaults.notes) tell("note: " + note);
  scene = std::move(defaults.scene);
  return defaults.taken;
}

Border traced_border(const sim::Scene& scene, const Photo& photo, const BorderSettings& settings,
                     const std::string& directory, bool overwrite, const BorderRunFacts& facts,
                     const Tell& tell) {
  BorderSettings followed = settings;
  const std::string work = "tracing borders";
  followed.progress = tell.progress_of(work);
  Border border = sim::placing_errors(scene, [&] { return trace_border(photo, scene, followed); });
  write_border_run(directory, overwrite, border, photo, scene, facts);
  tell.progress(work, 1.0);
  for (std::size_t t = 0; t < border.traces.size(); ++t)
    if (border.traces[t].is_claimed() && border.traces[t].measured > 0)
      tell(border_sentence(border, t, scene));
  if (const std::string others = unclaimed_words(border); !others.empty())
    tell("not claimed to be aurora: " + others);
  for (const std::string& note : border.notes) tell(note);
  if (border.measured == 0)
    tell("no lower border was measured; the reason is given above", Tell::Tone::doubtful);
  tell(directory + "/report.html");
  return border;
}

JournalSubject subject_of_map(const MapOptions& options, const sim::Scene& scene,
                              const std::vector<Photo>& photos) {
  JournalSubject subject = {{"the version of vegard", sim::version()},
                            {"the kind of work", "a map"},
                            {"the scene", sim::sha256(sim::write_scene(scene))},
                            {"--sparsity", sim::short_number(options.sparsity, 17)},
                            {"--farthest-km", sim::short_number(options.farthest_km, 17)},
                            {"--altitude-scale", sim::short_number(options.altitude_scale, 17)},
                            {"--spectrum", sim::spectrum_word(options.spectrum.kind)},
                            {"--spread", sim::short_number(options.spectrum.spread, 17)},
                            {"--kappa", sim::short_number(options.spectrum.kappa, 17)}};
  for (const auto& [path, sum] : sim::table_sums(scene)) subject.push_back({"the table of " + path, sum});
  for (std::size_t i = 0; i < photos.size(); ++i) {
    const std::string which = photos.size() > 1 ? " " + std::to_string(i + 1) : "";
    subject.push_back({"the photograph" + which, photos[i].sha256});
    subject.push_back({"the mask" + which, photos[i].mask_sha256});
    subject.push_back({"the decoding" + which, photos[i].decoding});
  }
  return subject;
}

bool PhotoMap::is_good() const {
  return std::all_of(verdicts.begin(), verdicts.end(),
                     [](const QuantityVerdict& v) { return v.trust == Trust::good; });
}

PhotoMap mapped_photos(const sim::Scene& scene, const std::vector<Photo>& photos, MapOptions options,
                       FileJournal& journal) {
  options.journal = &journal;
  MapResult result = [&] {
    try {
      return sim::placing_errors(scene, [&] { return map_photos(scene, photos, options); });
    } catch (const sim::Error&) {
      journal.remove();  // there is nothing to go on with
      throw;
    }
  }();
  std::vector<Curtain> curtains = find_curtains(result);
  std::vector<QuantityVerdict> verdicts = map_verdicts(result, curtains);
  return {std::move(result), std::move(curtains), std::move(verdicts)};
}

void write_map(const PhotoMap& map, const std::vector<Photo>& photos, const std::string& directory,
               bool overwrite, MapRunFacts facts, const Tell& tell) {
  facts.faint = find_faint_curtains(map.result);
  for (std::size_t i = 0; i < photos.size(); ++i)
    facts.decodings.emplace_back(map.result.photos[i].name, photos[i].decoding);
  write_map_run(directory, overwrite, map.result, map.curtains, facts);
  for (const QuantityVerdict& v : map.verdicts)
    tell(v.quantity + ": " + trust_name(v.trust) + (v.value.empty() ? "" : ", ") + v.value + " (" + v.reason +
             ")",
         v.trust == Trust::good ? Tell::Tone::plain : Tell::Tone::doubtful);
  tell(std::to_string(map.curtains.size()) + " curtain" + (map.curtains.size() == 1 ? "" : "s"));
  tell(directory + "/report.html");
}

}  // namespace vegard::fit
