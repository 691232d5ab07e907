#include "fit/report/netcdf/model_inputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "fit/report/netcdf/conductance.h"
#include "sim/base/error.h"
#include "sim/base/file/input_file.h"
#include "sim/base/file/whole_directory.h"
#include "sim/base/file/whole_file.h"
#include "sim/base/text.h"
#include "sim/base/utc_time.h"
#include "sim/base/version.h"

namespace vegard::fit {
namespace {

using sim::NetcdfDataset;

constexpr const char* kGeminiMark = "vegard.json";
constexpr const char* kGeminiKind = "vegard to-gemini";
constexpr const char* kSecondsOfTime = "seconds since 1970-01-01 00:00:00";

sim::KnownFolder look_at_gemini(const std::string& directory) {
  sim::KnownFolder known;
  const sim::InputFile mark = sim::read_input(directory + "/" + kGeminiMark);
  const nlohmann::json json = nlohmann::json::parse(mark.bytes, nullptr, false);
  if (!mark.problem.empty())
    known.objection = std::string("its ") + kGeminiMark + " " + mark.problem;
  else if (!json.is_object() || !json.contains("kind") || json["kind"] != kGeminiKind)
    known.objection = std::string("its ") + kGeminiMark + " is none that vegard wrote";
  known.has = [](const std::string& name) {
    return name == kGeminiMark || name == "simsize.h5" || name == "simgrid.h5" ||
           sim::has_form(name, "00000000_00000.000000.h5");
  };
  return known;
}

sim::DirectoryKind gemini_kind() { return {"inputs of GEMINI", look_at_gemini, {kGeminiMark}}; }

void scale_flux(PrecipitationPlanes& map, double factor) {
  for (double& flux : map.energy_flux_mw_m2) flux *= factor;
}

/// The energy where nothing falls, which GEMINI must not take for 0.
double energy_of_the_dark(const GeographicMap& map) {
  std::vector<double> energies;
  for (const double energy : map.energy_kev)
    if (std::isfinite(energy)) energies.push_back(energy);
  if (energies.empty()) return 1.0;
  const auto middle = energies.begin() + static_cast<std::ptrdiff_t>(energies.size() / 2);
  std::nth_element(energies.begin(), middle, energies.end());
  return *middle;
}

/// How many cells no picture constrains.
std::size_t unknown_cells(const GeographicMap& map) {
  return static_cast<std::size_t>(std::count_if(map.energy_flux_mw_m2.begin(), map.energy_flux_mw_m2.end(),
                                                [](double flux) { return !std::isfinite(flux); }));
}

std::string source_words() { return "vegard " + sim::version(); }

NetcdfDataset gemini_frame(const ModelInputs& inputs, std::size_t which) {
  const GeographicMap& map = inputs.maps[which];
  NetcdfDataset frame("precipitation for GEMINI", source_words());
  frame.attribute("time", sim::utc_text(inputs.times_s[which]));
  frame.dimension("mlat", inputs.grid.latitude_deg.size());
  frame.dimension("mlon", inputs.grid.longitude_deg.size());
  constexpr double kElectronVolts = 1000.0;
  const double dark_ev = kElectronVolts * energy_of_the_dark(map);
  std::vector<double> flux, energy;
  std::vector<int> known;
  for (std::size_t i = 0; i < inputs.grid.cells(); ++i) {
    // GEMINI interpolates all cells and needs a number in each: what is unknown says so beside it.
    known.push_back(std::isfinite(map.energy_flux_mw_m2[i]) ? 1 : 0);
    flux.push_back(known.back() != 0 ? map.energy_flux_mw_m2[i] : 0.0);
    energy.push_back(std::isfinite(map.energy_kev[i]) ? kElectronVolts * map.energy_kev[i] : dark_ev);
  }
  frame.real("mlat", "magnetic latitude", "degree", {"mlat"}, inputs.grid.latitude_deg);
  frame.real("mlon", "magnetic longitude", "degree", {"mlon"}, inputs.grid.longitude_deg);
  // The last dimension runs fastest, as the first does in Fortran: (llon, llat) there.
  frame.real("Qp", "total energy flux", "mW m-2", {"mlat", "mlon"}, flux);
  frame.whole("known", "1 where a picture tells the energy flux, 0 where Qp stands for what is unknown", "1",
              {"mlat", "mlon"}, known);
  frame.real("E0p", "characteristic energy of Maxwellian electrons", "eV", {"mlat", "mlon"}, energy);
  return frame;
}

std::string gemini_json(const ModelInputs& inputs) {
  nlohmann::ordered_json json;
  json["kind"] = kGeminiKind;
  json["version"] = sim::version();
  json["maps"] = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < inputs.maps.size(); ++i)
    json["maps"].push_back({{"map", inputs.names[i]},
                            {"time", sim::utc_text(inputs.times_s[i])},
                            {"file", gemini_file_name(inputs.times_s[i])},
                            {"dark_energy_ev", 1000.0 * energy_of_the_dark(inputs.maps[i])},
                            {"unknown_cells", unknown_cells(inputs.maps[i])}});
  json["frame"] = "centred dipole, pole at colatitude 11 degrees and longitude 289 degrees";
  json["longitudes"] = inputs.grid.longitude_deg.size();
  json["latitudes"] = inputs.grid.latitude_deg.size();
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string base_name(std::string directory) {
  while (directory.size() > 1 && directory.back() == '/') directory.pop_back();
  return std::filesystem::path(directory).filename().string();
}

}  // namespace

ModelInputs model_inputs(const std::vector<std::string>& directories, EarthFrame frame, double step_deg,
                         double flux_factor, std::optional<double> time_s) {
  if (flux_factor < 0.0 || !std::isfinite(flux_factor))
    throw sim::Error(sim::ErrorKind::usage, "fluxes cannot be negative")
        .key("--flux-factor")
        .expected("a number above 0");
  if (time_s && directories.size() != 1)
    throw sim::Error(sim::ErrorKind::usage, "several maps have a time each")
        .key("--time")
        .expected("one map with it");
  struct Dated {
    PrecipitationPlanes map;
    std::string name;
  };
  std::vector<Dated> dated;
  for (const std::string& directory : directories) {
    Dated one{read_precipitation_planes(directory), base_name(directory)};
    if (time_s) one.map.time_s = time_s;
    if (!one.map.time_s)
      throw sim::unreadable(directory, "this map says no time")
          .expected("a map of a scene with site.time_utc")
          .hint("--time says it of a single map");
    if (!one.map.flux_is_absolute && flux_factor == 0.0)
      throw sim::unreadable(
          directory, "its energy flux is right up to a factor only, since the sensor is not calibrated")
          .expected("a map with FLUXCAL = 'absolute'")
          .hint("--flux-factor F says that factor, if it is known from elsewhere");
    if (one.map.spectrum != "maxwellian")
      throw sim::unreadable(directory, "its electrons have the spectrum " + one.map.spectrum)
          .expected("a map of Maxwellian electrons, whose energies these models take");
    if (flux_factor > 0.0) scale_flux(one.map, flux_factor);
    dated.push_back(std::move(one));
  }
  std::stable_sort(dated.begin(), dated.end(),
                   [](const Dated& a, const Dated& b) { return *a.map.time_s < *b.map.time_s; });
  ModelInputs inputs;
  std::vector<PrecipitationPlanes> maps;
  for (Dated& one : dated) {
    if (!inputs.times_s.empty() && !(*one.map.time_s > inputs.times_s.back()))
      throw sim::Error(sim::ErrorKind::usage, "two maps are of the time " + sim::utc_text(*one.map.time_s))
          .key("MAP")
          .expected("a time of its own for each map");
    inputs.times_s.push_back(*one.map.time_s);
    inputs.names.push_back(one.name);
    maps.push_back(std::move(one.map));
  }
  inputs.grid = grid_over(maps, frame, step_deg);
  for (const PrecipitationPlanes& map : maps) inputs.maps.push_back(on_grid(map, inputs.grid));
  return inputs;
}

NetcdfDataset lompe_dataset(const ModelInputs& inputs) {
  NetcdfDataset dataset("energy flux, energy and conductances by electrons", source_words());
  dataset.attribute("maps", sim::joined(inputs.names, "\n"));
  dataset.attribute("references",
                    "Robinson et al. 1987, J. Geophys. Res. 92, 2565-2569: conductances, by electrons alone");
  const std::vector<std::string> by = {"time", "lat", "lon"};
  dataset.dimension("time", inputs.maps.size());
  dataset.dimension("lat", inputs.grid.latitude_deg.size());
  dataset.dimension("lon", inputs.grid.longitude_deg.size());
  dataset.real("time", "when the photograph was taken", kSecondsOfTime, {"time"}, inputs.times_s)
      .with("standard_name", "time")
      .with("calendar", "standard");
  dataset
      .real("lat", "geographic latitude of the feet at 110 km, on the sphere", "degrees_north", {"lat"},
            inputs.grid.latitude_deg)
      .with("standard_name", "latitude");
  dataset
      .real("lon", "geographic longitude of the feet at 110 km", "degrees_east", {"lon"},
            inputs.grid.longitude_deg)
      .with("standard_name", "longitude");
  std::vector<double> flux, flux_sigma, energy, energy_sigma, mean, sp, sp_sigma, sh, sh_sigma;
  for (const GeographicMap& map : inputs.maps)
    for (std::size_t i = 0; i < inputs.grid.cells(); ++i) {
      const double q = map.energy_flux_mw_m2[i], e = map.energy_kev[i];
      const Conductances c = conductances(q, e, map.relative_flux_error[i], map.ln_energy_error[i]);
      flux.push_back(q);
      flux_sigma.push_back(q * map.relative_flux_error[i]);
      energy.push_back(e);
      energy_sigma.push_back(e * map.ln_energy_error[i]);
      mean.push_back(2.0 * e);
      sp.push_back(c.pedersen_s);
      sp_sigma.push_back(c.pedersen_s * c.relative_pedersen_error);
      sh.push_back(c.hall_s);
      sh_sigma.push_back(c.hall_s * c.relative_hall_error);
    }
  const auto with_error = [&](const std::string& name, const std::string& long_name, const std::string& unit,
                              const std::vector<double>& values, const std::vector<double>& sigmas) {
    dataset.real(name, long_name, unit, by, values).with("ancillary_variables", name + "_sigma");
    dataset.real(name + "_sigma", "standard error of " + name, unit, by, sigmas);
  };
  with_error("energy_flux", "energy flux of the electrons", "mW m-2", flux, flux_sigma);
  with_error("energy", "characteristic energy E0 of Maxwellian electrons", "keV", energy, energy_sigma);
  dataset.real("mean_energy", "mean energy of the electrons, 2 E0", "keV", by, mean);
  with_error("SP", "Pedersen conductance by electrons", "S", sp, sp_sigma);
  with_error("SH", "Hall conductance by electrons", "S", sh, sh_sigma);
  return dataset;
}

std::string gemini_file_name(double time_s) {
  constexpr long long kMicro = 1000000, kDay_s = 86400;
  const long long micro = std::llround(time_s * kMicro);
  const long long day = (micro >= 0 ? micro : micro - kDay_s * kMicro + 1) / (kDay_s * kMicro);
  const long long of_day = micro - day * kDay_s * kMicro;
  std::string date = sim::utc_text(static_cast<double>(day * kDay_s)).substr(0, 10);
  date.erase(std::remove(date.begin(), date.end(), '-'), date.end());
  return fmt::format("{}_{:05}.{:06}.h5", date, of_day / kMicro, of_day % kMicro);
}

void check_gemini_directory(const std::string& directory, bool overwrite) {
  sim::WholeDirectory(directory, overwrite, gemini_kind());
}

void write_gemini(const std::string& directory, bool overwrite, const ModelInputs& inputs) {
  sim::WholeDirectory whole(directory, overwrite, gemini_kind());
  const auto put = [&](const std::string& name, const NetcdfDataset& dataset) {
    dataset.write(whole.file(name), directory + "/" + name);
  };
  NetcdfDataset size("size of the grid of precipitation for GEMINI", source_words());
  size.whole("llon", "longitudes", "1", {}, {static_cast<int>(inputs.grid.longitude_deg.size())});
  size.whole("llat", "latitudes", "1", {}, {static_cast<int>(inputs.grid.latitude_deg.size())});
  put("simsize.h5", size);
  NetcdfDataset grid("grid of precipitation for GEMINI", source_words());
  grid.dimension("mlon", inputs.grid.longitude_deg.size());
  grid.dimension("mlat", inputs.grid.latitude_deg.size());
  grid.real("mlon", "magnetic longitude", "degree", {"mlon"}, inputs.grid.longitude_deg);
  grid.real("mlat", "magnetic latitude", "degree", {"mlat"}, inputs.grid.latitude_deg);
  put("simgrid.h5", grid);
  for (std::size_t i = 0; i < inputs.maps.size(); ++i)
    put(gemini_file_name(inputs.times_s[i]), gemini_frame(inputs, i));
  sim::write_whole(whole.file(kGeminiMark), gemini_json(inputs));
  whole.commit();
}

}  // namespace vegard::fit
