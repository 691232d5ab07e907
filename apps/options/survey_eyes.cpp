#include "apps/options/survey_eyes.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>
#include <utility>

#include "apps/options/photo_options.h"
#include "apps/options/scene_options.h"
#include "sim/base/error.h"
#include "sim/scene/rows/decoding_word.h"

namespace vegard::apps {
namespace {

/// A curve's file stands where the survey's other files do.
std::string placed_decoding(const fit::SurveyCamera& camera, const SurveyPlaces& place) {
  if (camera.decoding.empty()) return {};
  const std::string file = sim::decoding_word(camera.decoding).file;
  return file.empty() ? camera.decoding : std::string(sim::kCurveWord) + place(file);
}

}  // namespace

std::string SurveyPlaces::operator()(const std::string& name) const {
  return name.empty() ? "" : (std::filesystem::path(folder) / name).string();
}

fit::SurveyEye survey_eye(const fit::SurveyCamera& camera, int calibration, const SurveyPlaces& place,
                          const std::vector<fit::SurveyWork>& work) {
  const fit::SurveyCalibration& one = camera.calibrations.at(static_cast<std::size_t>(calibration));
  SceneOptions options;
  options.file = place(camera.scene.empty() ? one.file : camera.scene);
  if (!camera.scene.empty()) options.camera_file = place(one.file);
  options.changes = camera.changes;
  fit::SurveyEye eye;
  eye.scene = scene_of(options);
  eye.decoding = decoding_of(placed_decoding(camera, place), eye.scene.fit.decoding, &eye.scene);
  eye.mask = place(one.mask);
  eye.channel = camera.channel;
  fit::check_eye(eye, work);
  if (std::count(work.begin(), work.end(), fit::SurveyWork::filter) > 0)
    eye.filter = std::make_shared<fit::FrameFilter>(eye.scene, eye.mask, place(camera.filter));
  return eye;
}

fit::PlanInput survey_setup(const fit::SurveyCamera& camera, int calibration, const SurveyPlaces& place,
                            const std::vector<fit::SurveyWork>& work) {
  const fit::SurveyEye eye = survey_eye(camera, calibration, place, work);
  return {fit::setup_words(camera, calibration), fit::eye_sha256(eye, placed_decoding(camera, place))};
}

fit::SurveyEye planned_eye(const fit::SurveyPlan& plan, int camera, int calibration) {
  const fit::SurveyCamera& planned = plan.cameras.at(static_cast<std::size_t>(camera));
  const SurveyPlaces place{plan.place("")};
  fit::SurveyEye eye = survey_eye(planned, calibration, place, plan.work);
  const std::string what = fit::setup_words(planned, calibration);
  if (fit::eye_sha256(eye, placed_decoding(planned, place)) != plan.sha256_of(what))
    throw sim::Error(sim::ErrorKind::existing_output,
                     what + " (scene, camera, mask, decoding) is not what it was when the plan was made")
        .file(plan.file)
        .hint("make a new plan, or put back what has changed");
  return eye;
}

void check_planned_eyes(const fit::SurveyPlan& plan) {
  std::set<std::pair<int, int>> seen;
  for (const fit::PlannedBlock& block : plan.blocks)
    if (block.calibration >= 0 && seen.emplace(block.camera, block.calibration).second)
      planned_eye(plan, block.camera, block.calibration);
}

}  // namespace vegard::apps
