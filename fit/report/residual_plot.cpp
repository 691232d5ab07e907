#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "fit/report/calibration_plots.h"

namespace vegard::fit {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// 1, 2 or 5 times a power of ten, not above.
double round_factor(double factor) {
  const double power = std::pow(10.0, std::floor(std::log10(factor)));
  const double first = factor / power;
  return power * (first >= 5.0 ? 5.0 : first >= 2.0 ? 2.0 : 1.0);
}

struct Ink {
  Colour used = distinct_colour(0), left_out = distinct_colour(3);
};

Panel arrows(const Calibration& calibration, double factor) {
  Panel panel;
  panel.title = "observed minus computed";
  panel.x.label = "x (px)";
  panel.x.min = 0.0;
  panel.x.max = calibration.frame.width_px;
  panel.y.label = "y (px)";
  panel.y.min = 0.0;
  panel.y.max = calibration.frame.height_px;
  panel.y.reversed = true;
  const Ink ink;
  for (const bool used : {true, false}) {
    Series lines, dots;
    lines.colour = dots.colour = used ? ink.used : ink.left_out;
    lines.label = used ? "used" : "left out";
    lines.width_px = 1.8;
    dots.mark = Mark::points;
    dots.width_px = 4.0;
    for (std::size_t i = 0; i < calibration.stars.size(); ++i) {
      const StarResidual& one = calibration.residuals[i];
      if (one.used != used || !std::isfinite(one.dx_px)) continue;
      const double x = calibration.stars[i].x_px, y = calibration.stars[i].y_px;
      dots.x.push_back(x);
      dots.y.push_back(y);
      lines.x.insert(lines.x.end(), {x, x + factor * one.dx_px, kNone});
      lines.y.insert(lines.y.end(), {y, y + factor * one.dy_px, kNone});
    }
    if (dots.x.empty()) continue;
    panel.series.push_back(lines);
    panel.series.push_back(dots);
  }
  return panel;
}

Panel by_radius(const Calibration& calibration) {
  Panel panel;
  panel.title = "by distance from the lens's centre";
  panel.x.label = "distance (px)";
  panel.y.label = "residual (px)";
  Series along, across;
  along.label = "along the radius";
  across.label = "across it";
  along.colour = distinct_colour(1);
  across.colour = distinct_colour(2);
  along.mark = across.mark = Mark::points;
  along.width_px = across.width_px = 5.0;
  for (std::size_t i = 0; i < calibration.stars.size(); ++i) {
    const StarResidual& one = calibration.residuals[i];
    if (!one.used || !(one.from_centre_px > 0.0)) continue;
    const double x =
        (calibration.stars[i].x_px - calibration.camera.numbers[centre_x_number]) / one.from_centre_px;
    const double y =
        (calibration.stars[i].y_px - calibration.camera.numbers[centre_y_number]) / one.from_centre_px;
    for (Series* series : {&along, &across}) series->x.push_back(one.from_centre_px);
    along.y.push_back(one.dx_px * x + one.dy_px * y);
    across.y.push_back(one.dy_px * x - one.dx_px * y);
  }
  Series zero;
  zero.colour = {120, 120, 120};
  zero.mark = Mark::dashed_line;
  zero.width_px = 1.0;
  if (!along.x.empty()) zero.x = {0.0, *std::max_element(along.x.begin(), along.x.end())};
  zero.y.assign(zero.x.size(), 0.0);
  panel.series = {zero, along, across};
  return panel;
}

}  // namespace

Plot residual_plot(const Calibration& calibration) {
  const double extent = std::max(calibration.frame.width_px, calibration.frame.height_px);
  const double factor = round_factor(0.06 * extent / std::max(calibration.rms_px, 1e-6));
  Plot plot;
  const bool stars = calibration.evidence == CalibrationEvidence::stars;
  plot.title =
      (stars ? "Stars, observed minus computed, " : "Maps minus camera, ") + words_of(calibration.form);
  char note[200];
  if (stars)
    std::snprintf(note, sizeof note,
                  "%d of %d stars, rms %.3f px, each by a fit without it %.3f px; arrows %g times too long",
                  calibration.used(), static_cast<int>(calibration.stars.size()), calibration.rms_px,
                  calibration.without_rms_px, factor);
  else
    std::snprintf(note, sizeof note, "%d of %d points, rms %.3g px; arrows %g times too long",
                  calibration.used(), static_cast<int>(calibration.stars.size()), calibration.rms_px, factor);
  plot.note = note;
  plot.panels = {arrows(calibration, factor), by_radius(calibration)};
  plot.panel_height_px = 360;
  return plot;
}

}  // namespace vegard::fit
