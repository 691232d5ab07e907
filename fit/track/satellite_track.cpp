#include "fit/track/satellite_track.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "sim/base/error.h"
#include "sim/base/file/csv_table.h"
#include "sim/base/number/constants.h"
#include "sim/base/text.h"
#include "sim/base/utc_time.h"
#include "sim/scene/rows/parameter_rules.h"
#include "sim/scene/structs/scene.h"
#include "sim/scene/structs/site_axes.h"

namespace vegard::fit {
namespace satellite_track {

constexpr double kDay_s = 86400.0;

std::string small_letters(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

/// The cells of a line; a text in quotes has no separator in tracks.
std::vector<std::string> cells_of(const std::string& line, char separator) {
  std::vector<std::string> cells(1);
  for (const char c : line)
    if (c == separator)
      cells.emplace_back();
    else if (c != '"' && c != '\r')
      cells.back() += c;
  for (std::string& cell : cells) cell = std::string(sim::trimmed(cell));
  return cells;
}

/// The rows of a table of a track, by recognised columns.
class TrackTable {
 public:
  TrackTable(const std::string& text, const std::string& name) : name_(name) {
    int number = 0;
    for (std::size_t begin = 0; begin < text.size();) {
      const std::size_t end = std::min(text.find('\n', begin), text.size());
      const std::string line = text.substr(begin, end - begin);
      begin = end + 1;
      ++number;
      if (sim::trimmed(line).empty() || line.front() == '#') continue;
      if (columns_.empty()) {
        separator_ = sim::table_separator(line);
        columns_ = cells_of(line, separator_);
        continue;
      }
      rows_.push_back(cells_of(line, separator_));
      lines_.push_back(number);
      if (rows_.back().size() != columns_.size())
        throw bad(rows_.size() - 1,
                  fmt::format("there are {} cells for {} columns", rows_.back().size(), columns_.size()));
    }
    if (rows_.empty()) throw sim::unreadable(name_, "there are no rows in it").expected(kColumns);
  }

  std::size_t rows() const { return rows_.size(); }

  /// The first column with one of the names.
  std::optional<std::size_t> column(std::initializer_list<const char*> names) const {
    for (const char* name : names)
      for (std::size_t c = 0; c < columns_.size(); ++c)
        if (small_letters(columns_[c]) == name) return c;
    return std::nullopt;
  }

  std::size_t required(std::optional<std::size_t> found, const char* what) const {
    if (found) return *found;
    throw sim::unreadable(name_, std::string("no column is ") + what + " among " + sim::joined(columns_))
        .expected(kColumns);
  }

  double number(std::size_t row, std::size_t column, double least, double most) const {
    const std::string cell = sim::with_decimal_point(rows_[row][column], separator_);
    double value = 0.0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error != std::errc() || end != cell.data() + cell.size() || !(value >= least && value <= most))
      throw bad(row, "'" + cell + "' in column '" + columns_[column] + "'")
          .expected(fmt::format("a number from {:g} to {:g}", least, most));
    return value;
  }

  double time(std::size_t row, std::size_t column, bool is_number) const {
    constexpr double kLatest = 4102444800.0;  // 2100
    if (is_number) return number(row, column, 0.0, kLatest);
    const std::optional<double> seconds = sim::utc_seconds(rows_[row][column]);
    if (!seconds)
      throw bad(row, "'" + rows_[row][column] + "' in column '" + columns_[column] + "' is no time")
          .expected("UTC such as 2014-03-10T06:05:33Z");
    return *seconds;
  }

 private:
  static constexpr const char* kColumns =
      "columns such as time, latitude, longitude, altitude in km (or radius in m)";

  sim::Error bad(std::size_t row, const std::string& problem) const {
    return sim::unreadable(name_, problem).line(lines_[row]);
  }

  std::string name_;
  char separator_ = ',';
  std::vector<std::string> columns_;
  std::vector<std::vector<std::string>> rows_;
  std::vector<int> lines_;
};

/// East and north of a place at the map's altitude, in the tangent plane of its site.
struct FootOfMap {
  double east_km = sim::kNaN, north_km = sim::kNaN;
};
FootOfMap in_plane(const PrecipitationPlanes& map, const GeodeticPlace& foot) {
  const double lat = foot.latitude_deg * sim::kRadiansPerDegree,
               lon = foot.longitude_deg * sim::kRadiansPerDegree;
  const std::array<double, 3> out = {std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon),
                                     std::sin(lat)};
  const sim::SiteAxes axes = sim::axes_at(map.site);
  const auto along = [&](int axis) {
    return (sim::kEarthRadiusKm + map.height_km) *
           (out[0] * axes.axis[axis][0] + out[1] * axes.axis[axis][1] + out[2] * axes.axis[axis][2]);
  };
  if (!(along(2) > 0.0)) return {};
  return {along(0), along(1)};
}

/// The four cells about a place and their weights; nothing outside of the map.
struct Cells {
  std::array<std::size_t, 4> index{};
  std::array<double, 4> weight{};
};
std::optional<Cells> cells_at(const PrecipitationPlanes& map, const FootOfMap& foot) {
  const double x = (foot.east_km - map.west_km) / map.step_km,
               y = (foot.north_km - map.south_km) / map.step_km;
  if (!(x >= 0.0 && y >= 0.0 && x <= map.columns - 1.0 && y <= map.rows - 1.0)) return std::nullopt;
  const int left = std::min(static_cast<int>(x), std::max(0, map.columns - 2)),
            low = std::min(static_cast<int>(y), std::max(0, map.rows - 2));
  const double a = x - left, b = y - low;
  Cells cells;
  for (std::size_t i = 0; i < 4; ++i) {
    const int column = std::min(left + static_cast<int>(i % 2), map.columns - 1),
              row = std::min(low + static_cast<int>(i / 2), map.rows - 1);
    cells.index[i] = static_cast<std::size_t>(row) * static_cast<std::size_t>(map.columns) +
                     static_cast<std::size_t>(column);
    cells.weight[i] = (i % 2 == 0 ? 1.0 - a : a) * (i / 2 == 0 ? 1.0 - b : b);
  }
  return cells;
}

/// The mean over the cells of `value_of(index)`; NaN where one that counts is.
template <class Value>
double mean_of(const Cells& cells, const Value& value_of) {
  double sum = 0.0;
  for (std::size_t i = 0; i < 4; ++i)
    if (cells.weight[i] > 0.0) sum += cells.weight[i] * value_of(cells.index[i]);
  return sum;
}

/// The mean weighted with flux besides, over the cells where the value is known; NaN where those have less
/// than half of the flux.
template <class Value>
double mean_by_flux(const Cells& cells, const PrecipitationPlanes& map, const Value& value_of) {
  double all = 0.0, known = 0.0, sum = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    const double weight = cells.weight[i] * std::max(0.0, map.energy_flux_mw_m2[cells.index[i]]);
    if (!(weight > 0.0)) continue;
    all += weight;
    const double value = value_of(cells.index[i]);
    if (!std::isfinite(value)) continue;
    known += weight;
    sum += weight * value;
  }
  return known > 0.0 && 2.0 * known >= all ? sum / known : sim::kNaN;
}

double year_of(double utc_s, const std::string& name) {
  sim::Scene scene;
  scene.site.time_utc = sim::utc_text(utc_s);
  try {
    return sim::igrf_year(scene);
  } catch (const sim::Error& error) {
    throw sim::unreadable(name, error.details().problem).expected("times from 1900 to 2029");
  }
}

/// How far a place is from the map's rectangle, km.
double outside_km(const PrecipitationPlanes& map, const FootOfMap& foot) {
  const double east = map.west_km + (map.columns - 1) * map.step_km,
               north = map.south_km + (map.rows - 1) * map.step_km;
  return std::hypot(std::max({0.0, map.west_km - foot.east_km, foot.east_km - east}),
                    std::max({0.0, map.south_km - foot.north_km, foot.north_km - north}));
}

}  // namespace satellite_track

std::vector<SatellitePoint> read_track(const std::string& text, const std::string& name) {
  using namespace satellite_track;
  const TrackTable table(text, name);
  const auto words = table.column({"time", "time_utc", "timestamp", "utc", "epoch"});
  const auto seconds = table.column({"ut1_unix", "time_s", "unix"});
  const std::size_t time = table.required(words ? words : seconds, "a time"),
                    lat = table.required(table.column({"lat", "latitude", "latitude_deg", "glat", "gdlat"}),
                                         "a latitude"),
                    lon = table.required(table.column({"lon", "long", "longitude", "longitude_deg", "glon"}),
                                         "a longitude");
  const auto altitude = table.column({"alt", "altitude", "altitude_km", "alt_km", "gdalt"}),
             radius = table.column({"radius"});
  const std::size_t height = table.required(altitude ? altitude : radius, "an altitude");
  constexpr double kHighestKm = 50000.0, kLeastM = 6.3e6, kMostM = 6e7, kKmPerM = 1e-3;
  std::vector<SatellitePoint> track;
  for (std::size_t r = 0; r < table.rows(); ++r) {
    SatellitePoint point{table.time(r, time, !words), {}};
    const double latitude = table.number(r, lat, -90.0, 90.0),
                 longitude = table.number(r, lon, -180.0, 360.0);
    if (altitude) {
      constexpr double kTurn_deg = 360.0;
      point.place = {latitude, longitude > 180.0 ? longitude - kTurn_deg : longitude,
                     table.number(r, height, 0.0, kHighestKm)};
    } else {
      const double km = kKmPerM * table.number(r, height, kLeastM, kMostM),
                   up = latitude * sim::kRadiansPerDegree, turned = longitude * sim::kRadiansPerDegree;
      point.place = geodetic_place(EarthShape::wgs84,
                                   km * Eigen::Vector3d(std::cos(up) * std::cos(turned),
                                                        std::cos(up) * std::sin(turned), std::sin(up)));
    }
    track.push_back(point);
  }
  return track;
}

std::vector<double> instants_of(const std::string& words) {
  const auto refused = [&](const std::string& problem) {
    return sim::Error(sim::ErrorKind::usage, problem)
        .key("--times")
        .expected(
            "START/STEP/STOP, such as 2014-03-10T06:00:00Z/1/2014-03-10T06:10:00Z with seconds between");
  };
  const std::size_t first = words.find('/'), second = words.find('/', first + 1);
  if (first == std::string::npos || second == std::string::npos)
    throw refused("'" + words + "' has no two /");
  const std::optional<double> start = sim::utc_seconds(words.substr(0, first)),
                              stop = sim::utc_seconds(words.substr(second + 1));
  const std::string digits = words.substr(first + 1, second - first - 1);
  double step = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), step);
  if (!start || !stop) throw refused("'" + words + "' has no two times");
  if (error != std::errc() || end != digits.data() + digits.size() || !(step > 0.0) || !std::isfinite(step))
    throw refused("'" + digits + "' is no step");
  if (*stop < *start) throw refused("the times end before they begin");
  constexpr double kMost = 1e5;
  const double count = std::floor((*stop - *start) / step + 1e-9) + 1.0;
  if (count > kMost) throw refused(fmt::format("there are {:.0f} instants, and 100000 at most", count));
  std::vector<double> instants;
  for (int i = 0; i < static_cast<int>(count); ++i) instants.push_back(*start + i * step);
  return instants;
}

std::vector<SatellitePoint> track_of_elements(const std::string& text, const std::string& name,
                                              const std::string& satellite,
                                              const std::vector<double>& instants, double& oldest_days) {
  using namespace satellite_track;
  std::vector<OrbitalElements> all = read_orbital_elements(text, name);
  std::set<std::string> satellites;
  for (const OrbitalElements& of : all) satellites.insert(of.satellite);
  const std::vector<std::string> names(satellites.begin(), satellites.end());
  if (satellite.empty() ? satellites.size() > 1 : satellites.count(satellite) == 0)
    throw sim::Error(sim::ErrorKind::usage, satellite.empty()
                                                ? "the elements are those of several satellites"
                                                : "there are no elements of '" + satellite + "'")
        .key("--satellite")
        .expected("one of " + sim::joined(names));
  all.erase(std::remove_if(
                all.begin(), all.end(),
                [&](const OrbitalElements& of) { return !satellite.empty() && of.satellite != satellite; }),
            all.end());
  std::vector<Sgp4> orbits;
  for (const OrbitalElements& of : all) orbits.emplace_back(of, name);
  std::vector<SatellitePoint> track;
  oldest_days = 0.0;
  for (const double instant : instants) {
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < all.size(); ++i)
      if (std::abs(all[i].epoch_s - instant) < std::abs(all[nearest].epoch_s - instant)) nearest = i;
    const double age_s = instant - all[nearest].epoch_s;
    oldest_days = std::max(oldest_days, std::abs(age_s) / kDay_s);
    if (oldest_days > kOldElementsDays)
      throw sim::unreadable(name,
                            fmt::format("the elements are {:.0f} days {} {}", oldest_days,
                                        age_s > 0.0 ? "older than" : "younger than", sim::utc_text(instant)))
          .expected(fmt::format("elements within {:g} days of it", kOldElementsDays))
          .hint("archives of elements have those of the day");
    constexpr double kMinute_s = 60.0;
    track.push_back({instant, place_of_state(orbits[nearest].at(age_s / kMinute_s), instant)});
  }
  return track;
}

std::vector<MetElectrons> electrons_along(const std::vector<PrecipitationPlanes>& maps,
                                          const std::vector<SatellitePoint>& track,
                                          const TrackRequest& request, const std::string& name) {
  using namespace satellite_track;
  std::vector<MetElectrons> met;
  bool has_any = false;
  double nearest_km = INFINITY, nearest_s = INFINITY;
  const sim::Igrf igrf(year_of(track.front().time_s, name));
  for (const SatellitePoint& point : track) {
    MetElectrons here;
    here.point = point;
    const PrecipitationPlanes* map = &maps.front();
    for (const PrecipitationPlanes& other : maps)
      if (std::abs(*other.time_s - point.time_s) < std::abs(*map->time_s - point.time_s)) map = &other;
    here.seconds_after_map = point.time_s - *map->time_s;
    const bool is_in_time = std::abs(here.seconds_after_map) <= request.time_tolerance_s;
    const std::optional<GeodeticPlace> foot = field_foot(igrf, point.place, map->height_km);
    here.foot = foot.value_or(GeodeticPlace{sim::kNaN, sim::kNaN, sim::kNaN});
    const FootOfMap plane = foot ? in_plane(*map, *foot) : FootOfMap{};
    here.east_km = plane.east_km;
    here.north_km = plane.north_km;
    here.energy_kev = here.energy_flux_mw_m2 = here.ln_energy_sigma = here.relative_flux_sigma = sim::kNaN;
    const std::optional<Cells> cells = cells_at(*map, plane);
    if (is_in_time && std::isfinite(plane.east_km))
      nearest_km = std::min(nearest_km, outside_km(*map, plane));
    if (cells) nearest_s = std::min(nearest_s, std::abs(here.seconds_after_map));
    if (cells && is_in_time) {
      here.energy_flux_mw_m2 = mean_of(*cells, [&](std::size_t i) { return map->energy_flux_mw_m2[i]; });
      here.energy_kev =
          std::exp(mean_by_flux(*cells, *map, [&](std::size_t i) { return std::log(map->energy_kev[i]); }));
      here.ln_energy_sigma =
          mean_by_flux(*cells, *map, [&](std::size_t i) { return map->ln_energy_error[i]; });
      here.relative_flux_sigma =
          mean_by_flux(*cells, *map, [&](std::size_t i) { return map->relative_flux_error[i]; });
      has_any = has_any || std::isfinite(here.energy_flux_mw_m2);
    }
    met.push_back(here);
  }
  if (has_any) return met;
  std::string why = "its feet are never where the map knows the electrons";
  if (std::isinf(nearest_km) && std::isfinite(nearest_s))
    why = fmt::format("it is over the map {:.0f} s from the map's time at best", nearest_s);
  else if (std::isfinite(nearest_km) && nearest_km > 0.0)
    why = fmt::format("its feet stay {:.0f} km outside of the map", nearest_km);
  else if (std::isinf(nearest_km))
    why = "it is not near the map within the time tolerance";
  throw sim::unreadable(name, why)
      .expected(fmt::format("a track over the map within {:g} s", request.time_tolerance_s))
      .hint("--time-tolerance SECONDS allows more");
}

}  // namespace vegard::fit
