#include "fit/report/model_picture.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <utility>

#include "fit/answer/answer.h"
#include "fit/photo/grey_light.h"
#include "fit/report/table/report_bins.h"
#include "sim/emit/aurora/sheet.h"
#include "sim/render/picture.h"
#include "sim/render/render.h"
#include "sim/view/film/composite.h"
#include "sim/view/sky/night_sky.h"

namespace vegard::fit {
namespace {

// How many times the scene's beams: enough that single ones are hardly seen, within a second or so.
constexpr int kMinTimes = 4, kMaxTimes = 16;
constexpr int kDenseBeams = 32000;  // of a layer: more than the least are not needed

int dense(int beams) {
  const int least = std::min(beams, std::numeric_limits<int>::max() / kMinTimes) * kMinTimes;
  return std::max(least, std::min(beams, kDenseBeams / kMaxTimes) * kMaxTimes);
}

/// Gain and sky of the bins that a pixel is in, where bins are no columns of rows; elsewhere the mean gain
/// and the scene's sky. A gain that the data do not determine may be a hundred times the others': the mean in
/// its place.
void add_gain_and_sky_by_bins(const FittedPhoto& fitted, sim::Image& rgb) {
  const BinGrid& grid = *fitted.data.grid;
  const bool grey = is_grey(fitted.best);
  sim::Image level(rgb.width, rgb.height, rgb.channel_names);
  sim::add_sky(fitted.best.sky, level);
  sim::Image result = level;
  const double mean_gain = fitted.best.sensor.gain_per_kilorayleigh;
  for (int y = 0; y < rgb.height; ++y)
    for (int x = 0; x < rgb.width; ++x)
      for (int c = 0; c < 3; ++c) result.at(x, y, c) += static_cast<float>(mean_gain * rgb.at(x, y, c));
  const std::vector<std::vector<bool>> constrained = constrained_gains(fitted);
  for (std::size_t bin = 0; bin < grid.bins(); ++bin)
    for (std::size_t r = grid.first_run[bin]; r < grid.first_run[bin + 1]; ++r) {
      const BinGrid::Run& run = grid.runs[r];
      for (int x = run.begin; x < run.end; ++x)
        for (int c = 0; c < 3; ++c) {
          const double behind = fitted.behind[bin * 3 + (grey ? kGreyChannel : c)];
          const int band = grid.band[bin];
          const double gain = constrained[band][c] ? fitted.gain[band][c] : mean_gain;
          result.at(x, run.y, c) = static_cast<float>(behind + gain * rgb.at(x, run.y, c));
        }
    }
  rgb = std::move(result);
}

}  // namespace

double gain_at_column(const FittedPhoto& fitted, double x_px, int channel) {
  const int bands = static_cast<int>(fitted.gain.size());
  if (bands == 0) return fitted.best.sensor.gain_per_kilorayleigh;
  const Region& region = fitted.data.region;
  const auto centre = [&](int band) {
    return 0.5 * (band_begin(region, bands, band) + band_begin(region, bands, band + 1));
  };
  int right = 0;
  while (right < bands && centre(right) < x_px) ++right;
  if (right == 0) return fitted.gain.front()[channel];
  if (right == bands) return fitted.gain.back()[channel];
  const double t = (x_px - centre(right - 1)) / (centre(right) - centre(right - 1));
  return (1.0 - t) * fitted.gain[right - 1][channel] + t * fitted.gain[right][channel];
}

sim::Scene scene_of_expectation(const FittedPhoto& fitted) {
  sim::Scene scene = fitted.best;
  for (sim::Sheet& sheet : scene.sheets) {
    sheet.spacing_jitter = 0.0;
    sheet.beams = dense(sim::beams_per_layer(sheet));
    sheet.beams_per_km = 0.0;
  }
  return scene;
}

ModelPicture model_picture(const FittedPhoto& fitted, const Photo& photo, int threads) {
  assert(photo.linear.width == fitted.best.camera.width && photo.linear.height == fitted.best.camera.height);
  sim::Scene scene = scene_of_expectation(fitted);
  const sim::Scene with_gain = scene;
  scene.sensor.exposure = sim::ExposureRule::gain;
  scene.sensor.gain_per_kilorayleigh = 1.0;
  scene.airglow = {};  // added below, at the scene's own gain
  scene.twilight = {};
  scene.light_pollution = {};
  scene.stars.shown = false;  // a fit knows of no stars
  scene.march.shrink = 1;     // and marches every cell
  sim::RenderOptions options;
  options.threads = threads;
  sim::Rendering rendering = sim::render(scene, options);

  ModelPicture picture;
  picture.rgb = std::move(rendering.aurora);
  // As in the fit, out-of-gamut light is clipped before gain and sky, or kept.
  const bool clips = !keeps_negative_light(photo);
  if (clips) sim::clip_out_of_gamut(picture.rgb);
  const bool by_bins = has_named_axes(fitted.data) && !fitted.gain.empty() && !fitted.behind.empty();
  if (by_bins) add_gain_and_sky_by_bins(fitted, picture.rgb);
  for (int x = 0; x < picture.rgb.width && !by_bins; ++x)
    for (int c = 0; c < 3; ++c) {
      const auto gain = static_cast<float>(gain_at_column(fitted, x + 0.5, c));
      for (int y = 0; y < picture.rgb.height; ++y) picture.rgb.at(x, y, c) *= gain;
    }
  if (!by_bins) sim::add_sky(scene.sky, picture.rgb);
  if (sim::has_night_sky(with_gain)) {
    sim::Image night_sky = sim::night_sky_light(with_gain, threads);
    if (clips) sim::clip_out_of_gamut(night_sky);
    sim::add_light(night_sky, 1.0, picture.rgb);
  }
  picture.rayleigh = std::move(rendering.rayleigh);
  picture.residual = photo.linear;
  for (std::size_t i = 0; i < picture.residual.data.size(); ++i)
    picture.residual.data[i] -= picture.rgb.data[i];
  if (is_grey(fitted.best))  // whose one channel was compared
    for (std::size_t i = 0; i < picture.residual.data.size(); ++i)
      picture.residual.data[i] = picture.residual.data[i - i % 3 + kGreyChannel];
  return picture;
}

}  // namespace vegard::fit
