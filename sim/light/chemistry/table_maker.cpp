#include "sim/light/chemistry/table_maker.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdio>

#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "sim/base/version.h"
#include "sim/light/chemistry/line_sources.h"

namespace vegard::sim {
namespace {

constexpr double kFirstKm = 80.0, kLastKm = 640.0;
constexpr double kMinOfPeak = 1e-7;  // less is written as 0
constexpr const char* kIonisationColumn = "ionisation_electron";
constexpr std::array<double, 3> kFluxes = {0.1, 1.0, 10.0};  // mW m^-2, of the flux law

double rounded(const char* format, double value) { return std::stod(table_number(format, value)); }

std::vector<double> energies(double first, double last, int count) {
  std::vector<double> kev;
  for (int i = 0; i < count; ++i)
    kev.push_back(rounded("%.5g", first * std::pow(last / first, static_cast<double>(i) / (count - 1))));
  return kev;
}

/// Interpolates at an altitude: between two places a rate above 0 falls off exponentially.
double at_altitude(const FieldAir& column, const std::vector<double>& rate, double altitude_km) {
  const auto after = std::upper_bound(column.altitude_km.begin(), column.altitude_km.end() - 1, altitude_km);
  const auto high = static_cast<std::size_t>(std::max(after - column.altitude_km.begin(), std::ptrdiff_t{1}));
  const std::size_t low = high - 1;
  const double way = std::clamp(
      (altitude_km - column.altitude_km[low]) / (column.altitude_km[high] - column.altitude_km[low]), 0.0,
      1.0);
  if (rate[low] <= 0.0 || rate[high] <= 0.0) return (1.0 - way) * rate[low] + way * rate[high];
  return rate[low] * std::pow(rate[high] / rate[low], way);
}

std::string rates_csv(const std::vector<MadeCase>& cases, const std::vector<MadeLight>& lights,
                      SpectrumKind kind, const char* energy_name) {
  std::string text = std::string("oxygen_factor,") + energy_name + ",altitude_km";
  for (const std::string& name : lights.front().names) text += "," + name;
  text += "\n";
  const std::vector<double> altitudes = made_altitudes_km();
  for (std::size_t c = 0; c < cases.size(); ++c) {
    if (cases[c].kind != kind || cases[c].flux_mw_m2 != 1.0) continue;
    std::vector<double> least;
    for (const std::vector<double>& rate : lights[c].rates)
      least.push_back(kMinOfPeak * *std::max_element(rate.begin(), rate.end()));
    for (std::size_t a = 0; a < altitudes.size(); ++a) {
      text += table_number("%g", cases[c].oxygen) + table_number(",%.5g", cases[c].energy_kev) +
              table_number(",%g", altitudes[a]);
      for (std::size_t n = 0; n < least.size(); ++n) {
        const double rate = lights[c].rates[n][a];
        text += rate > least[n] ? table_number(",%.4e", rate) : ",0";
      }
      text += "\n";
    }
  }
  return text;
}

/// Returns the names of the columns of brightness: "R_5577" for "ver_5577".
std::string column_names(const MadeLight& light) {
  std::string text;
  for (const std::string& name : light.names)
    if (name != kIonisationColumn) text += ",R_" + name.substr(4);
  return text + "\n";
}

std::string columns_csv(const std::vector<MadeCase>& cases, const std::vector<MadeLight>& lights,
                        bool by_flux) {
  std::string text = (by_flux ? "Q_erg,E0_keV" : "E0_keV") + column_names(lights.front());
  for (std::size_t c = 0; c < cases.size(); ++c) {
    const MadeCase& which = cases[c];
    if (which.kind != SpectrumKind::maxwellian || which.oxygen != 1.0) continue;
    if (!by_flux && which.flux_mw_m2 != 1.0) continue;
    if (by_flux) text += table_number("%g,", which.flux_mw_m2);
    text += table_number("%.5g", which.energy_kev);
    for (const double rayleigh : lights[c].rayleigh) text += table_number(",%.6e", rayleigh);
    text += "\n";
  }
  return text;
}

std::string air_csv(const FieldAir& air) {
  std::string text = "altitude_km,T_K,nO,nO2,nN2,nNO,nN4S,Te_K\n";
  for (const double altitude : made_altitudes_km()) {
    text +=
        table_number("%g", altitude) + table_number(",%.2f", at_altitude(air, air.temperature_k, altitude));
    for (const Gas gas : {Gas::o, Gas::o2, Gas::n2})
      text +=
          table_number(",%.6e", at_altitude(air, air.density_cm3[static_cast<std::size_t>(gas)], altitude));
    text += table_number(",%.6e", at_altitude(air, air.no_cm3, altitude)) +
            table_number(",%.6e", at_altitude(air, air.n_cm3, altitude)) +
            table_number(",%.2f\n", at_altitude(air, air.electron_temperature_k, altitude));
  }
  return text;
}

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return result + "\"";
}

std::string about_json(const TableRequest& request) {
  std::string factors;
  for (const double factor : request.oxygen_factors)
    factors += (factors.empty() ? "" : ", ") + table_number("%g", factor);
  return std::string("{\n  \"format\": \"vegard emission tables 1\",\n  \"made_by\": \"vegard tables ") +
         version() + "\",\n  \"licence\": \"MIT\",\n  \"atmosphere\": " + quoted(request.air_name) +
         ",\n  \"reactions\": " + quoted(request.reactions_name) +
         ",\n  \"seconds\": " + (std::isinf(request.seconds) ? "null" : table_number("%g", request.seconds)) +
         ",\n  \"dip_deg\": " + table_number("%g", request.dip_deg) +
         ",\n  \"refinement\": " + table_number("%g", request.refinement) + ",\n  \"oxygen_factors\": [" +
         factors + "]" +
         (request.draws > 0 ? ",\n  \"mode_draws\": " + std::to_string(request.draws) +
                                  ",\n  \"mode_seed\": " + std::to_string(request.seed)
                            : "") +
         "\n}\n";
}

}  // namespace

std::string table_number(const char* format, double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

std::vector<double> usual_maxwellian_kev() {
  std::vector<double> kev = energies(0.1, 15.849, 23);
  kev.push_back(20.0);
  return kev;
}

std::vector<double> usual_mono_kev() { return energies(0.05, 100.0, 54); }

std::vector<double> made_altitudes_km() {
  constexpr std::array<std::array<double, 2>, 5> kStepsTo = {
      {{130.0, 1.0}, {160.0, 2.0}, {250.0, 5.0}, {400.0, 10.0}, {kLastKm, 20.0}}};
  std::vector<double> altitudes = {kFirstKm};
  for (const auto& [to, step] : kStepsTo)
    while (altitudes.back() < to) altitudes.push_back(altitudes.back() + step);
  return altitudes;
}

MadeLight made_light(const MadeCase& which, const TableRequest& request, const Degradation& degradation) {
  IncidentSpectrum spectrum;
  spectrum.kind = which.kind;
  spectrum.energy_kev = which.energy_kev;
  const FieldAir air =
      field_air(with_oxygen_factor(request.air, which.oxygen), request.dip_deg, request.refinement);
  const AuroralRun run =
      auroral_run(degradation, air, incident_flux(spectrum, degradation.grid, which.flux_mw_m2),
                  PitchAngles::isotropic, request.reactions, request.seconds);
  if (std::abs(run.rates.budget.missing_share()) > kMaxMissingShare)
    throw unreadable(request.air_file.empty() ? request.air_name : request.air_file,
                     "the energy of the electrons does not balance in this air")
        .expected("densities that fall off smoothly, to where electrons pass freely at the top");
  MadeLight light;
  const auto add = [&](const std::string& name, const std::vector<double>& rate) {
    light.names.push_back(name);
    light.rates.emplace_back();
    for (const double altitude : made_altitudes_km())
      light.rates.back().push_back(at_altitude(run.column, rate, altitude) / which.flux_mw_m2);
  };
  for (const SourcedLine& line : run.light.lines) {
    const std::vector<double> photons = line.photons_cm3_s();
    add(line.column, photons);
    light.rayleigh.push_back(column_rayleigh(run.column, photons));
  }
  std::vector<double> pairs;
  for (std::size_t m = 0; m < run.column.size(); ++m) pairs.push_back(run.rates.all_ion_pairs(m));
  add(kIonisationColumn, pairs);
  return light;
}

Degradation table_degradation(const TableRequest& request, const std::map<int, double>& factor_of_process) {
  IncidentSpectrum fastest;
  fastest.energy_kev = request.maxwellian_kev.back();
  return degradation(energy_grid(1e3 * std::max(highest_energy_kev(fastest),
                                                request.mono_kev.empty() ? 0.0 : request.mono_kev.back()),
                                 request.refinement),
                     factor_of_process);
}

void require_air_of_tables(const TableRequest& request) {
  if (request.air.altitude_km.front() > kFirstKm || request.air.altitude_km.back() < kLastKm)
    throw unreadable(request.air_file, "the air reaches from " +
                                           table_number("%g", request.air.altitude_km.front()) + " to " +
                                           table_number("%g km", request.air.altitude_km.back()))
        .expected("a table from 80 km or below to 640 km or above, as emission tables have it");
}

MadeTables make_tables(const TableRequest& request, int threads,
                       const std::function<void(std::size_t, std::size_t)>& progress) {
  require_air_of_tables(request);
  std::vector<MadeCase> cases;
  for (const double oxygen : request.oxygen_factors) {
    for (const double energy : request.maxwellian_kev)
      for (const double flux : kFluxes)
        if (flux == 1.0 || oxygen == 1.0) cases.push_back({SpectrumKind::maxwellian, oxygen, energy, flux});
    for (const double energy : request.mono_kev) cases.push_back({SpectrumKind::mono, oxygen, energy, 1.0});
  }
  const Degradation all = table_degradation(request);
  std::vector<MadeLight> lights(cases.size());
  std::atomic<std::size_t> done{0};
  parallel_for(cases.size(), threads, [&](std::size_t c, int) {
    lights[c] = made_light(cases[c], request, all);
    const std::size_t now = ++done;
    if (progress) progress(now, cases.size());
  });
  return {
      {"ver_maxwellian.csv", rates_csv(cases, lights, SpectrumKind::maxwellian, "E0_keV")},
      {"ver_mono.csv", rates_csv(cases, lights, SpectrumKind::mono, "E_keV")},
      {"column_brightness.csv", columns_csv(cases, lights, false)},
      {"linearity_Q.csv", columns_csv(cases, lights, true)},
      {"atmosphere.csv", air_csv(field_air(request.air, request.dip_deg, request.refinement))},
      {"about.json", about_json(request)},
  };
}

}  // namespace vegard::sim
