#include "fit/report/keogram_plot.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "fit/report/plot/plot_axis.h"
#include "sim/base/file/number_text.h"
#include "sim/base/utc_time.h"
#include "sim/view/sensor/tone_curve.h"

namespace vegard::fit {
namespace {

constexpr double kKeogramPlotGap = 1.5;  ///< median distances
constexpr double kLeftOut = 0.005;
constexpr int kPanelWidth = 900, kPanelHeight = 360;
constexpr int kKeogramPlotFiner = 2;  ///< pixels of the raster for each of the panel, as its PNG has
constexpr double kTickDistance = 75.0;
constexpr Colour kNothing{205, 205, 205};

using Rgb = std::array<double, 3>;  ///< encoded, 0 to 1

/// Dark blue, violet, orange, pale yellow: brightness grows all the way. `value` 0 to 1.
Rgb colour_map(double value) {
  constexpr std::array<Rgb, 5> kStops = {
      {{0.02, 0.02, 0.12}, {0.24, 0.10, 0.44}, {0.66, 0.22, 0.42}, {0.96, 0.56, 0.22}, {1.0, 0.97, 0.72}}};
  const double at = std::clamp(value, 0.0, 1.0) * (kStops.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(at), kStops.size() - 2);
  Rgb colour;
  for (int c = 0; c < 3; ++c)
    colour[c] =
        kStops[below][c] + (at - static_cast<double>(below)) * (kStops[below + 1][c] - kStops[below][c]);
  return colour;
}

struct KeogramScale {
  double black = 0.0, white = 1.0;
};

KeogramScale scale_of(const Keogram& keogram, const KeogramLook& look) {
  KeogramScale scale;
  if (!keogram.srgb) {
    std::vector<double> values;
    for (const KeogramColumn& column : keogram.columns)
      for (std::size_t i = 0; i < column.mean.size(); ++i)
        if (std::isfinite(column.mean[i]) && (!look.channel || static_cast<int>(i % 3) == *look.channel))
          values.push_back(column.mean[i]);
    std::sort(values.begin(), values.end());
    if (!values.empty()) {
      const auto rank = static_cast<std::size_t>(kLeftOut * static_cast<double>(values.size() - 1));
      scale = {values[rank], values[values.size() - 1 - rank]};
    }
  }
  scale.black = look.black.value_or(scale.black);
  scale.white = look.white.value_or(scale.white);
  if (!(scale.white > scale.black)) scale.white = scale.black + 1.0;
  return scale;
}

/// Pictures begin to end - 1 whose middle is between two times; if there is none, the one whose span holds
/// the middle of the two.
std::pair<std::size_t, std::size_t> pictures_between(const Keogram& keogram,
                                                     const std::vector<TimeSpan>& spans, double from,
                                                     double to) {
  const auto& columns = keogram.columns;
  const auto later = [](const KeogramColumn& column, double time) { return column.time < time; };
  const auto begin = std::lower_bound(columns.begin(), columns.end(), from, later);
  const auto end = std::lower_bound(begin, columns.end(), to, later);
  const auto index = static_cast<std::size_t>(begin - columns.begin());
  if (begin != end) return {index, static_cast<std::size_t>(end - columns.begin())};
  const double middle = 0.5 * (from + to);
  for (const std::size_t i : {index - 1, index})
    if (i < spans.size() && middle >= spans[i].begin && middle < spans[i].end) return {i, i + 1};
  return {0, 0};
}

Raster raster_of(const Keogram& keogram, const KeogramLook& look, const KeogramScale& scale,
                 const std::vector<TimeSpan>& spans) {
  Raster raster;
  raster.width = kPanelWidth * kKeogramPlotFiner;
  raster.height = keogram.positions();
  raster.left = spans.front().begin;
  raster.right = spans.back().end;
  raster.rgb.resize(static_cast<std::size_t>(raster.width) * raster.height * 3);
  const double pixel = (raster.right - raster.left) / raster.width;
  for (int x = 0; x < raster.width; ++x) {
    const auto [begin, end] =
        pictures_between(keogram, spans, raster.left + x * pixel, raster.left + (x + 1) * pixel);
    for (int y = 0; y < raster.height; ++y) {
      Rgb sum = {0.0, 0.0, 0.0}, known = sum;
      for (std::size_t i = begin; i < end; ++i)
        for (int c = 0; c < 3; ++c) {
          const double value = keogram.columns[i].mean[3 * y + c];
          if (!std::isfinite(value)) continue;
          sum[c] += value;
          known[c] += 1.0;
        }
      Rgb shown = {kNothing.r / 255.0, kNothing.g / 255.0, kNothing.b / 255.0};
      const auto encoded = [&](int c) {
        return sim::srgb_encode(
            std::clamp((sum[c] / known[c] - scale.black) / (scale.white - scale.black), 0.0, 1.0));
      };
      if (look.channel && known[*look.channel] > 0.0) {
        shown = colour_map(encoded(*look.channel));
      } else if (!look.channel && known[0] > 0.0 && known[1] > 0.0 && known[2] > 0.0) {
        for (int c = 0; c < 3; ++c) shown[c] = encoded(c);
      }
      std::uint8_t* to = &raster.rgb[3 * (static_cast<std::size_t>(y) * raster.width + x)];
      for (int c = 0; c < 3; ++c) to[c] = static_cast<std::uint8_t>(std::lround(255.0 * shown[c]));
    }
  }
  return raster;
}

void label_positions(const KeogramLine& line, Panel& panel) {
  const double top = line.position.front(), bottom = line.position.back();
  const double outwards = (top > bottom ? 0.5 : -0.5) * line.step;
  // A row's number is at its upper edge, as in the profile's plot.
  const double shift = line.of_directions ? 0.0 : 0.5;
  panel.raster.top = top + outwards + shift;
  panel.raster.bottom = bottom - outwards + shift;
  panel.y.min = std::min(panel.raster.top, panel.raster.bottom);
  panel.y.max = std::max(panel.raster.top, panel.raster.bottom);
  panel.y.reversed = top < bottom;
  panel.y.label = "row (px)";
  if (line.of_directions)
    panel.y.label = "elevation from azimuth " + sim::short_number(line.azimuth_deg, 4) + "\u00b0" +
                    (line.position.back() > line.position.front() ? " over the zenith" : "") + " (\u00b0)";
}

void label_times(const Keogram& keogram, Panel& panel) {
  const double begin = panel.raster.left, end = panel.raster.right;
  panel.x.min = begin;
  panel.x.max = end;
  switch (keogram.time_kind) {
    case PictureTimes::Kind::utc: {
      TimeTicks ticks = utc_ticks(begin, end, static_cast<int>(kPanelWidth / kTickDistance));
      panel.x.tick_places = std::move(ticks.places);
      panel.x.tick_labels = std::move(ticks.labels);
      const std::string first = sim::utc_text(keogram.columns.front().time).substr(0, 10),
                        last = sim::utc_text(keogram.columns.back().time).substr(0, 10);
      panel.x.label = "UTC, " + first + (first == last ? "" : " to " + last);
      break;
    }
    case PictureTimes::Kind::clock:
      panel.x.label = "time (s)";
      break;
    case PictureTimes::Kind::number: {
      const AxisTicks chosen = axis_ticks(begin, end, static_cast<int>(kPanelWidth / kTickDistance));
      for (std::size_t i = 0; i < chosen.places.size(); ++i) {
        if (chosen.places[i] != std::floor(chosen.places[i])) continue;
        panel.x.tick_places.push_back(chosen.places[i]);
        panel.x.tick_labels.push_back(std::to_string(std::lround(chosen.places[i])));
      }
      panel.x.label = "picture";
      break;
    }
  }
  panel.x.label += " \u2013 times: " + keogram.time_source;
}

}  // namespace

std::vector<TimeSpan> column_spans(const Keogram& keogram) {
  const auto& columns = keogram.columns;
  std::vector<double> distances;
  for (std::size_t i = 1; i < columns.size(); ++i) distances.push_back(columns[i].time - columns[i - 1].time);
  double median = 1.0;
  if (!distances.empty()) {
    std::vector<double> sorted = distances;
    std::sort(sorted.begin(), sorted.end());
    median = sorted[(sorted.size() - 1) / 2];
  }
  const auto reach = [&](double distance) {
    return 0.5 * (distance > kKeogramPlotGap * median ? median : distance);
  };
  std::vector<TimeSpan> spans;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const double before = i > 0 ? distances[i - 1] : median,
                 after = i < distances.size() ? distances[i] : median;
    spans.push_back({columns[i].time - reach(before), columns[i].time + reach(after)});
  }
  return spans;
}

Plot keogram_plot(const Keogram& keogram, const KeogramLook& look) {
  const char* const names[3] = {"red", "green", "blue"};
  const std::vector<TimeSpan> spans = column_spans(keogram);
  const KeogramScale scale = scale_of(keogram, look);
  Plot plot;
  plot.title = "Keogram of " + std::to_string(keogram.columns.size()) + " pictures, from " +
               keogram.columns.front().file_name;
  plot.note = look.channel ? std::string(names[*look.channel]) + " channel" : "in colour";
  plot.note += ", light from " + sim::short_number(scale.black, 4) + " (black) to " +
               sim::short_number(scale.white, 4) + " (white), shown by the sRGB curve; " + keogram.decoding;
  Panel panel;
  panel.raster = raster_of(keogram, look, scale, spans);
  label_positions(keogram.line, panel);
  label_times(keogram, panel);
  plot.panels = {panel};
  plot.panel_width_px = kPanelWidth;
  plot.panel_height_px = kPanelHeight;
  return plot;
}

}  // namespace vegard::fit
