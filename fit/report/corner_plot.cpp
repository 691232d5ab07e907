#include "fit/report/corner_plot.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "fit/report/plot/plot.h"
#include "fit/report/plot/plot_axis.h"
#include "fit/report/plot/plot_canvas.h"
#include "fit/uncertainty/band_bootstrap.h"
#include "sim/base/file/number_text.h"
#include "sim/base/text.h"
#include "sim/scene/table/parameter_id.h"

namespace vegard::fit {

CornerData corner_data(const FitResult& result) {
  CornerData data;
  const std::size_t n = result.parameters.size();
  const bool one_sheet = result.best.sheets.size() == 1;
  const bool has_chain = result.chain && !result.chain->samples.empty();
  std::vector<std::size_t> shown;
  for (std::size_t j = 0; j < n && result.correlation.size() == n; ++j) {
    const FittedParameter& p = result.parameters[j];
    if (p.of_profile) continue;
    if (p.sigma || (has_chain && result.chain->sigma[j] > 0.0))
      shown.push_back(j);
    else
      data.left_out.push_back(sim::short_path(p.path, one_sheet));
  }
  for (const std::size_t j : shown) {
    const FittedParameter& p = result.parameters[j];
    data.parameters.push_back({sim::short_path(p.path, one_sheet), p.unit, p.value, p.sigma});
    data.correlation.emplace_back();
    for (const std::size_t k : shown) data.correlation.back().push_back(result.correlation[j][k]);
  }
  if (has_chain)
    for (std::size_t i = 0; i < result.chain->samples.size(); i += n)
      for (const std::size_t j : shown) data.samples.push_back(result.chain->samples[i + j]);
  return data;
}

std::vector<std::size_t> most_correlated(const CornerData& data, std::size_t most) {
  const std::size_t n = data.parameters.size();
  std::vector<std::size_t> order;
  std::vector<double> strongest(n, 0.0);
  for (std::size_t j = 0; j < n; ++j) {
    order.push_back(j);
    for (std::size_t k = 0; k < n; ++k)
      if (j != k && std::isfinite(data.correlation[j][k]))
        strongest[j] = std::max(strongest[j], std::abs(data.correlation[j][k]));
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return strongest[a] > strongest[b]; });
  order.resize(std::min(order.size(), most));
  std::sort(order.begin(), order.end());
  return order;
}

namespace {

constexpr std::size_t kMax = 10;
constexpr double kWide = 760.0, kMinCell = 78.0, kMaxCell = 210.0;  // of all cells, of one
constexpr double kCornerGap = 8.0, kCornerEdge = 18.0, kCornerLeft = 74.0, kCornerBelow = 44.0;
constexpr double kNameSize = 12.0, kValueSize = 11.0, kCornerTickSize = 9.5, kCornerNoteSize = 12.0,
                 kCornerTitleSize = 16.0;
constexpr double kNameHeight = 34.0;  // name and value above the first cell
constexpr double kCornerNoteHeight = 18.0;
constexpr double kSigmas = 2.8;      // shown to either side
constexpr double kMinShare = 0.003;  // of the samples may fall outside
constexpr std::size_t kMaxDots = 7000, kMaxDotsOfOne = 2000;
constexpr int kBins = 24;
constexpr Colour kCornerInk{38, 38, 38}, kSoftInk{95, 95, 95}, kFrame{170, 170, 170};

Colour covariance_ink() { return distinct_colour(0); }
Colour chain_ink() { return distinct_colour(1); }

TextStyle style(double size, Colour colour, TextAnchor anchor = TextAnchor::start, bool bold = false) {
  TextStyle s;
  s.size_px = size;
  s.colour = colour;
  s.anchor = anchor;
  s.bold = bold;
  return s;
}

struct Range {
  double min = 0.0, max = 1.0;
};

std::string value_text(const CornerParameter& p) {
  const std::string number = sim::number_with_error(p.value, p.sigma);
  if (p.unit == "deg") return number + "\u00b0";
  return p.unit.empty() ? number : number + " " + p.unit;
}

/// Everything about one parameter that the drawing needs.
struct Side {
  CornerParameter parameter;
  std::vector<double> samples;
  Range range;
  AxisTicks ticks;
  std::string axis_name;
};

Range range_of(const CornerParameter& p, const std::vector<double>& samples) {
  double low = p.value, high = p.value;
  if (p.sigma) {
    low -= kSigmas * *p.sigma;
    high += kSigmas * *p.sigma;
  }
  if (!samples.empty()) {
    std::vector<double> sorted = samples;
    std::sort(sorted.begin(), sorted.end());
    const double least = percentile(sorted, kMinShare), most = percentile(sorted, 1.0 - kMinShare);
    low = std::min(low, least - 0.05 * (most - least));
    high = std::max(high, most + 0.05 * (most - least));
  }
  if (!(high - low > 1e-9 * std::max(std::abs(low), std::abs(high)))) {
    const double half = p.value == 0.0 ? 1.0 : 0.1 * std::abs(p.value);
    return {p.value - half, p.value + half};
  }
  return {low, high};
}

/// As many ticks as there is room for their numbers side by side, at most three.
AxisTicks ticks_of(const Range& range, double cell) {
  for (int most = 4;; --most) {
    AxisTicks ticks = axis_ticks(range.min, range.max, most);
    double widest = 0.0;
    for (const std::string& label : ticks.labels)
      widest = std::max(widest, text_width_px(label, kCornerTickSize));
    const double step =
        ticks.places.size() < 2 ? cell : (ticks.places[1] - ticks.places[0]) / (range.max - range.min) * cell;
    if (most <= 1 || (step >= widest + 6.0 && ticks.places.size() <= 4)) return ticks;
  }
}

struct Corner {
  std::vector<Side> sides;
  std::vector<std::vector<double>> correlation;
  std::size_t samples = 0;
  double cell = kMaxCell;
  double top = 0.0;
  std::vector<std::string> notes;
  PlotSize size;

  PlotRectangle area(std::size_t row, std::size_t column) const {
    return {kCornerEdge + kCornerLeft + (cell + kCornerGap) * static_cast<double>(column),
            top + (cell + kCornerGap) * static_cast<double>(row), cell, cell};
  }
  double x_in(const PlotRectangle& a, std::size_t j, double value) const {
    const Range& r = sides[j].range;
    return a.x + a.width * (value - r.min) / (r.max - r.min);
  }
  double y_in(const PlotRectangle& a, std::size_t j, double value) const {
    const Range& r = sides[j].range;
    return a.y + a.height * (r.max - value) / (r.max - r.min);
  }
};

Corner lay_out(const CornerData& data) {
  Corner c;
  const std::vector<std::size_t> chosen = most_correlated(data, kMax);
  const std::size_t n = chosen.size(), all = data.parameters.size();
  c.cell = std::clamp(kWide / static_cast<double>(n), kMinCell, kMaxCell);
  c.samples = data.samples.size() / all;
  for (const std::size_t j : chosen) {
    Side side;
    side.parameter = data.parameters[j];
    for (std::size_t i = 0; i < c.samples; ++i) side.samples.push_back(data.samples[i * all + j]);
    side.range = range_of(side.parameter, side.samples);
    side.ticks = ticks_of(side.range, c.cell);
    c.sides.push_back(std::move(side));
    c.correlation.emplace_back();
    for (const std::size_t k : chosen) c.correlation.back().push_back(data.correlation[j][k]);
  }
  // Names along the axes where all of them fit, else numbers.
  const bool fit = std::all_of(c.sides.begin(), c.sides.end(), [&](const Side& side) {
    return text_width_px(side.parameter.name, kValueSize) <= c.cell;
  });
  for (std::size_t j = 0; j < n; ++j) {
    c.sides[j].axis_name = fit ? c.sides[j].parameter.name : std::to_string(j + 1);
    if (!fit) c.sides[j].parameter.name = std::to_string(j + 1) + "  " + c.sides[j].parameter.name;
  }
  if (n < all)
    c.notes.push_back(fmt::format("{} of {} parameters: those of the strongest correlations.", n, all));
  if (!data.left_out.empty())
    c.notes.push_back("Left out, without an error bar: " + sim::joined(data.left_out) + ".");
  c.top = kCornerEdge + 26.0 + kCornerNoteHeight * static_cast<double>(1 + (c.samples > 0) + c.notes.size()) +
          kNameHeight + 6.0;
  const double step = c.cell + kCornerGap;
  double right = 0.0;
  for (std::size_t j = 0; j < n; ++j) {
    const double wide = std::max(text_width_px(c.sides[j].parameter.name, 1.08 * kNameSize),
                                 text_width_px(value_text(c.sides[j].parameter), kValueSize));
    right = std::max(right, step * static_cast<double>(j) + std::max(c.cell, wide));
  }
  c.size.width = kCornerEdge + kCornerLeft + right + kCornerEdge;
  for (const std::string& note : c.notes)
    c.size.width = std::max(c.size.width, 2 * kCornerEdge + text_width_px(note, kCornerNoteSize));
  c.size.width = std::ceil(std::max(c.size.width, 480.0));
  c.size.height = std::ceil(c.top + step * static_cast<double>(n) + kCornerBelow);
  return c;
}

void draw_head(const Corner& c, PlotCanvas& canvas) {
  double y = kCornerEdge + 6.0;
  canvas.text({kCornerEdge, y}, "Every parameter against every other",
              style(kCornerTitleSize, kCornerInk, TextAnchor::start, true));
  y += 24.0;
  const double sample = 22.0;
  canvas.area({{kCornerEdge, y - 9},
               {kCornerEdge + sample, y - 9},
               {kCornerEdge + sample, y + 1},
               {kCornerEdge, y + 1}},
              covariance_ink(), 0.25);
  canvas.text({kCornerEdge + sample + 7, y}, "covariance: 1 \u03c3 and 2 \u03c3 (39 % and 86 % inside)",
              style(kCornerNoteSize, kSoftInk));
  y += kCornerNoteHeight;
  if (c.samples > 0) {
    canvas.dot({kCornerEdge + sample / 2, y - 4}, 4.0, chain_ink());
    canvas.text({kCornerEdge + sample + 7, y}, "samples of the chain", style(kCornerNoteSize, kSoftInk));
    y += kCornerNoteHeight;
  }
  for (const std::string& note : c.notes) {
    canvas.text({kCornerEdge, y}, note, style(kCornerNoteSize, kSoftInk));
    y += kCornerNoteHeight;
  }
}

void draw_frame(const PlotRectangle& a, PlotCanvas& canvas) {
  const double right = a.x + a.width, bottom = a.y + a.height;
  canvas.line({{a.x, a.y}, {right, a.y}, {right, bottom}, {a.x, bottom}, {a.x, a.y}}, kFrame, 1, false);
}

void draw_x_axis(const Corner& c, std::size_t j, PlotCanvas& canvas) {
  const PlotRectangle a = c.area(c.sides.size() - 1, j);
  const double bottom = a.y + a.height;
  for (std::size_t t = 0; t < c.sides[j].ticks.places.size(); ++t) {
    const double x = c.x_in(a, j, c.sides[j].ticks.places[t]);
    canvas.line({{x, bottom}, {x, bottom + 4}}, kFrame, 1, false);
    // The next cell's numbers stand close by.
    const double half = 0.5 * text_width_px(c.sides[j].ticks.labels[t], kCornerTickSize);
    const bool sticks_out = x - half < a.x - kCornerGap / 2 || x + half > a.x + a.width + kCornerGap / 2;
    if (sticks_out && c.sides[j].ticks.places.size() > 1) continue;
    canvas.text({x, bottom + 14}, c.sides[j].ticks.labels[t],
                style(kCornerTickSize, kSoftInk, TextAnchor::middle));
  }
  canvas.text({a.x + a.width / 2, bottom + 32}, c.sides[j].axis_name,
              style(kValueSize, kCornerInk, TextAnchor::middle));
}

void draw_y_axis(const Corner& c, std::size_t j, PlotCanvas& canvas) {
  const PlotRectangle a = c.area(j, 0);
  for (std::size_t t = 0; t < c.sides[j].ticks.places.size(); ++t) {
    const double y = c.y_in(a, j, c.sides[j].ticks.places[t]);
    canvas.line({{a.x - 4, y}, {a.x, y}}, kFrame, 1, false);
    canvas.text({a.x - 7, y + 0.36 * kCornerTickSize}, c.sides[j].ticks.labels[t],
                style(kCornerTickSize, kSoftInk, TextAnchor::end));
  }
  TextStyle name = style(kValueSize, kCornerInk, TextAnchor::middle);
  name.upwards = true;
  canvas.text({a.x - kCornerLeft + 12, a.y + a.height / 2}, c.sides[j].axis_name, name);
}

/// Density of the samples in equal bins over the range, per unit.
std::vector<double> histogram(const Side& side) {
  std::vector<double> density(kBins, 0.0);
  const double width = (side.range.max - side.range.min) / kBins;
  for (const double x : side.samples) {
    const double bin = std::floor((x - side.range.min) / width);
    if (bin >= 0.0 && bin < kBins)
      density[static_cast<std::size_t>(bin)] += 1.0 / (width * static_cast<double>(side.samples.size()));
  }
  return density;
}

void draw_diagonal(const Corner& c, std::size_t j, PlotCanvas& canvas) {
  constexpr int kPoints = 80;
  const Side& side = c.sides[j];
  const PlotRectangle a = c.area(j, j);
  const std::vector<double> density = histogram(side);
  double highest = side.samples.empty() ? 0.0 : *std::max_element(density.begin(), density.end());
  const double peak =
      side.parameter.sigma ? 1.0 / (std::sqrt(2.0 * std::acos(-1.0)) * *side.parameter.sigma) : 0.0;
  highest = 1.1 * std::max(highest, peak);
  const double bottom = a.y + a.height;
  const auto height = [&](double d) { return bottom - a.height * d / highest; };
  canvas.begin_clip(a);
  if (!side.samples.empty()) {
    std::vector<PlotPoint> steps = {{a.x, bottom}};
    for (int b = 0; b < kBins; ++b)
      for (const int end : {b, b + 1})
        steps.push_back({a.x + a.width * end / kBins, height(density[static_cast<std::size_t>(b)])});
    steps.push_back({a.x + a.width, bottom});
    canvas.area(steps, chain_ink(), 0.3);
  }
  if (side.parameter.sigma) {
    std::vector<PlotPoint> curve;
    for (int i = 0; i <= kPoints; ++i) {
      const double x = side.range.min + (side.range.max - side.range.min) * i / kPoints;
      const double z = (x - side.parameter.value) / *side.parameter.sigma;
      curve.push_back({c.x_in(a, j, x), height(peak * std::exp(-0.5 * z * z))});
    }
    canvas.line(curve, covariance_ink(), 1.5, false);
  }
  canvas.end_clip();
  draw_frame(a, canvas);
  canvas.text({a.x, a.y - 21}, side.parameter.name, style(kNameSize, kCornerInk, TextAnchor::start, true));
  canvas.text({a.x, a.y - 6}, value_text(side.parameter), style(kValueSize, kSoftInk));
}

void draw_pair(const Corner& c, std::size_t row, std::size_t column, std::size_t stride, PlotCanvas& canvas) {
  constexpr int kPoints = 60;
  const PlotRectangle a = c.area(row, column);
  const Side &x = c.sides[column], &y = c.sides[row];
  canvas.begin_clip(a);
  const double diameter = c.cell > 120.0 ? 2.0 : 1.5;
  for (std::size_t i = 0; i < c.samples; i += stride) {
    const PlotPoint at{c.x_in(a, column, x.samples[i]), c.y_in(a, row, y.samples[i])};
    if (at.x > a.x && at.x < a.x + a.width && at.y > a.y && at.y < a.y + a.height)
      canvas.dot(at, diameter, chain_ink());
  }
  const double r = c.correlation[row][column];
  const bool known = x.parameter.sigma && y.parameter.sigma && std::isfinite(r);
  if (known) {
    for (const double sigmas : {2.0, 1.0}) {
      std::vector<PlotPoint> ellipse;
      for (int i = 0; i <= kPoints; ++i) {
        const double t = 2.0 * std::acos(-1.0) * i / kPoints;
        const double along = sigmas * std::cos(t), across = sigmas * std::sin(t);
        const double other = r * along + std::sqrt(std::max(0.0, 1.0 - r * r)) * across;
        ellipse.push_back({c.x_in(a, column, x.parameter.value + *x.parameter.sigma * along),
                           c.y_in(a, row, y.parameter.value + *y.parameter.sigma * other)});
      }
      canvas.area(ellipse, covariance_ink(), 0.16);
      canvas.line(ellipse, covariance_ink(), 1.2, false);
    }
  }
  canvas.end_clip();
  draw_frame(a, canvas);
  if (!known) return;
  // In the corner that the ellipse leaves free.
  std::string text = fmt::format("{:.2f}", std::abs(r));
  if (r < 0.0 && text != "0.00") text.insert(0, "\u2212");
  const bool left = r >= 0.0;
  canvas.text({left ? a.x + 4 : a.x + a.width - 4, a.y + 12}, text,
              style(kCornerTickSize + 0.5, kCornerInk, left ? TextAnchor::start : TextAnchor::end,
                    std::abs(r) > 0.9));
}

}  // namespace

std::string corner_plot_svg(const CornerData& data) {
  if (data.parameters.size() < 2) return {};
  const Corner c = lay_out(data);
  const std::size_t n = c.sides.size();
  const std::size_t dots = std::min(kMaxDotsOfOne, kMaxDots / (n * (n - 1) / 2));
  const std::size_t stride = std::max<std::size_t>(1, (c.samples + dots - 1) / dots);
  return drawn_svg("Every parameter against every other", c.size, [&](PlotCanvas& canvas) {
    canvas.area({{0, 0}, {c.size.width, 0}, {c.size.width, c.size.height}, {0, c.size.height}},
                {255, 255, 255}, 1.0);
    draw_head(c, canvas);
    for (std::size_t row = 0; row < n; ++row) {
      for (std::size_t column = 0; column < row; ++column) draw_pair(c, row, column, stride, canvas);
      draw_diagonal(c, row, canvas);
      draw_x_axis(c, row, canvas);
      if (row > 0) draw_y_axis(c, row, canvas);
    }
  });
}

}  // namespace vegard::fit
