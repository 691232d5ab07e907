#include "fit/report/ionosphere/ionosphere_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "fit/report/netcdf/run_dataset.h"
#include "sim/base/error.h"
#include "sim/base/file/csv_table.h"
#include "sim/base/number/constants.h"
#include "sim/base/parallel.h"
#include "sim/base/version.h"

namespace vegard::fit {
namespace ionosphere_report {

using sim::IonosphereNumber;

constexpr double kPerM3 = 1e6;  // of cm^-3

/// A number by altitude as a variable.
struct ByAltitude {
  IonosphereNumber number;
  const char *name, *long_name, *unit;
  double factor;
  const char* label;  ///< in the plot
};
constexpr std::array<ByAltitude, sim::kIonosphereNumbers> kProfiles = {
    {{IonosphereNumber::electrons, "electron_density", "density of electrons", "m-3", kPerM3, "electrons"},
     {IonosphereNumber::op, "o_plus_density", "density of O+", "m-3", kPerM3, "O+"},
     {IonosphereNumber::o2p, "o2_plus_density", "density of O2+", "m-3", kPerM3, "O2+"},
     {IonosphereNumber::nop, "no_plus_density", "density of NO+", "m-3", kPerM3, "NO+"},
     {IonosphereNumber::n2p, "n2_plus_density", "density of N2+", "m-3", kPerM3, "N2+"},
     {IonosphereNumber::pedersen, "pedersen_conductivity", "Pedersen conductivity", "S m-1", 1.0, "Pedersen"},
     {IonosphereNumber::hall, "hall_conductivity", "Hall conductivity", "S m-1", 1.0, "Hall"},
     {IonosphereNumber::deposited, "energy_deposition",
      "energy that the electrons leave in the air, of which light and chemistry carry a part away", "W m-3",
      1.0, ""}}};

/// A number of the whole height as a variable.
struct OverAll {
  sim::KnownNumber sim::IonosphereEstimate::*number;
  const char *name, *long_name, *unit;
  double factor;
  const char* words;  ///< in a summary
  double shown;       ///< the factor there
};
constexpr std::array<OverAll, 4> kScalars = {
    {{&sim::IonosphereEstimate::pedersen_s, "pedersen_conductance",
      "Pedersen conductivity integrated over altitude", "S", 1.0, "Pedersen conductance (S)", 1.0},
     {&sim::IonosphereEstimate::hall_s, "hall_conductance", "Hall conductivity integrated over altitude", "S",
      1.0, "Hall conductance (S)", 1.0},
     {&sim::IonosphereEstimate::peak_cm3, "peak_density", "largest density of electrons", "m-3", kPerM3,
      "largest density (10^11 m^-3)", 1e-5},
     {&sim::IonosphereEstimate::peak_km, "peak_altitude", "altitude of the largest density", "km", 1.0,
      "its altitude (km)", 1.0}}};

/// The places by which variables run: rows or cells.
struct Places {
  std::vector<std::string> dimensions;
  std::string coordinates;
};

void add_known(sim::NetcdfDataset& dataset, const std::string& name, const std::string& long_name,
               const std::string& unit, const std::vector<std::string>& dimensions,
               const std::string& coordinates, std::vector<double> values, std::vector<double> sigmas) {
  sim::NetcdfVariable& value = dataset.real(name, long_name, unit, dimensions, std::move(values));
  value.with("ancillary_variables", name + "_sigma");
  sim::NetcdfVariable& sigma =
      dataset.real(name + "_sigma", "standard deviation of " + name, unit, dimensions, std::move(sigmas));
  if (coordinates.empty()) return;
  value.with("coordinates", coordinates);
  sigma.with("coordinates", coordinates);
}

Places add_places(const ElectronSource& source, sim::NetcdfDataset& dataset) {
  if (source.map) {
    add_map_places(*source.map, dataset);
    return {{"north", "east"}, "latitude longitude"};
  }
  if (source.rows.size() == 1) return {};
  dataset.dimension("row", source.rows.size());
  if (source.row_name.empty()) return {{"row"}, {}};
  const std::string name =
      dataset.real(source.row_name, "the table's column " + source.row_name, "", {"row"}, source.row_numbers)
          .name;
  return {{"row"}, name};
}

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Series profile_series(const sim::IonosphereTable& table, const sim::ElectronEstimate& electrons,
                      const ByAltitude& profile, int colour) {
  constexpr double kHighestKm = 300.0;
  Series series;
  series.label = profile.label;
  series.colour = distinct_colour(colour);
  series.band_along_x = true;
  const std::vector<sim::KnownNumber> known = table.profile(electrons, profile.number);
  for (std::size_t a = 0; a < known.size() && table.altitudes_km()[a] <= kHighestKm; ++a) {
    const double value = profile.factor * known[a].value, relative = known[a].sigma / known[a].value;
    const double ln10 = std::log10(value), half = relative * std::log10(std::exp(1.0));
    series.x.push_back(std::isfinite(ln10) ? ln10 : sim::kNaN);
    series.y.push_back(table.altitudes_km()[a]);
    series.low.push_back(ln10 - half);
    series.high.push_back(ln10 + half);
  }
  return series;
}

Panel profile_panel(const char* title, const char* label, std::vector<Series> series, double decades) {
  Panel panel;
  panel.title = title;
  panel.x.label = label;
  panel.y.label = "altitude (km)";
  double most = -300.0;
  for (const Series& one : series)
    for (const double x : one.x) most = std::max(most, std::isfinite(x) ? x : most);
  panel.x.max = most + 0.3;
  panel.x.min = most - decades;
  panel.series = std::move(series);
  return panel;
}

}  // namespace ionosphere_report

std::size_t ionosphere_count(const ElectronSource& source) {
  return source.map ? source.map->cells() : source.rows.size();
}

sim::ElectronEstimate electrons_of(const ElectronSource& source, std::size_t index) {
  if (!source.map) return source.rows[index];
  const PrecipitationPlanes& map = *source.map;
  return {map.energy_kev[index], map.energy_flux_mw_m2[index], map.ln_energy_error[index],
          map.relative_flux_error[index], 0.0};
}

sim::IonosphereTable::Range electron_range(const ElectronSource& source, const sim::IonosphereModel& model) {
  sim::IonosphereTable::Range range{INFINITY, 0.0, INFINITY, 0.0};
  for (std::size_t i = 0; i < ionosphere_count(source); ++i) {
    const sim::ElectronEstimate of = electrons_of(source, i);
    if (!(of.energy_flux_mw_m2 >= 0.0)) continue;
    range.least_mw_m2 = std::min(range.least_mw_m2, of.energy_flux_mw_m2);
    range.most_mw_m2 = std::max(range.most_mw_m2, of.energy_flux_mw_m2);
    if (!(of.energy_kev > 0.0)) continue;
    range.least_kev = std::min(range.least_kev, of.energy_kev);
    range.most_kev = std::max(range.most_kev, of.energy_kev);
  }
  if (!(range.most_kev > 0.0))
    throw sim::unreadable(source.words, "no energy and energy flux is known anywhere in it")
        .expected("electrons somewhere");
  if (range.least_kev < model.least_kev() || range.most_kev > model.most_kev())
    throw sim::unreadable(source.words,
                          fmt::format("E0 of {:g} keV is beyond the emission tables",
                                      range.least_kev < model.least_kev() ? range.least_kev : range.most_kev))
        .expected(fmt::format("{:g} to {:g} keV", model.least_kev(), model.most_kev()));
  constexpr double kMostFlux = 1e4;
  if (range.most_mw_m2 > kMostFlux)
    throw sim::unreadable(source.words, fmt::format("an energy flux of {:g} mW m^-2", range.most_mw_m2))
        .expected("at most 10000");
  return range;
}

IonosphereAnswer ionospheres(const sim::IonosphereTable& table, const ElectronSource& source, int threads) {
  IonosphereAnswer answer;
  answer.estimates.resize(ionosphere_count(source));
  sim::parallel_for(answer.estimates.size(), threads,
                    [&](std::size_t i, int) { answer.estimates[i] = table.at(electrons_of(source, i)); });
  return answer;
}

sim::NetcdfDataset ionosphere_dataset(const sim::IonosphereTable& table, const ElectronSource& source,
                                      const IonosphereAnswer& answer, const IonosphereFacts& facts,
                                      bool has_profiles, int threads) {
  using namespace ionosphere_report;
  sim::NetcdfDataset dataset("the ionosphere that precipitating electrons make", "vegard " + sim::version());
  dataset.attribute("electrons", facts.electrons);
  dataset.attribute("emission_tables", facts.tables);
  dataset.attribute("air", facts.air);
  dataset.attribute("instant", facts.instant);
  dataset.attribute("magnetic_field", facts.field);
  dataset.attribute("errors", facts.errors);
  dataset.attribute("references",
                    "Schunk and Nagy 2009, Ionospheres, chapter 4: collisions; Rees 1989, Physics and "
                    "Chemistry of the Upper Atmosphere, chapter 3: shares of the gases");
  const Places places = add_places(source, dataset);
  const std::size_t count = answer.estimates.size();
  std::vector<double> energy, energy_sigma, flux, flux_sigma;
  for (std::size_t i = 0; i < count; ++i) {
    const sim::ElectronEstimate of = electrons_of(source, i);
    energy.push_back(of.energy_kev);
    energy_sigma.push_back(of.energy_kev * of.ln_energy_sigma);
    flux.push_back(of.energy_flux_mw_m2);
    flux_sigma.push_back(of.energy_flux_mw_m2 * of.relative_flux_sigma);
  }
  add_known(dataset, "energy", "characteristic energy E0 of the electrons", "keV", places.dimensions,
            places.coordinates, energy, energy_sigma);
  add_known(dataset, "energy_flux", "energy flux of the electrons", "mW m-2", places.dimensions,
            places.coordinates, flux, flux_sigma);
  for (const OverAll& scalar : kScalars) {
    std::vector<double> values, sigmas;
    for (const sim::IonosphereEstimate& of : answer.estimates) {
      values.push_back(scalar.factor * (of.*scalar.number).value);
      sigmas.push_back(scalar.factor * (of.*scalar.number).sigma);
    }
    add_known(dataset, scalar.name, scalar.long_name, scalar.unit, places.dimensions, places.coordinates,
              values, sigmas);
  }
  std::vector<double> pedersen, hall;
  for (const sim::IonosphereEstimate& of : answer.estimates) {
    pedersen.push_back(of.pedersen_physics_sigma);
    hall.push_back(of.hall_physics_sigma);
  }
  dataset.real("pedersen_conductance_physics_sigma", "what physics leaves of pedersen_conductance_sigma", "S",
               places.dimensions, pedersen);
  dataset.real("hall_conductance_physics_sigma", "what physics leaves of hall_conductance_sigma", "S",
               places.dimensions, hall);
  if (!has_profiles) return dataset;
  const std::vector<double>& altitudes = table.altitudes_km();
  dataset.dimension("level", altitudes.size());
  // A map has an altitude already, that of its feet.
  dataset.real(source.map ? "level_altitude" : "altitude", "altitude", "km", {"level"}, altitudes)
      .with("standard_name", "altitude")
      .with("positive", "up")
      .with("axis", "Z");
  std::vector<std::string> dimensions = {"level"};
  dimensions.insert(dimensions.end(), places.dimensions.begin(), places.dimensions.end());
  for (const ByAltitude& profile : kProfiles) {
    std::vector<double> values(altitudes.size() * count), sigmas(values.size());
    sim::parallel_for(count, threads, [&](std::size_t i, int) {
      const std::vector<sim::KnownNumber> known = table.profile(electrons_of(source, i), profile.number);
      for (std::size_t a = 0; a < known.size(); ++a) {
        values[a * count + i] = profile.factor * known[a].value;
        sigmas[a * count + i] = profile.factor * known[a].sigma;
      }
    });
    add_known(dataset, profile.name, profile.long_name, profile.unit, dimensions,
              source.map ? places.coordinates : "altitude", std::move(values), std::move(sigmas));
  }
  return dataset;
}

std::string ionosphere_csv(const sim::IonosphereTable& table, const sim::ElectronEstimate& electrons,
                           const IonosphereFacts& facts) {
  using namespace ionosphere_report;
  std::string text =
      sim::csv_comment("electrons: " + facts.electrons) +
      sim::csv_comment("air: " + facts.air + ", " + facts.instant) +
      sim::csv_comment("field: " + facts.field) + sim::csv_comment("errors: " + facts.errors) +
      sim::csv_comment("units: km; densities m^-3, conductivities S/m, energy_deposition W m^-3");
  text += "altitude_km";
  std::vector<std::vector<sim::KnownNumber>> columns;
  for (const ByAltitude& profile : kProfiles) {
    columns.push_back(table.profile(electrons, profile.number));
    text += fmt::format(",{0},{0}_sigma", profile.name);
  }
  text += "\n";
  for (std::size_t a = 0; a < table.altitudes_km().size(); ++a) {
    text += fmt::format("{:g}", table.altitudes_km()[a]);
    for (std::size_t c = 0; c < columns.size(); ++c)
      for (const double value : {columns[c][a].value, columns[c][a].sigma})
        text += std::isfinite(value) ? fmt::format(",{:.5g}", kProfiles[c].factor * value) : ",";
    text += "\n";
  }
  return text;
}

Plot ionosphere_plot(const sim::IonosphereTable& table, const sim::ElectronEstimate& electrons,
                     const std::string& note) {
  using namespace ionosphere_report;
  constexpr double kDensityDecades = 4.0, kConductivityDecades = 5.0;
  std::vector<Series> densities, conductivities;
  int colour = 0;
  for (const ByAltitude& profile : kProfiles) {
    const bool is_density = profile.number <= IonosphereNumber::n2p;
    if (profile.number == IonosphereNumber::deposited) continue;
    if (profile.number == IonosphereNumber::pedersen) colour = 0;
    (is_density ? densities : conductivities).push_back(profile_series(table, electrons, profile, colour++));
  }
  Plot plot;
  plot.title = "The ionosphere of these electrons";
  plot.note = note;
  plot.panels = {profile_panel("Densities", "log10(density in m^-3)", std::move(densities), kDensityDecades),
                 profile_panel("Conductivities", "log10(conductivity in S/m)", std::move(conductivities),
                               kConductivityDecades)};
  return plot;
}

std::string ionosphere_text(const IonosphereAnswer& answer, const IonosphereFacts& facts) {
  using namespace ionosphere_report;
  std::string text = fmt::format("electrons: {}\nair: {}, {}\nfield: {}\n", facts.electrons, facts.air,
                                 facts.instant, facts.field);
  for (const OverAll& scalar : kScalars) {
    if (answer.estimates.size() == 1) {
      const sim::KnownNumber& known = answer.estimates.front().*scalar.number;
      text += fmt::format("{:<30}{:.4g} ± {:.2g}\n", scalar.words, scalar.shown * known.value,
                          scalar.shown * known.sigma);
      continue;
    }
    std::vector<double> values;
    for (const sim::IonosphereEstimate& of : answer.estimates)
      if (std::isfinite((of.*scalar.number).value))
        values.push_back(scalar.shown * (of.*scalar.number).value);
    if (values.empty()) continue;
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    text += fmt::format("{:<30}{:.3g} to {:.3g}, median {:.3g}\n", scalar.words, *least, *most,
                        median_of(values));
  }
  return text + "errors: " + facts.errors + "\n";
}

}  // namespace vegard::fit
