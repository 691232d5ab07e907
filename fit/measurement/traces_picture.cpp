#include "fit/measurement/traces_picture.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "fit/report/plot/plot.h"
#include "fit/report/plot/plot_canvas.h"
#include "sim/base/number/constants.h"
#include "sim/base/number/quantile.h"
#include "sim/view/camera/camera.h"

namespace vegard::fit {
namespace traces_on_photo {

constexpr int kWide_px = 1060;  // of the picture; a page is 1124 px wide inside its margins
/// Bright on a night sky, and none green as the light is.
constexpr Colour kInk[kNamedTraces] = {{255, 80, 60},  {255, 215, 0},   {60, 215, 255},
                                       {255, 95, 230}, {175, 150, 255}, {255, 255, 255}};
constexpr Colour kMoreInk{235, 190, 150}, kUnclaimedInk{150, 150, 150};

Raster photo_raster(const sim::Image& image) {
  const int shrink = std::max(1, static_cast<int>(std::lround(image.width / (1.0 * kWide_px))));
  Raster raster;
  raster.width = image.width / shrink;
  raster.height = image.height / shrink;
  raster.left = raster.top = 0.0;
  raster.right = raster.width * shrink;
  raster.bottom = raster.height * shrink;
  std::vector<double> values, green;
  for (int y = 0; y < raster.height; ++y)
    for (int x = 0; x < raster.width; ++x)
      for (int c = 0; c < 3; ++c) {
        double sum = 0.0;
        for (int k = 0; k < shrink * shrink; ++k)
          sum += image.at(x * shrink + k % shrink, y * shrink + k / shrink, c);
        values.push_back(sum / (shrink * shrink));
        if (c == 1) green.push_back(values.back());
      }
  if (values.empty()) return raster;
  const double white = sim::quantile(green, 0.998), dark = 0.8 * sim::quantile(green, 0.02);
  for (const double v : values) {
    const double x = std::clamp((v - dark) / std::max(white - dark, 1e-12), 0.0, 1.0);
    raster.rgb.push_back(static_cast<std::uint8_t>(std::lround(255.0 * std::sqrt(x))));
  }
  return raster;
}

/// The measured points of a trace in the picture, in pieces where there are gaps.
std::vector<std::vector<PlotPoint>> pieces_of(const BorderTrace& trace, const sim::CameraView<double>& view,
                                              double widest_gap_deg, double scale) {
  std::vector<std::vector<PlotPoint>> pieces(1);
  double before = sim::kNaN;
  for (const BorderPoint& p : trace.points) {
    double enu[3], x = 0.0, y = 0.0;
    sim::enu_of_direction({p.azimuth_deg, p.elevation_deg}, enu);
    const bool is_in_picture = p.measured() && sim::pixel_of_enu(view, enu, x, y);
    // High up a degree of azimuth is short.
    const double apart = std::abs(std::remainder(p.azimuth_deg - before, 360.0)) *
                         std::cos(p.elevation_deg * sim::kRadiansPerDegree);
    if (!is_in_picture || apart > widest_gap_deg) pieces.emplace_back();
    before = p.azimuth_deg;
    if (is_in_picture) pieces.back().push_back({scale * x, scale * y});
  }
  pieces.erase(
      std::remove_if(pieces.begin(), pieces.end(), [](const auto& piece) { return piece.size() < 2; }),
      pieces.end());
  return pieces;
}

std::string css(Colour c) { return fmt::format("#{:02x}{:02x}{:02x}", c.r, c.g, c.b); }

}  // namespace traces_on_photo

std::string trace_colour(std::size_t claimed) {
  return traces_on_photo::css(claimed < kNamedTraces ? traces_on_photo::kInk[claimed]
                                                     : traces_on_photo::kMoreInk);
}

std::string unclaimed_colour() { return traces_on_photo::css(traces_on_photo::kUnclaimedInk); }

std::string traces_svg(const Border& border, const Photo& photo, const sim::Scene& scene) {
  using namespace traces_on_photo;
  const Raster raster = photo_raster(photo.linear);
  const double scale = kWide_px / std::max(1.0, raster.right);
  const PlotSize size{kWide_px, scale * raster.bottom};
  const sim::CameraView<double> view = sim::camera_view(scene.camera);
  return drawn_svg("the photograph and the borders traced", size, [&](PlotCanvas& canvas) {
    canvas.picture({0.0, 0.0, size.width, size.height}, raster);
    const auto draw = [&](const BorderTrace& trace, Colour colour, double width_px, const std::string& name) {
      std::vector<PlotPoint> longest;
      for (const std::vector<PlotPoint>& piece :
           pieces_of(trace, view, 4.5 * border.cells.azimuth_step_deg, scale)) {
        canvas.line(piece, colour, width_px, false);
        if (piece.size() > longest.size()) longest = piece;
      }
      if (name.empty() || longest.empty()) return;
      TextStyle style;
      style.size_px = 24.0;
      style.bold = true;
      style.colour = colour;
      const PlotPoint middle = longest[longest.size() / 2];
      canvas.text({std::clamp(middle.x + 8.0, 0.0, size.width - 30.0), std::max(26.0, middle.y - 10.0)}, name,
                  style);
    };
    for (const BorderTrace& trace : border.traces)
      if (!trace.is_claimed() && trace.measured > 0) draw(trace, kUnclaimedInk, 1.4, "");
    std::size_t claimed = 0;
    for (std::size_t t = 0; t < border.traces.size(); ++t) {
      const BorderTrace& trace = border.traces[t];
      if (!trace.is_claimed() || trace.measured == 0) continue;
      const bool is_named = claimed < kNamedTraces;
      draw(trace, is_named ? kInk[claimed] : kMoreInk, 2.6, is_named ? std::to_string(t + 1) : "");
      ++claimed;
    }
  });
}

}  // namespace vegard::fit
