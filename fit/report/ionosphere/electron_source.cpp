#include "fit/report/ionosphere/electron_source.h"

#include <cmath>
#include <filesystem>
#include <map>

#include "fit/report/netcdf/keyed_table.h"
#include "fit/report/netcdf/record_json.h"
#include "fit/report/netcdf/run_dataset.h"
#include "sim/base/error.h"
#include "sim/base/file/input_file.h"
#include "sim/base/number/constants.h"
#include "sim/base/text.h"

namespace vegard::fit {
namespace electron_source {

constexpr const char* kExpected =
    "a map's or a fit's directory, JSON of vegard invert -o, or a table with energy_kev and "
    "energy_flux_mw_m2";

void require_maxwellian(const std::string& file, const std::string& spectrum) {
  if (!spectrum.empty() && spectrum != "maxwellian")
    throw sim::unreadable(file, "its electrons have the spectrum " + spectrum)
        .expected("Maxwellian electrons")
        .hint("--energy-kev and --flux-mw-m2 with --spectrum are for one place");
}

ElectronSource of_map(const std::string& directory, double flux_factor) {
  ElectronSource source;
  source.words = "the map " + directory;
  source.map = read_precipitation_planes(directory);
  require_maxwellian(directory, source.map->spectrum);
  if (!source.map->flux_is_absolute && flux_factor == 0.0)
    throw sim::unreadable(directory,
                          "its energy flux is right up to a factor only, since the sensor is not calibrated")
        .expected("a map with FLUXCAL = 'absolute'")
        .hint("--flux-factor F says that factor, if it is known from elsewhere");
  if (flux_factor > 0.0)
    for (double& flux : source.map->energy_flux_mw_m2) flux *= flux_factor;
  return source;
}

/// The derived numbers of one source of light of a run.
struct Derived {
  double energy_kev = sim::kNaN, energy_sigma = sim::kNaN, flux = sim::kNaN, flux_sigma = sim::kNaN;
  std::string why_no_flux;
};

ElectronSource of_run(const std::string& directory, const std::string& name) {
  const std::string file = directory + "/result.json";
  const RecordOfRun json = read_record(file, kExpected);
  const std::string of_energy = "characteristic energy E0 of the ", of_flux = "energy flux Q of the ";
  std::map<std::string, Derived> all;
  for (const RecordOfRun& one : record_list(json, "derived")) {
    const std::string words = record_text(one, "name");
    if (words.rfind(of_energy, 0) == 0) {
      Derived& of = all[words.substr(of_energy.size())];
      of.energy_kev = record_number(one, "value");
      of.energy_sigma = record_number(one, "sigma");
    } else if (words.rfind(of_flux, 0) == 0) {
      Derived& of = all[words.substr(of_flux.size())];
      of.flux = record_number(one, "value");
      of.flux_sigma = record_number(one, "sigma");
      of.why_no_flux = record_text(one, "why_none");
    }
  }
  std::vector<std::string> known, names;
  std::string why;
  for (const auto& [of, numbers] : all) {
    names.push_back(of);
    if (numbers.energy_kev > 0.0 && numbers.flux >= 0.0) known.push_back(of);
    if (!numbers.why_no_flux.empty()) why = numbers.why_no_flux;
  }
  if (known.empty())
    throw sim::unreadable(file, "the fit tells no energy and energy flux of Maxwellian electrons" +
                                    (why.empty() ? std::string() : ": " + why))
        .expected("a fit of a calibrated picture (sensor.calibration_error)");
  std::string chosen = known.front();
  if (!name.empty() || known.size() > 1) {
    chosen.clear();
    for (const std::string& of : known)
      if (of == name || of == name + " sheet" || of == name + " footprint") chosen = of;
    if (chosen.empty())
      throw sim::Error(sim::ErrorKind::usage, name.empty() ? "the fit has electrons of several sheets"
                                                           : "'" + name + "' is none of the fit's sheets")
          .key("--name")
          .expected("one of " + sim::joined(known));
  }
  const Derived& of = all[chosen];
  ElectronSource source;
  source.words = "the " + chosen + " of the fit " + directory;
  source.rows.push_back(
      {of.energy_kev, of.flux, of.energy_sigma / of.energy_kev, of.flux_sigma / of.flux, 0.0});
  return source;
}

ElectronSource of_inversion(const std::string& file) {
  const RecordOfRun json = read_record(file, kExpected);
  const RecordOfRun& solutions = record_list(json, "solutions");
  if (record_text(json, "kind") != "vegard invert" || solutions.empty())
    throw sim::unreadable(file, "is no answer of vegard invert --line").expected(kExpected);
  require_maxwellian(file, record_text(json, "spectrum"));
  const RecordOfRun& best = solutions.front();
  const auto part = [&](const char* key, const char* number) {
    const auto found = best.find(key);
    return found == best.end() ? sim::kNaN : record_number(*found, number);
  };
  // What is held at a value has no error.
  const auto sigma = [&](const char* key) {
    const auto found = best.find(key);
    const bool is_held = found != best.end() && found->contains("free") && (*found)["free"].is_boolean() &&
                         !(*found)["free"].get<bool>();
    return is_held ? 0.0 : part(key, "sigma_ln");
  };
  ElectronSource source;
  source.words = "the inversion " + file;
  if (solutions.size() > 1)
    source.words += ", the best of " + std::to_string(solutions.size()) + " solutions, without the others";
  source.tables = record_text(json, "tables");
  if (part("oxygen_factor", "value") > 0.0) source.oxygen_factor = part("oxygen_factor", "value");
  double correlation = 0.0;
  if (best.contains("correlations"))
    correlation = record_number(best["correlations"], "energy_kev,energy_flux_mw_m2");
  source.rows.push_back({part("energy_kev", "value"), part("energy_flux_mw_m2", "value"), sigma("energy_kev"),
                         sigma("energy_flux_mw_m2"), std::isfinite(correlation) ? correlation : 0.0});
  if (!(source.rows.front().energy_kev > 0.0) || !(source.rows.front().energy_flux_mw_m2 >= 0.0))
    throw sim::unreadable(file, "its best solution has no energy or no energy flux").expected(kExpected);
  return source;
}

ElectronSource of_table(const std::string& file) {
  constexpr const char *kEnergy = "energy_kev", *kFlux = "energy_flux_mw_m2";
  const TextTable table = read_text_table(sim::input_bytes(file, kExpected), file);
  if (!table.has(kEnergy) || !table.has(kFlux))
    throw sim::unreadable(file, "the columns energy_kev and energy_flux_mw_m2 are not both there")
        .expected(kExpected);
  for (const char* other : {"gaussian", "mono", "kappa"})
    if (table.title.find(std::string(other) + " electrons") != std::string::npos)
      require_maxwellian(file, other);
  TextTable numbered = table;
  numbered.columns.push_back("row of the table");
  for (std::size_t r = 0; r < numbered.rows.size(); ++r) numbered.rows[r].push_back(std::to_string(r));
  const KeyedTable rows(numbered, {"row of the table"});
  const auto column = [&](const std::string& name) {
    return table.has(name) ? rows.numbers(name, {"row of the table"})
                           : std::vector<double>(table.rows.size(), sim::kNaN);
  };
  const std::vector<double> energy = column(kEnergy), flux = column(kFlux);
  const auto ln_sigma = [&](const std::string& name) {
    const std::vector<double> low = column(name + "_68_low"), high = column(name + "_68_high");
    std::vector<double> sigma;
    for (std::size_t r = 0; r < low.size(); ++r)
      sigma.push_back(low[r] > 0.0 && high[r] >= low[r] ? 0.5 * std::log(high[r] / low[r]) : sim::kNaN);
    return sigma;
  };
  const std::vector<double> of_energy = ln_sigma(kEnergy), of_flux = ln_sigma(kFlux);
  ElectronSource source;
  source.words = "the table " + file;
  for (std::size_t r = 0; r < energy.size(); ++r) {
    if (energy[r] <= 0.0 || flux[r] < 0.0)
      throw sim::unreadable(file, "an energy or an energy flux is not above 0")
          .line(table.lines[r])
          .expected("energies in keV and fluxes in mW m^-2 above 0, or empty cells");
    source.rows.push_back({energy[r], flux[r], of_energy[r], of_flux[r], 0.0});
  }
  if (const std::string& first = table.columns.front(); first != kEnergy && first != kFlux) {
    try {
      source.row_numbers = column(first);
      source.row_name = first;
    } catch (const sim::Error&) {
      source.row_numbers.clear();  // words, which number nothing
    }
  }
  return source;
}

}  // namespace electron_source

ElectronSource read_electron_source(const std::string& path, const std::string& name, double flux_factor) {
  using namespace electron_source;
  namespace fs = std::filesystem;
  std::string directory = path;
  std::error_code none;
  const std::string file_name = fs::path(path).filename().string();
  if (fs::is_regular_file(path, none))
    for (const char* of_map : {kMapNetcdf, "precipitation.fits", "map.json"})
      if (file_name == of_map) directory = fs::path(path).parent_path().string();
  if (directory.empty()) directory = ".";
  const bool is_map = fs::exists(directory + "/map.json", none),
             is_run = fs::exists(directory + "/result.json", none);
  if (!name.empty() && !is_run)
    throw sim::Error(sim::ErrorKind::usage, "there is no fit with several sheets")
        .key("--name")
        .expected("the directory of a fit");
  if (flux_factor > 0.0 && !is_map)
    throw sim::Error(sim::ErrorKind::usage, "the electrons are not those of a map")
        .key("--flux-factor")
        .expected("the directory of a map");
  if (is_map) return of_map(directory, flux_factor);
  if (is_run) return of_run(directory, name);
  if (file_name.size() > 5 && file_name.substr(file_name.size() - 5) == ".json") return of_inversion(path);
  return of_table(path);
}

}  // namespace vegard::fit
