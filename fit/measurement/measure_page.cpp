#include "fit/measurement/measure.h"

#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include "fit/border/border_distance.h"
#include "fit/measurement/traces_picture.h"
#include "fit/report/report_style.h"
#include "sim/base/file/number_text.h"
#include "sim/base/shown_text.h"
#include "sim/base/version.h"

namespace vegard::fit {
namespace {

using sim::html_text;

std::string stage_section(const MeasureStage& stage) {
  std::string html = "<section>\n<h2>" + html_text(stage.title) + " <small>(" + trust_name(stage.trust) +
                     ")</small></h2>\n<p>" + html_text(stage.found) + "</p>\n";
  if (!stage.lacking.empty()) html += "<p><b>What would help:</b> " + html_text(stage.lacking) + "</p>\n";
  if (!stage.files.empty()) {
    html += "<p>Written:";
    for (const std::string& file : stage.files)
      html += " <a href=\"" + html_text(file) + "\">" + html_text(file) + "</a>";
    html += "</p>\n";
  }
  if (!stage.command.empty())
    html += "<details><summary>The same by hand</summary>\n<pre><code>" + html_text(stage.command) +
            "</code></pre>\n<pre>" + html_text(stage.words) + "</pre></details>\n";
  return html + "</section>\n";
}

/// The names of the traces' colours under the picture.
std::string traces_legend(const Border& border) {
  std::string html = "<figcaption class=\"inks\">";
  const auto entry = [&](const std::string& colour, const std::string& words) {
    html += "<span><i style=\"background:" + colour + "\"></i>" + words + "</span>";
  };
  std::size_t claimed = 0, others = 0;
  for (std::size_t t = 0; t < border.traces.size(); ++t) {
    if (border.traces[t].measured == 0) continue;
    if (!border.traces[t].is_claimed())
      ++others;
    else if (claimed++ < kNamedTraces)
      entry(trace_colour(claimed - 1), fmt::format("border {}", t + 1));
  }
  if (claimed > kNamedTraces)
    entry(trace_colour(kNamedTraces), fmt::format("and {} more in the table", claimed - kNamedTraces));
  if (others > 0) entry(unclaimed_colour(), fmt::format("not claimed to be aurora ({})", others));
  return html + "</figcaption>";
}

std::string figure(const Measurement& m, const std::string& picture) {
  return "<figure class=\"large\"><img src=\"" + html_text(picture) + "\" alt=\"" + html_text(picture) +
         "\">" + (picture == "traces.svg" && m.border ? traces_legend(*m.border) : "") + "</figure>\n";
}

/// The claimed borders: where each is.
std::string border_table(const Measurement& m) {
  if (!m.main_border) return {};
  std::string html = fmt::format(
      "<section>\n<h2>The borders</h2>\n<p>The nearest part of each, if it is {:.0f} km high, and, in "
      "brackets, "
      "for {:.0f} and {:.0f} km.</p>\n<table class=\"wide\">\n<thead><tr><th>border</th><th>azimuths "
      "(°)</th><th>elevations (°)</th><th>distance (km)</th><th>at azimuth (°)</th><th>probability of "
      "aurora</th></tr></thead>\n<tbody>\n",
      kAssumedBorder_km, kBorderAltitudesKm.front(), kBorderAltitudesKm.back());
  for (std::size_t t = 0; t < m.border->traces.size(); ++t) {
    const BorderTrace& trace = m.border->traces[t];
    if (!trace.is_claimed() || trace.measured == 0) continue;
    const MainBorder b = placed_border(*m.border, t, *m.border_scene, m.pointing_error_deg);
    html += fmt::format(
        "<tr><td>{}{}</td><td>{:.0f} to {:.0f}</td><td>{:.1f} to {:.1f}</td><td>{} ({:.0f} to "
        "{:.0f})</td><td>{:.0f}</td><td>{:.0f} %</td></tr>\n",
        t + 1, t == m.main_border->trace ? ", the main one" : "", b.from_azimuth_deg, b.to_azimuth_deg,
        b.lowest_deg, b.highest_deg, sim::number_with_error(b.distance_km, b.distance_error_km),
        b.lowest_distance_km, b.highest_distance_km, b.azimuth_deg, 100.0 * trace.aurora_probability);
  }
  html += "</tbody></table>\n<p><a href=\"border/report.html\">All points, with their places</a></p>\n";
  return html + "</section>\n";
}

/// The map's main curtain: the answer's numbers, and how they vary along it.
std::string curtain_table(const Measurement& m) {
  if (!m.map || !m.main_curtain) return {};
  const MainCurtain& c = *m.main_curtain;
  const auto row = [](const std::string& name, const std::string& value) {
    return "<tr><th>" + name + "</th><td>" + value + "</td></tr>\n";
  };
  std::string html =
      "<section>\n<h2>The main curtain of the map</h2>\n<p>Means weighted by energy "
      "flux.</p>\n<table>\n<tbody>\n";
  html += row("distance", sim::number_with_error(c.distance_km.value, c.distance_km.error) + " km" +
                              (c.is_along_border ? ", by the border alone " +
                                                       sim::number_with_error(c.border_distance_km.value,
                                                                              c.border_distance_km.error) +
                                                       " km"
                                                 : ""));
  html += row("mean energy", sim::number_with_error(c.energy_kev.value, c.energy_kev.error) +
                                 " keV, along it " + sim::short_number(c.lowest_kev, 2) + " to " +
                                 sim::short_number(c.highest_kev, 2) + " keV");
  html += row("lower border",
              sim::number_with_error(c.lower_border_km.value, c.lower_border_km.error) + " km high");
  html += row("curtains in the map", std::to_string(m.map->curtains.size()));
  return html + "</tbody></table>\n<p><a href=\"map/report.html\">The map</a></p>\n</section>\n";
}

nlohmann::ordered_json with_error(const WithError& number) {
  return {{"value", number.value}, {"error", number.error}};
}

nlohmann::ordered_json border_numbers(const Measurement& m) {
  const MainBorder& b = *m.main_border;
  nlohmann::ordered_json numbers = {
      {"trace", b.trace + 1},
      {"aurora_probability", m.border->traces[b.trace].aurora_probability},
      {"azimuth_deg", b.azimuth_deg},
      {"elevation_deg", b.elevation_deg},
      {"distance_km", {{"value", b.distance_km}, {"error", b.distance_error_km}}},
      {"distance_km_for_95_and_110_km", {b.lowest_distance_km, b.highest_distance_km}}};
  if (m.site && m.has_azimuth) {
    numbers["latitude_deg"] = b.latitude_deg;
    numbers["longitude_deg"] = b.longitude_deg;
  }
  return numbers;
}

nlohmann::ordered_json curtain_numbers(const MainCurtain& c) {
  return {{"azimuth_deg", c.azimuth_deg},
          {"distance_km", with_error(c.distance_km)},
          {"border_distance_km", with_error(c.border_distance_km)},
          {"energy_kev", with_error(c.energy_kev)},
          {"lower_border_km", with_error(c.lower_border_km)},
          {"is_along_border", c.is_along_border}};
}

}  // namespace

std::string measure_page(const Measurement& m) {
  std::string html = headed_page("What " + m.photo + " tells");
  html += std::string("<div class=\"verdict ") +
          (m.trust == Trust::unconstrained ? "failed" : trust_name(m.trust)) +
          "\"><div><div class=\"word\">" + html_text(m.word) + "</div><div>";
  constexpr std::size_t kLarge = 2;
  for (std::size_t i = 0; i < m.answer.size(); ++i)
    html += std::string("<div class=\"") + (i < kLarge ? "answer" : "line") + "\">" + html_text(m.answer[i]) +
            "</div>";
  if (!m.not_known.empty()) {
    html += "<div class=\"line\">Not known from this picture alone:</div>\n<ul>";
    for (const std::string& sentence : m.not_known) html += "<li>" + html_text(sentence) + "</li>";
    html += "</ul>";
  }
  html += "</div></div></div>\n<main>\n";
  if (!m.pictures.empty()) html += figure(m, m.pictures.front());
  html += border_table(m) + curtain_table(m);
  for (std::size_t i = 1; i < m.pictures.size(); ++i) html += figure(m, m.pictures[i]);
  for (const MeasureStage& stage : m.stages) html += stage_section(stage);
  html += "<section>\n<h2>Command</h2>\n<pre><code>" + html_text(m.command) + "</code></pre>\n</section>\n";
  return html + "</main>\n</body>\n</html>\n";
}

std::string measure_json(const Measurement& m) {
  nlohmann::ordered_json json;
  json["kind"] = "vegard measure";
  json["version"] = sim::version();
  json["command"] = m.command;
  json["photo"] = m.photo;
  json["trust"] = trust_name(m.trust);
  json["word"] = m.word;
  json["answer"] = m.answer;
  json["parts"] = nlohmann::ordered_json::array();
  for (const AnswerPart& part : m.parts)
    json["parts"].push_back(
        {{"name", part.name}, {"trust", trust_name(part.trust)}, {"reasons", part.reasons}});
  json["not_known"] = m.not_known;
  if (m.sky_kind)
    json["sky_kind"] = {{"kind", sky_kind_name(m.sky_kind->kind)},
                        {"probability", m.sky_kind->probability},
                        {"aurora_probability", m.sky_kind->aurora}};
  if (m.main_border) json["main_border"] = border_numbers(m);
  if (m.main_curtain) json["main_curtain"] = curtain_numbers(*m.main_curtain);
  if (m.is_map_interrupted) json["interrupted"] = true;
  json["stages"] = nlohmann::ordered_json::array();
  for (const MeasureStage& s : m.stages)
    json["stages"].push_back({{"title", s.title},
                              {"trust", trust_name(s.trust)},
                              {"found", s.found},
                              {"lacking", s.lacking},
                              {"command", s.command},
                              {"exit_code", s.exit_code},
                              {"files", s.files},
                              {"numbers", s.numbers.empty() ? nlohmann::ordered_json(nullptr)
                                                            : nlohmann::ordered_json::parse(s.numbers)}});
  // A file's name may hold bytes that are no UTF-8.
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace vegard::fit
