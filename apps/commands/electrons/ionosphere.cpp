#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "apps/commands/commands.h"
#include "apps/commands/electrons/electron_options.h"
#include "apps/options/exit_code.h"
#include "apps/options/file_names.h"
#include "apps/options/json_answer.h"
#include "apps/options/refusals.h"
#include "apps/options/spectrum_options.h"
#include "apps/options/standard_streams.h"
#include "apps/output/plot_file.h"
#include "fit/report/ionosphere/ionosphere_report.h"
#include "sim/base/file/whole_file.h"
#include "sim/base/number/constants.h"
#include "sim/base/utc_time.h"
#include "sim/light/chemistry/table_maker.h"
#include "sim/scene/rows/parameter_rules.h"
#include "sim/scene/table/emission_folder.h"

namespace vegard::apps {
namespace {

constexpr const char* kAirOfTables = "tables";

struct IonosphereOptions {
  std::string source, name, tables, atmosphere = kAirOfTables, time, uncertainty = "modes", output, plot;
  SpectrumOptions spectrum;
  std::optional<double> energy_kev, flux_mw_m2, energy_error, flux_error, latitude_deg, longitude_deg;
  double correlation = 0.0, flux_factor = 0.0, seconds = sim::kUsualSeconds;
  int threads = 0;
  bool steady = false, profiles = false, overwrite = false;
};

/// The electrons of the options --energy-kev and --flux-mw-m2, or those of the file.
fit::ElectronSource source_of(const IonosphereOptions& options) {
  const auto refuse = [](bool is_given, const char* option, const char* problem, const char* expected) {
    if (is_given) throw usage_error(option, problem, expected);
  };
  if (!options.source.empty()) {
    refuse(options.energy_kev.has_value(), "--energy-kev", "SOURCE has its energies", "one of the two");
    refuse(options.flux_mw_m2.has_value(), "--flux-mw-m2", "SOURCE has its fluxes", "one of the two");
    for (const auto& [given, option] : {std::pair{options.energy_error.has_value(), "--energy-error"},
                                        {options.flux_error.has_value(), "--flux-error"},
                                        {options.correlation != 0.0, "--correlation"}})
      refuse(given, option, "SOURCE has its errors", "--energy-kev and --flux-mw-m2 beside it");
    refuse(options.spectrum.spectrum != "maxwellian", "--spectrum", "SOURCE is of Maxwellian electrons",
           "--energy-kev and --flux-mw-m2 beside it");
    return fit::read_electron_source(options.source, options.name, options.flux_factor);
  }
  refuse(!options.energy_kev, "--energy-kev", "it is missing", "E0 in keV with --flux-mw-m2, or SOURCE");
  refuse(!options.flux_mw_m2, "--flux-mw-m2", "it is missing", "mW m^-2 with --energy-kev, or SOURCE");
  refuse(!options.name.empty(), "--name", "there is no fit", "the directory of a fit as SOURCE");
  refuse(options.flux_factor > 0.0, "--flux-factor", "there is no map", "the directory of a map as SOURCE");
  constexpr double kPerCent = 0.01;
  fit::ElectronSource source;
  source.words = fmt::format("{}, {:g} keV, {:g} mW m^-2", options.spectrum.spectrum, *options.energy_kev,
                             *options.flux_mw_m2);
  source.rows.push_back({*options.energy_kev, *options.flux_mw_m2,
                         kPerCent * options.energy_error.value_or(0.0),
                         kPerCent * options.flux_error.value_or(0.0), options.correlation});
  return source;
}

const sim::EmissionTables& tables_of_choice(const std::string& name) {
  sim::Scene scene;
  scene.emission.tables = name;
  try {
    sim::read_emission_folder(scene, name);
    return sim::emission_tables(scene);
  } catch (const sim::Error& error) {
    if (error.details().key != "emission.tables") throw;
    throw sim::Error(error).key("--tables");
  }
}

/// Where the field is: that of the options, else of the map, else of the named conditions of the air.
sim::FieldPlace field_place(const IonosphereOptions& options, const fit::ElectronSource& source) {
  sim::FieldPlace place;
  std::string time = options.time;
  if (source.map) {
    place.latitude_deg = source.map->site.latitude_deg;
    place.longitude_deg = source.map->site.longitude_deg;
    if (time.empty() && source.map->time_s) time = sim::utc_text(*source.map->time_s);
  }
  place.latitude_deg = options.latitude_deg.value_or(place.latitude_deg);
  place.longitude_deg = options.longitude_deg.value_or(place.longitude_deg);
  if (time.empty()) return place;
  sim::Scene scene;
  scene.site.time_utc = time;
  try {
    place.year = sim::igrf_year(scene);
  } catch (const sim::Error& error) {
    throw usage_error("--time", error.details().problem,
                      "UTC from 1900 to 2029, such as 2014-03-10T06:05:33Z");
  }
  return place;
}

std::string words_of_errors(const IonosphereOptions& options, const fit::ElectronSource& source) {
  const bool has_none = source.rows.size() == 1 && source.rows.front().ln_energy_sigma == 0.0 &&
                        source.rows.front().relative_flux_sigma == 0.0;
  const std::string electrons = has_none ? "none of the electrons" : "those of the electrons";
  if (options.uncertainty == "none") return electrons + "; physics is taken as exact";
  return electrons + fmt::format("; {} draws of the numbers of physics", sim::IonosphereTable::kUsualDraws);
}

void answer_ionosphere(const fit::IonosphereAnswer& answer) {
  if (answer.estimates.size() != 1) {
    json_answer()["ionospheres"] = answer.estimates.size();
    return;
  }
  const sim::IonosphereEstimate& of = answer.estimates.front();
  const auto put = [](const char* name, const sim::KnownNumber& known) {
    json_answer()[name] = {{"value", json_number(known.value)}, {"sigma", json_number(known.sigma)}};
  };
  put("pedersen_conductance_s", of.pedersen_s);
  put("hall_conductance_s", of.hall_s);
  put("peak_density_cm3", of.peak_cm3);
  put("peak_altitude_km", of.peak_km);
}

int run_ionosphere(const IonosphereOptions& options) {
  const PlotFormat format = plot_format(options.plot, "--plot");
  const std::string ending = std::filesystem::path(options.output).extension().string();
  if (!options.output.empty() && ending != ".nc" && ending != ".csv")
    throw usage_error("--output", "'" + options.output + "' is no name of a netCDF or CSV file",
                      "a name that ends in .nc or .csv");
  const fit::ElectronSource source = source_of(options);
  const bool has_own_air = options.atmosphere != kAirOfTables;
  protect_outputs({{"--output", options.output}, {"--plot", options.plot}},
                  {options.source, has_own_air ? air_file(options.atmosphere) : std::string()});
  if (format != PlotFormat::none && fit::ionosphere_count(source) != 1)
    throw usage_error("--plot", "it draws one ionosphere, and there are more", "-o OUT.nc for them");
  if (ending == ".csv" && fit::ionosphere_count(source) != 1)
    throw usage_error("--output", "a table holds one ionosphere, and there are more", "-o OUT.nc for them");
  sim::WholeFiles files({options.output, options.plot}, options.overwrite);

  const std::string tables_name = !options.tables.empty()  ? options.tables
                                  : !source.tables.empty() ? source.tables
                                                           : std::string(sim::kDefaultEmissionTables);
  const sim::EmissionTables& tables = tables_of_choice(tables_name);
  sim::IonosphereRequest request;
  request.spectrum = electron_spectrum(options.spectrum);
  request.oxygen_factor = source.oxygen_factor;
  request.place = field_place(options, source);
  request.seconds = options.steady ? std::numeric_limits<double>::infinity() : options.seconds;
  if (has_own_air) {
    sim::TableRequest reach;  // from 80 to 640 km, as tables need it
    reach.air_file = options.atmosphere;
    reach.air = air_of_choice(options.atmosphere);
    sim::require_air_of_tables(reach);
    request.air = reach.air;
  }
  const sim::IonosphereModel model(tables, request);
  const int draws = options.uncertainty == "none" ? 0 : sim::IonosphereTable::kUsualDraws;
  const sim::IonosphereTable table(model, fit::electron_range(source, model), draws, options.threads);
  const fit::IonosphereAnswer answer = fit::ionospheres(table, source, options.threads);

  fit::IonosphereFacts facts;
  facts.electrons = source.words;
  facts.tables = tables_name;
  facts.air = has_own_air ? words_of_air(options.atmosphere) : "that of the emission tables " + tables_name;
  facts.instant = options.steady ? "in a steady state"
                                 : fmt::format("{:g} s after the electrons began to fall", options.seconds);
  const sim::FieldPlace& place = request.place;
  const double foot_nt =
      sim::ionosphere_air(sim::standard_air_table(), {sim::kFootAltitudeKm}, place).field_nt[0];
  facts.field = fmt::format("IGRF-14, {:g} N {:g} E, {:.1f}: {:.0f} nT at 110 km", place.latitude_deg,
                            place.longitude_deg, place.year, foot_nt);
  facts.errors = words_of_errors(options, source);
  if (ending == ".csv")
    files.write(options.output, fit::ionosphere_csv(table, source.rows.front(), facts));
  else if (!options.output.empty())
    fit::ionosphere_dataset(table, source, answer, facts, options.profiles || !source.map, options.threads)
        .write(files.file(options.output).temporary(), options.output);
  if (format != PlotFormat::none)
    files.write(options.plot, plot_bytes(fit::ionosphere_plot(table, source.rows.front(),
                                                              facts.electrons + "; " + facts.instant),
                                         format));
  files.commit();
  answer_ionosphere(answer);
  json_answer()["outputs"] = json_names(files.written());
  say_result(fit::ionosphere_text(answer, facts));
  return good;
}

void add_field_options(const Command& command, IonosphereOptions& options) {
  command.option("--latitude-deg", options.latitude_deg, "Of the magnetic field (default: the map's, or 65)")
      .finite_range(-90.0, 90.0);
  command.option("--longitude-deg", options.longitude_deg, "East positive (default: the map's, or 212)")
      .finite_range(-180.0, 360.0);
  command.option("--time", options.time, "UTC, for the field (default: the map's, or 2014)")
      .type_name("TIME");
}

void add_source_options(const Command& command, IonosphereOptions& options) {
  command.option("SOURCE", options.source,
                 "Electrons: the directory of a map or of a fit, JSON of vegard invert, or a table of "
                 "energy_kev and energy_flux_mw_m2; or --energy-kev and --flux-mw-m2");
  command.option("--name", options.name, "Which sheet of a fit");
  command.option("--energy-kev", options.energy_kev, "E0 of the electrons").finite_range(1e-3, 1e3);
  command.option("--flux-mw-m2", options.flux_mw_m2, "Their energy flux").finite_range(1e-6, 1e4);
  command.option("--energy-error", options.energy_error, "Standard error of E0, in per cent")
      .finite_range(0.0, 200.0)
      .type_name("PERCENT");
  command.option("--flux-error", options.flux_error, "Standard error of the energy flux, in per cent")
      .finite_range(0.0, 200.0)
      .type_name("PERCENT");
  command.option("--correlation", options.correlation, "Of the errors of both").finite_range(-1.0, 1.0);
  add_spectrum_options(command, options.spectrum);
  command
      .option("--flux-factor", options.flux_factor,
              "Factor on a map's energy fluxes, needed if they are relative")
      .finite_range(1e-9, 1e9)
      .type_name("F");
}

}  // namespace

void add_ionosphere_command(Program& program) {
  const auto options = std::make_shared<IonosphereOptions>();
  const Command command =
      program.add("ionosphere",
                  "Compute densities, ions, conductivities and conductances that electrons "
                  "make, at a place or on a map");
  add_source_options(command, *options);
  command
      .option("--tables", options->tables,
              "Emission tables, whose ion pairs are used: by name, or a folder (default: an "
              "inversion's own; of maps, fits and tables vegard)")
      .type_name("NAME|FOLDER");
  command
      .option("--atmosphere", options->atmosphere,
              "The air: that of the tables, a name (vegard atmosphere --list) or a table from 80 to 640 km")
      .type_name("tables|NAME|FILE.csv")
      .shows_default();
  add_field_options(command, *options);
  const Option seconds = command
                             .option("--seconds", options->seconds,
                                     "Time since the electrons have begun to fall, into the night's ions")
                             .finite_range(1.0, 1e6)
                             .shows_default();
  command.flag("--steady", options->steady, "The steady state of hours in place of --seconds")
      .excludes(seconds);
  command
      .option("--uncertainty", options->uncertainty,
              "Errors contain the uncertainty of physics (modes), or take it as exact (none)")
      .one_of({"modes", "none"})
      .shows_default();
  command.flag("--profiles", options->profiles, "Write the profiles of every cell of a map too");
  command.option("-o,--output", options->output, "The numbers by altitude, row or cell")
      .type_name("OUT.nc|OUT.csv");
  command.option("--plot", options->plot, "Draw the profiles").type_name("OUT.svg|OUT.png");
  add_threads_option(command, options->threads);
  command.flag("--overwrite", options->overwrite, "Replace outputs that exist");
  command.runs([options] { return run_ionosphere(*options); });
}

}  // namespace vegard::apps
