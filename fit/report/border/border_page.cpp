#include "fit/report/border/border_run.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "fit/border/border_distance.h"
#include "fit/report/plot/plot.h"
#include "fit/report/report_style.h"
#include "sim/base/file/number_text.h"
#include "sim/base/number/constants.h"
#include "sim/base/shown_text.h"
#include "sim/scene/structs/line_of.h"
#include "sim/view/camera/camera.h"

namespace vegard::fit {
namespace {

constexpr int kBorderPanel_px = 520;  // of border.svg
constexpr int kPagePanel_px = 390;    // two fit side by side on the page
constexpr Colour kBorderAltitudeInk[4] = {{200, 60, 30}, {220, 140, 20}, {20, 130, 90}, {40, 90, 180}};
constexpr Colour kBorderPeakInk{150, 158, 168}, kBorderGridInk{190, 196, 204};
constexpr Colour kBorderDoubtInk{170, 170, 170};  // of traces that are not claimed
constexpr Colour kBorderTraceInk[6] = {{255, 60, 60},  {255, 170, 0},  {60, 220, 255},
                                       {255, 90, 230}, {190, 255, 60}, {150, 160, 255}};

Colour border_trace_ink(std::size_t index) { return kBorderTraceInk[index % 6]; }

std::uint8_t border_code(double value, double dark, double white) {
  const double x = std::clamp((value - dark) / std::max(white - dark, 1e-12), 0.0, 1.0);
  return static_cast<std::uint8_t>(std::lround(255.0 * std::sqrt(x)));
}

double border_share(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * (values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// Where azimuths are cut for drawing: in the middle of the widest stretch without light to be traced.
double border_first_azimuth(const Border& border) {
  std::vector<char> lit(static_cast<std::size_t>(border.cells.columns), 0);
  for (int c = 0; c < border.cells.columns; ++c)
    for (int r = 0; r < border.cells.rows && lit[c] == 0; ++r)
      if (std::isfinite(border.cells.light[border.cells.index(c, r)])) lit[c] = 1;
  if (std::count(lit.begin(), lit.end(), 1) == border.cells.columns) {
    std::fill(lit.begin(), lit.end(), 0);
    for (const BorderTrace& trace : border.traces)
      for (const BorderPoint& p : trace.points)
        lit[static_cast<std::size_t>(std::lround(p.azimuth_deg / border.cells.azimuth_step_deg)) %
            lit.size()] = 1;
  }
  int best = 0, at = 0, run = 0;
  const int columns = border.cells.columns;
  for (int i = 0; i < 2 * columns; ++i) {
    run = lit[static_cast<std::size_t>(i % columns)] != 0 ? 0 : run + 1;
    if (run > best && run <= columns) best = run, at = i - run / 2;
  }
  return (at % columns) * border.cells.azimuth_step_deg;
}

double drawn_border_azimuth(double azimuth_deg, double first_deg) {
  double offset = std::fmod(azimuth_deg - first_deg + 720.0, 360.0);
  // Azimuths are drawn between -180 and 360.
  return (first_deg > 180.0 ? first_deg - 360.0 : first_deg) + offset;
}

Series border_line(const std::string& label, Colour colour, Mark mark, double width_px) {
  Series line;
  line.label = label;
  line.colour = colour;
  line.mark = mark;
  line.width_px = width_px;
  return line;
}

/// A claimed trace has a colour and a place in the legend; the others are thin, grey and dashed.
Series border_trace_line(const Border& border, std::size_t trace) {
  if (!border.traces[trace].is_claimed()) return border_line("", kBorderDoubtInk, Mark::dashed_line, 0.6);
  return border_line("trace " + std::to_string(trace + 1), border_trace_ink(trace), Mark::line, 1.2);
}

Panel border_photo_panel(const Border& border, const Photo& photo, const sim::Scene& scene) {
  const sim::Image& image = photo.linear;
  const int shrink = std::max(1, (image.width + 2 * kBorderPanel_px - 1) / (2 * kBorderPanel_px));
  Panel panel;
  panel.title = "the photograph, and the borders traced";
  panel.x.label = panel.y.label = "pixel";
  panel.y.reversed = true;
  panel.x.min = panel.y.min = 0.0;
  panel.raster.width = image.width / shrink;
  panel.raster.height = image.height / shrink;
  panel.x.max = panel.raster.width * shrink;
  panel.y.max = panel.raster.height * shrink;
  panel.raster.left = panel.raster.top = 0.0;
  panel.raster.right = *panel.x.max;
  panel.raster.bottom = *panel.y.max;
  std::vector<double> sum(static_cast<std::size_t>(panel.raster.width) * panel.raster.height * 3);
  std::vector<double> bright;
  for (int y = 0; y < panel.raster.height; ++y)
    for (int x = 0; x < panel.raster.width; ++x)
      for (int c = 0; c < 3; ++c) {
        double& s = sum[(static_cast<std::size_t>(y) * panel.raster.width + x) * 3 + c];
        for (int k = 0; k < shrink * shrink; ++k)
          s += image.at(x * shrink + k % shrink, y * shrink + k / shrink, c);
        s /= shrink * shrink;
        if (c == 1) bright.push_back(s);
      }
  const double white = border_share(bright, 0.998), dark = border_share(bright, 0.02);
  for (const double s : sum) panel.raster.rgb.push_back(border_code(s, 0.8 * dark, white));
  const sim::CameraView<double> view = sim::camera_view(scene.camera);
  for (std::size_t t = 0; t < border.traces.size(); ++t) {
    Series line = border_trace_line(border, t);
    double before = sim::kNaN;
    for (const BorderPoint& p : border.traces[t].points) {
      double enu[3], x = sim::kNaN, y = sim::kNaN;
      sim::enu_of_direction({p.azimuth_deg, p.elevation_deg}, enu);
      if (!p.measured() || !sim::pixel_of_enu(view, enu, x, y)) x = y = sim::kNaN;
      // High up a degree of azimuth is short.
      const double apart = std::abs(std::remainder(p.azimuth_deg - before, 360.0)) *
                           (p.measured() ? std::cos(p.elevation_deg * sim::kRadiansPerDegree) : 1.0);
      if (apart > 4.5 * border.cells.azimuth_step_deg) {
        line.x.push_back(sim::kNaN);
        line.y.push_back(sim::kNaN);
      }
      before = p.azimuth_deg;
      line.x.push_back(x);
      line.y.push_back(y);
    }
    if (border.traces[t].measured > 0) panel.series.push_back(std::move(line));
  }
  return panel;
}

Panel border_sky_panel(const Border& border) {
  const SkyCells& cells = border.cells;
  const double first = border_first_azimuth(border);
  Panel panel;
  panel.title = "light by azimuth and elevation; the border with its error, the peak (grey)";
  panel.x.label = "azimuth (°)";
  panel.y.label = "elevation (°)";
  int low = cells.columns, high = 0, lowest = cells.rows, highest = 0;
  std::vector<double> bright;
  const auto column_of = [&](int drawn) {
    return static_cast<int>(std::lround(drawn + first / cells.azimuth_step_deg)) % cells.columns;
  };
  for (int i = 0; i < cells.columns; ++i)
    for (int r = 0; r < cells.rows; ++r) {
      const double v = cells.light[cells.index(column_of(i), r)];
      if (!std::isfinite(v)) continue;
      bright.push_back(v);
      low = std::min(low, i), high = std::max(high, i);
      lowest = std::min(lowest, r), highest = std::max(highest, r);
    }
  if (bright.empty()) return panel;
  const double white = border_share(bright, 0.995), dark = border_share(bright, 0.02);
  panel.raster.width = high - low + 1;
  panel.raster.height = highest - lowest + 1;
  const double left = drawn_border_azimuth(first, first);
  panel.raster.left = left + (low - 0.5) * cells.azimuth_step_deg;
  panel.raster.right = left + (high + 0.5) * cells.azimuth_step_deg;
  panel.raster.bottom = cells.elevation_deg(lowest - 0.5);
  panel.raster.top = cells.elevation_deg(highest + 0.5);
  panel.x.min = panel.raster.left;
  panel.x.max = panel.raster.right;
  panel.y.min = panel.raster.bottom;
  panel.y.max = panel.raster.top;
  for (int r = highest; r >= lowest; --r)
    for (int i = low; i <= high; ++i) {
      const double v = cells.light[cells.index(column_of(i), r)];
      const std::uint8_t code = std::isfinite(v) ? border_code(v, dark, white) : 0;
      panel.raster.rgb.insert(panel.raster.rgb.end(),
                              {static_cast<std::uint8_t>(std::isfinite(v) ? code / 2 : 60), code,
                               static_cast<std::uint8_t>(std::isfinite(v) ? code / 2 : 60)});
    }
  for (std::size_t t = 0; t < border.traces.size(); ++t) {
    Series line = border_trace_line(border, t);
    Series peak = border_line("", kBorderPeakInk, Mark::points, 1.6);
    for (const BorderPoint& p : border.traces[t].points) {
      const double x = drawn_border_azimuth(p.azimuth_deg, first);
      if (!line.x.empty() && std::abs(x - line.x.back()) > 4.5 * cells.azimuth_step_deg) {
        line.x.push_back(x), line.y.push_back(sim::kNaN);
        line.low.push_back(sim::kNaN), line.high.push_back(sim::kNaN);
      }
      line.x.push_back(x);
      line.y.push_back(p.elevation_deg);
      line.low.push_back(p.elevation_deg - p.elevation_error_deg);
      line.high.push_back(p.elevation_deg + p.elevation_error_deg);
      peak.x.push_back(x);
      peak.y.push_back(p.peak_elevation_deg);
    }
    if (border.traces[t].is_claimed()) panel.series.push_back(std::move(peak));
    if (border.traces[t].measured > 0) panel.series.push_back(std::move(line));
  }
  return panel;
}

struct BorderGround {
  double east = 0.0, north = 0.0;
};

/// On the azimuthal equidistant map about the site (Snyder 1987, USGS Professional Paper 1395, chapter 25).
BorderGround on_border_map(const sim::Site& site, double latitude_deg, double longitude_deg) {
  const double a = site.latitude_deg * sim::kRadiansPerDegree, b = latitude_deg * sim::kRadiansPerDegree;
  const double l = (longitude_deg - site.longitude_deg) * sim::kRadiansPerDegree;
  const double x = std::cos(b) * std::sin(l);
  const double y = std::cos(a) * std::sin(b) - std::sin(a) * std::cos(b) * std::cos(l);
  const double z = std::sin(a) * std::sin(b) + std::cos(a) * std::cos(b) * std::cos(l);
  const double aside = std::hypot(x, y);
  const double scale = aside > 0.0 ? sim::kEarthRadiusKm * std::atan2(aside, z) / aside : 0.0;
  return {x * scale, y * scale};
}

void add_border_grid(const sim::Scene& scene, double reach_km, Panel& panel) {
  const sim::Site& site = scene.site;
  const double span_lat = 2.0 * reach_km / 111.2;
  const double span_lon = span_lat / std::max(0.1, std::cos(site.latitude_deg * sim::kRadiansPerDegree));
  const auto step_of = [](double range) {
    for (const double step : {0.5, 1.0, 2.0, 5.0, 10.0, 15.0})
      if (range / step <= 8.0) return step;
    return 30.0;
  };
  const double lat_step = step_of(span_lat), lon_step = step_of(span_lon);
  std::string label = fmt::format("every {} ° of latitude, {} ° of longitude", sim::short_number(lat_step),
                                  sim::short_number(lon_step));
  const double south = std::max(-89.0, site.latitude_deg - span_lat / 2.0);
  const double north = std::min(89.0, site.latitude_deg + span_lat / 2.0);
  const double west = site.longitude_deg - std::min(180.0, span_lon),
               east = site.longitude_deg + std::min(180.0, span_lon);
  const auto add = [&](const auto& place) {
    Series line = border_line(label, kBorderGridInk, Mark::dashed_line, 0.8);
    label.clear();
    for (int i = 0; i <= 80; ++i) {
      const BorderGround p = place(i / 80.0);
      const bool inside = std::abs(p.east) <= reach_km && std::abs(p.north) <= reach_km;
      line.x.push_back(inside ? p.east : sim::kNaN);
      line.y.push_back(inside ? p.north : sim::kNaN);
    }
    panel.series.push_back(std::move(line));
  };
  for (double lat = std::ceil(south / lat_step) * lat_step; lat <= north; lat += lat_step)
    add([&](double t) { return on_border_map(site, lat, west + t * (east - west)); });
  for (double lon = std::ceil(west / lon_step) * lon_step; lon <= east; lon += lon_step)
    add([&](double t) { return on_border_map(site, south + t * (north - south), lon); });
}

Panel border_map_panel(const Border& border, const sim::Scene& scene) {
  Panel panel;
  panel.title = "where the border is, for an assumed altitude";
  panel.x.label = "east (km)";
  panel.y.label = "north (km)";
  double reach = 50.0;
  std::vector<Series> lines;
  const auto claimed = static_cast<std::size_t>(border.measured);  // they come first
  for (std::size_t t = 0; t < claimed; ++t)
    for (std::size_t h = 0; h < kBorderAltitudesKm.size(); ++h) {
      Series line = border_line(t == 0 ? fmt::format("{:.0f} km", kBorderAltitudesKm[h]) : std::string(),
                                kBorderAltitudeInk[h], Mark::line, 1.4);
      double before = sim::kNaN;
      for (const BorderPoint& p : border.traces[t].points) {
        if (std::abs(std::remainder(p.azimuth_deg - before, 360.0)) > 4.5 * border.cells.azimuth_step_deg)
          line.x.push_back(sim::kNaN), line.y.push_back(sim::kNaN);
        before = p.azimuth_deg;
        const double km = p.measured()
                              ? ground_distance_km(true_elevation_deg(p.elevation_deg, scene.site.altitude_m),
                                                   scene.site.altitude_m, kBorderAltitudesKm[h])
                              : sim::kNaN;
        line.x.push_back(km * std::sin(p.azimuth_deg * sim::kRadiansPerDegree));
        line.y.push_back(km * std::cos(p.azimuth_deg * sim::kRadiansPerDegree));
        if (std::isfinite(km)) reach = std::max({reach, std::abs(line.x.back()), std::abs(line.y.back())});
      }
      lines.push_back(std::move(line));
    }
  reach = std::ceil(1.08 * reach / 50.0) * 50.0;
  panel.x.min = panel.y.min = -reach;
  panel.x.max = panel.y.max = reach;
  if (sim::is_latitude_given(scene) && sim::is_longitude_given(scene)) add_border_grid(scene, reach, panel);
  Series site = border_line("the camera", {0, 0, 0}, Mark::points, 5.0);
  site.x = site.y = {0.0};
  panel.series.push_back(std::move(site));
  for (Series& line : lines) panel.series.push_back(std::move(line));
  return panel;
}

std::string one_border_panel(Panel panel, int width_px, int height_px) {
  Plot plot;
  plot.panels.push_back(std::move(panel));
  plot.panel_width_px = width_px;
  plot.panel_height_px = height_px;
  return plot_svg(plot);
}

std::string border_table(const Border& border, const sim::Scene& scene) {
  std::string html =
      "<table>\n<tr><th>trace</th><th>azimuth (°)</th><th>border (°)</th><th>peak (°)</th><th>distance (km) "
      "at 95</th><th>100</th><th>105</th><th>110 km</th></tr>\n";
  for (std::size_t t = 0; t < static_cast<std::size_t>(border.measured); ++t) {
    const std::vector<BorderPoint>& points = border.traces[t].points;
    double last = sim::kNaN;
    for (const BorderPoint& p : points) {
      if (std::abs(std::remainder(p.azimuth_deg - last, 360.0)) < 4.99) continue;
      last = p.azimuth_deg;
      html += fmt::format("<tr><td>{}</td><td>{:.0f}</td><td>{}</td><td>{:.1f}</td>", t + 1, p.azimuth_deg,
                          p.measured() ? sim::number_with_error(p.elevation_deg, p.elevation_error_deg)
                                       : std::string("beyond ") + border_limit_name(p.limit),
                          p.peak_elevation_deg);
      for (const double altitude : kBorderAltitudesKm) {
        const BorderPlace place =
            border_place(scene.site, p.azimuth_deg, p.elevation_deg, p.elevation_error_deg, altitude);
        html += "<td>" + sim::number_with_error(place.distance_km, place.distance_error_km) + "</td>";
      }
      html += "</tr>\n";
    }
  }
  return html + "</table>\n";
}

}  // namespace

BorderSummary border_summary(const BorderTrace& trace, const sim::Scene& scene) {
  BorderSummary out;
  out.from_azimuth_deg = out.to_azimuth_deg = out.lowest_deg = out.highest_deg = sim::kNaN;
  out.nearest_azimuth_deg = out.nearest_error_deg = sim::kNaN;
  out.distance_km.fill(sim::kNaN);
  out.distance_error_km.fill(sim::kNaN);
  for (const BorderPoint& p : trace.points) {
    if (!p.measured()) continue;
    if (std::isnan(out.from_azimuth_deg)) out.from_azimuth_deg = p.azimuth_deg;
    out.to_azimuth_deg = p.azimuth_deg;
    out.lowest_deg = std::fmin(out.lowest_deg, p.elevation_deg);
    if (p.elevation_deg <= out.highest_deg) continue;
    out.highest_deg = p.elevation_deg;
    out.nearest_azimuth_deg = p.azimuth_deg;
    out.nearest_error_deg = p.elevation_error_deg;
  }
  for (std::size_t h = 0; h < kBorderAltitudesKm.size(); ++h) {
    const BorderPlace place = border_place(scene.site, out.nearest_azimuth_deg, out.highest_deg,
                                           out.nearest_error_deg, kBorderAltitudesKm[h]);
    out.distance_km[h] = place.distance_km;
    out.distance_error_km[h] = place.distance_error_km;
  }
  return out;
}

std::string border_sentence(const Border& border, std::size_t trace, const sim::Scene& scene) {
  const BorderTrace& t = border.traces[trace];
  if (t.measured == 0)
    return fmt::format("Trace {}: azimuths {:.0f} to {:.0f}°, the border was not measured (beyond {})",
                       trace + 1, t.points.front().azimuth_deg, t.points.back().azimuth_deg,
                       border_limit_name(t.points.front().limit));
  const BorderSummary s = border_summary(t, scene);
  if (!t.is_claimed())
    return fmt::format("Trace {}: azimuths {:.0f} to {:.0f}°, elevations {:.1f} to {:.1f}°: not claimed ({})",
                       trace + 1, s.from_azimuth_deg, s.to_azimuth_deg, s.lowest_deg, s.highest_deg, t.doubt);
  return fmt::format(
      "Trace {}: azimuths {:.0f} to {:.0f}°, elevations {:.1f} to {:.1f}°; nearest {:.0f} ± {:.0f} km away "
      "at azimuth {:.0f}° if the border is 105 km high ({:.0f} to {:.0f} km for 95 to 110 km)",
      trace + 1, s.from_azimuth_deg, s.to_azimuth_deg, s.lowest_deg, s.highest_deg, s.distance_km[2],
      s.distance_error_km[2], s.nearest_azimuth_deg, s.distance_km[0], s.distance_km[3]);
}

std::string border_svg(const Border& border, const Photo& photo, const sim::Scene& scene) {
  Plot plot;
  Panel picture = border_photo_panel(border, photo, scene);
  // The panels are square, and the picture keeps its shape.
  const double spare = 0.5 * (*picture.x.max - *picture.y.max);
  Axis& narrow = spare > 0.0 ? picture.y : picture.x;
  *narrow.min -= std::abs(spare);
  *narrow.max += std::abs(spare);
  plot.panels.push_back(std::move(picture));
  plot.panels.push_back(border_sky_panel(border));
  plot.panels.push_back(border_map_panel(border, scene));
  plot.columns = 3;
  plot.panel_width_px = plot.panel_height_px = kBorderPanel_px;
  return plot_svg(plot);
}

std::string border_answer(const Border& border, const sim::Scene& scene) {
  if (border.measured == 0) return "No lower border of the light could be measured.";
  const BorderSummary best = border_summary(border.traces[0], scene);  // the most probable and longest
  return fmt::format(
      "The nearest point of {} is {:.0f} ± {:.0f} km away, at azimuth {:.0f}°, if the border is 105 km high.",
      border.measured == 1 ? std::string("the lower border")
                           : fmt::format("the clearest of {} lower borders", border.measured),
      best.distance_km[2], best.distance_error_km[2], best.nearest_azimuth_deg);
}

std::string border_page(const Border& border, const Photo& photo, const sim::Scene& scene,
                        const BorderRunFacts& facts) {
  const bool is_measured = border.measured > 0;
  std::string html =
      headed_page("Lower borders in " + photo.file_name) + "<div class=\"verdict " +
      (is_measured ? "good" : "doubtful") + "\"><div>\n<div class=\"word\">" +
      (is_measured ? "Measured" : "Not measured") + "</div>\n<div><div class=\"answer\">" +
      sim::html_text(border_answer(border, scene)) + "</div><div class=\"line\">" +
      (is_measured
           ? std::string("Its elevation is measured, its altitude assumed: distances are given for four "
                         "altitudes.")
       : border.notes.empty() ? std::string()
                              : sim::html_text(border.notes.front())) +
      "</div></div></div></div>\n<main>\n";
  const double shape = static_cast<double>(photo.linear.height) / std::max(1, photo.linear.width);
  html += "<section><h2>Pictures</h2>\n<div class=\"plots\">" +
          one_border_panel(border_photo_panel(border, photo, scene), kPagePanel_px,
                           std::clamp(static_cast<int>(kPagePanel_px * shape), 160, 740)) +
          one_border_panel(border_sky_panel(border), kPagePanel_px, 280) +
          one_border_panel(border_map_panel(border, scene), kPagePanel_px, kPagePanel_px) +
          "</div></section>\n";
  html +=
      "<section><h2>The traces</h2>\n<p>The border is where the light has fallen to half of its peak, "
      "above the sky beneath. Grey dashed lines are not claimed to be aurora.</p>\n";
  for (std::size_t t = 0; t < border.traces.size(); ++t)
    html += "<p>" + sim::html_text(border_sentence(border, t, scene)) + ".</p>\n";
  for (const std::string& note : border.notes) html += "<p>" + sim::html_text(note) + "</p>\n";
  html += "</section>\n";
  if (border.measured > 0)
    html +=
        "<section><h2>Elevations and distances</h2>\n<p>Every 5° of azimuth; all of them are in border.csv. "
        "Errors of distances are those of the elevation alone.</p>\n" +
        border_table(border, scene) + "</section>\n";
  html += "<section><h2>How it was made</h2>\n<p>Decoding: " + sim::html_text(facts.decoding) +
          "</p>\n<p>Distances are over a sphere of 6371 km, with refraction taken off (Saemundsson's "
          "formula).</p>\n"
          "<p><code>" +
          sim::html_text(facts.command) + "</code></p>\n</section>\n</main>\n</body>\n</html>\n";
  return html;
}

}  // namespace vegard::fit
