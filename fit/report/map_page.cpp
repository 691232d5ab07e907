#include "fit/report/map_run.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "fit/map/raster_grid.h"
#include "fit/report/plot/plot.h"
#include "fit/report/report_style.h"
#include "fit/report/report_tables.h"
#include "sim/base/file/number_text.h"
#include "sim/base/number/constants.h"
#include "sim/base/shown_text.h"
#include "sim/emit/aurora/foot_line.h"
#include "sim/scene/structs/site_axes.h"

namespace vegard::fit {
namespace {

constexpr int kPanelWidth_px = 520;
constexpr Colour kMeridianInk{150, 158, 168}, kCurtainInk{220, 60, 40};

std::uint8_t display_code(double linear) {
  const double x = std::clamp(linear, 0.0, 1.0);
  return static_cast<std::uint8_t>(
      std::lround(255.0 * (x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055)));
}

/// From dark blue by green to yellow; t from 0 to 1.
std::array<std::uint8_t, 3> heat(double t) {
  constexpr double kStop[5][3] = {{68, 1, 84}, {59, 82, 139}, {33, 145, 140}, {94, 201, 98}, {253, 231, 37}};
  const double x = std::clamp(t, 0.0, 1.0) * 4.0;
  const int i = std::min(3, static_cast<int>(x));
  std::array<std::uint8_t, 3> rgb{};
  for (int c = 0; c < 3; ++c)
    rgb[c] = static_cast<std::uint8_t>(std::lround(kStop[i][c] + (x - i) * (kStop[i + 1][c] - kStop[i][c])));
  return rgb;
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 1.0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * (values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// One picture of the film's cells, whatever they hold.
template <class Rgb>
Panel film_panel(const MappedPhoto& photo, const std::string& title, const Rgb& rgb_of_cell) {
  const sim::FilmGeometry& film = photo.film;
  const int margin = static_cast<int>(-film.x0_px / film.cell_width_px);
  const int width = film.columns - 2 * margin, height = film.rows - 2 * margin;
  Panel panel;
  panel.title = title;
  panel.x.label = "pixel";
  panel.y.label = "pixel";
  panel.y.reversed = true;
  panel.x.min = 0.0;
  panel.x.max = width * film.cell_width_px;
  panel.y.min = 0.0;
  panel.y.max = height * film.cell_height_px;
  panel.raster.width = width;
  panel.raster.height = height;
  panel.raster.left = panel.raster.top = 0.0;
  panel.raster.right = *panel.x.max;
  panel.raster.bottom = *panel.y.max;
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column) {
      const auto rgb = rgb_of_cell(static_cast<std::size_t>(row + margin) * film.columns + column + margin);
      panel.raster.rgb.insert(panel.raster.rgb.end(), rgb.begin(), rgb.end());
    }
  return panel;
}

std::string pictures(const MappedPhoto& photo) {
  std::vector<double> bright;
  for (std::size_t i = 0; i < photo.data.size(); ++i)
    if (photo.sigma[i] > 0.0f) bright.push_back(photo.data[i]);
  const double white = std::max(1e-9, quantile(bright, 0.995));
  const auto shown = [&](const auto& value) {
    return [&photo, value, white](std::size_t cell) {
      std::array<std::uint8_t, 3> rgb{};
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t i = cell * 3 + c;
        const bool shown_at_all =
            photo.sigma[cell * 3] + photo.sigma[cell * 3 + 1] + photo.sigma[cell * 3 + 2] > 0.0f;
        rgb[c] = shown_at_all ? display_code(value(i) / white) : 0;
      }
      return rgb;
    };
  };
  Plot plot;
  plot.panels.push_back(film_panel(photo, "photograph",
                                   shown([&](std::size_t i) { return static_cast<double>(photo.data[i]); })));
  plot.panels.push_back(film_panel(photo, "the map's light and the sky", shown([&](std::size_t i) {
                                     return static_cast<double>(photo.model[i]) + photo.sky[i];
                                   })));
  plot.panels.push_back(film_panel(photo, "(photograph − model) / error, grey is 0", [&](std::size_t cell) {
    std::array<std::uint8_t, 3> rgb{};
    constexpr double kShown = 5.0;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t i = cell * 3 + c;
      const double z =
          photo.sigma[i] > 0.0f ? (photo.data[i] - photo.model[i] - photo.sky[i]) / photo.sigma[i] : 0.0;
      rgb[c] = static_cast<std::uint8_t>(std::lround(127.5 + 127.5 * std::clamp(z / kShown, -1.0, 1.0)));
    }
    return rgb;
  }));
  plot.columns = 3;
  plot.panel_width_px = 350;
  plot.panel_height_px =
      std::max(120, static_cast<int>(350.0 * (*plot.panels[0].y.max) / std::max(1.0, *plot.panels[0].x.max)));
  return plot_svg(plot);
}

/// The foot at a latitude and longitude, in the site's tangent plane.
sim::EastNorth foot_at(const sim::Site& site, double latitude_deg, double longitude_deg) {
  const sim::SiteAxes axes = sim::axes_at(site);
  sim::Site there;
  there.latitude_deg = latitude_deg;
  there.longitude_deg = longitude_deg;
  const sim::SiteAxes up = sim::axes_at(there);
  const double radius = sim::kEarthRadiusKm + sim::kFootAltitudeKm;
  double foot[3];
  for (int i = 0; i < 3; ++i)
    foot[i] = radius * (axes.axis[i][0] * up.axis[2][0] + axes.axis[i][1] * up.axis[2][1] +
                        axes.axis[i][2] * up.axis[2][2]);
  return foot[2] > 0.0 ? sim::EastNorth{foot[0], foot[1]} : sim::EastNorth{sim::kNaN, sim::kNaN};
}

double round_grid_step(double range) {
  for (const double step : {0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0})
    if (range / step <= 6.0) return step;
  return 20.0;
}

/// Lines of latitude and longitude over a map, dashed.
void add_geographic_grid(const MapResult& result, const RasterGrid& raster, Panel& panel) {
  double south = 90.0, north = -90.0, west = 1e9, east = -1e9;
  for (const double x : {0.0, 0.5, 1.0})
    for (const double y : {0.0, 0.5, 1.0}) {
      const sim::PlaceOnEarth p =
          sim::place_of_foot(result.scene, raster.place(x * raster.columns, y * raster.rows));
      if (std::isnan(p.latitude_deg)) continue;
      south = std::min(south, p.latitude_deg);
      north = std::max(north, p.latitude_deg);
      west = std::min(west, p.longitude_from_site_deg);
      east = std::max(east, p.longitude_from_site_deg);
    }
  const double from = result.scene.site.longitude_deg;
  const auto add = [&](const std::string& label, const auto& point) {
    Series line;
    line.label = label;
    line.colour = kMeridianInk;
    line.mark = Mark::dashed_line;
    line.width_px = 0.8;
    for (int i = 0; i <= 60; ++i) {
      const sim::EastNorth p = point(i / 60.0);
      const bool inside = p.east > raster.west_km && p.north > raster.south_km &&
                          p.east < raster.west_km + raster.columns * raster.step_km &&
                          p.north < raster.south_km + raster.rows * raster.step_km;
      line.x.push_back(inside ? p.east : sim::kNaN);
      line.y.push_back(inside ? p.north : sim::kNaN);
    }
    panel.series.push_back(std::move(line));
  };
  const double lat_step = round_grid_step(north - south), lon_step = round_grid_step(east - west);
  std::string label = fmt::format("every {} ° of latitude, {} ° of longitude", sim::short_number(lat_step),
                                  sim::short_number(lon_step));
  for (double lat = std::ceil(south / lat_step) * lat_step; lat <= north; lat += lat_step) {
    add(label, [&](double t) { return foot_at(result.scene.site, lat, from + west + t * (east - west)); });
    label.clear();
  }
  for (double lon = std::ceil((from + west) / lon_step) * lon_step; lon <= from + east; lon += lon_step)
    add("", [&](double t) { return foot_at(result.scene.site, south + t * (north - south), lon); });
}

std::string range_words(double low, double high, const char* unit) {
  return sim::short_number(low, 3) + " to " + sim::short_number(high, 3) + " " + unit;
}

std::string maps(const MapResult& result, const std::vector<Curtain>& curtains) {
  const RasterGrid raster = raster_over(result);
  const RasterFlux flux = raster_flux(result, raster, result.cells);
  const std::vector<std::uint8_t> in_view = places_in_view(result, raster);
  double most = 0.0;
  std::vector<double> lit, ln;
  for (const double q : flux.flux) most = std::max(most, q);
  for (std::size_t i = 0; i < raster.size(); ++i)
    if (flux.flux[i] > 0.05 * most) {
      lit.push_back(flux.flux[i]);
      ln.push_back(flux.flux_ln_energy[i] / flux.flux[i]);
    }
  const double white = quantile(lit, 0.98), low = quantile(ln, 0.02),
               high = std::max(quantile(ln, 0.98), low + 0.1);
  const auto panel_of = [&](const std::string& title, const auto& colour) {
    Panel panel;
    panel.title = title;
    panel.x.label = "east of the site (km)";
    panel.y.label = "north of the site (km)";
    panel.x.min = raster.west_km;
    panel.x.max = raster.west_km + (raster.columns - 1) * raster.step_km;
    panel.y.min = raster.south_km;
    panel.y.max = raster.south_km + (raster.rows - 1) * raster.step_km;
    panel.raster.width = raster.columns;
    panel.raster.height = raster.rows;
    panel.raster.left = *panel.x.min - 0.5 * raster.step_km;
    panel.raster.right = *panel.x.max + 0.5 * raster.step_km;
    panel.raster.bottom = *panel.y.min - 0.5 * raster.step_km;
    panel.raster.top = *panel.y.max + 0.5 * raster.step_km;
    for (int row = raster.rows - 1; row >= 0; --row)
      for (int column = 0; column < raster.columns; ++column) {
        const std::size_t i = static_cast<std::size_t>(row) * raster.columns + column;
        std::array<std::uint8_t, 3> rgb = {228, 231, 235};  // no answer here
        if (in_view[i] != 0) rgb = colour(i);
        panel.raster.rgb.insert(panel.raster.rgb.end(), rgb.begin(), rgb.end());
      }
    add_geographic_grid(result, raster, panel);
    return panel;
  };
  Plot plot;
  plot.panels.push_back(
      panel_of(std::string("energy flux, 0 to ") + sim::short_number(white, 3) + " mW m⁻²" +
                   (is_absolute(result) ? "" : " (relative)"),
               [&](std::size_t i) { return heat(std::sqrt(std::max(0.0, flux.flux[i]) / white)); }));
  plot.panels.push_back(
      panel_of("E0, " + range_words(std::exp(low), std::exp(high), "keV"), [&](std::size_t i) {
        if (flux.flux[i] < 0.03 * white) return std::array<std::uint8_t, 3>{250, 250, 250};
        return heat((flux.flux_ln_energy[i] / flux.flux[i] - low) / (high - low));
      }));
  for (std::size_t c = 0; c < curtains.size(); ++c) {
    Series line;
    line.label = c == 0 ? "curtains" : "";
    line.colour = kCurtainInk;
    line.width_px = 1.2;
    for (const CurtainPoint& p : curtains[c].points) {
      line.x.push_back(p.foot_km.east);
      line.y.push_back(p.foot_km.north);
    }
    plot.panels[1].series.push_back(std::move(line));
  }
  plot.columns = 2;
  plot.panel_width_px = kPanelWidth_px;
  plot.panel_height_px = std::clamp(
      static_cast<int>(kPanelWidth_px * static_cast<double>(raster.rows) / raster.columns), 160, 640);
  return plot_svg(plot);
}

std::string along_curtains(const std::vector<Curtain>& curtains) {
  constexpr std::size_t kMaxShown = 6;
  struct Quantity {
    const char* title;
    const char* label;
    WithError (*value_at)(const CurtainPoint&);
  };
  const Quantity quantities[] = {
      {"distance", "distance (km)",
       [](const CurtainPoint& p) {
         return WithError{p.distance_km, p.distance_error_km};
       }},
      {"energy", "E0 (keV)", [](const CurtainPoint& p) { return p.energy_kev; }},
      {"energy flux", "Q (mW m⁻²)", [](const CurtainPoint& p) { return p.flux_mw_m2; }},
      {"lower border of the green light", "altitude (km)",
       [](const CurtainPoint& p) { return p.lower_border_km; }}};
  double north = 0.0;
  for (const Curtain& curtain : curtains)
    for (const CurtainPoint& p : curtain.points) north += p.foot_km.north;
  const bool northern = north > 0.0;
  Plot plot;
  plot.columns = 2;
  plot.panel_width_px = kPanelWidth_px - 60;
  plot.panel_height_px = 230;
  for (const Quantity& quantity : quantities) {
    Panel panel;
    panel.title = quantity.title;
    panel.x.label = "azimuth (°)";
    panel.y.label = quantity.label;
    for (std::size_t c = 0; c < std::min(curtains.size(), kMaxShown); ++c) {
      Series line;
      line.label = "curtain " + std::to_string(c + 1);
      line.colour = distinct_colour(static_cast<int>(c));
      for (const CurtainPoint& p : curtains[c].points) {
        const WithError v = quantity.value_at(p);
        // North in the middle where curtains stand in the north, else south.
        line.x.push_back(northern && p.azimuth_deg > 180.0 ? p.azimuth_deg - 360.0 : p.azimuth_deg);
        line.y.push_back(v.value);
        if (std::isfinite(v.error)) {
          line.low.push_back(v.value - v.error);
          line.high.push_back(v.value + v.error);
        }
      }
      if (line.low.size() != line.x.size()) line.low = line.high = {};
      panel.series.push_back(std::move(line));
    }
    plot.panels.push_back(std::move(panel));
  }
  return plot_svg(plot);
}

std::string verdict_table(const std::vector<QuantityVerdict>& verdicts) {
  std::string html = "<table>\n<tr><th>quantity</th><th>verdict</th><th>found</th><th>why</th></tr>\n";
  for (const QuantityVerdict& v : verdicts)
    html += "<tr><td>" + sim::html_text(v.quantity) + "</td><td><b>" + trust_name(v.trust) + "</b></td><td>" +
            sim::html_text(v.value) + "</td><td>" + sim::html_text(v.reason) + "</td></tr>\n";
  return html + "</table>\n";
}

/// What was counted as a curtain, and what was not.
std::string count_words(const MapResult& result, const std::vector<Curtain>& curtains,
                        const std::vector<Curtain>& others) {
  const auto patches =
      std::count_if(others.begin(), others.end(), [](const Curtain& c) { return c.is_diffuse_patch; });
  const auto count = [](std::size_t n, const char* one) {
    return std::to_string(n) + " " + one + (n == 1 ? "" : "s");
  };
  std::string html = "<p>" + count(curtains.size(), "curtain");
  if (result.replicates.empty())
    html += ", not tested against chance: that needs perturbed solutions (--replicates)";
  else if (!curtains.empty())
    html += ", which nearly all perturbed solutions have, and chance does not make";
  html += ".";
  const auto length_words = [](const Curtain& c) { return sim::short_number(c.length_km, 3) + " km"; };
  if (!curtains.empty()) {
    html += curtains.size() == 1 ? " It is " : " They are ";
    for (std::size_t c = 0; c < curtains.size(); ++c)
      html += (c == 0 ? "" : c + 1 == curtains.size() ? " and " : ", ") + length_words(curtains[c]);
    html += " long.";
  }
  const std::size_t rest = others.size() - static_cast<std::size_t>(patches);
  if (rest > 0)
    html += fmt::format(" {} that {} faint or may be chance {} in faint_curtains.csv.", count(rest, "ridge"),
                        rest == 1 ? "is" : "are", rest == 1 ? "is" : "are");
  if (patches > 0)
    html += fmt::format(" Diffuse patches, wide and not long, in the same table: {}.", patches);
  return html + "</p>\n";
}

std::string prior_words(const MapResult& result) {
  std::string html = fmt::format(
      "<p>Strength of the prior: {} per lit cell{}. {} cells of the ground, {} energies from {} to {} keV, "
      "{} values of the picture, {} perturbed solutions for the error bars.</p>\n",
      sim::short_number(result.sparsity, 3),
      result.trials.empty() ? ", as given"
      : is_prior_at_its_end(result)
          ? ", the weakest that is tried; left-out blocks of the picture may want less"
          : ", by what left-out blocks of the picture want",
      result.grid.cells(), result.energies_kev.size(), sim::short_number(result.energies_kev.front(), 3),
      sim::short_number(result.energies_kev.back(), 3), result.values, result.replicates.size());
  if (result.altitude_scale != 1.0)
    html += "<p>All light is at " + sim::short_number(result.altitude_scale, 4) +
            " times the altitudes of the tables, as asked (--altitude-scale).</p>\n";
  if (result.spectrum.kind != sim::ElectronSpectrum::Kind::maxwellian)
    html += "<p>The electrons' spectrum is " + sim::spectrum_in_words(result.spectrum) +
            ", as asked (--spectrum).</p>\n";
  if (is_of_one_station(result) && result.replicates.size() > 1)
    html +=
        "<p>Every second perturbed solution has another spectrum of electrons (docs/map.md): from one "
        "station "
        "its effect looks like another height and distance.</p>\n";
  if (!result.numbers.empty() && !result.replicates.empty()) {
    std::string unknown;
    bool has_modes = false;
    for (const MapNumber& n : result.numbers) {
      has_modes = has_modes || n.mode >= 0;
      if (n.mode >= 0) continue;
      unknown +=
          (unknown.empty() ? "" : ", ") + sim::html_text(n.label) + " (" +
          sim::html_text(sim::number_with_error(n.value, n.error) + (n.unit.empty() ? "" : " " + n.unit)) +
          ")";
    }
    if (has_modes)
      unknown += (unknown.empty() ? "" : ", ") +
                 std::string("the light of electrons (the emission tables' uncertainty)");
    html += "<p>In the error bars is also what is not known of " + unknown + ".</p>\n";
  }
  if (result.trials.empty()) return html;
  html += "<table>\n<tr><th>strength</th><th>loss of what was left out</th></tr>\n";
  for (const MapTrial& t : result.trials)
    html += "<tr><td>" + sim::short_number(t.sparsity, 3) + "</td><td>" +
            sim::number_with_error(t.left_out, t.error) + "</td></tr>\n";
  return html + "</table>\n";
}

}  // namespace

std::string map_page(const MapResult& result, const std::vector<Curtain>& curtains,
                     const std::vector<QuantityVerdict>& verdicts, const MapRunFacts& facts) {
  const bool all_good = std::all_of(verdicts.begin(), verdicts.end(),
                                    [](const QuantityVerdict& v) { return v.trust == Trust::good; });
  std::string title = "Precipitation map";
  for (std::size_t i = 0; i < facts.inputs.size(); ++i)
    if (facts.inputs[i].role == "photo") title += (title.size() > 17 ? ", " : " of ") + facts.inputs[i].name;
  std::string html = headed_page(title);
  const char* word = result.interrupted ? "interrupted" : all_good ? "good" : "doubtful";
  html += std::string("<div class=\"verdict ") + word + "\"><div><div class=\"word\">" +
          (result.interrupted ? "Interrupted"
           : all_good         ? "Good"
                              : "With care") +
          "</div><div class=\"line\">" + sim::html_text(verdict_line(verdicts)) +
          "</div></div></div>\n<main>\n";
  html +=
      "<section><h2>Where electrons fall</h2>\n<p>Energy flux and energy on the ground's cells, at the feet "
      "of the field lines 110 km high, seen from above. Grey: not in view of any picture.</p>\n<div "
      "class=\"plots\">" +
      maps(result, curtains) + "</div>\n" + count_words(result, curtains, facts.faint) + "</section>\n";
  html += "<section><h2>What the map says</h2>\n" + verdict_table(verdicts) +
          corrections_list(map_corrections(result, curtains), "What it says about the emission tables:") +
          "</section>\n";
  for (const MappedPhoto& photo : result.photos)
    html += "<section><h2>The picture" + (photo.name.empty() ? "" : " " + sim::html_text(photo.name)) +
            "</h2>\n<p>chi2 " + sim::short_number(photo.chi2, 4) + " over " + std::to_string(photo.values) +
            " values.</p>\n<div class=\"plots\">" + pictures(photo) + "</div></section>\n";
  if (!curtains.empty())
    html +=
        "<section><h2>Along the curtains</h2>\n<p>The brightest first; bands are one standard error. All of "
        "them are in curtains.csv.</p>\n<div class=\"plots\">" +
        along_curtains(curtains) + "</div></section>\n";
  html += "<section><h2>How it was made</h2>\n" + prior_words(result);
  for (const auto& [name, how] : facts.decodings)
    html += "<p>Decoding" + (name.empty() ? "" : " of " + sim::html_text(name)) + ": " + sim::html_text(how) +
            "</p>\n";
  for (const PhotoFact& fact : facts.from_photograph)
    html += "<p>From the photograph: " + sim::html_text(fact_text(fact)) + "</p>\n";
  html +=
      "<p><code>" + sim::html_text(facts.command) + "</code></p>\n</section>\n</main>\n</body>\n</html>\n";
  return html;
}

}  // namespace vegard::fit
