#include "apps/output/layers.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "apps/options/refusals.h"
#include "sim/base/error.h"

namespace vegard::apps {
namespace {

constexpr std::array<const char*, 12> kOwnNames = {"aurora", "sky",    "night_sky",  "background",
                                                   "stars",  "mask",   "foreground", "rayleigh",
                                                   "volume", "hidden", "literal",    "ground"};

sim::Image named(const std::string& layer, sim::Image image) {
  for (std::string& name : image.channel_names) name.insert(0, layer + ".");
  return image;
}

/// The channels from `first` on.
sim::Image channels_of(const sim::Image& image, int first, std::vector<std::string> names) {
  sim::Image part(image.width, image.height, std::move(names));
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < part.channels(); ++c) part.at(x, y, c) = image.at(x, y, first + c);
  return part;
}

}  // namespace

void check_layer_names(const sim::Scene& scene) {
  for (const sim::Sheet& sheet : scene.sheets) {
    if (std::find(kOwnNames.begin(), kOwnNames.end(), sheet.name) == kOwnNames.end()) continue;
    throw with_place(
        sim::Error(sim::ErrorKind::scene, "--layers has a layer '" + sheet.name + "' that is no sheet")
            .key("sheet." + sheet.name + ".name")
            .expected("another name for the sheet"),
        scene);
  }
}

sim::Image volume_layer(const sim::Rendering& rendering) {
  return rendering.volume.empty() ? sim::Image() : named("volume", rendering.volume);
}

std::vector<sim::Image> layers_of(const sim::Scene& scene, sim::Rendering&& rendering) {
  std::vector<sim::Image> layers;
  for (sim::SheetLayer& sheet : rendering.sheets) {
    layers.push_back(named(sheet.name, std::move(sheet.aurora)));
    layers.push_back(named(sheet.name + ".rayleigh", std::move(sheet.rayleigh)));
  }
  layers.push_back(named("aurora", std::move(rendering.aurora)));
  layers.push_back(named("sky", sim::sky_light(scene)));
  if (!rendering.night_sky.empty()) layers.push_back(named("night_sky", std::move(rendering.night_sky)));
  if (!rendering.background.empty()) layers.push_back(named("background", std::move(rendering.background)));
  if (!rendering.stars.empty()) layers.push_back(named("stars", std::move(rendering.stars)));
  if (!rendering.hidden.empty()) layers.push_back(named("hidden", std::move(rendering.hidden)));
  if (!rendering.literal.empty()) layers.push_back(named("literal", std::move(rendering.literal)));
  if (!rendering.ground.empty()) layers.push_back(named("ground", std::move(rendering.ground)));
  if (!rendering.foreground.empty()) {
    layers.push_back(channels_of(rendering.foreground, 0, {"foreground.R", "foreground.G", "foreground.B"}));
    layers.push_back(channels_of(rendering.foreground, 3, {"mask"}));
  }
  return layers;
}

}  // namespace vegard::apps
