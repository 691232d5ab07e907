#include "fit/report/report_html.h"

#include <algorithm>

#include <fmt/format.h>

#include "fit/answer/derived.h"
#include "fit/photo/grey_light.h"
#include "fit/report/corner_plot.h"
#include "fit/report/foot_map.h"
#include "fit/report/report_pictures.h"
#include "fit/report/report_plots.h"
#include "fit/report/report_style.h"
#include "fit/report/report_tables.h"
#include "fit/report/table/curtain_steps_table.h"
#include "fit/report/table/report_bins.h"
#include "fit/report/table/validation_table.h"
#include "sim/base/file/number_text.h"
#include "sim/base/shown_text.h"

namespace vegard::fit {
namespace {

std::string verdict_word(Verdict verdict) {
  std::string word = verdict_name(verdict);
  word.front() = static_cast<char>(word.front() - 'a' + 'A');
  return word;
}

/// What the verdict has asked, folded up; in words what was found where that is not among the reasons
/// already.
std::string checks_list(const FitResult& result) {
  if (result.checks.empty()) return {};
  const auto passed = std::count_if(result.checks.begin(), result.checks.end(),
                                    [](const Check& check) { return check.passed; });
  std::string html =
      fmt::format("<details><summary>{} of {} checks passed</summary>\n<ul class=\"checks\">\n", passed,
                  result.checks.size());
  for (const Check& check : result.checks)
    html += std::string("<li class=\"") + (check.passed ? "passed" : "missed") + "\"><b>" +
            (check.passed ? "\u2713 " : "\u2717 ") + sim::html_text(check.name) + "</b> " +
            sim::html_text(check.passed ? check.words : "not passed") + "</li>\n";
  return html + "</ul></details>";
}

/// The verdict on top: the answer in a sentence and why to believe it in another; reasons that its line does
/// not have come below it.
std::string verdict_band(const FitResult& result) {
  std::string html = std::string("<div class=\"verdict ") + verdict_name(result.verdict) +
                     "\"><div>\n<div class=\"word\">" + verdict_word(result.verdict) +
                     "</div>\n<div><div class=\"answer\">" + answer_sentence(result) +
                     "</div><div class=\"line\">" + sim::html_text(result.verdict_line) + "</div>";
  std::string reasons;
  for (const std::string& reason : result.reasons)
    if (result.verdict_line.find(reason) == std::string::npos)
      reasons += "<li>" + sim::html_text(reason) + "</li>";
  if (!reasons.empty()) html += "<ul>" + reasons + "</ul>";
  html += checks_list(result);
  return html + "</div>\n</div></div>\n";
}

std::string section(const std::string& title, const std::string& introduction, const std::string& content) {
  return "<section>\n<h2>" + title + "</h2>\n" +
         (introduction.empty() ? std::string() : "<p>" + introduction + "</p>\n") + content + "</section>\n";
}

std::string figure(const std::string& uri, const std::string& name, const std::string& words) {
  return "<figure><img src=\"" + uri + "\" alt=\"" + name + "\"><figcaption><b>" + name + "</b>" + words +
         "</figcaption></figure>\n";
}

/// A section's title; of several photographs it says whose it is.
std::string title_for(const std::string& title, const ShownPhoto& shown) {
  return shown.fitted->name.empty() ? title : sim::html_text(shown.fitted->name) + ": " + title;
}

std::string pictures_section(const ShownPhoto& shown, const ReportPictures& pictures) {
  const std::string brightness = pictures.brightness == 1.0
                                     ? std::string()
                                     : " Shown " + sim::html_text(sim::short_number(pictures.brightness, 2)) +
                                           " times as bright as it is.";
  const std::string scale = sim::html_text(sim::short_number(pictures.residual_scale, 2));
  return section(
      title_for(shown.fitted->name.empty() ? "Photograph, model, residual" : "photograph, model, residual",
                shown),
      "",
      "<div class=\"three\">\n" +
          figure(
              pictures.photo, "Photograph",
              (has_named_axes(shown.fitted->data) ? "Outlined: the bands that were fitted, the first and the "
                                                    "last one numbered."
                                                  : "Framed: the region that was fitted, with its bands.") +
                  brightness) +
          figure(
              pictures.model, "Model",
              (shown.fitted->best.sheets.empty()
                   ? std::string("The best scene. ")
                   : std::string(
                         "The best scene, rendered without the random spacing of its beams: the expectation "
                         "that was fitted, not one realisation. ")) +
                  std::string(has_named_axes(shown.fitted->data)
                                  ? "In the bands it has their own brightness and sky, elsewhere, and where "
                                    "nothing determines a band\u2019s brightness, the mean of all."
                                  : "Its brightness per band is joined from band to band without seams.") +
                  brightness) +
          figure(pictures.residual, "Residual",
                 "Photograph \u2212 model in linear light. Mid-grey is zero, black and white are \u00b1" +
                     scale + " of full scale.") +
          "</div>\n");
}

std::string profiles_section(const ShownPhoto& shown, const ReportPictures& pictures) {
  const FittedPhoto& fitted = *shown.fitted;
  const ElevationOfPixel& elevation_of_pixel = shown.elevation_of_pixel;
  const bool named = has_named_axes(fitted.data), grey = is_grey(fitted.best);
  std::string html =
      "<div class=\"plots\">\n" +
      (named
           ? bins_mean_svg(fitted) + bins_residual_svg(fitted) +
                 (fitted.best.fit.band_brightness ? bins_brightness_svg(fitted) : "") + bins_bands_svg(fitted)
           : mean_profile_svg(fitted, elevation_of_pixel) + mean_residual_svg(fitted, elevation_of_pixel) +
                 colour_svg(fitted, elevation_of_pixel) + band_profiles_svg(fitted, elevation_of_pixel)) +
      "</div>\n";
  const std::string places = named ? fitted.data.grid->along.name : "the region\u2019s rows";
  if (!pictures.misfit.empty())
    html +=
        std::string("<h3>Residuals, ") + (named ? "bin by bin" : "row by row and band by band") +
        "</h3>\n<div class=\"misfit\">\n" +
        std::string(
            grey ? "" : "<div class=\"names\"><span>red</span><span>green</span><span>blue</span></div>\n") +
        "<img src=\"" + pictures.misfit +
        "\" alt=\"residual / sigma\">\n"
        "<p class=\"soft\">(Photograph \u2212 model) / \u03c3, " +
        sim::html_text(places) +
        " downwards and bands to the right: \u22124<span class=\"scale\"></span>+4. Speckle is noise; a "
        "pattern is something that the model does not have. Grey was not used.</p>\n</div>\n";
  const std::string compared =
      fitted.best.fit.weight[sim::StatisticKind::profile] > 0.0
          ? "This is what was fitted: "
          : "To look at; they were not compared (<code>fit.profile_weight</code> is 0): ";
  return section(
      title_for(named                 ? (fitted.name.empty() ? "Profiles" : "profiles")
                : fitted.name.empty() ? "Vertical profiles"
                                      : "vertical profiles",
                shown),
      named
          ? compared + "the mean light of every bin, by the " + sim::html_text(fitted.data.grid->along.name) +
                " and, band by band, by the " + sim::html_text(fitted.data.grid->across.name) +
                ". \u03c3 holds the noise of the photograph and the model error that the scene allows for."
          : compared + "the mean light of every row, in every band" + (grey ? "" : " and channel") +
                ". \u03c3 holds the noise of the photograph and the model error that the scene allows for.",
      html);
}

std::string radars_section(const FitResult& result) {
  std::string html = "<div class=\"plots\">\n" + radars_svg(result) + "</div>\n" + radars_table(result);
  return section(
      "Radar",
      "Densities that were fitted beside the light, at the field line of the radar\u2019s beam. Bars "
      "are \u00b1\u03c3.",
      html);
}

std::string trade_off_list(const FitResult& result) {
  std::string items;
  for (const std::string& sentence : result.trade_offs)
    items += "<li>" + sim::html_text(sentence) + "</li>\n";
  return items.empty() ? items : "<ul class=\"soft\">\n" + items + "</ul>\n";
}

std::string fit_section(const FitResult& result) {
  const std::string correlation = correlation_table(result);
  std::string html = statistics_table(result) + "<div class=\"two\">\n";
  if (result.photos.size() > 1) html += "<div><h3>The photographs</h3>\n" + photos_table(result) + "</div>\n";
  if (!correlation.empty())
    html += "<div><h3>Correlation of the parameters</h3>\n" + correlation +
            "<p class=\"soft\">Near \u00b11 the photograph constrains only a combination of the two "
            "parameters.</p>\n" +
            trade_off_list(result) + "</div>\n";
  if (!result.trace.empty())
    html += "<div><h3>&#160;</h3>\n" + trace_svg(result) +
            "<p class=\"soft\">Lines: the best so far. Start and polish (solid) are of the full model; "
            "overall, scan and descent (dashed) go by smoothed profiles with wider errors, so that their "
            "\u03c7\u00b2 cannot be compared with the others\u2019.</p></div>\n";
  html += "</div>\n";
  const std::string corner = corner_plot_svg(corner_data(result));
  if (!corner.empty()) html += "<div class=\"plots\">\n" + corner + "</div>\n";
  return section("Goodness of fit", "", html);
}

std::string sky_words(int terms) {
  if (terms == 1) return "a level";
  return terms == 2 ? "a level and a gradient" : "a level, a gradient and a curvature";
}

std::string title_of(const FitResult& result, const std::vector<ShownPhoto>& photos) {
  std::string title;
  for (const InputFile& input : result.inputs)
    if (input.role == "photo") title += (title.empty() ? "" : ", ") + input.name;
  return title.empty() ? photos.front().photo->file_name : title;
}

std::string solved_section(const ShownPhoto& shown) {
  const FittedPhoto& fitted = *shown.fitted;
  if (fitted.solved.empty()) return {};
  return section(
      title_for(fitted.name.empty() ? "Gains and sky" : "gains and sky", shown),
      std::string("Linear numbers, exact at every step of the search: the gain is ") +
          (light_noun(fitted.best) == "solar light"
               ? "what the model\u2019s light is multiplied by to be the photograph\u2019s linear light"
               : "the linear light of one kilorayleigh of 557.7\u00a0nm") +
          "; the sky, " +
          std::string(fitted.best.fit.band_sky ? "of each band along its profile"
                                               : "over the picture\u2019s height") +
          ", is " + sky_words(fitted.best.fit.sky_terms) + ".",
      solved_table(fitted));
}

/// The names of the files that each photograph has.
std::string files_of(const std::vector<ShownPhoto>& photos) {
  std::string text;
  for (const ShownPhoto& shown : photos) {
    const std::string name =
        shown.fitted->name.empty() ? std::string() : "-" + sim::html_text(shown.fitted->name);
    for (const char* stem : {"profiles", "model", "residual"})
      text += (text.empty() ? "" : ", ") + std::string("<code>") + stem + name +
              (std::string(stem) == "profiles" ? ".csv" : ".exr") + "</code>";
  }
  return text;
}

std::string opening_words(const sim::Scene& scene) {
  const std::string noun = light_noun(scene);
  return noun == "solar light" ? "A simulated Sun" : "A simulated " + noun;
}

}  // namespace

std::string report_html(const FitResult& result, const std::vector<ShownPhoto>& photos) {
  std::vector<ReportPictures> pictures;
  for (const ShownPhoto& shown : photos)
    pictures.push_back(report_pictures(*shown.fitted, *shown.photo, *shown.model));
  const std::string title = sim::html_text(title_of(result, photos));
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en-GB\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
      title + ": " + verdict_name(result.verdict) + "</title>\n<style>" + kReportStyle +
      "</style>\n</head>\n<body>\n<header><div class=\"head\">\n<p>" + opening_words(result.best) +
      ", fitted to " +
      (photos.size() == 1 ? std::string("a photograph") : std::to_string(photos.size()) + " photographs") +
      "</p>\n<h1>" + title + "</h1>\n</div></header>\n" + verdict_band(result) + "<main>\n";
  for (std::size_t i = 0; i < photos.size(); ++i) html += pictures_section(photos[i], pictures[i]);
  const std::string cards = derived_cards(result) + derived_table(result) + tables_list(result);
  const bool believed = result.verdict == Verdict::good;
  if (!cards.empty())
    html +=
        section("What it says about the " + light_noun(result.best),
                believed ? ""
                         : "The verdict above is on the picture as a whole. Each number has its own: good, "
                           "doubtful or unconstrained.",
                cards);
  const std::string map = foot_map_svg(result);
  if (!map.empty()) html += section("Where it is", "", "<div class=\"plots\">\n" + map + "</div>\n");
  if (const std::string steps = curtain_steps_table(result); !steps.empty())
    html +=
        section("Selection of curtains",
                "The map\u2019s curtains were made curves and settled by their beams. Then the weakest were "
                "left out and the strongest faint ones of the map added, one after the other, and "
                "each time all others settled again: BIC, \u03c7\u00b2 with a price for every number, says "
                "which change stays.",
                steps);
  html += section(
      "Parameters",
      "\u03c3 is half of the 68\u00a0% interval, carried back from the scale on which the search moves the "
      "parameter; the interval itself may be lopsided.",
      parameter_table_html(result) + tied_table(result));
  if (const std::string stability = stability_table(result); !stability.empty())
    html +=
        section("Stability",
                "The fit repeated from its answer with one of its choices made otherwise: what each number "
                "moves by. What goes beyond chance (the difference of the statistical variances) is the "
                "systematic error, added over the choices in quadrature.",
                stability);
  const std::string validation = validation_table(result);
  if (!validation.empty())
    html += section(
        "Validation of the error bars",
        "The same intervals by means that do not take \u03c7\u00b2 for a parabola. Flagged: more than "
        "half as wide again as the curvature has it, or narrower than two thirds.",
        validation);
  if (!result.profiles.empty())
    html += section("Height profiles",
                    "Free of any electrons: for each line a smooth curve that is nowhere negative. Where "
                    "gains are solved "
                    "for, only its shape and the lines\u2019 ratios mean anything: the column of "
                    "557.7\u00a0nm is held at "
                    "the start\u2019s. Beside this page: <code>profile.csv</code>.",
                    "<div class=\"plots\">\n" + free_profiles_svg(result) + "</div>\n");
  if (!result.radars.empty()) html += radars_section(result);
  for (std::size_t i = 0; i < photos.size(); ++i) html += profiles_section(photos[i], pictures[i]);
  html += fit_section(result);
  for (const ShownPhoto& shown : photos) html += solved_section(shown);
  html += section("Provenance", "", provenance_table(result));
  html +=
      "<footer>Beside this page: <code>result.json</code> (all numbers), <code>best.toml</code> (the best "
      "scene), " +
      std::string(map.empty() ? "" : "<code>map.svg</code>, ") + "<code>trace.csv</code>, " +
      files_of(photos) + ".</footer>\n</main>\n</body>\n</html>\n";
  return html;
}

}  // namespace vegard::fit
