#include "sim/render/auto_exposure.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "sim/render/reduced_scene.h"
#include "sim/scene/emitters/emitter_kinds.h"
#include "sim/scene/freedom/ties.h"
#include "sim/scene/table/parameter_table.h"

namespace vegard::sim {
namespace {

constexpr int kMaxPixels = 320;        // to a side of the picture that it is found in
constexpr double kMaxPoints = 2e7;     // and of deflection points
constexpr double kShareAbove = 0.001;  // of the pixels
// The gain and the ISO number that a factor of 1 stands for, whatever the scene's own.
constexpr double kGainPerKilorayleigh = 0.01, kIso = 100.0;

void scale_gain(Sensor& sensor, double factor) {
  sensor.gain_per_kilorayleigh = kGainPerKilorayleigh * factor;
  sensor.iso = kIso * factor;
}

/// Returns the part of a picture that no gain changes: sky.level and nebulae of the literal march, where the
/// ground and absorbers leave them visible.
Image constant_light(Scene scene, const RenderOptions& options) {
  constexpr double kNearlyNothing = 1e-9;
  scale_gain(scene.sensor, kNearlyNothing);
  if (!has_emitters_of_sheets(scene)) scene.sheets.clear();  // they hide nothing
  return render(scene, options).rgb;
}

}  // namespace

std::optional<Scene> auto_exposed(const Scene& scene, double white, RenderOptions options) {
  Reduction reduction;
  reduction.most = {kMaxPixels, kMaxPixels};
  reduction.points = kMaxPoints;
  Scene small = reduced_scene(scene, reduction);
  small.composite = {};
  scale_gain(small.sensor, 1.0);
  options.progress = {};
  options.pictures = nullptr;
  options.memory = nullptr;
  options.sheet_layers = false;
  const Image seen = render(small, options).rgb, constant = constant_light(small, options);
  // How many times the gain takes each pixel to white.
  std::vector<double> factors;
  for (int y = 0; y < seen.height; ++y)
    for (int x = 0; x < seen.width; ++x) {
      double factor = std::numeric_limits<double>::infinity();
      for (int c = 0; c < 3; ++c) {
        const double rest = constant.at(x, y, c), light = seen.at(x, y, c) - rest;
        if (light > 0.0) factor = std::min(factor, std::max(0.0, white - rest) / light);
      }
      factors.push_back(factor);
    }
  const auto at = static_cast<std::ptrdiff_t>(kShareAbove * static_cast<double>(factors.size()));
  if (factors.empty()) return std::nullopt;
  std::nth_element(factors.begin(), factors.begin() + at, factors.end());
  const double factor = factors[static_cast<std::size_t>(at)];
  if (!(factor > 0.0) || !std::isfinite(factor)) return std::nullopt;
  Scene exposed = scene;
  const bool by_gain = scene.sensor.exposure == ExposureRule::gain;
  double& value = by_gain ? exposed.sensor.gain_per_kilorayleigh : exposed.sensor.iso;
  value = (by_gain ? kGainPerKilorayleigh : kIso) * factor;
  const char* path = by_gain ? "sensor.gain_per_kilorayleigh" : "sensor.iso";
  if (!is_within_limits(resolve(scene, path).front(), value)) return std::nullopt;
  return exposed;
}

}  // namespace vegard::sim
