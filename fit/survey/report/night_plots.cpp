#include "fit/survey/report/night_plots.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "fit/report/plot/plot_axis.h"
#include "fit/report/plot/plot_canvas.h"
#include "sim/base/file/number_text.h"
#include "sim/base/number/constants.h"

namespace vegard::fit {
namespace {

constexpr int kMaxMarks = 400, kMaxEnergyDots = 1500;
constexpr double kNightTickDistance_px = 75.0;
constexpr Colour kDoubtfulInk{176, 184, 194}, kStripGround{238, 241, 245}, kStripMeasured{96, 178, 152},
    kStripEnergy{196, 84, 10}, kBarText{95, 95, 95}, kBarAxis{150, 150, 150};

struct KindWords {
  FollowedKind kind;
  const char *title, *axis;
};
constexpr std::array<KindWords, 7> kCurveKinds = {{
    {FollowedKind::energy, "Mean electron energy", "energy (keV)"},
    {FollowedKind::characteristic, "Characteristic energy of the map's strongest curtain", "energy (keV)"},
    {FollowedKind::flux, "Energy flux", "flux (mW m\u207b\u00b2)"},
    {FollowedKind::distance, "Distance along the ground", "distance (km)"},
    {FollowedKind::velocity, "Velocity by which the distance grows, smoothed", "velocity (m/s)"},
    {FollowedKind::altitude, "Altitude of the lower border", "altitude (km)"},
    {FollowedKind::border, "Elevation of the lower border where it is highest", "elevation (\u00b0)"},
}};

/// Sets limits that a few wild points and wide error bars do not spoil: the 1 % and 99 % quantiles, and the
/// errors there.
void set_sound_limits(Panel& panel) {
  std::vector<double> values;
  for (const Series& series : panel.series)
    for (const double y : series.y)
      if (std::isfinite(y)) values.push_back(y);
  if (values.empty()) return;
  const double low = share_of_numbers(values, 0.01), high = share_of_numbers(values, 0.99);
  const double margin = std::max(0.25 * (high - low), 0.05 * std::max(std::abs(low), std::abs(high)));
  panel.y.min = low >= 0.0 ? std::max(0.0, low - margin) : low - margin;
  panel.y.max = high + margin;
}

void set_log_ticks(Axis& axis) {
  for (int power = -3; power <= 4; ++power)
    for (const double digit : {1.0, 2.0, 5.0}) {
      axis.tick_places.push_back(std::log10(digit) + power);
      axis.tick_labels.push_back(sim::short_number(digit * std::pow(10.0, power), 1));
    }
}

Series point_series(const std::string& label, Colour colour, double width_px) {
  Series series;
  series.label = label;
  series.colour = colour;
  series.mark = Mark::points;
  series.width_px = width_px;
  return series;
}

/// Returns the numbers that were left out of the smoothed track, or that begin a new one.
Series jumps_of(const NightDigest& digest, const FollowedSeries& series) {
  Series jumped = point_series("jumps", {200, 20, 60}, 6.0);
  if (series.kind == FollowedKind::velocity) return jumped;
  for (const JumpedNumber& one : digest.jumps) {
    if (one.name != series.name || static_cast<int>(jumped.x.size()) >= kMaxMarks) continue;
    jumped.x.push_back(one.time_s);
    jumped.y.push_back(one.value);
  }
  return jumped;
}

std::string label_of_series(const FollowedSeries& series) {
  return (series.work == SurveyWork::fit ? std::string()
                                         : survey_work_name(series.work) + std::string(": ")) +
         series.name;
}

Plot one_panel(const std::string& title, const char* x_label, const char* y_label) {
  Plot plot;
  plot.panels.emplace_back();
  plot.panels[0].title = title;
  plot.panels[0].x.label = x_label;
  plot.panels[0].y.label = y_label;
  plot.panel_width_px = 400;
  plot.panel_height_px = 340;
  return plot;
}

Plot energy_frame(const std::string& title) {
  Plot plot = one_panel(title, "mean electron energy (keV)", "energy flux (mW m\u207b\u00b2)");
  set_log_ticks(plot.panels[0].x);
  set_log_ticks(plot.panels[0].y);
  return plot;
}

/// Returns a colour from white to deep blue, by the square root of the count.
Colour count_ink(int count, int most) {
  const double x = std::sqrt(static_cast<double>(count) / std::max(1, most));
  const auto mix = [&](double from, double to) {
    return static_cast<std::uint8_t>(std::lround(from + (to - from) * x));
  };
  return {mix(226, 8), mix(240, 64), mix(247, 110)};
}

/// Shows cells of equal size as a panel's raster; it is white where there are none.
void show_cells(const std::map<std::pair<int, int>, int>& cells, double width, double height, Panel& panel) {
  int left = cells.begin()->first.first, right = left, bottom = cells.begin()->first.second, top = bottom,
      most = 1;
  for (const auto& [cell, count] : cells) {
    left = std::min(left, cell.first);
    right = std::max(right, cell.first);
    bottom = std::min(bottom, cell.second);
    top = std::max(top, cell.second);
    most = std::max(most, count);
  }
  Raster& raster = panel.raster;
  raster.width = right - left + 1;
  raster.height = top - bottom + 1;
  raster.rgb.assign(static_cast<std::size_t>(raster.width) * raster.height * 3, 255);
  for (const auto& [cell, count] : cells) {
    const Colour ink = count_ink(count, most);
    std::uint8_t* to =
        &raster.rgb[3 * (static_cast<std::size_t>(top - cell.second) * raster.width + cell.first - left)];
    to[0] = ink.r;
    to[1] = ink.g;
    to[2] = ink.b;
  }
  raster.left = left * width;
  raster.right = (right + 1) * width;
  raster.bottom = bottom * height;
  raster.top = (top + 1) * height;
  panel.x.min = raster.left - width;
  panel.x.max = raster.right + width;
  panel.y.min = raster.bottom - height;
  panel.y.max = raster.top + height;
}

int cell_of(double value, double size) { return static_cast<int>(std::floor(value / size)); }

constexpr double kEnergyCell = 0.05;  ///< of a power of ten
constexpr double kHalfHour_h = 0.5, kHalfDegree = 0.5, kSecondsOfHour = 3600.0, kHoursOfDay = 24.0;

/// Returns a verdict's place in the stack: the best stands at the bottom.
int verdict_rank(const std::string& verdict) {
  const std::array<const char*, 9> order = {"good",     "arc",   "doubtful", "aurora", "none",
                                            "twilight", "cloud", "failed",   "refused"};
  const auto at = std::find(order.begin(), order.end(), verdict);
  return static_cast<int>(at - order.begin());
}

std::vector<std::pair<std::string, int>> ranked_verdicts(const std::map<std::string, int>& counts) {
  std::vector<std::pair<std::string, int>> ranked(counts.begin(), counts.end());
  std::stable_sort(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) {
    return verdict_rank(a.first) < verdict_rank(b.first);
  });
  return ranked;
}

void fill_box(PlotCanvas& canvas, const PlotRectangle& box, Colour ink) {
  canvas.area({{box.x, box.y},
               {box.x + box.width, box.y},
               {box.x + box.width, box.y + box.height},
               {box.x, box.y + box.height}},
              ink, 1.0);
}

}  // namespace

Axis time_axis(const ShownSpan& span, const std::string& label) {
  Axis axis;
  axis.label = label;
  axis.min = span.begin_s;
  axis.max = span.end_s;
  TimeTicks ticks =
      utc_ticks(span.begin_s, span.end_s, static_cast<int>(kNightPanel_px / kNightTickDistance_px));
  axis.tick_places = std::move(ticks.places);
  axis.tick_labels = std::move(ticks.labels);
  return axis;
}

std::vector<FollowedPoint> thinned(const std::vector<FollowedPoint>& points, const ShownSpan& span,
                                   int most) {
  if (static_cast<int>(points.size()) <= most) return points;
  std::map<int, std::vector<FollowedPoint>> stretches;
  for (const FollowedPoint& point : points) {
    const double at = (point.time_s - span.begin_s) / (span.end_s - span.begin_s) * most;
    stretches[std::clamp(static_cast<int>(at), 0, most - 1)].push_back(point);
  }
  std::vector<FollowedPoint> kept;
  for (auto& [number, all] : stretches) {
    std::stable_sort(all.begin(), all.end(),
                     [](const FollowedPoint& a, const FollowedPoint& b) { return a.value < b.value; });
    kept.push_back(all[(all.size() - 1) / 2]);
  }
  return kept;
}

std::vector<Series> series_of(const FollowedSeries& followed, const ShownSpan& span, const std::string& name,
                              Colour ink) {
  Series doubtful = point_series("doubtful", kDoubtfulInk, 4.0), good = point_series(name, ink, 4.0);
  doubtful.error_bars = good.error_bars = true;
  for (const FollowedPoint& point : thinned(followed.points, span, kMaxMarks)) {
    Series& to = point.is_good ? good : doubtful;
    to.x.push_back(point.time_s);
    to.y.push_back(point.value);
    to.low.push_back(point.value - point.sigma);
    to.high.push_back(point.value + point.sigma);
  }
  std::vector<Series> both;
  for (Series* series : {&doubtful, &good})
    if (!series->x.empty()) both.push_back(std::move(*series));
  return both;
}

Plot night_curves(const NightDigest& digest, const ShownSpan& span) {
  Plot plot;
  plot.columns = 1;
  plot.panel_width_px = kNightPanel_px;
  plot.panel_height_px = 130;
  for (const KindWords& words : kCurveKinds) {
    Panel panel;
    panel.title = words.title;
    panel.x = time_axis(span, "");
    panel.y.label = words.axis;
    int number = 0;
    std::string alone;
    for (const FollowedSeries& series : digest.series) {
      if (series.kind != words.kind) continue;
      const std::string name = label_of_series(series);
      alone = name;
      for (Series& shown : series_of(series, span, name, distinct_colour(number)))
        panel.series.push_back(std::move(shown));
      ++number;
      if (Series jumped = jumps_of(digest, series); !jumped.x.empty())
        panel.series.push_back(std::move(jumped));
    }
    if (panel.series.empty()) continue;
    // A single series needs no label besides the title.
    if (number == 1)
      for (Series& series : panel.series)
        if (series.label == alone) series.label.clear();
    set_sound_limits(panel);
    plot.panels.push_back(std::move(panel));
  }
  if (!plot.panels.empty()) plot.panels.back().x.label = "UTC";
  return plot;
}

Plot energy_plot(const std::vector<EnergyAndFlux>& energies) {
  if (energies.empty()) return {};
  Plot plot = energy_frame("");
  Series good = point_series("good", verdict_ink("good"), 3.0),
         doubtful = point_series("doubtful", kDoubtfulInk, 3.0);
  const std::size_t step = (energies.size() + kMaxEnergyDots - 1) / kMaxEnergyDots;
  for (std::size_t i = 0; i < energies.size(); i += step) {
    Series& to = energies[i].is_good ? good : doubtful;
    to.x.push_back(std::log10(energies[i].energy_kev));
    to.y.push_back(std::log10(energies[i].flux_mw_m2));
  }
  for (Series* series : {&doubtful, &good})
    if (!series->x.empty()) plot.panels[0].series.push_back(std::move(*series));
  if (step > 1) plot.note = "every " + std::to_string(step) + "th frame";
  return plot;
}

void EnergyCells::add(const EnergyAndFlux& pair) {
  ++cells_[{cell_of(std::log10(pair.energy_kev), kEnergyCell),
            cell_of(std::log10(pair.flux_mw_m2), kEnergyCell)}];
  ++frames_;
}

Plot EnergyCells::plot() const {
  if (cells_.empty()) return {};
  Plot plot = energy_frame("Frames by energy and flux");
  show_cells(cells_, kEnergyCell, kEnergyCell, plot.panels[0]);
  return plot;
}

void LatitudeCells::add(const LatitudeAtTime& place) {
  const double hours = place.time_s / kSecondsOfHour;
  const double hour_of_day = hours - kHoursOfDay * std::floor(hours / kHoursOfDay);
  ++cells_[{cell_of(hour_of_day, kHalfHour_h), cell_of(place.latitude_deg, kHalfDegree)}];
  ++frames_;
}

Plot LatitudeCells::plot(int first_hour) const {
  if (cells_.empty()) return {};
  Plot plot = one_panel("Frames by hour and latitude", "hour (UTC)", "latitude (\u00b0)");
  Panel& panel = plot.panels[0];
  std::map<std::pair<int, int>, int> turned;
  constexpr int kHalfHours = 48;
  for (const auto& [cell, count] : cells_)
    turned[{(cell.first - 2 * first_hour + kHalfHours) % kHalfHours, cell.second}] = count;
  show_cells(turned, kHalfHour_h, kHalfDegree, panel);
  for (int hour = 0; hour <= 24; ++hour) {
    panel.x.tick_places.push_back(hour);
    panel.x.tick_labels.push_back(std::to_string((hour + first_hour) % 24));
  }
  return plot;
}

Colour verdict_ink(const std::string& verdict) {
  static const std::map<std::string, Colour> kInks = {
      {"good", {23, 120, 74}},       {"doubtful", {222, 158, 40}}, {"failed", {178, 48, 38}},
      {"refused", {120, 92, 92}},    {"none", {198, 205, 213}},    {"arc", {23, 120, 74}},
      {"aurora", {110, 186, 122}},   {"cloud", {150, 160, 172}},   {"moon", {232, 200, 92}},
      {"twilight", {108, 148, 204}}, {"lamp", {222, 128, 60}},     {"dark", {58, 66, 84}},
      {"clear", {58, 66, 84}}};
  const auto found = kInks.find(verdict);
  if (found != kInks.end()) return found->second;
  unsigned sum = 0;
  for (const char c : verdict) sum = 31 * sum + static_cast<unsigned char>(c);
  return distinct_colour(static_cast<int>(sum % 7));
}

std::string verdict_bars(const std::map<int, VerdictCounts>& verdicts_of_hour, SurveyWork work,
                         int first_hour) {
  std::map<int, std::map<std::string, int>> hours;  // counted from first_hour
  std::map<std::string, int> all;
  for (const auto& [hour, counts] : verdicts_of_hour) {
    const auto found = counts.find(work);
    if (found == counts.end()) continue;
    hours[(hour - first_hour + 24) % 24] = found->second;
    for (const auto& [verdict, count] : found->second) all[verdict] += count;
  }
  if (hours.empty()) return {};
  const int begin = hours.begin()->first, end = hours.rbegin()->first + 1;
  constexpr double kLeft = 50, kHeight = 170, kBelow = 44, kMaxBar = 46, kWidth = 470;
  const double bar = std::min(kMaxBar, (kWidth - kLeft - 10) / (end - begin));
  constexpr double kLegendRow = 16, kLegendText = 12;
  // The places of the legend's words, in as many rows as the picture's width asks for.
  std::vector<std::pair<std::string, std::pair<double, double>>> legend;
  double x = kLeft, y = 27;
  for (const auto& [verdict, count] : ranked_verdicts(all)) {
    const double wide = 32 + text_width_px(verdict, kLegendText);
    if (x > kLeft && x + wide > kWidth) {
      x = kLeft;
      y += kLegendRow;
    }
    legend.push_back({verdict, {x, y}});
    x += wide;
  }
  const double above = y + 39;
  const std::string title = std::string(survey_work_name(work)) + ": verdicts by the hour";
  return drawn_svg(title, {kWidth, above + kHeight + kBelow}, [&](PlotCanvas& canvas) {
    TextStyle style;
    style.size_px = 12.5;
    style.bold = true;
    style.colour = {38, 38, 38};
    canvas.text({kLeft, 16}, title, style);
    style.bold = false;
    style.size_px = kLegendText;
    for (const auto& [verdict, place] : legend) {
      fill_box(canvas, {place.first, place.second, 11, 11}, verdict_ink(verdict));
      canvas.text({place.first + 16, place.second + 10}, verdict, style);
    }
    style.size_px = 11;
    style.colour = kBarText;
    for (const int percent : {0, 25, 50, 75, 100}) {
      const double y = above + kHeight * (1.0 - percent / 100.0);
      canvas.line({{kLeft, y}, {kLeft + bar * (end - begin), y}}, {232, 232, 232}, 1, false);
      style.anchor = TextAnchor::end;
      canvas.text({kLeft - 6, y + 4}, std::to_string(percent) + "\u00a0%", style);
    }
    style.anchor = TextAnchor::middle;
    const int label_every = bar < 24 ? 2 : 1;
    for (const auto& [hour, counts] : hours) {
      int sum = 0;
      for (const auto& [verdict, count] : counts) sum += count;
      const double left = kLeft + bar * (hour - begin);
      double bottom = above + kHeight;
      for (const auto& [verdict, count] : ranked_verdicts(counts)) {
        const double height = kHeight * count / sum;
        fill_box(canvas, {left + 1, bottom - height, bar - 2, height}, verdict_ink(verdict));
        bottom -= height;
      }
      style.size_px = bar < 30 ? 8 : 10;
      canvas.text({left + bar / 2, above - 5}, std::to_string(sum), style);
    }
    style.size_px = 11;
    canvas.line({{kLeft, above + kHeight}, {kLeft + bar * (end - begin), above + kHeight}}, kBarAxis, 1,
                false);
    for (int hour = begin; hour < end; hour += label_every)
      canvas.text({kLeft + bar * (hour - begin + 0.5), above + kHeight + 16},
                  std::to_string((hour + first_hour) % 24), style);
    style.size_px = 12.5;
    canvas.text({kLeft + 0.5 * bar * (end - begin), above + kHeight + 36}, "hour (UTC); above: frames",
                style);
  });
}

NightMinutes night_minutes(const std::vector<const NightDigest*>& cameras, double begin_s) {
  constexpr int kMinutes = 24 * 60;
  constexpr double kSeconds = 60.0;
  NightMinutes night{std::vector<int>(kMinutes, 0), std::vector<int>(kMinutes, 0),
                     std::vector<double>(kMinutes, sim::kNaN)};
  const auto minute_of = [&](double time_s) {
    return static_cast<std::size_t>(
        std::clamp(static_cast<int>(std::floor((time_s - begin_s) / kSeconds)), 0, kMinutes - 1));
  };
  std::map<std::size_t, std::vector<double>> energies;
  for (const NightDigest* camera : cameras) {
    for (const auto& [minute, count] : camera->frames_of_minute)
      night.frames[minute_of(static_cast<double>(minute) * kSeconds)] += count;
    const std::vector<FollowedPoint> borders = points_of(*camera, FollowedKind::border);
    for (const FollowedPoint& p : borders.empty() ? points_of(*camera, FollowedKind::distance) : borders)
      ++night.measured[minute_of(p.time_s)];
    for (const FollowedPoint& p : points_of(*camera, FollowedKind::energy))
      energies[minute_of(p.time_s)].push_back(p.value);
  }
  for (auto& [minute, values] : energies) night.energy_kev[minute] = share_of_numbers(values, 0.5);
  return night;
}

void StripScales::add(const NightMinutes& night) {
  std::vector<double> energies;
  most_filled = std::max(most_filled, static_cast<int>(std::count_if(night.frames.begin(), night.frames.end(),
                                                                     [](int f) { return f > 0; })));
  for (std::size_t m = 0; m < night.frames.size(); ++m) {
    if (night.frames[m] > 0) {
      first_minute = std::min(first_minute, static_cast<int>(m));
      end_minute = std::max(end_minute, static_cast<int>(m) + 1);
    }
    if (std::isfinite(night.energy_kev[m])) energies.push_back(night.energy_kev[m]);
  }
  if (energies.empty()) return;
  min_kev = std::min(min_kev, share_of_numbers(energies, 0.02));
  max_kev = std::max(max_kev, share_of_numbers(energies, 0.98));
}

std::string night_strip(const NightMinutes& night, const StripScales& scales) {
  constexpr int kMaxStretches = 128, kMinStretches = 8;
  constexpr double kWidth = 384, kHeight = 40, kEdge = 3;
  const int minutes = std::max(1, scales.end_minute - scales.first_minute);
  // Stretches are so wide that each has frames, also of cameras that take one every few minutes.
  const int stretches = std::min(minutes, std::clamp(scales.most_filled / 2, kMinStretches, kMaxStretches));
  struct Stretch {
    int frames = 0, measured = 0;
    std::vector<double> energies;
  };
  std::vector<Stretch> all(static_cast<std::size_t>(stretches));
  for (int m = 0; m < minutes; ++m) {
    Stretch& s = all[static_cast<std::size_t>(static_cast<std::int64_t>(m) * stretches / minutes)];
    const auto at = static_cast<std::size_t>(scales.first_minute + m);
    s.frames += night.frames.at(at);
    s.measured += night.measured[at];
    if (std::isfinite(night.energy_kev[at])) s.energies.push_back(night.energy_kev[at]);
  }
  return drawn_svg("the night in small", {kWidth, kHeight}, [&](PlotCanvas& canvas) {
    const double width = kWidth / stretches;
    std::vector<PlotPoint> line;
    const auto finish = [&] {
      if (line.size() > 1) canvas.line(line, kStripEnergy, 1.5, false);
      if (line.size() == 1) canvas.dot(line[0], 2.5, kStripEnergy);
      line.clear();
    };
    // Neighbours of one height are drawn as one box: a night of nothing is a box, not a hundred.
    const auto boxes = [&](const auto& height_of, Colour ink) {
      for (std::size_t i = 0, next = 0; i < all.size(); i = next) {
        const double height = height_of(all[i]);
        for (next = i + 1; next < all.size() && height_of(all[next]) == height;) ++next;
        if (height > 0.0)
          fill_box(canvas, {i * width, kHeight - height, (next - i) * width + 0.1, height}, ink);
      }
    };
    boxes([&](const Stretch& s) { return s.frames > 0 ? kHeight : 0.0; }, kStripGround);
    boxes([&](const Stretch& s) { return s.measured == 0 ? 0.0 : kHeight * s.measured / s.frames; },
          kStripMeasured);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const double kev = share_of_numbers(all[i].energies, 0.5);
      if (kev > 0.0) {
        const double range = std::log(std::max(scales.max_kev / scales.min_kev, 1.01));
        const double share = std::clamp(std::log(kev / scales.min_kev) / range, 0.0, 1.0);
        line.push_back({(i + 0.5) * width, kEdge + (kHeight - 2 * kEdge) * (1.0 - share)});
      } else {
        finish();
      }
    }
    finish();
  });
}

}  // namespace vegard::fit
