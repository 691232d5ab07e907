#include <fmt/format.h>

#include <string_view>

#include "fit/report/plot/plot.h"
#include "fit/report/plot/plot_canvas.h"
#include "sim/base/image.h"
#include "sim/base/picture/image_io.h"
#include "sim/base/shown_text.h"
#include "sim/base/text.h"

namespace vegard::fit {
namespace {

/// Two decimals, without the zeros at their end.
std::string svg_number(double value) { return sim::without_trailing_zeros(fmt::format("{:.2f}", value)); }

std::string escaped(std::string_view text) {
  std::string out;
  // XML has no place for control characters, not even escaped, nor for bytes that are no UTF-8.
  for (const char c : sim::shown_text(text)) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string hex(Colour c) { return fmt::format("#{:02x}{:02x}{:02x}", c.r, c.g, c.b); }

std::string point_list(const std::vector<PlotPoint>& points) {
  std::string list;
  for (const PlotPoint& p : points)
    list += (list.empty() ? "" : " ") + svg_number(p.x) + "," + svg_number(p.y);
  return list;
}

class SvgCanvas : public PlotCanvas {
 public:
  void line(const std::vector<PlotPoint>& points, Colour colour, double width_px, bool dashed) override {
    svg_ += "<polyline fill=\"none\" stroke=\"" + hex(colour) + "\" stroke-width=\"" + svg_number(width_px) +
            "\" stroke-linejoin=\"round\"" + (dashed ? " stroke-dasharray=\"6 4\"" : "") + " points=\"" +
            point_list(points) + "\"/>\n";
  }

  void area(const std::vector<PlotPoint>& outline, Colour colour, double opacity) override {
    svg_ += "<polygon fill=\"" + hex(colour) + "\"" +
            (opacity < 1.0 ? " fill-opacity=\"" + svg_number(opacity) + "\"" : "") + " points=\"" +
            point_list(outline) + "\"/>\n";
  }

  void dot(PlotPoint centre, double diameter_px, Colour colour) override {
    svg_ += "<circle cx=\"" + svg_number(centre.x) + "\" cy=\"" + svg_number(centre.y) + "\" r=\"" +
            svg_number(diameter_px / 2) + "\" fill=\"" + hex(colour) + "\"/>\n";
  }

  void picture(const PlotRectangle& r, const Raster& raster) override {
    sim::Image image(raster.width, raster.height, {"R", "G", "B"});
    for (std::size_t i = 0; i < image.data.size(); ++i) image.data[i] = raster.rgb[i] / 255.0f;
    svg_ +=
        "<image x=\"" + svg_number(r.x) + "\" y=\"" + svg_number(r.y) + "\" width=\"" + svg_number(r.width) +
        "\" height=\"" + svg_number(r.height) +
        "\" preserveAspectRatio=\"none\" style=\"image-rendering:pixelated\" href=\"data:image/png;base64," +
        sim::base64(sim::encode_display(sim::ImageFormat::png, image, 8, 100, {})) + "\"/>\n";
  }

  void text(PlotPoint place, const std::string& text, const TextStyle& style) override {
    if (text.empty()) return;
    const std::string x = svg_number(place.x), y = svg_number(place.y);
    svg_ += "<text x=\"" + x + "\" y=\"" + y + "\" font-size=\"" + svg_number(style.size_px) + "\" fill=\"" +
            hex(style.colour) + "\"";
    if (style.anchor == TextAnchor::middle) svg_ += " text-anchor=\"middle\"";
    if (style.anchor == TextAnchor::end) svg_ += " text-anchor=\"end\"";
    if (style.bold) svg_ += " font-weight=\"600\"";
    if (style.upwards) svg_ += " transform=\"rotate(-90 " + x + " " + y + ")\"";
    svg_ += ">" + escaped(text) + "</text>\n";
  }

  // An inner <svg> cuts off what leaves it and, unlike a clip path, needs no id.
  void begin_clip(const PlotRectangle& r) override {
    const std::string x = svg_number(r.x), y = svg_number(r.y), w = svg_number(r.width),
                      h = svg_number(r.height);
    svg_ += "<svg x=\"" + x + "\" y=\"" + y + "\" width=\"" + w + "\" height=\"" + h + "\" viewBox=\"" + x +
            " " + y + " " + w + " " + h + "\" overflow=\"hidden\">\n";
  }
  void end_clip() override { svg_ += "</svg>\n"; }

  const std::string& svg() const { return svg_; }

 private:
  std::string svg_;
};

}  // namespace

std::string drawn_svg(const std::string& title, PlotSize size, const std::function<void(PlotCanvas&)>& draw) {
  SvgCanvas canvas;
  draw(canvas);
  const std::string w = svg_number(size.width), h = svg_number(size.height);
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + w + "\" height=\"" + h + "\" viewBox=\"0 0 " +
         w + " " + h +
         "\" role=\"img\" font-family=\"'Helvetica Neue', Helvetica, Arial, 'DejaVu Sans', sans-serif\">\n" +
         "<title>" + escaped(title) + "</title>\n" + canvas.svg() + "</svg>\n";
}

std::string plot_svg(const Plot& plot) {
  return drawn_svg(plot.title, plot_size(plot), [&](PlotCanvas& canvas) { draw_plot(plot, canvas); });
}

}  // namespace vegard::fit
