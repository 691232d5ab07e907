#include "fit/report/report_plots.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "fit/photo/grey_light.h"
#include "fit/report/plot/plot.h"
#include "fit/report/table/report_bins.h"
#include "sim/base/file/number_text.h"
#include "sim/base/number/constants.h"

namespace vegard::fit {
namespace {

constexpr int kMeanPoints = 160, kBandPoints = 110, kReportMaxBands = 6;
constexpr int kTallPanel = 430;
constexpr Colour kReportModelInk{40, 40, 40};
const char* const kReportHowToRead = "Dots: photograph. Shaded: \u00b11 \u03c3. Thin line: model.";

void set_height_axis(const FittedPhoto& fitted, const ElevationOfPixel& elevation_of_pixel, Axis& axis) {
  if (elevation_of_pixel) {
    axis.label = "elevation (\u00b0)";
    return;
  }
  axis.label = "row (px)";
  axis.reversed = true;
  axis.min = fitted.data.region.y;
  axis.max = fitted.data.region.y + fitted.data.rows;
}

Series points(const std::vector<double>& x, const std::vector<double>& sigma,
              const std::vector<double>& height, Colour colour, double diameter_px) {
  Series series;
  series.colour = colour;
  series.mark = Mark::points;
  series.width_px = diameter_px;
  series.x = x;
  series.y = height;
  series.band_along_x = true;
  for (std::size_t i = 0; i < sigma.size(); ++i) {
    series.low.push_back(x[i] - sigma[i]);
    series.high.push_back(x[i] + sigma[i]);
  }
  return series;
}

Series curve(const std::string& label, const std::vector<double>& x, const std::vector<double>& height,
             Colour colour) {
  Series series;
  series.label = label;
  series.colour = colour;
  series.width_px = 1.8;
  series.x = x;
  series.y = height;
  return series;
}

/// Thin and dark, over the dots that it is to meet.
Series model_curve(const std::vector<double>& x, const std::vector<double>& height) {
  Series series = curve("model", x, height, kReportModelInk);
  series.width_px = 1.1;
  return series;
}

Panel brightness_panel(const sim::Scene& scene, const ComparedProfile& profile, double diameter_px) {
  Panel panel;
  for (int c = 0; c < 3; ++c) {
    if (!has_channel(scene, c)) continue;
    Series series =
        points(profile.data[c], profile.sigma[c], profile.height, channel_ink(scene, c), diameter_px);
    series.label = channel_name(scene, c);
    panel.series.push_back(std::move(series));
  }
  for (int c = 0; c < 3; ++c)
    if (has_channel(scene, c)) panel.series.push_back(model_curve(profile.model[c], profile.height));
  return panel;
}

ComparedProfile mean_of_all(const FittedPhoto& fitted, const ElevationOfPixel& elevation_of_pixel) {
  return compared_profile(fitted, 0, fitted.data.bands, kMeanPoints, elevation_of_pixel);
}

Series upright(double x, const std::vector<double>& height, Colour colour, Mark mark) {
  Series series = curve("", {x, x}, {height.front(), height.back()}, colour);
  series.mark = mark;
  series.width_px = 1.0;
  return series;
}

Panel share_panel(const std::string& title, const ComparedProfile& profile, const std::vector<double>& data,
                  const std::vector<double>& sigma, const std::vector<double>& model, Colour colour) {
  Panel panel;
  panel.title = title;
  panel.series.push_back(points(data, sigma, profile.height, colour, 4.0));
  panel.series.push_back(model_curve(model, profile.height));
  panel.x.label = title;
  panel.x.min = 0.0;
  panel.x.max = 1.0;
  return panel;
}

/// "descent 1", "descent 2" are one kind.
std::string kind_of(const std::string& stage) {
  return stage.substr(0, stage.find_last_not_of("0123456789 ") + 1);
}

/// The other stages work on smoothed profiles with errors of their own (fit/search/search.h): their chi2 is
/// another scale.
bool is_of_full_model(const std::string& kind) { return kind == "start" || kind == "polish"; }

/// A line of steps that only falls.
struct BestSoFar {
  explicit BestSoFar(Mark mark) {
    series.mark = mark;
    series.colour = {60, 60, 60};
  }
  void add(double evaluation, double height) {
    if (!series.x.empty()) point(evaluation);
    least = std::min(least, height);
    point(evaluation);
  }
  void point(double evaluation) {
    series.x.push_back(evaluation);
    series.y.push_back(least);
  }
  Series series;
  double least = INFINITY;
};

struct ComparedCell {
  double data = sim::kNaN, sigma = sim::kNaN, model = sim::kNaN;
};

ComparedCell mean_over_bands(const FittedPhoto& fitted, int first_band, int end_band, int row, int channel) {
  double count = 0.0, data = 0.0, model = 0.0, variance = 0.0;
  for (int band = first_band; band < end_band; ++band) {
    const std::size_t i = fitted.data.index(band, row, channel);
    if (i >= fitted.sigma.size() || i >= fitted.model.size()) continue;
    const double n = fitted.data.count[i];
    if (n == 0 || !(fitted.sigma[i] > 0.0)) continue;
    count += n;
    data += n * fitted.data.mean[i];
    model += n * fitted.model[i];
    variance += std::pow(n * fitted.sigma[i], 2);
  }
  if (count == 0.0) return {};
  return {data / count, std::sqrt(variance) / count, model / count};
}

ComparedCell mean_over_rows(const FittedPhoto& fitted, int first_band, int end_band, int first_row,
                            int end_row, int channel) {
  int rows = 0;
  double data = 0.0, model = 0.0, variance = 0.0;
  for (int row = first_row; row < end_row; ++row) {
    const ComparedCell cell = mean_over_bands(fitted, first_band, end_band, row, channel);
    if (!std::isfinite(cell.data)) continue;
    ++rows;
    data += cell.data;
    model += cell.model;
    variance += cell.sigma * cell.sigma;
  }
  if (rows == 0) return {};
  return {data / rows, std::sqrt(variance / rows), model / rows};
}

/// One row of one band, so that its colour is computed where every colour is.
Chromaticity colour_of(const std::array<std::vector<double>, 3>& light,
                       const std::array<std::vector<double>, 3>& sigma, std::size_t i) {
  Profile profile;
  profile.bands = profile.rows = 1;
  for (int c = 0; c < 3; ++c) {
    profile.mean.push_back(light[c][i]);
    profile.standard_error.push_back(sigma[c][i]);
    profile.count.push_back(std::isfinite(light[c][i]) ? 1 : 0);
  }
  return chromaticity(profile, 0, 0);
}

}  // namespace

std::string mean_profile_svg(const FittedPhoto& fitted, const ElevationOfPixel& elevation_of_pixel) {
  Plot plot;
  plot.title = "Brightness";
  plot.note = kReportHowToRead;
  plot.panels.push_back(brightness_panel(fitted.best, mean_of_all(fitted, elevation_of_pixel), 4.4));
  plot.panels[0].x.label = "linear light, mean over the bands";
  set_height_axis(fitted, elevation_of_pixel, plot.panels[0].y);
  plot.panel_width_px = 520;
  plot.panel_height_px = kTallPanel;
  return plot_svg(plot);
}

std::string mean_residual_svg(const FittedPhoto& fitted, const ElevationOfPixel& elevation_of_pixel) {
  const ComparedProfile profile = mean_of_all(fitted, elevation_of_pixel);
  Plot plot;
  plot.title = "Residuals";
  plot.note = "Dashed: \u00b11 \u03c3.";
  Panel panel;
  constexpr Colour kGrey{120, 120, 120};
  if (!profile.height.empty()) {
    panel.series.push_back(upright(0.0, profile.height, kGrey, Mark::line));
    panel.series.push_back(upright(-1.0, profile.height, kGrey, Mark::dashed_line));
    panel.series.push_back(upright(1.0, profile.height, kGrey, Mark::dashed_line));
  }
  double widest = 3.0;
  for (int c = 0; c < 3; ++c) {
    if (!has_channel(fitted.best, c)) continue;
    std::vector<double> sigmas;
    for (std::size_t i = 0; i < profile.height.size(); ++i)
      sigmas.push_back((profile.data[c][i] - profile.model[c][i]) / profile.sigma[c][i]);
    for (const double s : sigmas)
      if (std::isfinite(s)) widest = std::max(widest, 1.05 * std::abs(s));
    Series series = points(sigmas, {}, profile.height, channel_ink(fitted.best, c), 3.2);
    series.label = channel_name(fitted.best, c);
    panel.series.push_back(std::move(series));
  }
  panel.x.label = "(photograph \u2212 model) / \u03c3";
  panel.x.min = -widest;
  panel.x.max = widest;
  set_height_axis(fitted, elevation_of_pixel, panel.y);
  plot.panels.push_back(std::move(panel));
  plot.panel_width_px = 300;
  plot.panel_height_px = kTallPanel;
  return plot_svg(plot);
}

std::string colour_svg(const FittedPhoto& fitted, const ElevationOfPixel& elevation_of_pixel) {
  if (is_grey(fitted.best)) return {};
  const ComparedProfile profile = mean_of_all(fitted, elevation_of_pixel);
  const ComparedColour colour = compared_colour(profile);
  Plot plot;
  plot.title = "Colour";
  plot.note = kReportHowToRead;
  plot.panels.push_back(share_panel("r / (r + g + b)", profile, colour.data_r, colour.sigma_r, colour.model_r,
                                    channel_colour(0)));
  plot.panels.push_back(share_panel("g / (r + g + b)", profile, colour.data_g, colour.sigma_g, colour.model_g,
                                    channel_colour(1)));
  for (Panel& panel : plot.panels) {
    panel.title.clear();
    set_height_axis(fitted, elevation_of_pixel, panel.y);
  }
  plot.panel_width_px = 410;
  plot.panel_height_px = 300;
  return plot_svg(plot);
}

std::string free_profiles_svg(const FitResult& result) {
  if (result.profiles.empty()) return {};
  Plot plot;
  plot.title = "Volume emission rate";
  plot.note =
      "Shaded: 68 % of each altitude by itself, given all that was not free. A dashed end has a band wider "
      "than a factor of two: there the curve is what the prior makes of its neighbours.";
  for (const FreeProfile& profile : result.profiles) {
    Panel panel;
    panel.title = sim::short_number(profile.wavelength_nm, 4) + " nm";
    if (result.best.sheets.size() > 1) panel.title += ", " + profile.sheet;
    Series known = curve("", {}, {}, line_ink(profile.wavelength_nm)), unknown = known;
    known.band_along_x = true;
    unknown.mark = Mark::dashed_line;
    unknown.width_px = 1.0;
    const double peak = *std::max_element(profile.rate.begin(), profile.rate.end());
    for (std::size_t i = 0; i < profile.rate.size(); ++i) {
      if (profile.rate[i] < 1e-3 * peak) continue;
      const bool constrained = profile.upper[i] < 2.0 * profile.rate[i];
      known.x.push_back(constrained ? profile.rate[i] : NAN);
      known.low.push_back(constrained ? profile.lower[i] : NAN);
      known.high.push_back(constrained ? profile.upper[i] : NAN);
      known.y.push_back(profile.altitude_km[i]);
      unknown.x.push_back(constrained ? NAN : profile.rate[i]);
      unknown.y.push_back(profile.altitude_km[i]);
    }
    panel.series = {known, unknown};
    panel.x.label = "cm\u207b\u00b3 s\u207b\u00b9 per mW m\u207b\u00b2";
    panel.x.min = 0.0;
    panel.y.label = "altitude (km)";
    plot.panels.push_back(std::move(panel));
  }
  plot.columns = 3;
  plot.panel_width_px = 260;
  plot.panel_height_px = kTallPanel;
  return plot_svg(plot);
}

std::string radars_svg(const FitResult& result) {
  if (result.radars.empty()) return {};
  constexpr double kShown = 1e-5;  // 10^11 m^-3 of cm^-3
  Plot plot;
  plot.title = "Density of electrons";
  plot.note = "Dashed: of the electrons alone. Solid: with the scale, and physics moved within its errors.";
  for (const FittedRadar& radar : result.radars) {
    Panel panel;
    panel.title = radar.name;
    Series measured = curve("measured", {}, radar.altitude_km, distinct_colour(1)),
           model = curve("fitted", {}, radar.altitude_km, distinct_colour(0)), alone = model;
    measured.mark = Mark::points;
    measured.width_px = 4.0;
    measured.band_along_x = measured.error_bars = true;
    alone.label = "of the electrons alone";
    alone.mark = Mark::dashed_line;
    alone.width_px = 1.0;
    for (std::size_t i = 0; i < radar.altitude_km.size(); ++i) {
      measured.x.push_back(kShown * radar.density_cm3[i]);
      measured.low.push_back(kShown * (radar.density_cm3[i] - radar.sigma_cm3[i]));
      measured.high.push_back(kShown * (radar.density_cm3[i] + radar.sigma_cm3[i]));
      model.x.push_back(kShown * radar.model_cm3[i]);
      alone.x.push_back(kShown * radar.electrons_cm3[i]);
    }
    panel.series = {alone, model, measured};
    panel.x.label = "10\u00b9\u00b9 m\u207b\u00b3";
    panel.y.label = "altitude (km)";
    plot.panels.push_back(std::move(panel));
  }
  plot.columns = 3;
  plot.panel_width_px = 296;
  plot.panel_height_px = kTallPanel;
  return plot_svg(plot);
}

std::string band_profiles_svg(const FittedPhoto& fitted, const ElevationOfPixel& elevation_of_pixel) {
  const Profile& data = fitted.data;
  const int panels = std::min(data.bands, kReportMaxBands);
  Plot plot;
  plot.title = "Single bands";
  plot.note = panels < data.bands ? std::to_string(panels) + " of " + std::to_string(data.bands) +
                                        " bands, from left to right. " + kReportHowToRead
                                  : std::string("From left to right. ") + kReportHowToRead;
  for (int p = 0; p < panels; ++p) {
    const int band = (2 * p + 1) * data.bands / (2 * panels);
    Panel panel = brightness_panel(
        fitted.best, compared_profile(fitted, band, band + 1, kBandPoints, elevation_of_pixel), 3.4);
    panel.title = "band " + std::to_string(band) + ", columns " +
                  std::to_string(band_begin(data.region, data.bands, band)) + "\u2013" +
                  std::to_string(band_begin(data.region, data.bands, band + 1) - 1);
    plot.panels.push_back(std::move(panel));
  }
  if (panels == 0) plot.panels.emplace_back();
  plot.panels[0].x.label = "linear light";
  set_height_axis(fitted, elevation_of_pixel, plot.panels[0].y);
  plot.shared_axes = true;
  plot.columns = 3;
  plot.panel_width_px = 296;
  plot.panel_height_px = 230;
  return plot_svg(plot);
}

std::string trace_svg(const FitResult& result) {
  Panel panel;
  std::map<std::string, std::size_t> series_of_stage;
  BestSoFar coarse(Mark::dashed_line), full(Mark::line);
  for (const TraceRow& row : result.trace) {
    if (result.dof <= 0 || !(row.chi2 > 0.0) || !std::isfinite(row.chi2)) continue;
    const double height = std::log10(row.chi2 / result.dof);
    const std::string kind = kind_of(row.stage);
    const auto [place, is_new] = series_of_stage.emplace(kind, panel.series.size());
    if (is_new) {
      Series series;
      series.label = kind;
      series.mark = Mark::points;
      series.width_px = 4.0;
      series.colour = distinct_colour(static_cast<int>(panel.series.size()));
      panel.series.push_back(std::move(series));
    }
    panel.series[place->second].x.push_back(row.evaluation);
    panel.series[place->second].y.push_back(height);
    (is_of_full_model(kind) ? full : coarse).add(row.evaluation, height);
  }
  for (BestSoFar* best : {&coarse, &full})
    if (!best->series.x.empty()) panel.series.insert(panel.series.begin(), std::move(best->series));
  panel.x.label = "evaluation";
  panel.y.label = "log\u2081\u2080(\u03c7\u00b2 / degree of freedom)";
  Plot plot;
  plot.title = "The search";
  plot.panels.push_back(std::move(panel));
  plot.panel_width_px = 420;
  plot.panel_height_px = 260;
  return plot_svg(plot);
}

ComparedProfile compared_profile(const FittedPhoto& fitted, int first_band, int end_band, int max_points,
                                 const ElevationOfPixel& elevation_of_pixel) {
  const Profile& data = fitted.data;
  const int rows_each = std::max(1, (data.rows + max_points - 1) / max_points);
  const double middle =
      0.5 * (band_begin(data.region, data.bands, first_band) + band_begin(data.region, data.bands, end_band));
  ComparedProfile profile;
  for (int row = 0; row < data.rows; row += rows_each) {
    const int end_row = std::min(data.rows, row + rows_each);
    const double y_px = data.region.y + 0.5 * (row + end_row);
    profile.height.push_back(elevation_of_pixel ? elevation_of_pixel(middle, y_px) : y_px);
    for (int c = 0; c < 3; ++c) {
      const ComparedCell cell = mean_over_rows(fitted, first_band, end_band, row, end_row, c);
      profile.data[c].push_back(cell.data);
      profile.sigma[c].push_back(cell.sigma);
      profile.model[c].push_back(cell.model);
    }
  }
  return profile;
}

ComparedColour compared_colour(const ComparedProfile& profile) {
  ComparedColour colour;
  for (std::size_t i = 0; i < profile.height.size(); ++i) {
    const Chromaticity data = colour_of(profile.data, profile.sigma, i);
    const Chromaticity model = colour_of(profile.model, profile.sigma, i);
    colour.data_r.push_back(data.r);
    colour.data_g.push_back(data.g);
    colour.sigma_r.push_back(data.sigma_r);
    colour.sigma_g.push_back(data.sigma_g);
    colour.model_r.push_back(model.r);
    colour.model_g.push_back(model.g);
  }
  return colour;
}

}  // namespace vegard::fit
