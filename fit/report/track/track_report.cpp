#include "fit/report/track/track_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/base/file/csv_table.h"
#include "sim/base/number/constants.h"
#include "sim/base/text.h"
#include "sim/base/utc_time.h"
#include "sim/base/version.h"
#include "sim/light/height_profile.h"
#include "sim/scene/lines/emission_lines.h"

namespace vegard::fit {
namespace track_report {

/// A column of numbers.
struct TrackColumn {
  std::string csv, netcdf, long_name, unit;
  std::vector<double> values;
};

std::vector<TrackColumn> columns_of(const std::vector<MetElectrons>& met,
                                    const std::vector<TrackLine>& lines) {
  std::vector<TrackColumn> columns;
  const auto add = [&](const char* csv, const char* netcdf, const char* long_name, const char* unit,
                       const auto& value_of) {
    TrackColumn column{csv, netcdf, long_name, unit, {}};
    for (const MetElectrons& here : met) column.values.push_back(value_of(here));
    columns.push_back(std::move(column));
  };
  using M = MetElectrons;
  add("latitude_deg", "latitude", "geodetic latitude of the satellite", "degrees_north",
      [](const M& m) { return m.point.place.latitude_deg; });
  add("longitude_deg", "longitude", "longitude of the satellite", "degrees_east",
      [](const M& m) { return m.point.place.longitude_deg; });
  add("altitude_km", "altitude", "altitude of the satellite", "km",
      [](const M& m) { return m.point.place.height_km; });
  add("foot_latitude_deg", "foot_latitude", "geodetic latitude of its foot along the field", "degrees_north",
      [](const M& m) { return m.foot.latitude_deg; });
  add("foot_longitude_deg", "foot_longitude", "longitude of its foot", "degrees_east",
      [](const M& m) { return m.foot.longitude_deg; });
  add("east_km", "east", "of the foot, in the tangent plane of the map's site", "km",
      [](const M& m) { return m.east_km; });
  add("north_km", "north", "of the foot, in the tangent plane of the map's site", "km",
      [](const M& m) { return m.north_km; });
  add("seconds_after_map", "seconds_after_map", "time of the point less that of the map", "s",
      [](const M& m) { return m.seconds_after_map; });
  add("energy_flux_mw_m2", "energy_flux", "energy flux of the electrons", "mW m-2",
      [](const M& m) { return m.energy_flux_mw_m2; });
  add("energy_flux_sigma_mw_m2", "energy_flux_sigma", "standard deviation of energy_flux", "mW m-2",
      [](const M& m) { return m.energy_flux_mw_m2 * m.relative_flux_sigma; });
  add("energy_kev", "energy", "characteristic energy E0 of the electrons", "keV",
      [](const M& m) { return m.energy_kev; });
  add("energy_sigma_kev", "energy_sigma", "standard deviation of energy", "keV",
      [](const M& m) { return m.energy_kev * m.ln_energy_sigma; });
  for (const TrackLine& line : lines) {
    const std::string name = sim::line_name(line.wavelength_nm);
    columns.push_back({"rayleigh_" + name, "rayleigh_" + name,
                       fmt::format("brightness of {:.1f} nm from straight below", line.wavelength_nm),
                       "rayleigh", line.rayleigh});
    columns.push_back({"sigma_rayleigh_" + name, "rayleigh_" + name + "_sigma",
                       "standard deviation of rayleigh_" + name, "rayleigh", line.sigma});
  }
  return columns;
}

/// A panel of one quantity and its band.
Panel quantity_panel(const std::vector<MetElectrons>& met, const char* label, double start_s,
                     double (*value)(const MetElectrons&), double (*sigma)(const MetElectrons&)) {
  Panel panel;
  panel.title = label;
  panel.x.label = "seconds after " + sim::utc_text(start_s);
  panel.y.label = label;
  Series series;
  series.colour = distinct_colour(0);
  for (const MetElectrons& here : met) {
    series.x.push_back(here.point.time_s - start_s);
    series.y.push_back(value(here));
    series.low.push_back(value(here) - sigma(here));
    series.high.push_back(value(here) + sigma(here));
  }
  panel.series = {series};
  return panel;
}

bool is_known(const MetElectrons& here) { return std::isfinite(here.energy_flux_mw_m2); }

}  // namespace track_report

std::vector<TrackLine> track_lines(const std::vector<MetElectrons>& met, const sim::EmissionTables& tables,
                                   const std::vector<double>& lines_nm) {
  std::vector<TrackLine> lines;
  const double least = tables.energies_kev().front(), most = tables.energies_kev().back();
  for (const double nm : lines_nm) {
    TrackLine line{nm, {}, {}};
    for (const MetElectrons& here : met) {
      double rayleigh = sim::kNaN, sigma = sim::kNaN;
      if (here.energy_kev >= least && here.energy_kev <= most && here.energy_flux_mw_m2 >= 0.0) {
        const sim::Column column = sim::column_below(
            sim::maxwellian_profile({tables}, {nm}, here.energy_kev, here.energy_flux_mw_m2), 0,
            sim::kTablesTopKm);
        rayleigh = here.energy_flux_mw_m2 * column.rayleigh;
        sigma = rayleigh * std::hypot(here.relative_flux_sigma,
                                      column.d_rayleigh_d_ln_energy / column.rayleigh * here.ln_energy_sigma);
      }
      line.rayleigh.push_back(rayleigh);
      line.sigma.push_back(sigma);
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

std::string track_csv(const std::vector<MetElectrons>& met, const std::vector<TrackLine>& lines,
                      const TrackFacts& facts) {
  std::string text =
      sim::csv_comment("vegard track " + sim::version()) + sim::csv_comment("track: " + facts.track) +
      sim::csv_comment("maps: " + sim::joined(facts.maps)) + sim::csv_comment("field: " + facts.field);
  const std::vector<track_report::TrackColumn> columns = track_report::columns_of(met, lines);
  text += "time_utc";
  for (const track_report::TrackColumn& column : columns) text += "," + column.csv;
  text += "\n";
  for (std::size_t i = 0; i < met.size(); ++i) {
    text += sim::utc_text(met[i].point.time_s);
    for (const track_report::TrackColumn& column : columns)
      text += std::isfinite(column.values[i]) ? fmt::format(",{:.7g}", column.values[i]) : ",";
    text += "\n";
  }
  return text;
}

sim::NetcdfDataset track_dataset(const std::vector<MetElectrons>& met, const std::vector<TrackLine>& lines,
                                 const TrackFacts& facts) {
  sim::NetcdfDataset dataset("the electrons that a satellite met, by maps", "vegard " + sim::version());
  dataset.attribute("track", facts.track);
  dataset.attribute("maps", sim::joined(facts.maps, "\n"));
  dataset.attribute("magnetic_field", facts.field);
  dataset.attribute("featureType", "trajectory");
  dataset.dimension("time", met.size());
  std::vector<double> times;
  for (const MetElectrons& here : met) times.push_back(here.point.time_s);
  dataset.real("time", "time of the satellite", "seconds since 1970-01-01 00:00:00", {"time"}, times)
      .with("standard_name", "time")
      .with("calendar", "standard");
  for (const track_report::TrackColumn& column : track_report::columns_of(met, lines)) {
    sim::NetcdfVariable& made =
        dataset.real(column.netcdf, column.long_name, column.unit, {"time"}, column.values);
    if (column.netcdf == "latitude" || column.netcdf == "longitude" || column.netcdf == "altitude")
      made.with("standard_name", column.netcdf);
    else
      made.with("coordinates", "latitude longitude altitude");
  }
  return dataset;
}

Plot track_plot(const std::vector<MetElectrons>& met, const TrackFacts& facts) {
  using namespace track_report;
  const auto first = std::find_if(met.begin(), met.end(), is_known);
  const double start_s = first == met.end() ? met.front().point.time_s : first->point.time_s;
  std::vector<MetElectrons> shown;
  for (const MetElectrons& here : met)
    if (here.point.time_s >= start_s) shown.push_back(here);
  while (shown.size() > 1 && !is_known(shown.back())) shown.pop_back();
  Plot plot;
  plot.title = "What the satellite met";
  plot.note = facts.track;
  plot.panels = {
      quantity_panel(
          shown, "energy flux (mW m^-2)", start_s, [](const MetElectrons& m) { return m.energy_flux_mw_m2; },
          [](const MetElectrons& m) { return m.energy_flux_mw_m2 * m.relative_flux_sigma; }),
      quantity_panel(
          shown, "E0 (keV)", start_s, [](const MetElectrons& m) { return m.energy_kev; },
          [](const MetElectrons& m) { return m.energy_kev * m.ln_energy_sigma; })};
  return plot;
}

std::string track_text(const std::vector<MetElectrons>& met, const TrackFacts& facts) {
  std::string text = fmt::format("track: {}\nfield: {}\n", facts.track, facts.field);
  std::size_t known = 0;
  double least_s = INFINITY, most_s = -INFINITY, most_flux = 0.0;
  const MetElectrons* brightest = nullptr;
  for (const MetElectrons& here : met) {
    if (!track_report::is_known(here)) continue;
    ++known;
    least_s = std::min(least_s, here.seconds_after_map);
    most_s = std::max(most_s, here.seconds_after_map);
    if (here.energy_flux_mw_m2 >= most_flux) {
      most_flux = here.energy_flux_mw_m2;
      brightest = &here;
    }
  }
  text += fmt::format("{} of {} points where a map knows the electrons, {:.1f} to {:.1f} s after it\n", known,
                      met.size(), least_s, most_s);
  if (brightest != nullptr)
    text += fmt::format(
        "most: {:.3g} ± {:.2g} mW m^-2, E0 {:.3g} ± {:.2g} keV, at {}\n", brightest->energy_flux_mw_m2,
        brightest->energy_flux_mw_m2 * brightest->relative_flux_sigma, brightest->energy_kev,
        brightest->energy_kev * brightest->ln_energy_sigma, sim::utc_text(brightest->point.time_s));
  return text;
}

}  // namespace vegard::fit
