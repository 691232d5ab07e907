#include "sim/scene/rows/parameter_rules.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "sim/base/text.h"
#include "sim/base/utc_time.h"
#include "sim/scene/lines/emission_lines.h"
#include "sim/scene/rows/complaint.h"
#include "sim/scene/rows/value_words.h"
#include "sim/scene/structs/line_of.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {
namespace {

constexpr std::size_t max_lines = 8;

std::string lines_text(const std::vector<double>& lines_nm) {
  std::string text;
  for (const double line : lines_nm) text += (text.empty() ? "" : ", ") + real_text(line);
  return text;
}

bool is_calendar_day(int year, int month, int day) {
  static const int days[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  const bool is_leap = (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
  return month >= 1 && month <= 12 && day >= 1 && day <= days[month - 1] + (month == 2 && is_leap ? 1 : 0);
}

/// Whether `text` looks like `form`, in which 0 stands for any digit.
/// "T05:00:00.25Z" becomes "T05:00:00Z".
std::string without_fraction(std::string text) {
  const std::size_t dot = text.find('.');
  if (dot == std::string::npos) return text;
  const std::size_t end = text.find_first_not_of("0123456789", dot + 1);
  return end == std::string::npos || end == dot + 1 ? text : text.erase(dot, end - dot);
}

bool is_iso_time(const std::string& given) {
  // A zone's offset stands where the Z does.
  std::string time = given;
  const std::size_t clock = given.find('T');
  const std::size_t offset = clock == std::string::npos ? clock : given.find_first_of("+-", clock);
  if (offset != std::string::npos && offset_minutes(given.substr(offset)))
    time = given.substr(0, offset) + "Z";
  const std::string text = without_fraction(time);
  const bool has_seconds = has_form(text, "0000-00-00T00:00:00Z");
  const bool has_time = has_seconds || (text == time && has_form(text, "0000-00-00T00:00Z"));
  if (!has_time && !(text == time && has_form(text, "0000-00-00"))) return false;
  const auto number = [&](std::size_t begin, std::size_t digits) {
    return std::stoi(text.substr(begin, digits));
  };
  if (!is_calendar_day(number(0, 4), number(5, 2), number(8, 2))) return false;
  if (has_time && (number(11, 2) >= 24 || number(14, 2) >= 60)) return false;
  // A leap second is the 61st of its minute.
  return !has_seconds || number(17, 2) <= 60;
}

}  // namespace

std::optional<Complaint> inclination_complaint(double inclination_deg) {
  if (std::abs(inclination_deg) >= 20.0) return std::nullopt;
  return Complaint{"the field is nearly horizontal (" + short_real_text(inclination_deg) + " deg)",
                   "an inclination of at least 20 above or below the horizon",
                   "aurorae are where the field is steep: 75 to 85 under the northern auroral oval"};
}

std::optional<Complaint> none_or_some_complaint(double value) {
  if (value == 0.0 || value >= 1e-3) return std::nullopt;
  return Complaint{short_real_text(value) + " is neither 0 nor enough", "0, or at least 0.001", ""};
}

std::optional<Complaint> layer_complaint(double scale_height_km) {
  if (scale_height_km == 0.0 || scale_height_km >= kThinnestLayer_km) return std::nullopt;
  return Complaint{"a layer of " + short_real_text(scale_height_km) + " km is too thin",
                   "0, or at least " + short_real_text(kThinnestLayer_km), ""};
}

bool is_table_file(const std::string& value) { return value.size() > 4 && ends_with(value, ".csv"); }

std::optional<Complaint> time_complaint(const std::string& time_utc) {
  if (time_utc.empty() || is_iso_time(time_utc)) return std::nullopt;
  return Complaint{
      "'" + time_utc + "' is not a time",
      "ISO 8601 such as \"2019-09-01T05:00:00Z\" in UTC, or with a zone, \"2019-09-01T07:00:00+02:00\"", ""};
}

std::optional<Complaint> emission_tables_complaint(const std::string& name) {
  if (!name.empty()) return std::nullopt;
  return Complaint{"no tables are named", "\"glow\", \"vegard\" or the name of a folder", ""};
}

std::optional<Complaint> lines_complaint(const Scene& scene, const std::vector<double>& lines_nm) {
  std::vector<double> known = known_emission_lines_nm();
  for (const OwnLine& own : scene.own_lines) known.push_back(own.wavelength_nm);
  if (lines_nm.empty() || lines_nm.size() > max_lines) {
    return Complaint{std::to_string(lines_nm.size()) + " emission lines",
                     "1 to " + std::to_string(max_lines) + " of " + lines_text(known), ""};
  }
  for (std::size_t l = 0; l < lines_nm.size(); ++l) {
    const double line_nm = lines_nm[l];
    if (std::find(known.begin(), known.end(), line_nm) != known.end()) continue;
    const double nearest = *std::min_element(known.begin(), known.end(), [&](double a, double b) {
      return std::abs(a - line_nm) < std::abs(b - line_nm);
    });
    return Complaint{"no emission line at " + short_real_text(line_nm) + " nm",
                     "one of " + lines_text(known) + ", or one that [[line]] adds",
                     "the nearest known is " + real_text(nearest), static_cast<int>(l)};
  }
  std::vector<double> sorted = lines_nm;
  std::sort(sorted.begin(), sorted.end());
  const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
  if (twice == sorted.end()) return std::nullopt;
  return Complaint{"the line " + real_text(*twice) + " is listed twice", "each line once", ""};
}

std::optional<Complaint> blur_complaint(const Scene& scene, const std::vector<double>& width_deg) {
  const std::size_t lines = scene.emission.lines.size();
  if (width_deg.size() == lines) return std::nullopt;
  return Complaint{
      std::to_string(width_deg.size()) + " widths for " + std::to_string(lines) + " emission lines",
      "one width per line of emission.lines, in its order", ""};
}

double igrf_year(const Scene& scene) {
  const std::string& time = scene.site.time_utc;
  const auto no_field = [&](const std::string& problem) {
    return scene_error({problem, "site.time_utc from 1900 to 2029, such as \"2019-09-01T05:00:00Z\"",
                        "or field.model = \"dipole\""},
                       {scene.file, line_of(scene, "field.model"), "field.model"});
  };
  std::optional<double> seconds = utc_seconds(time);
  if (!seconds && has_form(time, "0000-00-00")) seconds = utc_seconds(time + "T00:00:00Z");  // it is slow
  const std::string of_field = "the reference field (\"igrf\") ";
  if (time.empty()) throw no_field(of_field + "changes with the years, and the scene has no time");
  if (!seconds) throw no_field(of_field + "is not known for " + time);
  const std::string text = utc_text(*seconds);
  const int year = std::stoi(text.substr(0, 4));
  const auto start = [](int start_year) {
    const std::string digits = std::to_string(start_year);
    return utc_seconds(std::string(4 - std::min<std::size_t>(4, digits.size()), '0') + digits +
                       "-01-01T00:00:00Z");
  };
  const std::optional<double> first = start(year), next = start(year + 1);
  if (year < static_cast<int>(kFirstIgrfYear) || year >= static_cast<int>(kLastIgrfYear) || !first || !next)
    throw no_field(of_field + "is not known for " + time);
  return year + (*seconds - *first) / (*next - *first);
}

}  // namespace vegard::sim
