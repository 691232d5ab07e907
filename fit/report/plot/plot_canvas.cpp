// The layout of a plot: where everything goes, whatever it is drawn on.
#include "fit/report/plot/plot_canvas.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "fit/report/plot/plot_axis.h"

namespace vegard::fit {
namespace {

constexpr Colour kPlotInk{38, 38, 38}, kPlotSoftInk{95, 95, 95}, kPlotGrid{232, 232, 232},
    kPlotFrame{150, 150, 150};
constexpr double kPlotTitleSize = 16, kPanelTitleSize = 12.5, kLabelSize = 12.5, kPlotTickSize = 11,
                 kPlotNoteSize = 12;
constexpr double kPlotEdge = 18;  ///< free at the outside
constexpr double kTitleHeight = 26, kPlotNoteHeight = 20, kLegendHeight = 24;
constexpr double kPlotLeft = 66;     ///< left of a panel: label, numbers
constexpr double kPlotBelow = 50;    ///< below a panel: numbers, label
constexpr double kBelowInside = 28;  ///< the same where the label is written once
constexpr double kPanelTitleHeight = 22;
constexpr double kPlotGap = 22;  ///< between panels that share an axis
constexpr double kTickLength = 4;
constexpr double kLegendSample = 22, kLegendTextGap = 7, kLegendGap = 20;

struct Limits {
  double min = std::numeric_limits<double>::infinity();
  double max = -std::numeric_limits<double>::infinity();
  void add(const std::vector<double>& values) {
    for (const double v : values) {
      if (!std::isfinite(v)) continue;
      min = std::min(min, v);
      max = std::max(max, v);
    }
  }
};

void add_data(const Panel& panel, bool along_x, Limits& limits) {
  for (const Series& series : panel.series) {
    limits.add(along_x ? series.x : series.y);
    if (series.band_along_x == along_x) {
      limits.add(series.low);
      limits.add(series.high);
    }
  }
}

/// The data's limits, a little widened, unless the axis says other.
Limits axis_limits(const Axis& axis, Limits data) {
  if (!(data.min <= data.max)) data.min = 0.0, data.max = 1.0;
  const double margin = 0.04 * (data.max - data.min);
  Limits limits{axis.min.value_or(data.min - margin), axis.max.value_or(data.max + margin)};
  const double least = 1e-9 * std::max(std::abs(limits.min), std::abs(limits.max));
  if (!(limits.max - limits.min > least)) {
    const double middle = 0.5 * (limits.min + limits.max);
    const double half = middle == 0.0 ? 1.0 : 0.1 * std::abs(middle);
    limits = {middle - half, middle + half};
  }
  return limits;
}

double entry_width(const Series& entry) {
  return kLegendSample + kLegendTextGap + text_width_px(entry.label, kPlotNoteSize) + kLegendGap;
}

double legend_width(const std::vector<const Series*>& entries) {
  double width = 0.0;
  for (const Series* entry : entries) width += entry_width(*entry);
  return width;
}

struct Layout {
  int columns = 1, rows = 1;
  double head = 0.0;  ///< above the first row of panels
  PlotSize size;
  std::vector<PlotRectangle> panels;
};

/// One series per label, in order of appearance.
std::vector<const Series*> legend_entries(const Plot& plot) {
  std::vector<const Series*> entries;
  for (const Panel& panel : plot.panels)
    for (const Series& series : panel.series) {
      const bool known = std::any_of(entries.begin(), entries.end(),
                                     [&](const Series* entry) { return entry->label == series.label; });
      if (!series.label.empty() && !known) entries.push_back(&series);
    }
  return entries;
}

Layout lay_out(const Plot& plot) {
  Layout layout;
  const int count = static_cast<int>(plot.panels.size());
  layout.columns = std::max(1, plot.columns > 0 ? std::min(plot.columns, count) : count);
  layout.rows = std::max(1, (count + layout.columns - 1) / layout.columns);
  layout.head = kPlotEdge + (plot.title.empty() ? 0 : kTitleHeight) +
                (plot.note.empty() ? 0 : kPlotNoteHeight) +
                (legend_entries(plot).empty() ? 0 : kLegendHeight);
  const bool titled = std::any_of(plot.panels.begin(), plot.panels.end(),
                                  [](const Panel& panel) { return !panel.title.empty(); });
  const double above = titled ? kPanelTitleHeight : 8;
  const double step_x = plot.panel_width_px + (plot.shared_axes ? kPlotGap : kPlotLeft + kPlotGap);
  const double step_y = plot.panel_height_px + above + (plot.shared_axes ? kBelowInside : kPlotBelow);
  for (int i = 0; i < count; ++i) {
    const int column = i % layout.columns, row = i / layout.columns;
    layout.panels.push_back({kPlotEdge + kPlotLeft + step_x * column, layout.head + above + step_y * row,
                             static_cast<double>(plot.panel_width_px),
                             static_cast<double>(plot.panel_height_px)});
  }
  layout.size.width = kPlotEdge + kPlotLeft + step_x * (layout.columns - 1) + plot.panel_width_px + kPlotEdge;
  // A long title, note or legend must not be cut off.
  layout.size.width = std::max(layout.size.width, kPlotEdge + legend_width(legend_entries(plot)));
  for (const auto& [text, text_size] :
       {std::pair(plot.title, 1.08 * kPlotTitleSize), std::pair(plot.note, kPlotNoteSize)})
    layout.size.width =
        std::max(layout.size.width, 2 * kPlotEdge + std::ceil(text_width_px(text, text_size)));
  layout.size.height =
      layout.head + step_y * layout.rows + (plot.shared_axes ? kPlotBelow - kBelowInside : 0) + 4;
  return layout;
}

/// As many ticks as there is room for their numbers.
AxisTicks horizontal_ticks(const Limits& limits, double width_px) {
  constexpr double kMinStep = 34, kBetweenNumbers = 14;
  for (int most = static_cast<int>(width_px / kMinStep);; --most) {
    AxisTicks ticks = axis_ticks(limits.min, limits.max, std::max(1, most));
    if (most <= 1 || ticks.places.size() < 2) return ticks;
    double widest = 0.0;
    for (const std::string& label : ticks.labels)
      widest = std::max(widest, text_width_px(label, kPlotTickSize));
    const double step = (ticks.places[1] - ticks.places[0]) / (limits.max - limits.min) * width_px;
    if (step >= widest + kBetweenNumbers) return ticks;
  }
}

/// Those that the axis names; else `chosen`.
AxisTicks ticks_of(const Axis& axis, AxisTicks chosen) {
  if (axis.tick_places.empty()) return chosen;
  chosen.places.clear();
  chosen.labels.clear();
  for (std::size_t i = 0; i < axis.tick_places.size(); ++i) {
    if (axis.tick_places[i] < chosen.min || axis.tick_places[i] > chosen.max) continue;
    chosen.places.push_back(axis.tick_places[i]);
    chosen.labels.push_back(axis.tick_labels[i]);
  }
  return chosen;
}

/// A panel's way from data to pixels.
struct PlotScale {
  PlotRectangle area;
  AxisTicks x, y;
  bool x_reversed = false, y_reversed = false;
  double place_x(double value) const {
    const double t = (value - x.min) / (x.max - x.min);
    return area.x + area.width * (x_reversed ? 1 - t : t);
  }
  double place_y(double value) const {
    const double t = (value - y.min) / (y.max - y.min);
    return area.y + area.height * (y_reversed ? t : 1 - t);
  }
  PlotPoint place(double vx, double vy) const { return {place_x(vx), place_y(vy)}; }
};

void draw_grid(const PlotScale& scale, bool numbers_left, PlotCanvas& canvas) {
  const PlotRectangle& a = scale.area;
  const double right = a.x + a.width, bottom = a.y + a.height;
  for (const double v : scale.x.places)
    canvas.line({{scale.place_x(v), a.y}, {scale.place_x(v), bottom}}, kPlotGrid, 1, false);
  for (const double v : scale.y.places)
    canvas.line({{a.x, scale.place_y(v)}, {right, scale.place_y(v)}}, kPlotGrid, 1, false);
  canvas.line({{a.x, a.y}, {a.x, bottom}, {right, bottom}}, kPlotFrame, 1, false);
  TextStyle style;
  style.size_px = kPlotTickSize;
  style.colour = kPlotSoftInk;
  style.anchor = TextAnchor::middle;
  for (std::size_t i = 0; i < scale.x.places.size(); ++i) {
    const double px = scale.place_x(scale.x.places[i]);
    canvas.line({{px, bottom}, {px, bottom + kTickLength}}, kPlotFrame, 1, false);
    canvas.text({px, bottom + kTickLength + 13}, scale.x.labels[i], style);
  }
  style.anchor = TextAnchor::end;
  for (std::size_t i = 0; i < scale.y.places.size(); ++i) {
    const double py = scale.place_y(scale.y.places[i]);
    canvas.line({{a.x - kTickLength, py}, {a.x, py}}, kPlotFrame, 1, false);
    if (numbers_left)
      canvas.text({a.x - kTickLength - 4, py + 0.36 * kPlotTickSize}, scale.y.labels[i], style);
  }
}

bool finite_at(const Series& series, std::size_t i) {
  return std::isfinite(series.x[i]) && std::isfinite(series.y[i]);
}

void draw_band(const Series& series, const PlotScale& scale, PlotCanvas& canvas) {
  constexpr double kOpacity = 0.22;
  std::vector<PlotPoint> there, back;
  auto close = [&] {
    there.insert(there.end(), back.rbegin(), back.rend());
    if (there.size() >= 4) canvas.area(there, series.colour, kOpacity);
    there.clear();
    back.clear();
  };
  for (std::size_t i = 0; i < series.low.size(); ++i) {
    if (!finite_at(series, i) || !std::isfinite(series.low[i]) || !std::isfinite(series.high[i])) {
      close();
      continue;
    }
    there.push_back(series.band_along_x ? scale.place(series.low[i], series.y[i])
                                        : scale.place(series.x[i], series.low[i]));
    back.push_back(series.band_along_x ? scale.place(series.high[i], series.y[i])
                                       : scale.place(series.x[i], series.high[i]));
  }
  close();
}

/// Half as opaque as the points: a thinner line of a paler colour, since lines have no opacity.
void draw_error_bars(const Series& series, const PlotScale& scale, PlotCanvas& canvas) {
  constexpr double kWidth_px = 1.0;
  const auto paler = [](std::uint8_t ink) { return static_cast<std::uint8_t>((ink + 255) / 2); };
  const Colour colour{paler(series.colour.r), paler(series.colour.g), paler(series.colour.b)};
  for (std::size_t i = 0; i < series.low.size(); ++i) {
    if (!finite_at(series, i) || !std::isfinite(series.low[i]) || !std::isfinite(series.high[i])) continue;
    if (series.band_along_x)
      canvas.line({scale.place(series.low[i], series.y[i]), scale.place(series.high[i], series.y[i])}, colour,
                  kWidth_px, false);
    else
      canvas.line({scale.place(series.x[i], series.low[i]), scale.place(series.x[i], series.high[i])}, colour,
                  kWidth_px, false);
  }
}

void draw_raster(const Raster& raster, const PlotScale& scale, PlotCanvas& canvas) {
  if (raster.rgb.empty()) return;
  const PlotPoint corner = scale.place(raster.left, raster.top),
                  end = scale.place(raster.right, raster.bottom);
  canvas.picture({corner.x, corner.y, end.x - corner.x, end.y - corner.y}, raster);
}

void draw_series(const Series& series, const PlotScale& scale, PlotCanvas& canvas) {
  std::vector<PlotPoint> run;
  auto finish = [&] {
    if (run.size() > 1) canvas.line(run, series.colour, series.width_px, series.mark == Mark::dashed_line);
    if (run.size() == 1) canvas.dot(run[0], series.width_px, series.colour);
    run.clear();
  };
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    if (!finite_at(series, i)) {
      finish();
    } else if (series.mark == Mark::points) {
      canvas.dot(scale.place(series.x[i], series.y[i]), series.width_px, series.colour);
    } else {
      run.push_back(scale.place(series.x[i], series.y[i]));
    }
  }
  finish();
}

void draw_legend(const std::vector<const Series*>& entries, double base_line, PlotCanvas& canvas) {
  double x = kPlotEdge;
  for (const Series* entry : entries) {
    const double middle = base_line - 0.34 * kPlotNoteSize;
    if (!entry->low.empty() && !entry->error_bars)
      canvas.area({{x, middle - 5},
                   {x + kLegendSample, middle - 5},
                   {x + kLegendSample, middle + 5},
                   {x, middle + 5}},
                  entry->colour, 0.22);
    if (entry->mark == Mark::points)
      canvas.dot({x + kLegendSample / 2, middle}, entry->width_px, entry->colour);
    else
      canvas.line({{x, middle}, {x + kLegendSample, middle}}, entry->colour, entry->width_px + 0.4,
                  entry->mark == Mark::dashed_line);
    TextStyle style;
    style.size_px = kPlotNoteSize;
    style.colour = kPlotInk;
    canvas.text({x + kLegendSample + kLegendTextGap, base_line}, entry->label, style);
    x += entry_width(*entry);
  }
}

void draw_head(const Plot& plot, PlotCanvas& canvas) {
  double base_line = kPlotEdge;
  TextStyle style;
  if (!plot.title.empty()) {
    style.size_px = kPlotTitleSize;
    style.bold = true;
    style.colour = kPlotInk;
    canvas.text({kPlotEdge, base_line + 12}, plot.title, style);
    base_line += kTitleHeight;
  }
  if (!plot.note.empty()) {
    style.size_px = kPlotNoteSize;
    style.bold = false;
    style.colour = kPlotSoftInk;
    canvas.text({kPlotEdge, base_line + 9}, plot.note, style);
    base_line += kPlotNoteHeight;
  }
  draw_legend(legend_entries(plot), base_line + 13, canvas);
}

void label_axes(const Axis& x, const Axis& y, const PlotRectangle& area, PlotCanvas& canvas) {
  TextStyle style;
  style.size_px = kLabelSize;
  style.colour = kPlotInk;
  style.anchor = TextAnchor::middle;
  canvas.text({area.x + area.width / 2, area.y + area.height + 40}, x.label, style);
  style.upwards = true;
  canvas.text({area.x - kPlotLeft + 14, area.y + area.height / 2}, y.label, style);
}

void check_plot(const Plot& plot) {
  for (const Panel& panel : plot.panels) {
    assert(panel.x.tick_places.size() == panel.x.tick_labels.size());
    assert(panel.y.tick_places.size() == panel.y.tick_labels.size());
    assert(panel.raster.rgb.size() == static_cast<std::size_t>(panel.raster.width) * panel.raster.height * 3);
    for (const Series& series : panel.series) {
      assert(series.x.size() == series.y.size());
      assert(series.low.size() == series.high.size());
      assert(series.low.empty() || series.low.size() == series.x.size());
      static_cast<void>(series);
    }
  }
}

}  // namespace

Colour channel_colour(int channel) {
  constexpr std::array<Colour, 3> kChannels = {{{205, 50, 45}, {34, 145, 60}, {38, 92, 200}}};
  assert(channel >= 0 && channel < 3);
  return kChannels[channel];
}

Colour line_ink(double wavelength_nm) {
  constexpr double kReddestGreen = 600.0, kBluestGreen = 540.0;
  if (wavelength_nm > kReddestGreen) return channel_colour(0);
  return channel_colour(wavelength_nm > kBluestGreen ? 1 : 2);
}

Colour distinct_colour(int index) {
  constexpr std::array<Colour, 7> kDistinct = {{{0, 114, 178},
                                                {213, 94, 0},
                                                {0, 158, 115},
                                                {204, 121, 167},
                                                {230, 159, 0},
                                                {86, 180, 233},
                                                {60, 60, 60}}};
  assert(index >= 0);
  return kDistinct[index % kDistinct.size()];
}

PlotSize plot_size(const Plot& plot) { return lay_out(plot).size; }

void draw_plot(const Plot& plot, PlotCanvas& canvas) {
  check_plot(plot);
  const Layout layout = lay_out(plot);
  canvas.area(
      {{0, 0}, {layout.size.width, 0}, {layout.size.width, layout.size.height}, {0, layout.size.height}},
      {255, 255, 255}, 1.0);
  draw_head(plot, canvas);
  if (plot.panels.empty()) return;

  Limits all_x, all_y;
  for (const Panel& panel : plot.panels) {
    add_data(panel, true, all_x);
    add_data(panel, false, all_y);
  }
  for (std::size_t i = 0; i < plot.panels.size(); ++i) {
    const Panel& panel = plot.panels[i];
    const Panel& axes = plot.shared_axes ? plot.panels.front() : panel;
    Limits x = all_x, y = all_y;
    if (!plot.shared_axes) {
      x = y = Limits{};
      add_data(panel, true, x);
      add_data(panel, false, y);
    }
    x = axis_limits(axes.x, x);
    y = axis_limits(axes.y, y);
    const PlotRectangle& area = layout.panels[i];
    const PlotScale scale{
        area, ticks_of(axes.x, horizontal_ticks(x, area.width)),
        ticks_of(axes.y, axis_ticks(y.min, y.max, std::max(2, static_cast<int>(area.height / 42)))),
        axes.x.reversed, axes.y.reversed};
    const bool first_column = static_cast<int>(i) % layout.columns == 0;
    draw_grid(scale, first_column || !plot.shared_axes, canvas);
    TextStyle title;
    title.size_px = kPanelTitleSize;
    title.bold = true;
    title.colour = kPlotInk;
    canvas.text({area.x, area.y - 8}, panel.title, title);
    canvas.begin_clip(area);
    draw_raster(panel.raster, scale, canvas);
    for (const Series& series : panel.series)
      if (series.error_bars)
        draw_error_bars(series, scale, canvas);
      else
        draw_band(series, scale, canvas);
    for (const Series& series : panel.series) draw_series(series, scale, canvas);
    canvas.end_clip();
    if (!plot.shared_axes) label_axes(panel.x, panel.y, area, canvas);
  }
  if (plot.shared_axes) {
    const PlotRectangle &first = layout.panels.front(), &last = layout.panels.back();
    const double right = layout.panels[layout.columns - 1].x + plot.panel_width_px;
    label_axes(plot.panels.front().x, plot.panels.front().y,
               {first.x, first.y, right - first.x, last.y + last.height - first.y}, canvas);
  }
}

double text_width_px(const std::string& text, double size_px) {
  double ems = 0.0;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte & 0xc0) == 0x80) continue;  // the rest of a UTF-8 character
    const std::string_view narrow = "iljtfrI.,:;|!'()[] ", wide = "mwMW%@";
    ems += narrow.find(c) != std::string_view::npos ? 0.37
           : wide.find(c) != std::string_view::npos ? 0.96
                                                    : 0.62;
  }
  return ems * size_px;
}

}  // namespace vegard::fit
