#include "fit/survey/filter/frame_filter.h"

#include "sim/base/data_folders.h"
#include "sim/base/file/input_file.h"
#include "sim/base/file/sha256.h"

namespace vegard::fit {
namespace {

constexpr std::size_t kMaxModelBytes = 16 << 20;
constexpr const char* kBuiltInModel = "sky_kinds.json";

std::string text_of_model(const std::string& file) {
  return file.empty() ? std::string(sim::embedded_table(kBuiltInModel))
                      : sim::input_bytes(file, "model of the sky (JSON)", kMaxModelBytes);
}

/// Returns a flag for each pixel: 0 under the mask.
std::vector<std::uint8_t> kept_by(const std::string& mask, const sim::Camera& camera) {
  if (mask.empty()) return {};
  Photo blank;
  blank.linear = sim::Image(camera.width, camera.height, {"R", "G", "B"});
  blank.usable.assign(blank.linear.data.size(), 1);
  apply_mask(blank, mask);
  std::vector<std::uint8_t> kept(blank.usable.size() / 3);
  for (std::size_t i = 0; i < kept.size(); ++i) kept[i] = blank.usable[3 * i];
  return kept;
}

constexpr double kLikelierThanNot = 0.5;

}  // namespace

FrameFilter::FrameFilter(const sim::Scene& scene, const std::string& mask, const std::string& model)
    : cells_(filter_cells(scene, kept_by(mask, scene.camera))),
      model_(text_of_model(model), model.empty() ? kBuiltInModel : model),
      sha256_(sim::sha256(text_of_model(model))) {}

FilterFinding FrameFilter::classify(const Photo& photo, const sim::Scene& scene, double utc_s) const {
  FilterFinding found;
  found.features = frame_features(photo, scene, cells_, utc_s);
  found.scores = model_.scores(found.features);
  found.sky = sky_class(found.scores);
  return found;
}

bool has_arc(const SkyScores& scores) { return score(scores, SkyQuestion::arc) > kLikelierThanNot; }

std::string sky_class(const SkyScores& scores) {
  for (const SkyQuestion question : {SkyQuestion::arc, SkyQuestion::twilight, SkyQuestion::cloud,
                                     SkyQuestion::moon, SkyQuestion::lamp, SkyQuestion::aurora})
    if (score(scores, question) > kLikelierThanNot) return sky_question_name(question);
  return "dark";
}

}  // namespace vegard::fit
