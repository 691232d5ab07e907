#include "fit/survey/survey_eye.h"

#include <algorithm>

#include "fit/parameters/free_parameters.h"
#include "sim/base/error.h"
#include "sim/base/file/input_file.h"
#include "sim/base/file/sha256.h"
#include "sim/scene/file/named_files.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/scene/rows/decoding_word.h"
#include "sim/scene/structs/line_of.h"
#include "sim/scene/table/emission_folder.h"
#include "sim/scene/table/table_files.h"

namespace vegard::fit {
namespace {

[[noreturn]] void refuse_for_survey(const sim::Scene& scene, const std::string& key,
                                    const std::string& problem, const std::string& expected,
                                    const std::string& hint) {
  throw sim::Error(sim::ErrorKind::scene,
                   {problem, scene.file, sim::line_of(scene, key), key, expected, hint});
}

}  // namespace

void check_eye(const SurveyEye& eye, const std::vector<SurveyWork>& work) {
  const sim::Scene& scene = eye.scene;
  const auto wants = [&](SurveyWork one) { return std::count(work.begin(), work.end(), one) > 0; };
  if (wants(SurveyWork::filter) && !(sim::is_latitude_given(scene) && sim::is_longitude_given(scene)))
    refuse_for_survey(scene, "site.latitude_deg, site.longitude_deg",
                      "the filter asks where the Sun and the Moon are, and the site is not given",
                      "[site] with latitude_deg and longitude_deg",
                      "or a survey whose work is not \"filter\"");
  if (wants(SurveyWork::profile) && eye.decoding.kind == Decoding::Kind::unknown)
    refuse_for_survey(scene, "fit.decoding", "light cannot be measured through an unknown transfer curve",
                      "a decoding that is known",
                      "vegard fit --decoding unknown finds the curve of one frame");
  for (const SurveyWork one : work) {
    if (one != SurveyWork::fit && one != SurveyWork::map) continue;
    if (!scene.fit.photos.empty())
      refuse_for_survey(scene, "fit.photo", "a survey takes one photograph after another",
                        "a scene without [[fit.photo]]", "vegard fit and vegard map take them all at once");
    if (one == SurveyWork::fit && free_numbers(scene).empty())
      refuse_for_survey(scene, "fit.free", "nothing is free", "a scene with fit.free",
                        "or a survey whose work is not \"fit\"");
    if (eye.decoding.kind == Decoding::Kind::unknown)
      refuse_for_survey(
          scene, "fit.decoding", "a survey's camera has one transfer curve", "one that is known",
          "fit one frame by itself with --decoding unknown, and give all the curve that it finds");
  }
  if (!eye.mask.empty())
    if (const std::string problem = sim::why_no_input(eye.mask); !problem.empty())
      sim::refuse_file(sim::ErrorKind::unreadable_input, eye.mask, problem, "a mask");
}

std::string eye_sha256(const SurveyEye& eye, const std::string& decoding) {
  sim::Sha256 sum;
  const auto add = [&](const std::string& what, const std::string& bytes) {
    sum.add(what + " " + std::to_string(bytes.size()) + "\n" + bytes + "\n");
  };
  add("scene", sim::write_scene(eye.scene));
  for (const auto& [path, text] : eye.scene.tables) add(path, text);
  if (eye.scene.emission.folder)
    for (const auto& [file, text] : eye.scene.emission.folder->files)
      add(sim::emission_file_path(file), text);
  for (const sim::NamedFile& named : sim::named_files(eye.scene))
    for (const std::string& name : sim::files_of_name(named.name))
      add(named.path, sim::sha256_of_file(sim::table_place(eye.scene, name)));
  add("mask", eye.mask.empty() ? "" : sim::sha256_of_file(eye.mask));
  // A curve's file counts, not where it stands.
  const std::string file = decoding.empty() ? "" : sim::decoding_word(decoding).file;
  add("decoding", file.empty() ? decoding : sim::sha256_of_file(file));
  add("channel", std::to_string(eye.channel));
  if (eye.filter != nullptr) add("filter", eye.filter->sha256());
  return sum.digest();
}

}  // namespace vegard::fit
