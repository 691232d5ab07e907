#include "fit/report/map_run.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "fit/report/map_panels.h"
#include "fit/report/plot/plot.h"
#include "fit/report/report_style.h"
#include "fit/report/report_tables.h"
#include "sim/base/file/number_text.h"
#include "sim/base/number/constants.h"
#include "sim/base/shown_text.h"

namespace vegard::fit {
namespace {

constexpr int kPanelWidth_px = 520;

std::string pictures(const MappedPhoto& photo) {
  Plot plot;
  const double white = white_of(photo);
  plot.panels = {photograph_panel(photo, white), model_panel(photo, white), residual_panel(photo)};
  plot.columns = 3;
  plot.panel_width_px = 350;
  plot.panel_height_px =
      std::max(120, static_cast<int>(350.0 * (*plot.panels[0].y.max) / std::max(1.0, *plot.panels[0].x.max)));
  return plot_svg(plot);
}

std::string range_words(double low, double high, const char* unit) {
  return sim::short_number(low, 3) + " to " + sim::short_number(high, 3) + " " + unit;
}

std::string maps(const MapResult& result, const std::vector<Curtain>& curtains, bool magnetic_grid) {
  const ShownMap shown(result, magnetic_grid);
  const double white = shown.white();
  const auto [low, high] = shown.ln_energy_range();
  Plot plot;
  plot.panels.push_back(shown.flux_panel(std::string("energy flux, 0 to ") + sim::short_number(white, 3) +
                                             " mW m⁻²" + (is_absolute(result) ? "" : " (relative)"),
                                         white));
  plot.panels.push_back(
      shown.energy_panel("E0, " + range_words(std::exp(low), std::exp(high), "keV"), white, low, high));
  add_courses(curtains, "curtains", plot.panels[1]);
  plot.columns = 2;
  plot.panel_width_px = kPanelWidth_px;
  plot.panel_height_px = shown.height_px(kPanelWidth_px);
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
      maps(result, curtains, facts.magnetic_grid) + "</div>\n" + count_words(result, curtains, facts.faint) +
      "</section>\n";
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
