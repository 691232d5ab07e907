// Small line plots for reports and documents: one description, drawn as SVG or as PNG.
//
// All lengths are in pixels of the SVG; the PNG has two pixels for each of these. Text is UTF-8. The output
// depends on nothing but the description (the PNG also on OpenCV's version).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace vegard::fit {

struct Colour {
  std::uint8_t r = 0, g = 0, b = 0;
};

/// The colours of a photograph's channels, dark enough for lines on white.
Colour channel_colour(int channel);

/// The colour of an emission line: similar to its real one, and dark enough for lines on white.
Colour line_ink(double wavelength_nm);

/// A colour for everything else: distinguishable by the colour-blind (after Okabe and Ito), repeating after
/// seven.
Colour distinct_colour(int index);

enum class Mark { line, dashed_line, points };

/// One line or cloud of points. A point that is not finite interrupts the line.
struct Series {
  std::string label;  ///< for the legend, which lists equal labels once; empty: not listed
  Colour colour;
  Mark mark = Mark::line;
  double width_px = 1.6;  ///< of the line, or the diameter of the points
  std::vector<double> x, y;
  std::vector<double> low, high;  ///< limits of the shaded band, one per point; empty: none
  bool band_along_x = false;      ///< low and high are in x (for vertical profiles), else in y
  bool error_bars = false;        ///< low and high are drawn as a bar through each point, instead of the band
};

struct Axis {
  std::string label;                     ///< with its unit: "elevation (°)"
  std::optional<double> min, max;        ///< if they are not to be computed from the data
  bool reversed = false;                 ///< growing to the left or downwards
  std::vector<double> tick_places = {};  ///< for ticks that are not computed from the limits, such as times
  std::vector<std::string> tick_labels = {};  ///< one per place
};

/// A picture behind a panel's lines, scaled to the axes.
struct Raster {
  int width = 0, height = 0;      ///< empty: none
  std::vector<std::uint8_t> rgb;  ///< row-major from the top left corner, three bytes to a pixel
  double left = 0.0, right = 1.0, top = 1.0, bottom = 0.0;  ///< positions of its edges, in the axes' units
};

struct Panel {
  std::string title;
  Axis x, y;
  std::vector<Series> series;
  Raster raster;  ///< not used to compute the limits
};

struct Plot {
  std::string title;
  std::string note;  ///< a smaller line below the title
  std::vector<Panel> panels;
  int columns = 0;           ///< panels side by side; 0: all
  bool shared_axes = false;  ///< same limits for all panels, with the first panel's labels drawn once
  int panel_width_px = 420;  ///< of the area inside the axes
  int panel_height_px = 300;
};

/// Returns a whole SVG document, without an XML declaration and without ids, so that it may be embedded in an
/// HTML page.
std::string plot_svg(const Plot& plot);

/// The bytes of a PNG file.
std::string plot_png(const Plot& plot);

}  // namespace vegard::fit
