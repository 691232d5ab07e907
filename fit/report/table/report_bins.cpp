#include "fit/report/table/report_bins.h"

#include <algorithm>
#include <cmath>

#include "fit/answer/answer.h"
#include "fit/photo/grey_light.h"
#include "sim/base/file/number_text.h"

namespace vegard::fit {
namespace {

constexpr int kBinsMaxBands = 12;
constexpr double kMaxSigma = 0.5;  ///< of a gain that is drawn: others would take the scale for themselves
constexpr Colour kBinsModelInk{40, 40, 40}, kGrey{120, 120, 120};
const char* const kChannelNames[3] = {"red", "green", "blue"};
const char* const kBinsHowToRead = "Dots: photograph. Shaded: \u00b11 \u03c3. Thin line: model.";

/// Photograph and model by position, of one channel; NaN where nothing was used.
struct Curve {
  std::vector<double> place, data, sigma, model;
  bool any = false;
};

/// The mean over some bands, weighed by pixels, with bands taken as independent.
Curve mean_over(const FittedPhoto& fitted, int first_band, int end_band, int channel) {
  const Profile& data = fitted.data;
  Curve curve;
  for (int p = 0; p < data.rows; ++p) {
    double count = 0.0, light = 0.0, model = 0.0, variance = 0.0;
    for (int b = first_band; b < end_band; ++b) {
      const std::size_t i = data.index(b, p, channel);
      if (i >= fitted.sigma.size() || i >= fitted.model.size() || !(fitted.sigma[i] > 0.0)) continue;
      const double n = data.count[i];
      count += n;
      light += n * data.mean[i];
      model += n * fitted.model[i];
      variance += std::pow(n * fitted.sigma[i], 2);
    }
    curve.place.push_back(data.grid->along.edge(p + 0.5));
    curve.data.push_back(count > 0.0 ? light / count : NAN);
    curve.model.push_back(count > 0.0 ? model / count : NAN);
    curve.sigma.push_back(count > 0.0 ? std::sqrt(variance) / count : NAN);
    curve.any = curve.any || count > 0.0;
  }
  return curve;
}

Series line(const std::vector<double>& x, const std::vector<double>& y, Colour colour,
            Mark mark = Mark::line) {
  Series series;
  series.colour = colour;
  series.mark = mark;
  series.width_px = 1.1;
  series.x = x;
  series.y = y;
  return series;
}

Panel light_panel(const FittedPhoto& fitted, int first_band, int end_band, double diameter_px) {
  Panel panel;
  std::vector<Series> models;
  for (int c = 0; c < 3; ++c) {
    const Curve curve = mean_over(fitted, first_band, end_band, c);
    if (!curve.any) continue;
    Series dots = line(curve.place, curve.data, channel_ink(fitted.best, c), Mark::points);
    dots.label = channel_name(fitted.best, c);
    dots.width_px = diameter_px;
    for (std::size_t i = 0; i < curve.data.size(); ++i) {
      dots.low.push_back(curve.data[i] - curve.sigma[i]);
      dots.high.push_back(curve.data[i] + curve.sigma[i]);
    }
    panel.series.push_back(std::move(dots));
    models.push_back(line(curve.place, curve.model, kBinsModelInk));
    models.back().label = "model";
  }
  panel.series.insert(panel.series.end(), models.begin(), models.end());
  return panel;
}

}  // namespace

std::string channel_name(const sim::Scene& scene, int channel) {
  return is_grey(scene) ? "photograph" : kChannelNames[channel];
}

Colour channel_ink(const sim::Scene& scene, int channel) {
  return is_grey(scene) ? kGreyInk : channel_colour(channel);
}

bool has_named_axes(const Profile& profile) {
  return profile.grid != nullptr && profile.grid->along.is_given();
}

std::string axis_label(const BinAxis& axis) {
  return axis.unit.empty() ? axis.name : axis.name + " (" + axis.unit + ")";
}

std::string group_words(const BinAxis& axis, int group) {
  const std::string unit = axis.unit == "\u00b0" || axis.unit.empty() ? axis.unit : " " + axis.unit;
  return sim::short_number(axis.edge(group), 4) + "\u2013" + sim::short_number(axis.edge(group + 1), 4) +
         unit;
}

std::string bins_mean_svg(const FittedPhoto& fitted) {
  Plot plot;
  plot.title = "Brightness";
  plot.note = kBinsHowToRead;
  plot.panels.push_back(light_panel(fitted, 0, fitted.data.bands, 4.4));
  plot.panels[0].x.label = axis_label(fitted.data.grid->along);
  plot.panels[0].y.label = "linear light, mean over the bands";
  plot.panel_width_px = 480;
  plot.panel_height_px = 320;
  return plot_svg(plot);
}

std::string bins_residual_svg(const FittedPhoto& fitted) {
  Plot plot;
  plot.title = "Residuals";
  plot.note = "Dashed: \u00b11 \u03c3.";
  Panel panel;
  const BinAxis& axis = fitted.data.grid->along;
  const std::vector<double> ends = {axis.edge(0), axis.edge(fitted.data.rows)};
  panel.series.push_back(line(ends, {0.0, 0.0}, kGrey));
  panel.series.push_back(line(ends, {-1.0, -1.0}, kGrey, Mark::dashed_line));
  panel.series.push_back(line(ends, {1.0, 1.0}, kGrey, Mark::dashed_line));
  double widest = 3.0;
  for (int c = 0; c < 3; ++c) {
    const Curve curve = mean_over(fitted, 0, fitted.data.bands, c);
    if (!curve.any) continue;
    std::vector<double> sigmas;
    for (std::size_t i = 0; i < curve.data.size(); ++i) {
      sigmas.push_back((curve.data[i] - curve.model[i]) / curve.sigma[i]);
      if (std::isfinite(sigmas.back())) widest = std::max(widest, 1.05 * std::abs(sigmas.back()));
    }
    panel.series.push_back(line(curve.place, sigmas, channel_ink(fitted.best, c), Mark::points));
    panel.series.back().width_px = 3.2;
    panel.series.back().label = channel_name(fitted.best, c);
  }
  panel.x.label = axis_label(axis);
  panel.y.label = "(photograph \u2212 model) / \u03c3";
  panel.y.min = -widest;
  panel.y.max = widest;
  plot.panels.push_back(std::move(panel));
  plot.panel_width_px = 360;
  plot.panel_height_px = 320;
  return plot_svg(plot);
}

std::string bins_bands_svg(const FittedPhoto& fitted) {
  const Profile& data = fitted.data;
  const int panels = std::min(data.bands, kBinsMaxBands);
  Plot plot;
  plot.title = "Single bands";
  plot.note = panels < data.bands
                  ? std::to_string(panels) + " of " + std::to_string(data.bands) + " bands. " + kBinsHowToRead
                  : std::string(kBinsHowToRead);
  for (int p = 0; p < panels; ++p) {
    const int band = (2 * p + 1) * data.bands / (2 * panels);
    Panel panel = light_panel(fitted, band, band + 1, 3.4);
    panel.title = "band " + std::to_string(band) + ": " + group_words(data.grid->across, band);
    panel.x.label = axis_label(data.grid->along);
    panel.y.label = "linear light";
    plot.panels.push_back(std::move(panel));
  }
  if (panels == 0) plot.panels.emplace_back();
  plot.columns = 3;
  plot.panel_width_px = 270;
  plot.panel_height_px = 190;
  return plot_svg(plot);
}

std::string bins_brightness_svg(const FittedPhoto& fitted) {
  Plot plot;
  plot.title = "Brightness of the bands";
  plot.note =
      "The gain of each band: the model\u2019s light is multiplied by it. Shaded: \u00b11 \u03c3. Left out: "
      "bands whose \u03c3 is above half of the gain";
  Panel panel;
  const Profile& data = fitted.data;
  const std::vector<std::vector<double>> sigmas = gain_sigmas(fitted);
  std::string left_out;
  for (int c = 0; c < 3; ++c) {
    const bool per_channel = !fitted.best.fit.white_balance_known && !is_grey(fitted.best);
    if (!per_channel && c != kGreyChannel) continue;  // one gain for all
    if (per_channel && !mean_over(fitted, 0, data.bands, c).any) continue;
    Series series = line({}, {}, channel_ink(fitted.best, c), Mark::points);
    series.width_px = 5.0;
    if (per_channel) series.label = kChannelNames[c];
    for (int b = 0; b < data.bands && b < static_cast<int>(fitted.gain.size()); ++b) {
      const double sigma = sigmas[b][c];
      if (!(sigma <= kMaxSigma * fitted.gain[b][c])) {
        const std::string name = std::to_string(b) + (per_channel ? std::string(" ") + kChannelNames[c] : "");
        left_out += (left_out.empty() ? "" : ", ") + name;
        continue;
      }
      series.x.push_back(data.grid->across.edge(b + 0.5));
      series.y.push_back(fitted.gain[b][c]);
      series.low.push_back(fitted.gain[b][c] - sigma);
      series.high.push_back(fitted.gain[b][c] + sigma);
    }
    panel.series.push_back(std::move(series));
  }
  plot.note += left_out.empty() ? "; none." : " (" + left_out + ").";
  panel.x.label = axis_label(data.grid->across) + "; band 0 at the left";
  panel.x.min = data.grid->across.edge(0);
  panel.x.max = data.grid->across.edge(data.bands);
  panel.y.label = "gain";
  panel.y.min = 0.0;
  plot.panels.push_back(std::move(panel));
  plot.panel_width_px = 420;
  plot.panel_height_px = 280;
  return plot_svg(plot);
}

}  // namespace vegard::fit
