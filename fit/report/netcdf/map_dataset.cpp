#include "fit/report/netcdf/run_dataset.h"

#include <cmath>

#include "fit/answer/trust.h"
#include "fit/map/curtains/stored_map.h"
#include "fit/report/netcdf/keyed_table.h"
#include "fit/report/netcdf/record_json.h"
#include "sim/base/error.h"
#include "sim/base/file/input_file.h"
#include "sim/emit/aurora/foot_line.h"

namespace vegard::fit {
namespace {

using sim::NetcdfDataset;

void add_planes(const PrecipitationPlanes& map, NetcdfDataset& dataset) {
  const std::string places =
      std::string("latitude longitude magnetic_latitude altitude") + (map.time_s ? " time" : "");
  const auto plane = [&](const char* name, const std::string& long_name, const std::string& unit,
                         const std::vector<double>& values) -> sim::NetcdfVariable& {
    return dataset.real(name, long_name, unit, {"north", "east"}, values).with("coordinates", places);
  };
  std::vector<double> flux_sigma, energy_sigma;
  for (std::size_t i = 0; i < map.cells(); ++i) {
    flux_sigma.push_back(map.relative_flux_error[i] * map.energy_flux_mw_m2[i]);
    energy_sigma.push_back(map.ln_energy_error[i] * map.energy_kev[i]);
  }
  const std::string flux_unit = map.flux_is_absolute ? "mW m-2" : "1";
  plane("energy_flux",
        std::string("energy flux of the electrons") + (map.flux_is_absolute ? "" : ", up to a factor"),
        flux_unit, map.energy_flux_mw_m2)
      .with("ancillary_variables", "energy_flux_sigma energy_flux_error");
  plane("energy_flux_sigma", "standard error of energy_flux", flux_unit, flux_sigma);
  plane("energy_flux_error", "relative standard error of energy_flux", "1", map.relative_flux_error);
  const std::string electrons =
      map.spectrum == "maxwellian" ? "Maxwellian electrons" : "electrons of the spectrum " + map.spectrum;
  plane("energy", "characteristic energy E0 of " + electrons, "keV", map.energy_kev)
      .with("ancillary_variables", "energy_sigma ln_energy_error");
  plane("energy_sigma", "standard error of energy", "keV", energy_sigma);
  plane("ln_energy_error", "standard error of the logarithm of energy", "1", map.ln_energy_error);
  plane("sensitivity", "signal to noise ratio of 1 mW m-2 in a cell by itself", "1", map.sensitivity);
}

/// A number of a curtain's point, the column of its error, and what it is.
struct CurtainColumn {
  const char *column, *error, *name, *long_name, *unit;
};
constexpr CurtainColumn kCurtainColumns[] = {
    {"east_km", "", "east", "to the east", "km"},
    {"north_km", "", "north", "to the north", "km"},
    {"distance_km", "distance_error_km", "distance", "distance on the ground", "km"},
    {"azimuth_deg", "", "azimuth", "azimuth from north to the east", "degree"},
    {"lower_border_km", "lower_border_error_km", "lower_border", "altitude of the lower border", "km"},
    {"energy_flux_mw_m2", "energy_flux_error_mw_m2", "energy_flux", "energy flux at the peak", "mW m-2"},
    {"energy_kev", "energy_error_kev", "energy", "characteristic energy E0", "keV"},
    {"width_km", "width_error_km", "width", "standard deviation across", "km"},
    {"lateral_error_km", "", "lateral_error", "standard error of the place across", "km"}};

void add_curtains(const std::string& file, bool is_absolute, NetcdfDataset& dataset) {
  const TextTable table = [&] {
    const std::string text = sim::input_bytes(file, "the curtains of a map");
    // A map without curtains has the names of the columns alone.
    const std::size_t end = text.find('\n');
    return end == std::string::npos || end + 1 == text.size() ? TextTable() : read_text_table(text, file);
  }();
  if (table.rows.empty()) return;
  const KeyedTable points(table, {"curtain", "point"});
  // Curtains have different lengths, and stand one behind the other.
  const std::vector<double> curtain = points.numbers("curtain", {"curtain", "point"});
  std::vector<int> which;
  for (const double c : curtain)
    if (std::isfinite(c)) which.push_back(static_cast<int>(c));
  dataset.dimension("curtain_point", which.size());
  dataset.whole("curtain", "which curtain a point is of, counted from 1", "1", {"curtain_point"}, which);
  const auto add = [&](const std::string& name, const std::string& long_name, const std::string& unit,
                       const char* column) -> sim::NetcdfVariable& {
    const std::vector<double> all = points.numbers(column, {"curtain", "point"});
    std::vector<double> values;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (std::isfinite(curtain[i])) values.push_back(all[i]);
    return dataset.real(name, long_name, unit, {"curtain_point"}, values);
  };
  for (const CurtainColumn& c : kCurtainColumns) {
    const std::string name = std::string("curtain_") + c.name;
    const std::string unit = std::string(c.name) == "energy_flux" && !is_absolute ? "1" : c.unit;
    sim::NetcdfVariable& made = add(name, c.long_name, unit, c.column);
    if (*c.error == '\0') continue;
    made.with("ancillary_variables", add(name + "_sigma", "standard error of " + name, unit, c.error).name);
  }
}

void add_verdicts(const RecordOfRun& json, NetcdfDataset& dataset) {
  const std::vector<std::string> trusts = {trust_name(Trust::good), trust_name(Trust::doubtful),
                                           trust_name(Trust::unconstrained)};
  std::vector<std::string> quantities, values, reasons;
  std::vector<int> verdicts;
  for (const RecordOfRun& v : record_list(json, "verdicts")) {
    quantities.push_back(record_text(v, "quantity"));
    values.push_back(record_text(v, "value"));
    reasons.push_back(record_text(v, "reason"));
    verdicts.push_back(sim::flag_number(trusts, record_text(v, "verdict")));
  }
  if (quantities.empty()) return;
  dataset.dimension("quantity", quantities.size());
  dataset.text("quantity", "quantities with a verdict", {"quantity"}, quantities);
  dataset.flags("verdict", "whether to trust a quantity", trusts, {"quantity"}, verdicts);
  dataset.text("verdict_value", "the quantity in words", {"quantity"}, values);
  dataset.text("verdict_reason", "why", {"quantity"}, reasons);
}

}  // namespace

void add_map_places(const PrecipitationPlanes& map, NetcdfDataset& dataset) {
  const auto columns = static_cast<std::size_t>(map.columns), rows = static_cast<std::size_t>(map.rows);
  dataset.dimension("north", rows);
  dataset.dimension("east", columns);
  std::vector<double> east, north, latitude, longitude, magnetic;
  sim::Scene scene;
  scene.site = map.site;
  for (std::size_t column = 0; column < columns; ++column)
    east.push_back(map.west_km + static_cast<double>(column) * map.step_km);
  for (std::size_t row = 0; row < rows; ++row) {
    north.push_back(map.south_km + static_cast<double>(row) * map.step_km);
    for (const double x : east) {
      const sim::PlaceOnEarth place = sim::place_of_foot(scene, {x, north.back()});
      latitude.push_back(place.latitude_deg);
      longitude.push_back(place.longitude_deg);
      magnetic.push_back(place.magnetic_latitude_deg);
    }
  }
  dataset.real("north", "to the north in the tangent plane of the site", "km", {"north"}, north)
      .with("standard_name", "projection_y_coordinate")
      .with("axis", "Y");
  dataset.real("east", "to the east in the tangent plane of the site", "km", {"east"}, east)
      .with("standard_name", "projection_x_coordinate")
      .with("axis", "X");
  dataset.real("latitude", "geographic latitude on the sphere", "degrees_north", {"north", "east"}, latitude)
      .with("standard_name", "latitude");
  dataset.real("longitude", "geographic longitude", "degrees_east", {"north", "east"}, longitude)
      .with("standard_name", "longitude");
  dataset.real("magnetic_latitude", "latitude of the centred dipole of IGRF-13, 2020", "degree",
               {"north", "east"}, magnetic);
  dataset.real("altitude", "altitude of the feet", "km", {}, {map.height_km})
      .with("standard_name", "altitude")
      .with("positive", "up");
  dataset.real("site_latitude", "latitude of the site", "degrees_north", {}, {map.site.latitude_deg});
  dataset.real("site_longitude", "longitude of the site", "degrees_east", {}, {map.site.longitude_deg});
  if (map.time_s)
    dataset
        .real("time", "when the photograph was taken", "seconds since 1970-01-01 00:00:00", {}, {*map.time_s})
        .with("standard_name", "time")
        .with("calendar", "standard");
}

NetcdfDataset map_dataset(const std::string& directory) {
  const RecordOfRun json = read_record(directory + "/map.json", "the directory of a map");
  if (record_text(json, "kind") != "vegard map")
    throw sim::unreadable(directory + "/map.json", "is no map's").expected("the directory of a map");
  const PrecipitationPlanes map = read_precipitation_planes(directory);
  NetcdfDataset dataset("a map of precipitation", "vegard " + record_text(json, "version"));
  dataset.attribute("command", record_text(json, "command"));
  dataset.attribute("verdict_line", record_text(json, "verdict_line"));
  dataset.attribute("flux_calibration", map.flux_is_absolute ? "absolute" : "relative");
  add_map_places(map, dataset);
  add_planes(map, dataset);
  for (const auto& [key, long_name] :
       {std::pair<const char*, const char*>{"chi2_per_value", "chi2 per value"},
        {"model_error", "share of the light that the model may miss"},
        {"altitude_scale", "factor of the altitudes of the tables"}})
    dataset.real(key, long_name, "1", {}, {record_number(json, key)});
  add_curtains(directory + "/" + kCurtainTable, map.flux_is_absolute, dataset);
  add_verdicts(json, dataset);
  return dataset;
}

}  // namespace vegard::fit
