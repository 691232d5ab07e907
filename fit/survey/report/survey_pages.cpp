#include "fit/survey/report/survey_pages.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include <fmt/format.h>

#include "fit/report/report_style.h"
#include "fit/report/table/shared_physics_files.h"
#include "sim/base/file/number_text.h"
#include "sim/base/number/constants.h"
#include "sim/base/shown_text.h"
#include "sim/base/text.h"
#include "sim/base/utc_time.h"
#include "sim/base/version.h"

namespace vegard::fit {
namespace {

constexpr const char* kSurveyStyle = R"css(
.said { background: #0b5c73; color: #fff; } .said > div { max-width: 1180px; margin: 0 auto; padding: 18px 28px; font-size: 18px; }
.said p { margin: 0 0 4px; max-width: 100ch; }
nav { margin-top: 8px; font-size: 14px; display: flex; gap: 22px; } nav a { color: #bfe3ee; }
a { color: var(--mark); }
.nights { width: 100%; } .nights td { padding-top: 5px; padding-bottom: 5px; vertical-align: middle; }
.nights svg { display: block; width: 384px; height: 40px; border-radius: 3px; }
.reasons td:first-child { max-width: 62ch; overflow-wrap: anywhere; }
.swatch { display: inline-block; width: 10px; height: 10px; margin-right: 6px; border-radius: 2px; }
.stack > svg { display: block; }
)css";

std::string page_head(const std::string& title, const std::string& above, const std::string& links,
                      const std::vector<std::string>& sentences) {
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en-GB\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"generator\" content=\"vegard survey report\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
      sim::html_text(title) + "</title>\n<style>" + kReportStyle + kSurveyStyle +
      "</style>\n</head>\n<body>\n<header><div class=\"head\">\n<p>" + sim::html_text(above) + "</p>\n<h1>" +
      sim::html_text(title) + "</h1>\n" + (links.empty() ? "" : "<nav>" + links + "</nav>\n") +
      "</div></header>\n<div class=\"said\"><div>\n";
  for (const std::string& sentence : sentences) html += "<p>" + sim::html_text(sentence) + "</p>\n";
  return html + "</div></div>\n<main>\n";
}

std::string page_end(const SurveyFacts& facts) {
  std::string html = "<footer><p>vegard " + sim::html_text(sim::version()) + ". Worked out by:</p>\n<ul>\n";
  for (const std::string& origin : facts.origins) html += "<li>" + sim::html_text(origin) + "</li>\n";
  return html + "</ul></footer>\n</main>\n</body>\n</html>\n";
}

std::string page_section(const std::string& title, const std::string& introduction,
                         const std::string& content) {
  return "<section>\n<h2>" + sim::html_text(title) + "</h2>\n" +
         (introduction.empty() ? "" : "<p>" + sim::html_text(introduction) + "</p>\n") + content +
         "</section>\n";
}

std::string count_words(int count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string clock_of(double time_s) { return sim::utc_text(time_s).substr(11, 5); }

int counted(const VerdictCounts& counts, SurveyWork work, const std::string& verdict) {
  const auto found = counts.find(work);
  if (found == counts.end()) return 0;
  const auto count = found->second.find(verdict);
  return count == found->second.end() ? 0 : count->second;
}

int counted_all(const VerdictCounts& counts, SurveyWork work) {
  int sum = 0;
  if (const auto found = counts.find(work); found != counts.end())
    for (const auto& [verdict, count] : found->second) sum += count;
  return sum;
}

/// Returns what the works found, in half a sentence each: "a lower border was measured in 912 of 1000".
std::string found_words(const VerdictCounts& verdicts) {
  std::vector<std::string> words;
  for (const auto& [work, counts] : verdicts) {
    const int all = counted_all(verdicts, work), good = counted(verdicts, work, "good");
    if (work == SurveyWork::border)
      words.push_back(fmt::format("a lower border was measured in {} of {}", good, all));
    else if (work == SurveyWork::fit)
      words.push_back(fmt::format("a fit is good in {} of {}, and doubtful in {}", good, all,
                                  counted(verdicts, work, "doubtful")));
    else {
      std::string list;
      for (const auto& [verdict, count] : counts)
        list += fmt::format("{}{} {}", list.empty() ? "" : ", ", count, verdict);
      words.push_back(fmt::format("{} says {}", survey_work_name(work), list));
    }
  }
  return sim::joined(words, "; ");
}

std::string verdict_cell(const std::string& verdict) {
  const Colour ink = verdict_ink(verdict);
  return fmt::format("<span class=\"swatch\" style=\"background:#{:02x}{:02x}{:02x}\"></span>", ink.r, ink.g,
                     ink.b) +
         sim::html_text(verdict);
}

/// Returns the table of verdicts, with a row for each camera, work and verdict.
std::string camera_verdicts(const std::map<std::string, VerdictCounts>& cameras,
                            const std::map<std::string, std::map<FrameStatus, int>>& statuses) {
  std::string html =
      "<table><thead><tr><th>Camera</th><th>Of</th><th>Verdict</th><th class=\"number\">Frames</th>"
      "<th class=\"number\">Share</th></tr></thead>\n<tbody>\n";
  const auto row = [&](const std::string& camera, const std::string& subject, const std::string& verdict,
                       int count, int all) {
    html += "<tr><td>" + sim::html_text(camera) + "</td><td>" + sim::html_text(subject) + "</td><td>" +
            verdict + "</td><td class=\"number\">" + std::to_string(count) + "</td><td class=\"number\">" +
            fmt::format("{:.1f}\u00a0%", 100.0 * count / std::max(1, all)) + "</td></tr>\n";
  };
  for (const auto& [camera, counts] : statuses) {
    int all = 0;
    for (const auto& [status, count] : counts) all += count;
    for (const auto& [status, count] : counts) row(camera, "frames", frame_status_name(status), count, all);
    const auto verdicts = cameras.find(camera);
    if (verdicts == cameras.end()) continue;
    for (const auto& [work, counts_of_work] : verdicts->second)
      for (const auto& [verdict, count] : counts_of_work)
        row(camera, survey_work_name(work), verdict_cell(verdict), count,
            counted_all(verdicts->second, work));
  }
  return html + "</tbody></table>\n";
}

std::string failure_table(const Failures& failures, const FrameLink& link) {
  if (failures.empty()) return "<p>There are none.</p>\n";
  std::vector<std::pair<std::string, const FailedFrames*>> sorted;
  for (const auto& [reason, failed] : failures) sorted.emplace_back(reason, &failed);
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.second->frames > b.second->frames; });
  std::string html =
      "<table class=\"wide reasons\"><thead><tr><th>Reason</th><th class=\"number\">Frames</th>"
      "<th>The first of them</th></tr></thead>\n<tbody>\n";
  for (const auto& [reason, failed] : sorted) {
    html += "<tr><td>" + sim::html_text(reason) + "</td><td class=\"number\">" +
            std::to_string(failed->frames) + "</td><td>";
    for (std::size_t i = 0; i < failed->some.size(); ++i) {
      const NamedFrame& frame = failed->some[i];
      const std::string name = sim::html_text(frame.file), target = link ? link(frame) : "";
      html += (i == 0 ? "" : "<br>") +
              (target.empty() ? "<code>" + name + "</code>"
                              : "<a href=\"" + sim::html_text(target) + "\"><code>" + name + "</code></a>") +
              " <span class=\"soft\">" + sim::html_text(frame.time_utc) + "</span>";
    }
    html += "</td></tr>\n";
  }
  return html + "</tbody></table>\n";
}

std::string shown_plot(const Plot& plot) { return plot.panels.empty() ? "" : plot_svg(plot); }

/// Returns median and percentiles of a quantity: "4.3 keV (16 to 84 % of frames: 3.1 to 6.0)".
std::string spread_words(const std::vector<FollowedPoint>& points, const std::string& unit) {
  std::vector<double> values;
  for (const FollowedPoint& point : points) values.push_back(point.value);
  if (values.empty()) return {};
  const auto number = [&](double share) { return sim::short_number(share_of_numbers(values, share), 3); };
  return number(0.5) + "\u00a0" + unit + " (16 to 84\u00a0% of frames: " + number(0.16) + " to " +
         number(0.84) + ")";
}

/// Returns the sentence about a camera's numbers, which tells their middle half.
std::string numbers_sentence(const NightDigest& digest) {
  std::string text;
  const auto add = [&](FollowedKind kind, const std::string& noun, const std::string& unit) {
    const std::vector<FollowedPoint> points = points_of(digest, kind);
    if (points.empty()) return;
    text += (text.empty() ? "" : "; ") + noun + " " + spread_words(points, unit);
  };
  add(FollowedKind::energy, "mean electron energy", "keV");
  add(FollowedKind::distance, "distance", "km");
  add(FollowedKind::altitude, "lower border's altitude", "km");
  return text;
}

/// Returns the sentence that tells how many numbers jump.
std::string jump_words(const NightDigest& digest) {
  if (!digest.is_smoothed) return "For velocities and jumps: vegard survey smooth.";
  int outliers = 0;
  for (const JumpedNumber& one : digest.jumps) outliers += one.kind == "outlier" ? 1 : 0;
  const int breaks = static_cast<int>(digest.jumps.size()) - outliers;
  if (outliers + breaks == 0) return "No value is an outlier.";
  return fmt::format("Outliers: {} values left out of their tracks, {} breaks at which a track begins again.",
                     outliers, breaks);
}

std::string camera_words(const ShownCamera& shown) {
  std::string text = numbers_sentence(shown.digest);
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text + (text.empty() ? "" : ". ") + shown.keogram_note + " " + jump_words(shown.digest);
}

std::string bars_of(const std::map<int, VerdictCounts>& hours, const VerdictCounts& verdicts,
                    int first_hour) {
  std::string html;
  for (const auto& [work, counts] : verdicts) html += verdict_bars(hours, work, first_hour);
  return html;
}

void add_hours(const std::map<int, VerdictCounts>& more, std::map<int, VerdictCounts>& hours) {
  for (const auto& [hour, counts] : more) add_verdicts(counts, hours[hour]);
}

std::string flux_words(bool is_measured, const std::string& why_none) {
  if (is_measured)
    return "A dot, or a count, for each frame that has both, with a verdict of good or doubtful.";
  return "No frame has an energy flux" + (why_none.empty() ? "." : ": " + why_none + ".");
}

/// Returns what the night's fits say together of the emission tables; empty if they say nothing.
std::string physics_section(const ShownNight& night) {
  if (!night.physics) return {};
  std::string html;
  for (const std::string& sentence : asked_of_tables(*night.physics))
    html += "<li>" + sim::html_text(sentence) + "</li>\n";
  if (!html.empty()) html = "<ul>\n" + html + "</ul>\n";
  std::string rows;
  for (const SharedMean& mean : night.physics->means)
    rows += "<tr><td>" + sim::html_text(mean.name) + "</td><td class=\"number\">" +
            sim::number_with_error(mean.value, mean.sigma()) + "\u00a0" + sim::html_text(mean.unit) +
            "</td><td class=\"number\">" + sim::short_number(mean.sigma_own, 2) +
            "</td><td class=\"number\">" + sim::short_number(mean.sigma_common, 2) +
            "</td><td class=\"number\">" + sim::short_number(mean.scatter, 2) + "</td><td class=\"number\">" +
            std::to_string(mean.frames) + "</td></tr>\n";
  if (!rows.empty())
    html +=
        "<table><thead><tr><th>Mean of the night</th><th class=\"number\">Value \u00b1 \u03c3</th>"
        "<th class=\"number\">Own</th><th class=\"number\">In common</th><th class=\"number\">Scatter</th>"
        "<th class=\"number\">Frames</th></tr></thead>\n<tbody>\n" +
        rows + "</tbody></table>\n";
  html +=
      "<p class=\"soft\">The part of an error that is in common to all frames does not become smaller in "
      "a mean. Each frame's answers with what the others say: <a href=\"" +
      night.physics_file + "\">" + night.physics_file + "</a>.</p>\n";
  return page_section("What the night asks of the emission tables", shared_physics_words(*night.physics),
                      html);
}

}  // namespace

std::string night_file_name(const std::string& night) { return "night-" + night + ".html"; }

std::string night_page(const SurveyFacts& facts, const ShownNight& night, const FrameLink& link) {
  int frames = 0;
  double first_s = 0.0, last_s = 0.0;
  VerdictCounts verdicts;
  std::map<int, VerdictCounts> hours;
  std::map<std::string, VerdictCounts> of_camera;
  std::map<std::string, std::map<FrameStatus, int>> statuses;
  Failures failures;
  std::vector<EnergyAndFlux> energies;
  LatitudeCells latitudes;
  std::string why_no_flux, numbers;
  std::size_t max_points = 0;
  for (const ShownCamera& shown : night.cameras) {
    const NightDigest& d = shown.digest;
    first_s = frames == 0 ? d.first_s : std::min(first_s, d.first_s);
    last_s = frames == 0 ? d.last_s : std::max(last_s, d.last_s);
    frames += d.frames;
    add_verdicts(d.verdicts, verdicts);
    add_hours(d.verdicts_of_hour, hours);
    add_failures(d.failures, failures);
    energies.insert(energies.end(), d.energies.begin(), d.energies.end());
    for (const LatitudeAtTime& place : d.latitudes) latitudes.add(place);
    of_camera[d.camera] = d.verdicts;
    statuses[d.camera] = d.statuses;
    if (why_no_flux.empty()) why_no_flux = d.why_no_flux;
    // Of several cameras the one with most answers; each has its own beside its plots.
    const std::size_t points =
        points_of(d, FollowedKind::energy).size() + points_of(d, FollowedKind::border).size();
    if (points > max_points) {
      max_points = points;
      numbers = (night.cameras.size() > 1 ? "Seen by " + d.camera + ": " : "") + numbers_sentence(d);
    }
  }
  std::string links = "<a href=\"index.html\">the whole survey</a>";
  if (!night.before.empty())
    links = "<a href=\"" + night_file_name(night.before) + "\">\u2190 " + night.before + "</a>" + links;
  if (!night.after.empty())
    links += "<a href=\"" + night_file_name(night.after) + "\">" + night.after + " \u2192</a>";
  const std::string found = found_words(verdicts);
  std::string html = page_head(
      "The night of " + night.name, "vegard survey " + facts.name, links,
      {count_words(frames, "frame") + " of " + count_words(static_cast<int>(night.cameras.size()), "camera") +
           ", " + clock_of(first_s) + " to " + clock_of(last_s) + " UTC" +
           (found.empty() ? "" : ": " + found) + ".",
       numbers.empty() ? "No value is measured." : numbers + "."});
  const ShownSpan span{first_s, std::max(last_s, first_s + 1.0)};
  for (const ShownCamera& shown : night.cameras) {
    const Plot curves = night_curves(shown.digest, span);
    html += page_section(
        shown.digest.camera, camera_words(shown),
        "<div class=\"stack\">" + shown.keogram + shown_plot(curves) + "</div>\n" +
            (curves.panels.empty()
                 ? ""
                 : "<p class=\"soft\">Bars are standard deviations. Where there are more than 400 frames, of "
                   "each of 400 equal stretches of time the frame with the median value is shown. Axes leave "
                   "out what lies far beyond the middle 98\u00a0% of values.</p>\n"));
  }
  html += page_section("Verdicts", "",
                       "<div class=\"plots\">" + bars_of(hours, verdicts, facts.first_hour) + "</div>\n" +
                           camera_verdicts(of_camera, statuses));
  html += page_section("Energy against energy flux", flux_words(!energies.empty(), why_no_flux),
                       "<div class=\"plots\">" + shown_plot(energy_plot(energies)) +
                           shown_plot(latitudes.plot(facts.first_hour)) + "</div>\n");
  html += physics_section(night);
  html += page_section("What could not be measured", "Frames and works by their reason.",
                       failure_table(failures, link));
  return html + page_end(facts);
}

void SurveySum::add(const NightDigest& digest) {
  first_s = frames == 0 ? digest.first_s : std::min(first_s, digest.first_s);
  last_s = frames == 0 ? digest.last_s : std::max(last_s, digest.last_s);
  frames += digest.frames;
  for (const auto& [status, count] : digest.statuses) {
    statuses_of_camera[digest.camera][status] += count;
    if (status == FrameStatus::done) done += count;
    if (status == FrameStatus::filtered) filtered += count;
  }
  add_verdicts(digest.verdicts, verdicts);
  add_verdicts(digest.verdicts, verdicts_of_camera[digest.camera]);
  add_hours(digest.verdicts_of_hour, verdicts_of_hour);
  for (const EnergyAndFlux& pair : digest.energies) energies.add(pair);
  for (const LatitudeAtTime& place : digest.latitudes) latitudes.add(place);
  if (why_no_flux.empty()) why_no_flux = digest.why_no_flux;
  add_failures(digest.failures, failures);
}

std::string survey_page(const SurveyFacts& facts, const SurveySum& sum, const FrameLink& link) {
  const int cameras = static_cast<int>(sum.statuses_of_camera.size());
  const std::string found = found_words(sum.verdicts);
  std::vector<double> energies;
  for (const ListedNight& night : sum.nights)
    if (std::isfinite(night.energy_kev)) energies.push_back(night.energy_kev);
  std::vector<std::string> sentences = {
      count_words(sum.frames, "frame") + " of " + count_words(cameras, "camera") + " in " +
      count_words(static_cast<int>(sum.nights.size()), "night") + ", " +
      sim::utc_text(sum.first_s).substr(0, 10) + " to " + sim::utc_text(sum.last_s).substr(0, 10) +
      (found.empty() ? "" : ": " + found) + "."};
  std::string second;
  if (!energies.empty())
    second = "The mean electron energy of a night, in the middle of its frames, goes from " +
             sim::short_number(*std::min_element(energies.begin(), energies.end()), 3) + " to " +
             sim::short_number(*std::max_element(energies.begin(), energies.end()), 3) + "\u00a0keV";
  if (sum.filtered > 0)
    second += (second.empty() ? "" : "; ") + std::to_string(sum.filtered) + " frames have no arc";
  if (sum.frames > sum.done + sum.filtered)
    second += (second.empty() ? "" : "; ") + std::to_string(sum.frames - sum.done - sum.filtered) +
              " frames were skipped, missing or unreadable";
  if (facts.lacking > 0)
    second += (second.empty() ? "" : "; ") + count_words(facts.lacking, "frame") + " of the plan " +
              (facts.lacking == 1 ? "is" : "are") + " not there yet";
  sentences.push_back(second.empty() ? "All frames were measured." : second + ".");
  std::string html = page_head(facts.name, "vegard survey", "", sentences);
  html += page_section(
      "When", "",
      "<div class=\"plots\">" + bars_of(sum.verdicts_of_hour, sum.verdicts, facts.first_hour) +
          shown_plot(sum.energies.plot()) + shown_plot(sum.latitudes.plot(facts.first_hour)) + "</div>\n" +
          (sum.energies.frames() > 0
               ? ""
               : "<p class=\"soft\">" + sim::html_text(flux_words(false, sum.why_no_flux)) + "</p>\n"));
  std::string list = "<table class=\"nights\"><thead><tr><th>Night</th><th>" +
                     sim::html_text("frames with an answer (green), energy (orange), over the night") +
                     "</th><th class=\"number\">Frames</th>";
  for (const auto& [work, counts] : sum.verdicts)
    list += std::string("<th class=\"number\">") + survey_work_name(work) + "</th>";
  list +=
      "<th class=\"number\">Energy<br>(keV)</th><th class=\"number\">Distance<br>(km)</th></tr></thead>\n"
      "<tbody>\n";
  for (const ListedNight& night : sum.nights) {
    list += "<tr><td><a href=\"" + night.file + "\">" + night.name + "</a></td><td><a href=\"" + night.file +
            "\">" + night.strip + "</a></td><td class=\"number\">" + std::to_string(night.frames) + "</td>";
    for (const auto& [work, counts] : sum.verdicts) {
      const int all = counted_all(night.verdicts, work);
      const int good = counted(night.verdicts, work, "good") + counted(night.verdicts, work, "arc");
      list += "<td class=\"number\">" +
              (all == 0 ? "\u2013" : fmt::format("{:.0f}\u00a0%", 100.0 * good / all)) + "</td>";
    }
    list += "<td class=\"number\">" + sim::html_text(sim::short_number(night.energy_kev, 3)) +
            "</td><td class=\"number\">" + sim::html_text(sim::short_number(night.distance_km, 3)) +
            "</td></tr>\n";
  }
  html += page_section("The nights",
                       "All on one scale of time and of energy; shares are of frames with a verdict of good; "
                       "energies and distances are medians.",
                       list + "</tbody></table>\n");
  html +=
      page_section("Verdicts by camera", "", camera_verdicts(sum.verdicts_of_camera, sum.statuses_of_camera));
  html += page_section("What could not be measured", "Frames and works by their reason.",
                       failure_table(sum.failures, link));
  return html + page_end(facts);
}

}  // namespace vegard::fit
