// Renders a preview's pictures for the screen: the same as `vegard render` of the reduced scene, with
// everything reusable kept from one picture to the next.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/base/image.h"
#include "sim/render/reduced_scene.h"
#include "sim/render/render_memory.h"
#include "sim/scene/structs/scene.h"
#include "sim/view/film/composite.h"
#include "sim/view/sensor/tone_curve.h"

namespace vegard::apps {

/// 8 bits a channel: [row][column][red, green, blue].
struct ScreenPicture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

class PreviewPainter {
 public:
  explicit PreviewPainter(int threads) : threads_(threads) {}

  /// Returns the picture, empty if `stop` was raised. Throws as fit::read_composite_pictures() and the
  /// reading of volumes' files do.
  ScreenPicture paint(const sim::Scene& scene, const sim::Reduction& reduction,
                      const std::atomic<bool>* stop = nullptr);

 private:
  int threads_;
  sim::RenderMemory memory_;
  sim::CompositePictures pictures_;
  std::string pictures_key_ = "none yet", tone_key_;
  std::optional<sim::DisplayTable> display_;
};

}  // namespace vegard::apps
