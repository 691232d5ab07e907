#include "fit/report/map_sequence/map_sequence_run.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <system_error>

#include <fmt/format.h>

#include "fit/map/curtains/map_verdicts.h"
#include "fit/map/rasterised_map.h"
#include "fit/report/map_panels.h"
#include "sim/base/file/csv_table.h"
#include "sim/base/file/input_file.h"
#include "sim/base/file/number_text.h"
#include "sim/base/file/whole_directory.h"
#include "sim/base/file/whole_file.h"
#include "sim/base/number/constants.h"
#include "sim/base/utc_time.h"
#include "sim/base/version.h"

namespace vegard::fit {
namespace {

namespace fs = std::filesystem;

constexpr const char *kSequenceJson = "map_sequence.json", *kMovie = "sequence.mp4";
constexpr std::size_t kMostBytes = 256u << 20;
constexpr double kMegawattPerMw_km2 = 1e-3;  // 1 mW m^-2 on 1 km^2 is a kilowatt

sim::KnownFolder look_at_map_sequence(const std::string& directory) {
  sim::KnownFolder known;
  const sim::InputFile file = sim::read_input(directory + "/" + kSequenceJson, kMostBytes);
  const nlohmann::json json = nlohmann::json::parse(file.bytes, nullptr, false);
  if (!file.problem.empty())
    known.objection = std::string("its ") + kSequenceJson + " " + file.problem;
  else if (!json.is_object() || !json.contains("kind") || json["kind"] != "vegard map --sequence")
    known.objection = std::string("its ") + kSequenceJson + " is none that vegard wrote";
  known.has = [](const std::string& name) {
    static const std::set<std::string> names = {kSequenceJson, "precipitation.nc", "tracks.csv",
                                                "frames.csv",  "report.html",      kMovie};
    return names.count(name) != 0;
  };
  return known;
}

sim::DirectoryKind map_sequence_kind() {
  return {"a sequence of maps", look_at_map_sequence, {kSequenceJson}};
}

nlohmann::ordered_json finite(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
}

/// Power and mean ln E0 of what has its lower border in view.
std::pair<double, double> totals_in_view(const MapResult& map, const std::vector<CellFlux>& cells) {
  double power = 0.0, ln = 0.0;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (map.border_in_view[c] == 0 || cells[c].flux_mw_m2 <= 0.0f) continue;
    const double here = kMegawattPerMw_km2 * cells[c].flux_mw_m2 * map.grid.area_km2(static_cast<int>(c));
    power += here;
    ln += here * cells[c].ln_energy;
  }
  return {power, power > 0.0 ? ln / power : sim::kNaN};
}

void put_totals(const MapResult& map, MappedFrame& row) {
  const auto [power, ln] = totals_in_view(map, map.cells);
  double power_square = 0.0, ln_square = 0.0;
  for (const std::vector<CellFlux>& cells : map.replicates) {
    const auto [p, l] = totals_in_view(map, cells);
    power_square += (p - power) * (p - power);
    if (std::isfinite(l)) ln_square += (l - ln) * (l - ln);
  }
  const auto count = static_cast<double>(map.replicates.size());
  const double energy = std::exp(ln);
  row.power_mw = {power, count > 0.0 ? std::sqrt(power_square / count) : sim::kNaN};
  row.energy_kev = {energy,
                    count > 0.0 ? kEnergyInflation * energy * std::sqrt(ln_square / count) : sim::kNaN};
}

FramePlanes planes_of(const MapOfFrame& frame, const RasterisedMap& rasterised) {
  const RasterGrid& raster = rasterised.raster;
  FramePlanes planes;
  constexpr auto kNone = static_cast<float>(sim::kNaN);
  for (int row = 0; row < raster.rows; ++row)
    for (int column = 0; column < raster.columns; ++column) {
      const auto at = [&](int channel) {
        return rasterised.planes.at(column, raster.rows - 1 - row, channel);
      };
      planes.energy_flux_mw_m2.push_back(at(0));
      planes.energy_kev.push_back(at(1));
      planes.relative_flux_error.push_back(at(2));
      planes.ln_energy_error.push_back(at(3));
      const bool moves = frame.drift.moves() && std::isfinite(at(1));
      const sim::EastNorth place = raster.place(column, row);
      const Drift drift = frame.drift.at(place);
      const Eigen::Matrix2d covariance =
          moves ? frame.drift.covariance_at(place) : Eigen::Matrix2d::Constant(sim::kNaN);
      planes.east_km_s.push_back(moves ? static_cast<float>(drift.east_km_s) : kNone);
      planes.north_km_s.push_back(moves ? static_cast<float>(drift.north_km_s) : kNone);
      planes.east_error_km_s.push_back(static_cast<float>(std::sqrt(covariance(0, 0))));
      planes.north_error_km_s.push_back(static_cast<float>(std::sqrt(covariance(1, 1))));
    }
  return planes;
}

}  // namespace

void check_map_sequence_directory(const std::string& directory, bool overwrite) {
  sim::WholeDirectory(directory, overwrite, map_sequence_kind());
}

void MapSequenceRun::add(const MapOfFrame& frame) {
  const std::vector<Curtain> curtains = find_curtains(frame.map);
  const double seconds = frames_.empty() ? 0.0 : time_s_[frame.number] - frames_.back().time_s;
  tracker_.add(frame, curtains, seconds);
  MappedFrame row;
  row.number = frame.number;
  row.name = names_[frame.number];
  row.time_s = time_s_[frame.number];
  row.chi2_per_value = frame.map.chi2_per_value();
  row.curtains = curtains.size();
  const std::vector<QuantityVerdict> verdicts = map_verdicts(frame.map, curtains);
  row.is_good = std::all_of(verdicts.begin(), verdicts.end(),
                            [](const QuantityVerdict& v) { return v.trust == Trust::good; });
  row.verdict_line = verdict_line(verdicts);
  put_totals(frame.map, row);
  const RasterisedMap rasterised = rasterised_map(frame.map);
  const ShownMap shown(frame.map);
  if (frames_.empty()) {
    places_.columns = rasterised.raster.columns;
    places_.rows = rasterised.raster.rows;
    places_.west_km = rasterised.raster.west_km;
    places_.south_km = rasterised.raster.south_km;
    places_.step_km = rasterised.raster.step_km;
    places_.height_km = sim::kFootAltitudeKm;
    places_.site = frame.map.scene.site;
    is_absolute_ = is_absolute(frame.map);
    shown_flux_mw_m2_ = shown.white();
  }
  planes_.push_back(planes_of(frame, rasterised));
  frames_.push_back(std::move(row));
  const MappedPhoto& photo = frame.map.photos.front();
  const double white = white_of(photo);
  Plot plot;
  plot.title = fmt::format("{}   {} s", frames_.back().name, sim::short_number(frames_.back().time_s, 6));
  plot.panels = {photograph_panel(photo, white), model_panel(photo, white),
                 shown.flux_panel("energy flux on the ground", shown_flux_mw_m2_)};
  add_courses(curtains, "", plot.panels.back());  // a legend would change the size from frame to frame
  plot.columns = 3;
  plot.panel_width_px = 300;
  plot.panel_height_px =
      std::clamp(300 * photo.scene.camera.height / std::max(1, photo.scene.camera.width), 180, 300);
  last_picture_svg_ = plot_svg(plot);
  png_.push_back(plot_png(plot));
}

std::string MapSequenceRun::frames_csv() const {
  std::string csv =
      "frame,name,time_s,chi2_per_value,curtains,power_mw,power_error_mw,energy_kev,energy_error_kev,good,"
      "doubts\n";
  for (const MappedFrame& f : frames_) {
    csv += fmt::format("{},{},{},{},{}", f.number + 1, sim::csv_cell(f.name), sim::csv_number(f.time_s),
                       sim::csv_number(f.chi2_per_value), f.curtains);
    for (const double v : {f.power_mw.value, f.power_mw.error, f.energy_kev.value, f.energy_kev.error})
      csv += "," + sim::csv_number(v);
    csv += fmt::format(",{:d},{}\n", f.is_good, sim::csv_cell(f.verdict_line));
  }
  return csv;
}

std::string MapSequenceRun::tracks_csv() const {
  std::string csv =
      "track,frame,time_s,curtain,length_km,nearest_east_km,nearest_north_km,azimuth_deg,distance_km,"
      "distance_error_km,lower_border_km,lower_border_error_km,energy_kev,energy_error_kev,"
      "energy_flux_mw_m2,energy_flux_error_mw_m2,velocity_east_km_s,velocity_east_error_km_s,"
      "velocity_north_km_s,velocity_north_error_km_s,velocity_across_km_s,velocity_across_error_km_s,"
      "velocity_along_km_s,velocity_along_error_km_s\n";
  for (const CurtainTrack& track : tracks())
    for (const TrackedCurtain& t : track.frames) {
      csv += fmt::format("{},{},{},{}", track.number, t.frame + 1, sim::csv_number(time_s_[t.frame]),
                         t.curtain + 1);
      for (const double v : {t.length_km, t.nearest_km.east, t.nearest_km.north, t.azimuth_deg})
        csv += "," + sim::csv_number(v);
      for (const WithError& v : {t.distance_km, t.lower_border_km, t.energy_kev, t.flux_mw_m2, t.east_km_s,
                                 t.north_km_s, t.across_km_s, t.along_km_s})
        csv += "," + sim::csv_number(v.value) + "," + sim::csv_number(v.error);
      csv += "\n";
    }
  return csv;
}

std::string MapSequenceRun::json(const MapSequenceRunFacts& facts) const {
  nlohmann::ordered_json json;
  json["kind"] = "vegard map --sequence";
  json["version"] = sim::version();
  json["command"] = facts.command;
  json["flux_is_absolute"] = is_absolute_;
  json["time_bond"] = facts.sequence.bond.bond;
  json["bonds_tried"] = nlohmann::ordered_json::array();
  for (const TriedBond& t : facts.sequence.bond.tried)
    json["bonds_tried"].push_back({{"bond", t.bond}, {"prediction_chi2_per_value", t.chi2_per_value}});
  json["gain"] = facts.sequence.bond.gain;
  json["step_s"] = facts.sequence.bond.step_s;
  json["frames"] = nlohmann::ordered_json::array();
  for (const MappedFrame& f : frames_)
    json["frames"].push_back({{"frame", f.number + 1},
                              {"name", f.name},
                              {"time_s", f.time_s},
                              {"chi2_per_value", f.chi2_per_value},
                              {"curtains", f.curtains},
                              {"good", f.is_good},
                              {"doubts", f.verdict_line},
                              {"power_mw", finite(f.power_mw.value)},
                              {"energy_kev", finite(f.energy_kev.value)}});
  json["without_map"] = nlohmann::ordered_json::array();
  for (const FrameWithoutMap& f : facts.sequence.without_map)
    json["without_map"].push_back({{"name", names_[f.number]}, {"reason", f.reason}});
  if (facts.camera) {
    json["frames_by_stars_of_a_still_camera"] = facts.camera->told() > 0 ? facts.camera->told() + 1 : 0;
    if (facts.camera->drift()) json["camera_drift_deg"] = facts.camera->drift()->angle_deg;
    json["other_star_brightness"] = nlohmann::ordered_json::array();
    for (const CameraWatch::OtherBrightness& other : facts.camera->other_brightness())
      json["other_star_brightness"].push_back({{"name", other.name}, {"factor", other.brightness}});
  }
  json["tracks"] = nlohmann::ordered_json::array();
  for (const CurtainTrack& t : tracks())
    json["tracks"].push_back({{"track", t.number},
                              {"frames", t.frames.size()},
                              {"first_frame", t.frames.front().frame + 1},
                              {"last_frame", t.frames.back().frame + 1},
                              {"split_from", t.split_from},
                              {"merged_into", t.merged_into}});
  json["inputs"] = nlohmann::ordered_json::array();
  for (const InputFile& input : facts.inputs)
    json["inputs"].push_back({{"role", input.role}, {"name", input.name}, {"sha256", input.sha256}});
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

void MapSequenceRun::write(const std::string& directory, bool overwrite, const MapSequenceRunFacts& facts,
                           const Film& film) const {
  sim::WholeDirectory run(directory, overwrite, map_sequence_kind());
  run.fill([&] {
    sim::write_whole(run.file(kSequenceJson), json(facts));
    sim::write_whole(run.file("tracks.csv"), tracks_csv());
    sim::write_whole(run.file("frames.csv"), frames_csv());
    write_netcdf(run.file("precipitation.nc"), facts);
    std::vector<std::string> pictures;
    for (const std::string& png : png_) {
      pictures.push_back(run.file(fmt::format("picture-{:06d}.png", pictures.size())));
      sim::write_whole(pictures.back(), png);
    }
    const bool has_film = !pictures.empty() && film && film(pictures, run.file(kMovie));
    std::error_code ignored;
    for (const std::string& picture : pictures) fs::remove(picture, ignored);
    sim::write_whole(run.file("report.html"), page(facts, has_film));
  });
}

}  // namespace vegard::fit
