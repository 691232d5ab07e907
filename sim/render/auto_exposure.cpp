#include "sim/render/auto_exposure.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "sim/render/reduced_scene.h"

namespace vegard::sim {
namespace {

constexpr int kMaxPixels = 320;        // to a side of the picture that it is found in
constexpr double kMaxPoints = 2e7;     // and of deflection points
constexpr double kShareAbove = 0.001;  // of the pixels
// What it is found from, whatever the scene's own.
constexpr double kGainPerKilorayleigh = 0.01, kIso = 100.0;

}  // namespace

Scene auto_exposed(const Scene& scene, double white, RenderOptions options) {
  Reduction reduction;
  reduction.most = {kMaxPixels, kMaxPixels};
  reduction.points = kMaxPoints;
  Scene small = reduced_scene(scene, reduction);
  small.composite = {};
  small.sensor.gain_per_kilorayleigh = kGainPerKilorayleigh;
  small.sensor.iso = kIso;
  options.progress = {};
  options.pictures = nullptr;
  options.memory = nullptr;
  options.sheet_layers = false;
  const Rendering seen = render(small, options);
  // How many times the gain takes each pixel to white.
  std::vector<double> factors;
  for (int y = 0; y < seen.aurora.height; ++y)
    for (int x = 0; x < seen.aurora.width; ++x) {
      double factor = std::numeric_limits<double>::infinity();
      for (int c = 0; c < 3; ++c) {
        const double night_sky = seen.night_sky.empty() ? 0.0 : seen.night_sky.at(x, y, c);
        const double light = seen.aurora.at(x, y, c) + night_sky, rest = seen.rgb.at(x, y, c) - light;
        if (light > 0.0) factor = std::min(factor, std::max(0.0, white - rest) / light);
      }
      factors.push_back(factor);
    }
  const auto at = static_cast<std::ptrdiff_t>(kShareAbove * static_cast<double>(factors.size()));
  if (factors.empty()) return scene;
  std::nth_element(factors.begin(), factors.begin() + at, factors.end());
  const double factor = factors[static_cast<std::size_t>(at)];
  Scene exposed = scene;
  if (!(factor > 0.0) || !std::isfinite(factor)) return exposed;
  if (scene.sensor.exposure == ExposureRule::gain)
    exposed.sensor.gain_per_kilorayleigh = kGainPerKilorayleigh * factor;
  else
    exposed.sensor.iso = kIso * factor;
  return exposed;
}

}  // namespace vegard::sim
