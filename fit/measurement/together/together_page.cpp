#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "fit/border/border_distance.h"
#include "fit/measurement/main_border.h"
#include "fit/measurement/together/measure_together.h"
#include "fit/report/plot/plot.h"
#include "fit/report/report_style.h"
#include "fit/triangulation/shared_view.h"
#include "sim/base/file/number_text.h"
#include "sim/base/number/constants.h"
#include "sim/base/shown_text.h"

namespace vegard::fit {
namespace together_page_parts {

using sim::html_text;

constexpr double kOutlineHeight_km = 110.0;

/// East and north of a camera, in km on the ground.
class LocalPlane {
 public:
  explicit LocalPlane(const GeodeticPlace& centre) : centre_(centre) {}
  PixelPoint at(const GeodeticPlace& place) const {
    const double east_deg = std::remainder(place.longitude_deg - centre_.longitude_deg, 360.0);
    const double km_per_deg = sim::kEarthRadiusKm * sim::kRadiansPerDegree;
    return {east_deg * km_per_deg * std::cos(centre_.latitude_deg * sim::kRadiansPerDegree),
            (place.latitude_deg - centre_.latitude_deg) * km_per_deg};
  }

 private:
  GeodeticPlace centre_;
};

GeodeticPlace place_of_camera(const ViewPoint& view) {
  return {view.camera().site.latitude_deg, view.camera().site.longitude_deg, 0.0};
}

/// The fields of view, the cameras, and the border with its heights.
Panel map_panel(const PairOfPictures& pair) {
  Panel panel;
  panel.title = "Fields of view at 110 km, and the border";
  panel.x.label = "east of the first camera (km)";
  panel.y.label = "north (km)";
  const LocalPlane plane(place_of_camera(pair.cameras[0]));
  for (std::size_t i = 0; i < 2; ++i) {
    Series outline, station;
    outline.label = pair.cameras[i].camera().name;
    outline.colour = station.colour = distinct_colour(static_cast<int>(i));
    outline.mark = i == 0 ? Mark::line : Mark::dashed_line;
    for (const GeodeticPlace& place : view_outline(pair.cameras[i], kOutlineHeight_km)) {
      const PixelPoint at = plane.at(place);
      outline.x.push_back(at.x_px);
      outline.y.push_back(at.y_px);
    }
    station.mark = Mark::points;
    station.width_px = 9.0;
    const PixelPoint at = plane.at(place_of_camera(pair.cameras[i]));
    station.x = {at.x_px};
    station.y = {at.y_px};
    panel.series.push_back(std::move(outline));
    panel.series.push_back(std::move(station));
  }
  if (const BorderMatch* border = best_border(pair)) {
    // Thirds of the heights along the border.
    const double middle = border->branch.mean.km, half = std::max(1.0, border->branch.mean.scatter_km);
    const char* const names[3] = {"border below", "border at", "border above"};
    for (int part = 0; part < 3; ++part) {
      Series series;
      series.mark = Mark::points;
      series.width_px = 4.0;
      series.colour = distinct_colour(part + 3);
      series.label =
          part == 1 ? fmt::format("{} {:.0f} to {:.0f} km", names[part], middle - half, middle + half)
                    : fmt::format("{} {:.0f} km", names[part], part == 0 ? middle - half : middle + half);
      for (const CurveMatch& match : border->points) {
        const double off = match.point.place.height_km - middle;
        if ((off < -half ? 0 : off > half ? 2 : 1) != part) continue;
        const PixelPoint at = plane.at(match.point.place);
        series.x.push_back(at.x_px);
        series.y.push_back(at.y_px);
      }
      if (!series.x.empty()) panel.series.push_back(std::move(series));
    }
  }
  return panel;
}

Panel heights_panel(const PairOfPictures& pair) {
  Panel panel;
  panel.title = "Height along the border";
  panel.x.label = "longitude (°)";
  panel.y.label = "height (km)";
  const BorderMatch* border = best_border(pair);
  if (!border) return panel;
  const double middle = border->branch.mean.km;
  panel.y.min = std::max(0.0, middle - 50.0);
  panel.y.max = middle + 50.0;
  Series points, mean;
  points.mark = Mark::points;
  points.width_px = 4.0;
  points.error_bars = true;
  points.colour = distinct_colour(0);
  for (const CurveMatch& match : border->points) {
    const double height_km = match.point.place.height_km, error_km = match.point.height_error_km;
    if (std::abs(height_km - middle) > 50.0) continue;
    points.x.push_back(match.point.place.longitude_deg);
    points.y.push_back(height_km);
    points.low.push_back(std::max(*panel.y.min, height_km - error_km));
    points.high.push_back(std::min(*panel.y.max, height_km + error_km));
  }
  if (!points.x.empty()) {
    mean.label = fmt::format("mean {} km", sim::number_with_error(middle, border->branch.mean.error_km));
    mean.colour = distinct_colour(1);
    mean.x = {points.x.front(), points.x.back()};
    mean.y = {middle, middle};
  }
  panel.series = {std::move(points), std::move(mean)};
  return panel;
}

Panel pattern_panel(const PairOfPictures& pair) {
  Panel panel;
  panel.title = "Both pictures on shells";
  panel.x.label = "height of the shell (km)";
  panel.y.label = "correlation of ranks";
  Series series;
  series.colour = distinct_colour(2);
  series.x = pair.pattern->height_km;
  series.y = pair.pattern->correlation;
  panel.series = {std::move(series)};
  return panel;
}

/// The border that the second picture shows, and what the first one alone says of it.
Panel cross_check_panel(const CrossCheck& check) {
  Panel panel;
  panel.title = "The second picture's border, by the first one alone";
  panel.x.label = "azimuth from the second camera (°)";
  panel.y.label = "elevation (°)";
  const double middle = check.shown[check.shown.size() / 2].azimuth_deg;
  const auto azimuth = [&](double deg) { return middle + std::remainder(deg - middle, 360.0); };
  int colour = 0;
  for (const auto* curve : {&check.lowest, &check.highest}) {
    Series series;
    series.colour = distinct_colour(colour++);
    series.mark = Mark::line;
    series.label = fmt::format(
        "if {:.0f} km high", curve == &check.lowest ? kBorderAltitudesKm.front() : kBorderAltitudesKm.back());
    for (const SeenBorder& point : *curve) {
      series.x.push_back(azimuth(point.azimuth_deg));
      series.y.push_back(point.elevation_deg);
    }
    panel.series.push_back(std::move(series));
  }
  Series shown;
  shown.label = "shown";
  shown.colour = distinct_colour(colour);
  shown.mark = Mark::points;
  shown.width_px = 4.0;
  shown.error_bars = true;
  for (const SeenBorder& point : check.shown) {
    shown.x.push_back(azimuth(point.azimuth_deg));
    shown.y.push_back(point.elevation_deg);
    shown.low.push_back(point.elevation_deg - point.error_deg);
    shown.high.push_back(point.elevation_deg + point.error_deg);
  }
  panel.series.push_back(std::move(shown));
  return panel;
}

/// The mean light of both pictures along the field lines.
Panel profiles_panel(const PairOfPictures& pair) {
  Panel panel;
  panel.title = "Light along the field lines";
  panel.x.label = "height above the border (km)";
  panel.y.label = "mean light, least 0, most 1";
  for (std::size_t i = 0; i < 2; ++i) {
    Series series;
    series.label = pair.cameras[i].camera().name;
    series.colour = distinct_colour(static_cast<int>(i));
    series.mark = i == 0 ? Mark::line : Mark::dashed_line;
    series.x = pair.profiles.profiles.above_km;
    series.y = pair.profiles.profiles.light[i];
    panel.series.push_back(std::move(series));
  }
  return panel;
}

std::string matches_table(const PairOfPictures& pair) {
  if (pair.borders.matches.empty()) return {};
  std::string html =
      "<table class=\"wide\">\n<thead><tr><th>border in the first picture</th><th>in the "
      "second</th><th>height "
      "(km)</th><th>of that by pointing and clocks (km)</th><th>by the border's level (km)</th><th>scatter "
      "along it (km)</th><th>points</th>"
      "<th>weight</th></tr></thead>\n<tbody>\n";
  for (const BorderMatch& match : pair.borders.matches) {
    const MeanHeight& mean = match.branch.mean;
    html += fmt::format(
        "<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{:.2f}</td></"
        "tr>\n",
        match.first_trace + 1, match.second_trace + 1, sim::number_with_error(mean.km, mean.error_km),
        sim::short_number(mean.common_error_km, 2), sim::short_number(match.level_error_km, 2),
        sim::short_number(mean.scatter_km, 2), mean.points, match.weight);
  }
  return html + "</tbody></table>\n";
}

std::string pair_section(const TogetherMeasurement& m, const PairOfPictures& pair) {
  std::string html = "<section>\n<h2>" + html_text(m.alone[pair.first].photo) + " and " +
                     html_text(m.alone[pair.second].photo) + "</h2>\n";
  if (!pair.refusal.empty()) html += "<p>No height: " + html_text(pair.refusal) + ".</p>\n";
  if (std::isfinite(pair.base_km))
    html += fmt::format("<p>Base {:.0f} km towards azimuth {:.0f}°", pair.base_km, pair.base_azimuth_deg);
  if (std::isfinite(pair.base_km) && std::isfinite(pair.shared_share))
    html += fmt::format("; the second camera sees {:.0f} % of the first one's sky at 110 km",
                        100.0 * pair.shared_share);
  if (std::isfinite(pair.base_km))
    html += (std::isfinite(pair.apart_s) ? fmt::format("; {:.0f} s apart", pair.apart_s)
                                         : std::string("; the times are not known")) +
            ".</p>\n";
  if (!pair.refusal.empty()) return html + "</section>\n";
  Plot plot;
  plot.panel_width_px = 440;
  plot.panel_height_px = 380;
  plot.columns = 2;
  plot.panels = {map_panel(pair)};
  if (best_border(pair)) plot.panels.push_back(heights_panel(pair));
  if (pair.pattern && pair.pattern->places > 0) plot.panels.push_back(pattern_panel(pair));
  if (has_clear_profiles(pair)) plot.panels.push_back(profiles_panel(pair));
  const CrossCheck check = cross_check(pair, m.alone[pair.first], m.alone[pair.second]);
  if (check.compared > 0) plot.panels.push_back(cross_check_panel(check));
  html += "<figure class=\"large\">" + plot_svg(plot) + "</figure>\n" + matches_table(pair);
  if (pair.profiles.is_given())
    html += fmt::format(
        "<p>Light along the field lines: border {} km high without the clocks' part, ranks alike to {:.2f} "
        "(median of the pieces), "
        "weight {:.2f}; meanwhile moved by {} km across the base, to the left of it.</p>\n",
        sim::number_with_error(pair.profiles.border_km, std::sqrt(pair.profiles.covariance_km2(0, 0))),
        pair.profiles.correlation, pair.profiles.weight,
        sim::number_with_error(pair.profiles.across_km, std::sqrt(pair.profiles.covariance_km2(1, 1))));
  if (!check.sentence.empty()) html += "<p>" + html_text(check.sentence) + "</p>\n";
  if (pair.pattern)
    for (const ShellHeight& height : pair.pattern->heights)
      html +=
          fmt::format("<p>Densest light: {} km, correlation {:.2f}, weight {:.2f}.</p>\n",
                      sim::number_with_error(height.km, height.error_km), height.correlation, height.weight);
  return html + "</section>\n";
}

std::string clocks_section(const TogetherMeasurement& m) {
  std::string html =
      "<section>\n<h2>Clocks</h2>\n<table class=\"wide\">\n<thead><tr><th>picture</th><th>to be added to its "
      "time (s)</th><th>do the pictures tell</th></tr></thead>\n<tbody>\n";
  for (std::size_t i = 0; i < m.alone.size(); ++i) {
    const ClockOffset& clock = m.clocks.offsets[i];
    html += "<tr><td>" + html_text(m.alone[i].photo) + "</td><td>" +
            sim::number_with_error(clock.s, clock.error_s) + "</td><td>" + (clock.is_told ? "yes" : "no") +
            "</td></tr>\n";
  }
  return html + "</tbody></table>\n</section>\n";
}

std::string alone_section(const TogetherMeasurement& m) {
  std::string html =
      "<section>\n<h2>What each picture says alone</h2>\n<table class=\"wide\">\n<thead><tr><th>picture</th>"
      "<th>its answer</th><th>distance of its main border, if it is 105 km high (95 to "
      "110)</th></tr></thead>\n<tbody>\n";
  for (std::size_t i = 0; i < m.alone.size(); ++i) {
    const Measurement& one = m.alone[i];
    html += fmt::format("<tr><td><a href=\"picture_{}/report.html\">", i + 1) + html_text(one.photo) +
            "</a></td><td>" + html_text(one.answer.empty() ? one.word : one.answer.front()) + "</td><td>";
    if (one.main_border)
      html += fmt::format(
          "{} km ({:.0f} to {:.0f})",
          sim::number_with_error(one.main_border->distance_km, one.main_border->distance_error_km),
          one.main_border->lowest_distance_km, one.main_border->highest_distance_km);
    html += "</td></tr>\n";
  }
  return html + "</tbody></table>\n</section>\n";
}

std::string number_cell(const WithError& number) {
  return "<td>" + (std::isfinite(number.value) ? sim::number_with_error(number.value, number.error) : "") +
         "</td>";
}

std::string curtain_row(const std::string& name, const MainCurtain& curtain, const WithError& nearest_km) {
  return "<tr><td>" + name + "</td>" + number_cell(curtain.lower_border_km) + number_cell(nearest_km) +
         number_cell(curtain.energy_kev) + "</tr>\n";
}

/// The map of all pictures, beside the geometry and what each picture says alone.
std::string physics_section(const TogetherMeasurement& m) {
  std::string html = "<section>\n<h2>With the physics of electrons</h2>\n";
  if (!m.joint_map)
    return html +
           (m.is_map_interrupted ? "<p>The map of all pictures is not finished.</p>\n"
                                 : "<p>No map was made.</p>\n") +
           "</section>\n";
  const JointMap& map = *m.joint_map;
  if (!map.missing.empty())
    html += "<p>There is no map of all pictures: " + html_text(map.missing) + ".</p>\n";
  if (map.is_interrupted) html += "<p>The map of all pictures was interrupted.</p>\n";
  if (!map.missing.empty() || map.is_interrupted) return html + "</section>\n";
  html += fmt::format(
      "<p><a href=\"map/report.html\">One map explains {} pictures</a>, chi² per value {:.2f}. Means along "
      "the "
      "main border, weighted by energy flux.</p>\n<table class=\"wide\">\n<thead><tr><th>by</th><th>height "
      "of "
      "the lower border (km)</th><th>distance of its nearest part (km)</th><th>E0 "
      "(keV)</th></tr></thead>\n<tbody>\n",
      map.pictures.size(), map.chi2_per_value);
  const Measurement& home = m.alone[map.home];
  if (const std::optional<PairHeight> height = compared_height(m)) {
    html += "<tr><td>geometry alone</td>" + number_cell({height->km, height->error_km});
    const BorderDistance distance = distance_by(m.pairs[map.pair], *height, home, 0);
    html += number_cell({distance.km, distance.error_km}) + "<td></td></tr>\n";
  }
  if (map.curtain) html += curtain_row("the map of all pictures", *map.curtain, map.nearest_km);
  for (const std::size_t i : map.pictures)
    if (m.alone[i].main_curtain)
      html += curtain_row(
          fmt::format("<a href=\"picture_{}/map/report.html\">the map of {} alone</a>{}", i + 1,
                      html_text(m.alone[i].photo), i == map.home ? "" : ", from its own place"),
          *m.alone[i].main_curtain, nearest_by(*m.alone[i].main_curtain, *m.alone[i].main_border));
  html += "</tbody></table>\n<p>Distances are from " + html_text(home.photo) + ".</p>\n";
  for (const Contradiction& c : m.contradictions)
    html += "<p>Geometry and map contradict each other in the " + html_text(c.quantity) + ".</p>\n";
  return html + "</section>\n";
}

}  // namespace together_page_parts

std::string together_page(const TogetherMeasurement& m) {
  using namespace together_page_parts;
  std::string html = headed_page("What " + std::to_string(m.alone.size()) + " pictures tell together");
  html += std::string("<div class=\"verdict ") +
          (m.trust == Trust::unconstrained ? "failed" : trust_name(m.trust)) +
          "\"><div><div class=\"word\">" + html_text(m.word) + "</div><div>";
  for (std::size_t i = 0; i < m.answer.size(); ++i)
    html += std::string("<div class=\"") + (i == 0 ? "answer" : "line") + "\">" + html_text(m.answer[i]) +
            "</div>";
  html += "</div></div></div>\n<main>\n";
  for (const PairOfPictures& pair : m.pairs) html += pair_section(m, pair);
  html += clocks_section(m) + alone_section(m);
  html += physics_section(m) + "<section>\n<h2>Command</h2>\n<pre><code>" + html_text(m.command) +
          "</code></pre>\n</section>\n";
  return html + "</main>\n</body>\n</html>\n";
}

}  // namespace vegard::fit
