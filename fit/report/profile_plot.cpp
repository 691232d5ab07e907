#include "fit/report/profile_plot.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "fit/report/table/report_bins.h"
#include "sim/base/file/number_text.h"
#include "sim/base/number/constants.h"

namespace vegard::fit {
namespace {

constexpr int kMaxPanels = 6;
constexpr int kMaxRows = 500;

struct PlottedCell {
  double mean = sim::kNaN, sigma = sim::kNaN;
};

/// The mean over the usable pixels of some bands and rows, and its standard error.
PlottedCell average(const Profile& profile, int first_band, int end_band, int first_row, int end_row,
                    int channel) {
  double sum = 0.0, variance = 0.0, count = 0.0;
  for (int band = first_band; band < end_band; ++band)
    for (int row = first_row; row < end_row; ++row) {
      const std::size_t i = profile.index(band, row, channel);
      const double n = profile.count[i];
      if (n == 0) continue;
      sum += n * profile.mean[i];
      // Not known for a single pixel: it then counts as one of the same without error.
      if (std::isfinite(profile.standard_error[i])) variance += std::pow(n * profile.standard_error[i], 2);
      count += n;
    }
  if (count == 0) return {};
  return {sum / count, std::sqrt(variance) / count};
}

/// The channel that alone has pixels, as of a grey sensor's photograph; -1: there are several.
int only_channel(const Profile& profile) {
  bool has[3] = {false, false, false};
  for (std::size_t i = 0; i < profile.count.size(); ++i) has[i % 3] = has[i % 3] || profile.count[i] > 0;
  if (has[0] + has[1] + has[2] != 1) return -1;
  return has[0] ? 0 : has[1] ? 1 : 2;
}

std::string panel_title(const Profile& profile, int first_band, int end_band) {
  if (has_named_axes(profile)) {
    BinAxis axis = profile.grid->across;
    axis.first = axis.edge(first_band);
    axis.step *= end_band - first_band;
    return group_words(axis, 0);
  }
  const int begin = band_begin(profile.region, profile.bands, first_band);
  const int end = band_begin(profile.region, profile.bands, end_band);
  return "columns " + std::to_string(begin) + "\u2013" + std::to_string(end - 1);
}

Panel band_panel(const Profile& profile, int first_band, int end_band, int rows_each, int only,
                 const ElevationOfPixel& elevation_of_pixel) {
  Panel panel;
  panel.title = panel_title(profile, first_band, end_band);
  const char* names[3] = {"red", "green", "blue"};
  for (int channel = 0; channel < 3; ++channel) {
    if (only >= 0 && channel != only) continue;
    Series series;
    series.label = only >= 0 ? "" : names[channel];
    series.colour = only >= 0 ? kGreyInk : channel_colour(channel);
    series.band_along_x = !has_named_axes(profile);
    for (int row = 0; row < profile.rows; row += rows_each) {
      const int end_row = std::min(profile.rows, row + rows_each);
      const PlottedCell cell = average(profile, first_band, end_band, row, end_row, channel);
      if (has_named_axes(profile)) {
        series.x.push_back(profile.grid->along.edge(0.5 * (row + end_row)));
        series.y.push_back(cell.mean);
        series.low.push_back(cell.mean - cell.sigma);
        series.high.push_back(cell.mean + cell.sigma);
        continue;
      }
      double height = profile.region.y + 0.5 * (row + end_row);
      if (elevation_of_pixel) {
        const double middle = 0.5 * (band_begin(profile.region, profile.bands, first_band) +
                                     band_begin(profile.region, profile.bands, end_band));
        height = elevation_of_pixel(middle, height);
      }
      series.x.push_back(cell.mean);
      series.y.push_back(height);
      series.low.push_back(cell.mean - cell.sigma);
      series.high.push_back(cell.mean + cell.sigma);
    }
    panel.series.push_back(std::move(series));
  }
  return panel;
}

constexpr int kColours = 7;              ///< of distinct_colour()
constexpr int kMaxLines = 2 * kColours;  ///< the second seven are dashed

/// value(sector, position) with its error as lines against elevation.
template <class ValueOf>
Panel panel_of(const DirectionProfile& directions, const std::vector<int>& drawn, const std::string& title,
               const std::string& label, const ValueOf& value_of) {
  Panel panel;
  panel.title = title;
  const bool tangent = directions.sectors.tangent.has_value();
  panel.x.label = tangent ? "tangent altitude (km)" : "elevation (\u00b0)";
  panel.y.label = label;
  for (std::size_t k = 0; k < drawn.size(); ++k) {
    Series series;
    series.label = sim::short_number(directions.sectors.azimuths_deg[drawn[k]], 4) + "\u00b0";
    series.colour = distinct_colour(static_cast<int>(k));
    series.mark = k < kColours ? Mark::line : Mark::dashed_line;
    for (int position = 0; position < directions.profile.rows; ++position) {
      const Ratio value = value_of(drawn[k], position);
      series.x.push_back(tangent ? tangent_of_position_km(directions.sectors, position)
                                 : elevation_of_position_deg(directions.sectors, position));
      series.y.push_back(value.value);
      series.low.push_back(value.value - value.sigma);
      series.high.push_back(value.value + value.sigma);
    }
    panel.series.push_back(std::move(series));
  }
  return panel;
}

}  // namespace

Plot profile_plot(const Photo& photo, const Profile& profile, const ElevationOfPixel& elevation_of_pixel) {
  Plot plot;
  const int panels = std::min(profile.bands, kMaxPanels);
  const int rows_each = std::max(1, (profile.rows + kMaxRows - 1) / kMaxRows);
  // Through filters a channel is a line, and has its name.
  const int only = photo.filters.empty() ? only_channel(profile) : -1;
  for (int p = 0; p < panels; ++p)
    plot.panels.push_back(band_panel(profile, profile.bands * p / panels, profile.bands * (p + 1) / panels,
                                     rows_each, only, elevation_of_pixel));
  for (Panel& panel : plot.panels)
    for (std::size_t c = 0; c < photo.filters.size() && c < panel.series.size(); ++c)
      panel.series[c].label = photo.filters[c].wavelength_nm > 0.0
                                  ? sim::short_number(photo.filters[c].wavelength_nm) + " nm"
                                  : "no file";
  const bool named = has_named_axes(profile);
  plot.title = (named ? "Profiles of " : "Vertical profiles of ") + photo.file_name;
  plot.note = std::string("Mean linear light per ") + (named ? "bin" : "row") +
              "; shaded: \u00b11 standard error; " + photo.decoding;
  if (panels < profile.bands)
    plot.note += "; " + std::to_string(profile.bands) + " bands in " + std::to_string(panels) + " panels";
  if (rows_each > 1) plot.note += "; " + std::to_string(rows_each) + " rows per point";
  plot.shared_axes = true;
  plot.panel_width_px = panels == 1 ? 420 : panels <= 3 ? 260 : 1000 / panels;
  plot.panel_height_px = 400;
  Panel& first = plot.panels.front();
  const std::string light = photo.floating ? "linear light (the file's units)" : "linear light (white = 1)";
  if (named) {
    first.x.label = axis_label(profile.grid->along);
    first.y.label = light;
    return plot;
  }
  first.x.label = light;
  if (elevation_of_pixel) {
    first.y.label = "elevation (\u00b0)";
  } else {
    first.y.label = "row (px)";
    first.y.reversed = true;
    first.y.min = profile.region.y;
    first.y.max = profile.region.y + profile.rows;
  }
  return plot;
}

Plot direction_profile_plot(const Photo& photo, const DirectionProfile& directions) {
  const Profile& profile = directions.profile;
  Plot plot;
  plot.title = "Profiles by direction of " + photo.file_name;
  plot.note = std::string("Mean linear light against ") +
              (directions.sectors.tangent ? "tangent altitude" : "elevation") +
              ", a line per azimuth; shaded: \u00b11 standard error; " + photo.decoding;
  std::vector<int> drawn;
  const int lines = std::min(profile.bands, kMaxLines);
  for (int k = 0; k < lines; ++k) drawn.push_back(profile.bands * k / lines);
  if (lines < profile.bands)
    plot.note += "; " + std::to_string(lines) + " of " + std::to_string(profile.bands) + " azimuths";
  const char* names[3] = {"red", "green", "blue"};
  const std::string unit = photo.floating ? "light (the file's units)" : "light (white = 1)";
  for (int c = 0; c < 3; ++c)
    plot.panels.push_back(panel_of(directions, drawn, names[c], unit, [&](int sector, int position) {
      const std::size_t i = profile.index(sector, position, c);
      return Ratio{profile.mean[i], profile.standard_error[i]};
    }));
  for (const int c : {0, 2})
    plot.panels.push_back(
        panel_of(directions, drawn, std::string(names[c]) + " / green", "ratio",
                 [&](int sector, int position) { return channel_ratio(profile, sector, position, c, 1); }));
  plot.columns = 3;
  plot.panel_width_px = 300;
  plot.panel_height_px = 260;
  return plot;
}

}  // namespace vegard::fit
