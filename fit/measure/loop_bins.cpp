#include "fit/measure/profile_bins.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "fit/measure/bin_grid.h"
#include "fit/measure/guide_curve.h"
#include "sim/base/error.h"
#include "sim/base/file/number_text.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {
namespace {

constexpr std::size_t kLoopMinPoints = 3;
constexpr int kLoopMinPositions = 5;
constexpr int kLoopPositionsEachSide = 4;  ///< whose noise is pooled: bins are small, loops narrow

void check_points(const sim::Scene& scene) {
  const std::vector<double>&x = scene.fit.guide_x_px, &y = scene.fit.guide_y_px;
  if (x.size() < kLoopMinPoints)
    throw sim::Error(sim::ErrorKind::scene,
                     std::to_string(x.size()) + " guide points are drawn along the loop")
        .file(scene.file)
        .key("fit.guide_x_px")
        .expected("three or more")
        .hint("read their pixels off the photograph, from one foot to the other");
  if (x.size() != y.size())
    throw sim::Error(sim::ErrorKind::scene, std::to_string(y.size()) + " places down for " +
                                                std::to_string(x.size()) + " places across")
        .file(scene.file)
        .key("fit.guide_y_px")
        .expected("as many of guide_y_px as of guide_x_px");
  const auto text = [&](std::size_t i) {
    return "point " + std::to_string(i) + " at (" + sim::short_number(x[i]) + ", " + sim::short_number(y[i]) +
           ")";
  };
  for (std::size_t i = 0; i < x.size(); ++i) {
    const bool is_across = x[i] >= 0.0 && x[i] <= scene.camera.width,
               is_down = y[i] >= 0.0 && y[i] <= scene.camera.height;
    if (!is_across || !is_down)
      throw sim::Error(sim::ErrorKind::scene, text(i) + " lies outside of the picture")
          .file(scene.file)
          .key(is_across ? "fit.guide_y_px" : "fit.guide_x_px")
          .expected("pixels of the photograph, " + std::to_string(scene.camera.width) + " x " +
                    std::to_string(scene.camera.height));
    if (i > 0 && x[i] == x[i - 1] && y[i] == y[i - 1])
      throw sim::Error(sim::ErrorKind::scene, text(i) + " is the one before it")
          .file(scene.file)
          .key("fit.guide_x_px")
          .expected("points apart from each other");
  }
}

/// The nearest sample of the curve to each pixel's centre, of those that are within `reach`; -1: none.
std::vector<int> nearest_samples(const GuideCurve& curve, const Region& region, double reach) {
  const std::size_t pixels = static_cast<std::size_t>(region.width) * region.height;
  std::vector<int> sample(pixels, -1);
  std::vector<double> least(pixels, std::numeric_limits<double>::infinity());
  for (std::size_t k = 0; k < curve.samples(); ++k) {
    const double x = curve.x(k) - 0.5 - region.x, y = curve.y(k) - 0.5 - region.y;
    const int left = std::max(0, static_cast<int>(std::ceil(x - reach))),
              right = std::min(region.width - 1, static_cast<int>(std::floor(x + reach))),
              top = std::max(0, static_cast<int>(std::ceil(y - reach))),
              bottom = std::min(region.height - 1, static_cast<int>(std::floor(y + reach)));
    for (int j = top; j <= bottom; ++j)
      for (int i = left; i <= right; ++i) {
        const double square = (i - x) * (i - x) + (j - y) * (j - y);
        const std::size_t at = static_cast<std::size_t>(j) * region.width + i;
        if (square >= least[at]) continue;
        least[at] = square;
        sample[at] = static_cast<int>(k);
      }
  }
  return sample;
}

}  // namespace

BinGrid loop_bins(const sim::Scene& scene, const Region& region) {
  check_points(scene);
  const sim::Fit& fit = scene.fit;
  BinGrid grid;
  grid.region = region;
  grid.groups = fit.bands;
  grid.positions = static_cast<int>(std::lround(2.0 * fit.guide_half_width_px / fit.guide_cell_px));
  if (grid.positions < kLoopMinPositions)
    throw sim::Error(sim::ErrorKind::scene, std::to_string(grid.positions) + " cells of " +
                                                sim::short_number(fit.guide_cell_px) +
                                                " px lie across the loop")
        .file(scene.file)
        .key("fit.guide_half_width_px")
        .expected("at least " + std::to_string(kLoopMinPositions))
        .hint("a wider profile, or smaller fit.guide_cell_px");
  const GuideCurve curve(fit.guide_x_px, fit.guide_y_px);
  if (curve.length_px() < fit.bands)
    throw sim::Error(sim::ErrorKind::scene, std::to_string(fit.bands) + " bands do not fit onto a curve of " +
                                                sim::short_number(curve.length_px()) + " px")
        .file(scene.file)
        .key("fit.bands")
        .expected("bands of a pixel or more");
  grid.along = {"distance across the loop", "px", -fit.guide_half_width_px, fit.guide_cell_px};
  grid.across = {"distance along the loop", "px", 0.0, curve.length_px() / fit.bands};
  grid.pooled = kLoopPositionsEachSide;
  grid.position_px = fit.guide_cell_px;
  for (int b = 0; b < grid.groups; ++b) grid.band.insert(grid.band.end(), grid.positions, b);
  const double reach = fit.guide_half_width_px + 1.0;  // the nearest sample is farther than the curve
  const std::vector<int> sample = nearest_samples(curve, region, reach);
  const double cells = grid.positions;
  gather(
      [&](int x, int y) {
        const int k = sample[static_cast<std::size_t>(y - region.y) * region.width + x - region.x];
        if (k < 0) return kNoBin;
        const GuideCurve::Nearest place = curve.nearest(static_cast<std::size_t>(k), x + 0.5, y + 0.5);
        const double position = (place.across_px - grid.along.first) / grid.along.step;
        if (place.beyond || !(position >= 0.0 && position < cells)) return kNoBin;
        const int group = std::min(grid.groups - 1, static_cast<int>(place.along_px / grid.across.step));
        return group * grid.positions + static_cast<int>(position);
      },
      grid);
  if (grid.runs.empty())
    throw sim::Error(sim::ErrorKind::scene,
                     "no pixel of the region is near the curve through the guide points")
        .file(scene.file)
        .key("fit.roi_px")
        .expected("a region that the loop is in");
  return grid;
}

}  // namespace vegard::fit
