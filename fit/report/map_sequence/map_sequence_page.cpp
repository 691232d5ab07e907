#include <cmath>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "fit/report/map_sequence/map_sequence_run.h"
#include "fit/report/plot/plot.h"
#include "fit/report/report_style.h"
#include "sim/base/file/number_text.h"
#include "sim/base/shown_text.h"

namespace vegard::fit {
namespace {

struct TrackQuantity {
  const char *title, *label;
  WithError TrackedCurtain::*value;
};

constexpr TrackQuantity kTrackQuantities[] = {
    {"distance of the nearest point", "distance (km)", &TrackedCurtain::distance_km},
    {"energy", "E0 (keV)", &TrackedCurtain::energy_kev},
    {"energy flux", "Q (mW m⁻²)", &TrackedCurtain::flux_mw_m2},
    {"velocity across", "km/s", &TrackedCurtain::across_km_s},
    {"velocity along", "km/s", &TrackedCurtain::along_km_s},
    {"lower border of the green light", "altitude (km)", &TrackedCurtain::lower_border_km}};

std::string plots_of_tracks(const std::vector<CurtainTrack>& tracks, const std::vector<double>& time_s) {
  Plot plot;
  plot.columns = 2;
  plot.panel_width_px = 460;
  plot.panel_height_px = 210;
  for (const TrackQuantity& quantity : kTrackQuantities) {
    Panel panel;
    panel.title = quantity.title;
    panel.x.label = "time (s)";
    panel.y.label = quantity.label;
    for (const CurtainTrack& track : tracks) {
      Series line;
      line.label = fmt::format("track {}", track.number);
      line.colour = distinct_colour(track.number - 1);
      for (const TrackedCurtain& t : track.frames) {
        const WithError v = t.*quantity.value;
        line.x.push_back(time_s[t.frame]);
        line.y.push_back(v.value);
        line.low.push_back(v.value - v.error);
        line.high.push_back(v.value + v.error);
      }
      for (std::size_t i = 0; i < line.low.size(); ++i)
        if (!std::isfinite(line.low[i])) line.low[i] = line.high[i] = line.y[i];
      panel.series.push_back(std::move(line));
    }
    plot.panels.push_back(std::move(panel));
  }
  return plot_svg(plot);
}

std::string table_of_tracks(const std::vector<CurtainTrack>& tracks, const std::vector<double>& time_s) {
  std::string html =
      "<table>\n<tr><th>track</th><th>time (s)</th><th>frames</th><th>length (km)</th><th>distance "
      "(km)</th><th>E0 (keV)</th><th>Q (mW m⁻²)</th><th>across (km/s)</th><th>along (km/s)</th><th>begins, "
      "ends</th></tr>\n";
  const auto both = [](const TrackedCurtain& a, const TrackedCurtain& b, WithError TrackedCurtain::*of) {
    const auto words = [](const WithError& v) {
      return std::isfinite(v.value)
                 ? sim::number_with_error(v.value,
                                          std::isfinite(v.error) ? std::optional(v.error) : std::nullopt)
                 : "—";
    };
    return words(a.*of) + " … " + words(b.*of);
  };
  for (const CurtainTrack& track : tracks) {
    const TrackedCurtain &first = track.frames.front(), &last = track.frames.back();
    const std::string begin = track.split_from != 0 ? fmt::format("splits from {}", track.split_from)
                              : track.seen_first    ? "there at the beginning"
                                                    : "appears";
    const std::string end = track.merged_into != 0 ? fmt::format("merges into {}", track.merged_into)
                            : track.seen_last      ? "there at the end"
                                                   : "fades";
    html += fmt::format("<tr><td>{}</td><td>{} … {}</td><td>{}</td><td>{} … {}</td>", track.number,
                        sim::short_number(time_s[first.frame], 5), sim::short_number(time_s[last.frame], 5),
                        track.frames.size(), sim::short_number(first.length_km, 3),
                        sim::short_number(last.length_km, 3));
    for (const auto of :
         {&TrackedCurtain::distance_km, &TrackedCurtain::energy_kev, &TrackedCurtain::flux_mw_m2,
          &TrackedCurtain::across_km_s, &TrackedCurtain::along_km_s})
      html += "<td>" + both(first, last, of) + "</td>";
    html += "<td>" + begin + ", " + end + "</td></tr>\n";
  }
  return html + "</table>\n";
}

}  // namespace

std::string MapSequenceRun::page(const MapSequenceRunFacts& facts, bool has_film) const {
  const std::vector<CurtainTrack> found = tracks();
  std::size_t good = 0;
  std::map<std::string, std::size_t> doubts;
  for (const MappedFrame& f : frames_) {
    good += f.is_good ? 1 : 0;
    if (!f.is_good) ++doubts[f.verdict_line];
  }
  std::string html = headed_page("Maps of precipitation over time");
  html += fmt::format(
      "<div class=\"verdict {}\"><div><div class=\"word\">{}</div><div class=\"line\">{} frames, {} "
      "curtain{} "
      "followed; every quantity is good in {} of the frames</div></div></div>\n<main>\n",
      doubts.empty() ? "good" : "doubtful", doubts.empty() ? "Good" : "With care", frames_.size(),
      found.size(), found.size() == 1 ? "" : "s", good);
  html += "<section><h2>The frames</h2>\n";
  if (has_film)
    html += "<video controls loop preload=\"auto\" src=\"sequence.mp4\" style=\"max-width:100%\"></video>\n";
  html += "<div class=\"plots\">" + last_picture_svg_ +
          "</div>\n<p>Above, the last frame: the photograph, the map's light with the sky, and the energy "
          "flux on "
          "the ground, up to the brightest of the first frame.</p>\n";
  for (const auto& [doubt, count] : doubts)
    html += fmt::format("<p>In {} frame{}: {}.</p>\n", count, count == 1 ? "" : "s", sim::html_text(doubt));
  for (const FrameWithoutMap& f : facts.sequence.without_map)
    html += "<p>" + sim::html_text(names_[f.number]) + " has no map: " + sim::html_text(f.reason) + ".</p>\n";
  for (const std::string& said : facts.camera ? facts.camera->words() : std::vector<std::string>())
    html += "<p>" + sim::html_text(said) + "</p>\n";
  html += "</section>\n";
  if (!found.empty())
    html += "<section><h2>Curtains</h2>\n" + table_of_tracks(found, time_s_) +
            "<p>Across: to the left of the course from the curtain's western end to its eastern one. Along: "
            "eastwards. Bands are one standard error.</p>\n<div class=\"plots\">" +
            plots_of_tracks(found, time_s_) + "</div></section>\n";
  Plot plot;
  plot.columns = 2;
  plot.panel_width_px = 460;
  plot.panel_height_px = 180;
  const auto add = [&](const char* title, const char* label, const auto& value) {
    Panel panel;
    panel.title = title;
    panel.x.label = "time (s)";
    panel.y.label = label;
    Series line;
    line.colour = distinct_colour(0);
    for (const MappedFrame& f : frames_) {
      const WithError v = value(f);
      line.x.push_back(f.time_s);
      line.y.push_back(v.value);
      const double error = std::isfinite(v.error) ? v.error : 0.0;
      line.low.push_back(v.value - error);
      line.high.push_back(v.value + error);
    }
    panel.series.push_back(std::move(line));
    plot.panels.push_back(std::move(panel));
  };
  add("power of all that is in view", is_absolute_ ? "MW" : "MW, up to a factor",
      [](const MappedFrame& f) { return f.power_mw; });
  add("mean energy", "E0 (keV)", [](const MappedFrame& f) { return f.energy_kev; });
  add("how well the maps explain the pictures", "χ² per value", [](const MappedFrame& f) {
    return WithError{f.chi2_per_value, 0.0};
  });
  html +=
      "<section><h2>Everything in view</h2>\n<div class=\"plots\">" + plot_svg(plot) + "</div></section>\n";
  html += "<section><h2>How it was made</h2>\n<p>";
  if (facts.sequence.bond.bond > 0.0)
    html += fmt::format(
        "A map's own picture has a weight of {} in it; the rest is of the frames before, and what those "
        "after "
        "know better was carried back. χ² is that of the pass forward.",
        sim::short_number(facts.sequence.bond.gain, 2));
  else
    html +=
        "Each frame is mapped by itself: holding maps near those before them did not predict the pictures "
        "better.";
  html += "</p>\n<p><code>" + sim::html_text(facts.command) +
          "</code></p>\n<p>precipitation.nc has the maps with their errors and velocities, tracks.csv the "
          "curtains, "
          "frames.csv the frames.</p>\n</section>\n</main>\n</body>\n</html>\n";
  return html;
}

}  // namespace vegard::fit
