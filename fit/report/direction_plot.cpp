#include "fit/report/direction_plot.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "sim/base/file/number_text.h"

namespace vegard::fit {
namespace {

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
