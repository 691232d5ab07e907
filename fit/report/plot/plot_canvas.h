// The canvas of a plot: the drawing operations that SVG and PNG have in common.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "fit/report/plot/plot.h"

namespace vegard::fit {

struct PlotPoint {
  double x = 0.0, y = 0.0;
};

struct PlotRectangle {
  double x = 0.0, y = 0.0, width = 0.0, height = 0.0;
};

enum class TextAnchor { start, middle, end };

struct TextStyle {
  double size_px = 12.0;
  TextAnchor anchor = TextAnchor::start;
  Colour colour;
  bool bold = false;
  bool upwards = false;  ///< rotated by 90 degrees to the left, around its position
};

/// Positions are in pixels to the right and downwards from the top left corner. The position of a text is on
/// its base line.
class PlotCanvas {
 public:
  virtual ~PlotCanvas() = default;
  virtual void line(const std::vector<PlotPoint>& points, Colour colour, double width_px, bool dashed) = 0;
  virtual void area(const std::vector<PlotPoint>& outline, Colour colour, double opacity) = 0;
  virtual void dot(PlotPoint centre, double diameter_px, Colour colour) = 0;
  virtual void text(PlotPoint place, const std::string& text, const TextStyle& style) = 0;
  /// Draws a raster's pixels, scaled to the rectangle without smoothing.
  virtual void picture(const PlotRectangle& place, const Raster& raster) = 0;
  /// Until end_clip() nothing outside the rectangle is drawn.
  virtual void begin_clip(const PlotRectangle& inside) = 0;
  virtual void end_clip() = 0;
};

struct PlotSize {
  double width = 0.0, height = 0.0;
};

PlotSize plot_size(const Plot& plot);

/// Draws the whole plot on a white background of plot_size().
void draw_plot(const Plot& plot, PlotCanvas& canvas);

/// Returns a whole SVG document with what `draw` draws, as plot_svg() does.
std::string drawn_svg(const std::string& title, PlotSize size, const std::function<void(PlotCanvas&)>& draw);

/// Returns a text for a PNG's font, which has only ASCII: an exponent as ^-3, Greek letters by their names,
/// the degree sign as the byte 1, which is drawn as a ring, and ? for unknown characters.
std::string spelled_in_ascii(std::string_view text);

/// Returns an upper estimate of a text's width: that in a wide sans-serif font (DejaVu Sans), so that nothing
/// is cut off.
double text_width_px(const std::string& text, double size_px);

}  // namespace vegard::fit
