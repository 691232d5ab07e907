#include "fit/report/border/border_run.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include <fmt/format.h>

#include "fit/border/border_distance.h"
#include "sim/base/error.h"
#include "sim/base/file/csv_table.h"
#include "sim/base/file/input_file.h"
#include "sim/base/file/whole_directory.h"
#include "sim/base/file/whole_file.h"
#include "sim/base/number/constants.h"
#include "sim/base/version.h"
#include "sim/scene/structs/line_of.h"

namespace vegard::fit {
namespace {

constexpr const char* kBorderJson = "border.json";
constexpr std::size_t kMaxBorderBytes = 64u << 20;

sim::KnownFolder look_at_border(const std::string& directory) {
  const std::set<std::string> names = {kBorderJson, "border.csv", "border.svg", "report.html"};
  sim::KnownFolder known;
  const sim::InputFile file = sim::read_input(directory + "/" + kBorderJson, kMaxBorderBytes);
  const nlohmann::json json = nlohmann::json::parse(file.bytes, nullptr, false);
  if (!file.problem.empty())
    known.objection = "its border.json " + file.problem;
  else if (!json.is_object() || !json.contains("kind") || json["kind"] != "vegard border")
    known.objection = "its border.json is none that vegard wrote";
  known.has = [names](const std::string& name) { return names.count(name) != 0; };
  return known;
}

sim::DirectoryKind border_kind() { return {"traced borders", look_at_border, {kBorderJson}}; }

bool is_border_place_known(const sim::Scene& scene) {
  return sim::is_latitude_given(scene) && sim::is_longitude_given(scene);
}

/// Six digits after the point: 0.1 m on the ground, and less than the error of any border.
std::string border_cell(double value) { return std::isfinite(value) ? fmt::format(",{:.6g}", value) : ","; }

}  // namespace

std::string border_csv(const Border& border, const sim::Scene& scene) {
  std::string csv =
      "trace,azimuth_deg,elevation_deg,elevation_error_deg,peak_elevation_deg,brightness,signal,fall_deg,"
      "limited_by";
  for (const double h : kBorderAltitudesKm)
    csv += fmt::format(
        ",distance_{0:.0f}km_km,distance_error_{0:.0f}km_km,latitude_{0:.0f}km_deg,longitude_{0:.0f}km_deg",
        h);
  csv += ",aurora_probability,doubt\n";
  const bool is_known = is_border_place_known(scene);
  for (std::size_t t = 0; t < border.traces.size(); ++t)
    for (const BorderPoint& p : border.traces[t].points) {
      csv += std::to_string(t + 1);
      for (const double value : {p.azimuth_deg, p.elevation_deg, p.elevation_error_deg, p.peak_elevation_deg,
                                 p.brightness, p.signal, p.fall_deg})
        csv += border_cell(value);
      csv += "," + sim::csv_cell(border_limit_name(p.limit));
      for (const double h : kBorderAltitudesKm) {
        const BorderPlace place =
            border_place(scene.site, p.azimuth_deg, p.elevation_deg, p.elevation_error_deg, h);
        csv += border_cell(place.distance_km) + border_cell(place.distance_error_km) +
               border_cell(is_known ? place.latitude_deg : sim::kNaN) +
               border_cell(is_known ? place.longitude_deg : sim::kNaN);
      }
      csv += border_cell(border.traces[t].aurora_probability) + "," + sim::csv_cell(border.traces[t].doubt);
      csv += "\n";
    }
  return csv;
}

std::string border_json(const Border& border, const sim::Scene& scene, const BorderRunFacts& facts) {
  nlohmann::ordered_json json;
  json["kind"] = "vegard border";
  json["version"] = sim::version();
  json["command"] = facts.command;
  json["decoding"] = facts.decoding;
  json["site"] = {{"latitude_deg", scene.site.latitude_deg},
                  {"longitude_deg", scene.site.longitude_deg},
                  {"altitude_m", scene.site.altitude_m},
                  {"given", is_border_place_known(scene)}};
  json["measured"] = border.measured;
  json["altitudes_km"] = kBorderAltitudesKm;
  json["traces"] = nlohmann::ordered_json::array();
  for (const BorderTrace& trace : border.traces) {
    const BorderSummary s = border_summary(trace, scene);
    nlohmann::ordered_json of_altitude = nlohmann::ordered_json::array(), errors = of_altitude;
    for (std::size_t h = 0; h < kBorderAltitudesKm.size(); ++h) {
      of_altitude.push_back(s.distance_km[h]);
      errors.push_back(s.distance_error_km[h]);
    }
    json["traces"].push_back({{"points", trace.points.size()},
                              {"measured", trace.measured},
                              {"claimed", trace.is_claimed()},
                              {"aurora_probability", trace.aurora_probability},
                              {"doubt", trace.doubt},
                              {"from_azimuth_deg", s.from_azimuth_deg},
                              {"to_azimuth_deg", s.to_azimuth_deg},
                              {"lowest_elevation_deg", s.lowest_deg},
                              {"highest_elevation_deg", s.highest_deg},
                              {"nearest_azimuth_deg", s.nearest_azimuth_deg},
                              {"nearest_distance_km", of_altitude},
                              {"nearest_distance_error_km", errors},
                              {"brightness", trace.mean_brightness()}});
  }
  json["notes"] = border.notes;
  json["inputs"] = nlohmann::ordered_json::array();
  for (const InputFile& input : facts.inputs)
    json["inputs"].push_back({{"role", input.role}, {"name", input.name}, {"sha256", input.sha256}});
  return json.dump(2) + "\n";
}

void check_border_directory(const std::string& directory, bool overwrite) {
  sim::WholeDirectory(directory, overwrite, border_kind());
}

void write_border_run(const std::string& directory, bool overwrite, const Border& border, const Photo& photo,
                      const sim::Scene& scene, const BorderRunFacts& facts) {
  sim::WholeDirectory run(directory, overwrite, border_kind());
  run.fill([&] {
    sim::write_whole(run.file(kBorderJson), border_json(border, scene, facts));
    sim::write_whole(run.file("border.csv"), border_csv(border, scene));
    sim::write_whole(run.file("border.svg"), border_svg(border, photo, scene) + "\n");
    sim::write_whole(run.file("report.html"), border_page(border, photo, scene, facts));
  });
}

}  // namespace vegard::fit
