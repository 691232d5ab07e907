#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <string_view>

#include "fit/photo/codec/opencv_codecs.h"
#include "fit/report/plot/plot.h"
#include "fit/report/plot/plot_canvas.h"

namespace vegard::fit {
namespace {

constexpr int kOutputScale = 2;  ///< pixels of the file for each of the plot
constexpr int kPngFiner = 2;  ///< strokes are drawn this much finer still: OpenCV's own smoothing is coarse
constexpr int kPngScale = kOutputScale * kPngFiner;
constexpr int kPngShift = 4;  ///< fractional bits of OpenCV's coordinates

constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
constexpr double kFontCapHeight = 21.0;  ///< of that font at scale 1, in pixels
constexpr double kCapHeight = 0.72;      ///< of a sans-serif face, as a fraction of its size

cv::Scalar bgr(Colour c) {
  return {static_cast<double>(c.b), static_cast<double>(c.g), static_cast<double>(c.r)};
}

constexpr char kDegree = '\x01';  // in what spelled_in_ascii() gives

class PngCanvas : public PlotCanvas {
 public:
  explicit PngCanvas(PlotSize size)
      : whole_(static_cast<int>(std::ceil(size.height)) * kPngScale,
               static_cast<int>(std::ceil(size.width)) * kPngScale, CV_8UC3, cv::Scalar::all(255)),
        view_(whole_) {}

  void line(const std::vector<PlotPoint>& points, Colour colour, double width_px, bool dashed) override {
    if (!dashed) {
      stroke(points, colour, width_px);
      return;
    }
    for (const std::vector<PlotPoint>& dash : dashes(points)) stroke(dash, colour, width_px);
  }

  void area(const std::vector<PlotPoint>& outline, Colour colour, double opacity) override {
    const std::vector<std::vector<cv::Point>> polygon = {fixed(outline)};
    if (opacity >= 1.0) {
      cv::fillPoly(view_, polygon, bgr(colour), cv::LINE_AA, kPngShift);
      return;
    }
    cv::Mat mask(view_.size(), CV_8U, cv::Scalar(0));
    cv::fillPoly(mask, polygon, cv::Scalar(255.0 * opacity), cv::LINE_8, kPngShift);
    blend(mask, {0, 0}, colour);
  }

  void dot(PlotPoint centre, double diameter_px, Colour colour) override {
    cv::circle(view_, fixed(centre),
               static_cast<int>(std::lround(diameter_px / 2 * kPngScale * (1 << kPngShift))), bgr(colour),
               cv::FILLED, cv::LINE_AA, kPngShift);
  }

  void picture(const PlotRectangle& r, const Raster& raster) override {
    const auto edge = [](double v) { return static_cast<int>(std::lround(v * kPngScale)); };
    const int left = edge(r.x - origin_.x), top = edge(r.y - origin_.y);
    const int width = std::max(1, edge(r.width)), height = std::max(1, edge(r.height));
    for (int y = std::max(0, top); y < std::min(view_.rows, top + height); ++y) {
      auto* row = view_.ptr<cv::Vec3b>(y);
      const int from_y = static_cast<int>(static_cast<long long>(y - top) * raster.height / height);
      for (int x = std::max(0, left); x < std::min(view_.cols, left + width); ++x) {
        const int from_x = static_cast<int>(static_cast<long long>(x - left) * raster.width / width);
        const std::uint8_t* rgb = &raster.rgb[3 * (static_cast<std::size_t>(from_y) * raster.width + from_x)];
        row[x] = {rgb[2], rgb[1], rgb[0]};
      }
    }
  }

  void text(PlotPoint place, const std::string& text, const TextStyle& style) override {
    const std::string ascii = spelled_in_ascii(text);
    if (ascii.empty()) return;
    const double cap = kCapHeight * style.size_px * kPngScale;
    const double scale = cap / kFontCapHeight;
    const int stroke =
        std::max(1, static_cast<int>(std::lround(style.size_px * kPngScale * (style.bold ? 0.125 : 0.085))));
    const int border = static_cast<int>(cap);

    const int width = draw_words(nullptr, {}, ascii, scale, stroke, cap);
    cv::Mat ink(3 * border, width + 2 * border, CV_8U, cv::Scalar(0));
    cv::Point origin(border, 2 * border);  // of the base line
    draw_words(&ink, origin, ascii, scale, stroke, cap);
    const int before = style.anchor == TextAnchor::end      ? width
                       : style.anchor == TextAnchor::middle ? width / 2
                                                            : 0;
    origin.x += before;
    if (style.upwards) {
      cv::rotate(ink, ink, cv::ROTATE_90_COUNTERCLOCKWISE);
      origin = {origin.y, ink.rows - 1 - origin.x};
    }
    const cv::Point at(static_cast<int>(std::lround((place.x - origin_.x) * kPngScale)),
                       static_cast<int>(std::lround((place.y - origin_.y) * kPngScale)));
    blend(ink, at - origin, style.colour);
  }

  void begin_clip(const PlotRectangle& r) override {
    const cv::Point from(static_cast<int>(std::lround(r.x * kPngScale)),
                         static_cast<int>(std::lround(r.y * kPngScale)));
    const cv::Size size(static_cast<int>(std::lround(r.width * kPngScale)),
                        static_cast<int>(std::lround(r.height * kPngScale)));
    view_ = whole_(cv::Rect(from, size) & cv::Rect({0, 0}, whole_.size()));
    origin_ = {static_cast<double>(from.x) / kPngScale, static_cast<double>(from.y) / kPngScale};
  }

  void end_clip() override {
    view_ = whole_;
    origin_ = {};
  }

  std::string png() const {
    cv::Mat small;
    cv::resize(whole_, small, whole_.size() / kPngFiner, 0, 0, cv::INTER_AREA);
    return encoded_png(small);
  }

 private:
  cv::Point fixed(PlotPoint p) const {
    // The middle of a pixel is at whole numbers in OpenCV, at halves in the plot. Far outside is cut off, so
    // that nothing overflows.
    auto coordinate = [](double v) {
      return static_cast<int>(std::lround(std::clamp(v * kPngScale - 0.5, -3e4, 3e4) * (1 << kPngShift)));
    };
    return {coordinate(p.x - origin_.x), coordinate(p.y - origin_.y)};
  }

  std::vector<cv::Point> fixed(const std::vector<PlotPoint>& points) const {
    std::vector<cv::Point> list;
    list.reserve(points.size());
    for (const PlotPoint& p : points) list.push_back(fixed(p));
    return list;
  }

  void stroke(const std::vector<PlotPoint>& points, Colour colour, double width_px) {
    const int thickness = std::max(1, static_cast<int>(std::lround(width_px * kPngScale)));
    cv::polylines(view_, std::vector<std::vector<cv::Point>>{fixed(points)}, false, bgr(colour), thickness,
                  cv::LINE_AA, kPngShift);
  }

  static std::vector<std::vector<PlotPoint>> dashes(const std::vector<PlotPoint>& points) {
    constexpr double kOn = 6, kPeriod = 10;
    std::vector<std::vector<PlotPoint>> list;
    double along = 0.0;  // since the start of the present period
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const PlotPoint from = points[i], to = points[i + 1];
      const double length = std::hypot(to.x - from.x, to.y - from.y);
      double done = 0.0;
      while (done < length) {
        const bool on = along < kOn;
        const double step = std::min(length - done, (on ? kOn : kPeriod) - along);
        auto at = [&](double s) {
          return PlotPoint{from.x + (to.x - from.x) * s / length, from.y + (to.y - from.y) * s / length};
        };
        if (on) {
          if (along == 0.0 || list.empty()) list.push_back({at(done)});
          list.back().push_back(at(done + step));
        }
        done += step;
        along += step;
        if (along >= kPeriod - 1e-9) along = 0.0;
      }
    }
    return list;
  }

  /// Draws the words, or only measures them; returns their width.
  static int draw_words(cv::Mat* ink, cv::Point origin, const std::string& ascii, double scale, int stroke,
                        double cap) {
    int width = 0;
    std::size_t begin = 0;
    while (begin < ascii.size()) {
      if (ascii[begin] == kDegree) {
        const int radius = static_cast<int>(std::lround(0.2 * cap));
        if (ink != nullptr)
          cv::circle(*ink, {origin.x + width + 2 * radius, origin.y - static_cast<int>(cap) + radius}, radius,
                     cv::Scalar(255), stroke, cv::LINE_AA);
        width += 4 * radius;
        ++begin;
        continue;
      }
      const std::size_t end = std::min(ascii.find(kDegree, begin), ascii.size());
      const std::string words = ascii.substr(begin, end - begin);
      if (ink != nullptr)
        cv::putText(*ink, words, {origin.x + width, origin.y}, kFont, scale, cv::Scalar(255), stroke,
                    cv::LINE_AA);
      int base_line = 0;
      width += cv::getTextSize(words, kFont, scale, stroke, &base_line).width;
      begin = end;
    }
    return width;
  }

  /// Colour where the ink is, its top left corner at `at` of the view.
  void blend(const cv::Mat& ink, cv::Point at, Colour colour) {
    const cv::Rect there = cv::Rect(at, ink.size()) & cv::Rect({0, 0}, view_.size());
    const int to[3] = {colour.b, colour.g, colour.r};
    for (int y = there.y; y < there.y + there.height; ++y) {
      const auto* alpha = ink.ptr<unsigned char>(y - at.y);
      auto* row = view_.ptr<cv::Vec3b>(y);
      for (int x = there.x; x < there.x + there.width; ++x) {
        const int a = alpha[x - at.x];
        if (a == 0) continue;
        for (int c = 0; c < 3; ++c)
          row[x][c] = static_cast<unsigned char>((row[x][c] * (255 - a) + to[c] * a + 127) / 255);
      }
    }
  }

  cv::Mat whole_;
  cv::Mat view_;      ///< the part that may be drawn on
  PlotPoint origin_;  ///< its top left corner in the plot
};

}  // namespace

std::string spelled_in_ascii(std::string_view text) {
  struct Spelling {
    std::string_view character, ascii;
    bool raised = false;  // a run of such is one exponent
  };
  constexpr Spelling kSpellings[] = {
      {"\u00b0", "\x01"},    {"\u2212", "-"},       {"\u2013", "-"},       {"\u2014", "-"},
      {"\u00b1", "+/-"},     {"\u00d7", "x"},       {"\u00b7", "."},       {"\u2026", "..."},
      {"\u00b5", "u"},       {"\u03bc", "u"},       {"\u03b1", "alpha"},   {"\u03b4", "delta"},
      {"\u0394", "Delta"},   {"\u03bb", "lambda"},  {"\u03c3", "sigma"},   {"\u03c4", "tau"},
      {"\u03c7", "chi"},     {"\u2264", "<="},      {"\u2265", ">="},      {"\u2032", "'"},
      {"\u00b2", "2", true}, {"\u00b3", "3", true}, {"\u00b9", "1", true}, {"\u2070", "0", true},
      {"\u2074", "4", true}, {"\u2075", "5", true}, {"\u2076", "6", true}, {"\u2077", "7", true},
      {"\u2078", "8", true}, {"\u2079", "9", true}, {"\u207a", "+", true}, {"\u207b", "-", true},
      {"\u2080", "0"},       {"\u2081", "1"},       {"\u2082", "2"},       {"\u2083", "3"},
      {"\u2084", "4"},       {"\u2085", "5"},       {"\u2086", "6"},       {"\u2087", "7"},
      {"\u2088", "8"},       {"\u2089", "9"}};
  std::string out;
  bool raised = false;
  for (std::size_t i = 0; i < text.size();) {
    const auto* known = std::find_if(std::begin(kSpellings), std::end(kSpellings), [&](const Spelling& one) {
      return text.substr(i, one.character.size()) == one.character;
    });
    if (known != std::end(kSpellings)) {
      if (known->raised && !raised) out += '^';
      raised = known->raised;
      out += known->ascii;
      i += known->character.size();
      continue;
    }
    raised = false;
    const auto byte = static_cast<unsigned char>(text[i]);
    if (byte >= 0x20 && byte < 0x7f) out += text[i];
    if (byte >= 0xc0) out += '?';  // the first byte of an unknown character
    ++i;
  }
  return out;
}

std::string plot_png(const Plot& plot) {
  PngCanvas canvas(plot_size(plot));
  draw_plot(plot, canvas);
  return canvas.png();
}

}  // namespace vegard::fit
