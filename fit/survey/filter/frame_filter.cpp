#include "fit/survey/filter/frame_filter.h"

#include "sim/base/embedded_table.h"
#include "sim/base/file/input_file.h"
#include "sim/base/file/sha256.h"

namespace vegard::fit {
namespace {

constexpr std::size_t kMaxTreesBytes = 16 << 20;
constexpr const char* kBuiltIn = "sky_trees.json";

std::string text_of_trees(const std::string& file) {
  return file.empty() ? std::string(sim::embedded_table(kBuiltIn))
                      : sim::input_bytes(file, "trees of a filter (JSON)", kMaxTreesBytes);
}

/// Per pixel, 0 under the mask.
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

}  // namespace

FrameFilter::FrameFilter(const sim::Scene& scene, const std::string& mask, const std::string& trees)
    : cells_(filter_cells(scene, kept_by(mask, scene.camera))),
      trees_(text_of_trees(trees), trees.empty() ? kBuiltIn : trees),
      sha256_(sim::sha256(text_of_trees(trees))) {}

FilterFinding FrameFilter::look(const Photo& photo, const sim::Scene& scene, double utc_s) const {
  FilterFinding found;
  found.features = frame_features(photo, scene, cells_, utc_s);
  found.scores = trees_.scores(found.features);
  found.sky = sky_class(found.scores);
  return found;
}

}  // namespace vegard::fit
