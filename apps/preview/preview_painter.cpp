#include "apps/preview/preview_painter.h"

#include <cmath>
#include <cstdint>

#include <fmt/format.h>

#include "fit/photo/composite_pictures.h"
#include "sim/render/render.h"
#include "sim/scene/table/parameter_table.h"
#include "sim/view/sensor/sensor.h"
#include "sim/view/sensor/tone_curve.h"

namespace vegard::apps {

ScreenPicture PreviewPainter::paint(const sim::Scene& whole, const sim::Reduction& reduction,
                                    const std::atomic<bool>* stop) {
  const sim::Scene scene = sim::reduced_scene(whole, reduction);
  std::string pictures_key = fmt::format("{} x {}", scene.camera.width, scene.camera.height);
  for (const std::string& file : fit::picture_files(scene)) pictures_key += "\n" + file;
  if (pictures_key != pictures_key_) {
    pictures_ = fit::read_composite_pictures(scene);
    pictures_key_ = pictures_key;
  }
  const std::string tone_key =
      fmt::format("{} {} {}", sim::word_of(scene.sensor.tone), scene.sensor.gamma, scene.sensor.tone_file);
  if (!display_ || tone_key != tone_key_) {
    display_.emplace(sim::ToneCurve(scene));
    tone_key_ = tone_key;
  }

  sim::RenderOptions options;
  options.threads = threads_;
  options.stop = stop;
  options.pictures = &pictures_;
  options.memory = &memory_;
  const sim::Rendering rendering = sim::render(scene, options);
  if (rendering.aurora.empty()) return {};
  sim::Image light = sim::shown_light(scene, rendering);
  sim::darken(sim::Vignetting(scene), light);
  if (scene.sensor.colour_table == "none" && scene.sensor.tone != sim::ToneKind::filmic)
    return {light.width, light.height, display_->bytes(light, threads_)};
  const sim::Image shown = sim::encoded(scene, light);
  ScreenPicture picture{shown.width, shown.height, {}};
  picture.rgb.reserve(shown.data.size());
  for (const float value : shown.data)
    picture.rgb.push_back(static_cast<std::uint8_t>(std::lround(value * 255.0)));
  return picture;
}

}  // namespace vegard::apps
