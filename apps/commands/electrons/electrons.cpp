#include "apps/commands/commands.h"

#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "apps/commands/electrons/electron_plot.h"
#include "apps/commands/electrons/electron_texts.h"
#include "apps/options/exit_code.h"
#include "apps/options/file_names.h"
#include "apps/options/refusals.h"
#include "apps/options/standard_streams.h"
#include "apps/output/plot_file.h"
#include "sim/base/file/csv_table.h"
#include "sim/base/file/input_file.h"
#include "sim/base/file/whole_file.h"
#include "sim/light/ionisation.h"
#include "sim/light/transport/electron_transport.h"

namespace vegard::apps {
namespace {

struct ElectronsRequest {
  std::string spectrum = "maxwellian", pitch = "isotropic", table, atmosphere, output, plot;
  std::optional<double> energy_kev, spread, kappa, potential_kev;
  double flux_mw_m2 = 1.0, dip_deg = 90.0;
  bool overwrite = false;
};

sim::SpectrumKind kind_of(const std::string& word) {
  if (word == "mono") return sim::SpectrumKind::mono;
  if (word == "gaussian") return sim::SpectrumKind::gaussian;
  if (word == "kappa") return sim::SpectrumKind::kappa;
  if (word == "accelerated") return sim::SpectrumKind::accelerated;
  if (word == "table") return sim::SpectrumKind::table;
  return sim::SpectrumKind::maxwellian;
}

/// An option that belongs to one spectrum alone.
void refuse_elsewhere(const std::optional<double>& value, const char* option, const ElectronsRequest& request,
                      const char* spectrum) {
  if (value && request.spectrum != spectrum)
    throw usage_error(option, "a spectrum of the kind '" + request.spectrum + "' has no such number",
                      std::string("--spectrum ") + spectrum + " beside it");
}

sim::IncidentSpectrum table_spectrum(const std::string& file) {
  const sim::CsvTable table =
      sim::read_csv_table(sim::input_bytes(file, "a table of the columns energy_keV and flux"), file);
  table.require_increasing("energy_keV");
  table.require_within("energy_keV", sim::kLeastSpectrumKev, sim::kHighestKev);
  table.require_within("flux", 0.0, 1e300);
  sim::IncidentSpectrum spectrum;
  spectrum.kind = sim::SpectrumKind::table;
  spectrum.table_energy_kev = table.column("energy_keV");
  spectrum.table_flux = table.column("flux");
  double most = 0.0;
  for (const double flux : spectrum.table_flux) most = flux > most ? flux : most;
  if (table.rows() < 2 || most <= 0.0)
    sim::refuse_file(sim::ErrorKind::unreadable_input, file, "the table has no electrons",
                     "two rows or more, a flux above 0 in one of them");
  return spectrum;
}

sim::IncidentSpectrum spectrum_of(const ElectronsRequest& request) {
  refuse_elsewhere(request.spread, "--spread", request, "gaussian");
  refuse_elsewhere(request.kappa, "--kappa", request, "kappa");
  refuse_elsewhere(request.potential_kev, "--potential-kev", request, "accelerated");
  if (request.spectrum == "table") {
    if (request.table.empty())
      throw usage_error("--spectrum", "a table has no name", "--spectrum-table FILE.csv beside it");
    if (request.energy_kev)
      throw usage_error("--energy-kev", "a table has its energies", "no --energy-kev beside it");
    return table_spectrum(request.table);
  }
  if (!request.table.empty())
    throw usage_error("--spectrum-table", "the spectrum is of the kind '" + request.spectrum + "'",
                      "--spectrum table beside it");
  if (!request.energy_kev)
    throw usage_error("--energy-kev", "it is missing", "the energy of the electrons in keV, such as 5");
  sim::IncidentSpectrum spectrum;
  spectrum.kind = kind_of(request.spectrum);
  spectrum.energy_kev = *request.energy_kev;
  spectrum.spread = request.spread.value_or(spectrum.spread);
  spectrum.kappa = request.kappa.value_or(spectrum.kappa);
  if (spectrum.kind == sim::SpectrumKind::accelerated) {
    if (!request.potential_kev)
      throw usage_error("--potential-kev", "it is missing", "what the electrons have fallen through, in keV");
    spectrum.potential_kev = *request.potential_kev;
  }
  return spectrum;
}

std::string electron_words(const ElectronsRequest& request, const sim::IncidentSpectrum& spectrum) {
  std::string words = request.spectrum;
  if (spectrum.kind == sim::SpectrumKind::table)
    words += " " + file_name_of(request.table);
  else
    words += fmt::format(", {:g} keV", spectrum.energy_kev);
  if (spectrum.kind == sim::SpectrumKind::gaussian) words += fmt::format(", spread {:g}", spectrum.spread);
  if (spectrum.kind == sim::SpectrumKind::kappa) words += fmt::format(", kappa {:g}", spectrum.kappa);
  if (spectrum.kind == sim::SpectrumKind::accelerated)
    words += fmt::format(", through {:g} kV", spectrum.potential_kev);
  return words +
         fmt::format(", {:g} mW m^-2, {}, dip {:g} deg", request.flux_mw_m2, request.pitch, request.dip_deg);
}

/// Fang's ion pairs of the same electrons, from 0.1 keV up, as far as the formula goes.
std::vector<double> fang_rates(const sim::FieldAir& column, const sim::EnergyGrid& grid,
                               const std::vector<double>& flux) {
  constexpr double kLeastEv = 100.0;
  std::vector<double> rates(column.size(), 0.0);
  for (std::size_t m = 0; m < column.size(); ++m) {
    const sim::StoppingAir air = sim::stopping_air(column, m);
    for (std::size_t j = 0; j < grid.size(); ++j) {
      if (flux[j] <= 0.0 || grid.energy_ev[j] < kLeastEv) continue;
      const double mw_m2 = flux[j] * grid.energy_ev[j] / sim::kEvPerErg;
      rates[m] += mw_m2 * std::exp(sim::log_ionisation(air, 1e-3 * grid.energy_ev[j]).value);
    }
  }
  return rates;
}

/// An air whose density jumps, or that is thick where electrons begin, is not what the places are made for.
void require_balance(const ElectronsRequest& request, const sim::ElectronBudget& budget) {
  constexpr double kMostMissing = 0.03;
  if (request.atmosphere.empty() || std::abs(budget.missing_share()) <= kMostMissing) return;
  sim::refuse_file(sim::ErrorKind::unreadable_input, request.atmosphere,
                   fmt::format("the energy of the electrons does not balance in this air, {:.0f} % of it",
                               100.0 * std::abs(budget.missing_share())),
                   "densities that fall off smoothly, to where electrons pass freely at the top");
}

int run_electrons(const ElectronsRequest& request) {
  const PlotFormat format = plot_format(request.plot, "--plot");
  for (const auto& [key, file] : {std::pair{"--output", request.output}, std::pair{"--plot", request.plot}})
    for (const std::string& input : {request.table, request.atmosphere})
      if (same_file(file, input)) refuse_same_file(key, file, "an input");
  if (same_file(request.plot, request.output)) refuse_same_file("--plot", request.plot, "another output");
  const sim::IncidentSpectrum spectrum = spectrum_of(request);
  const sim::AirTable air =
      request.atmosphere.empty()
          ? sim::standard_air_table()
          : sim::read_air_table(sim::input_bytes(request.atmosphere,
                                                 "a table of the columns altitude_km, T_K, nN2, nO2 and nO"),
                                request.atmosphere);
  std::optional<sim::WholeFile> output, plot;
  if (!request.output.empty()) output.emplace(request.output, request.overwrite);
  if (format != PlotFormat::none) plot.emplace(request.plot, request.overwrite);

  const sim::FieldAir column = sim::field_air(air, request.dip_deg);
  const sim::Degradation degradation =
      sim::degradation(sim::energy_grid(1e3 * sim::highest_energy_kev(spectrum)));
  const std::vector<double> flux = sim::incident_flux(spectrum, degradation.grid, request.flux_mw_m2);
  const auto angles =
      request.pitch == "isotropic" ? sim::PitchAngles::isotropic : sim::PitchAngles::field_aligned;
  const sim::ElectronRates rates = sim::electron_transport(degradation, column, flux, angles);

  require_balance(request, rates.budget);

  ElectronRun run;
  run.electrons = electron_words(request, spectrum);
  run.atmosphere =
      request.atmosphere.empty() ? "U.S. Standard Atmosphere 1976" : file_name_of(request.atmosphere);
  if (angles == sim::PitchAngles::isotropic && request.dip_deg == 90.0)
    run.fang_cm3_s = fang_rates(column, degradation.grid, flux);
  if (output) output->write(electron_rates_csv(run, column, rates));
  if (plot)
    plot->write(plot_bytes(
        electron_plot(column, rates, run.fang_cm3_s, run.electrons + "; " + run.atmosphere), format));
  if (output) output->commit();
  if (plot) plot->commit();
  say_text(electron_budget_text(run, column, rates));
  return good;
}

}  // namespace

void add_electrons_command(Program& program) {
  const auto options = std::make_shared<ElectronsRequest>();
  const Command command = program.add(
      "electrons", "Follow electrons down through the air: ion pairs, excitations and energy by altitude");
  command.option("--spectrum", options->spectrum, "Energies of the electrons")
      .one_of({"mono", "gaussian", "maxwellian", "kappa", "accelerated", "table"})
      .shows_default();
  command
      .option("--energy-kev", options->energy_kev,
              "E0: their energy (mono, gaussian), or half the mean of a Maxwellian's")
      .finite_range(sim::kLeastSpectrumKev, sim::kMostSpectrumKev);
  command.option("--spread", options->spread, "Standard deviation of a Gaussian over E0 (default: 0.1)")
      .finite_range(0.01, 1.0);
  command.option("--kappa", options->kappa, "Kappa of such a spectrum (default: 5)").finite_range(2.1, 100.0);
  command
      .option("--potential-kev", options->potential_kev,
              "Energy that accelerated electrons have gained, in keV")
      .finite_range(0.0, sim::kMostSpectrumKev);
  command
      .option("--spectrum-table", options->table,
              "Number flux against energy: columns energy_keV and flux, in any unit (needs --spectrum table)")
      .type_name("FILE.csv");
  command.option("--flux-mw-m2", options->flux_mw_m2, "Energy flux through a plane across the field")
      .finite_range(1e-6, 1e4)
      .shows_default();
  command.option("--pitch", options->pitch, "Directions: all downwards alike, or along the field")
      .one_of({"isotropic", "field-aligned"})
      .shows_default();
  command.option("--dip-deg", options->dip_deg, "Inclination of the field to the horizontal")
      .finite_range(10.0, 90.0)
      .shows_default();
  command
      .option("--atmosphere", options->atmosphere,
              "Columns altitude_km, T_K, nN2, nO2, nO in km, K and cm^-3 (default: U.S. Standard Atmosphere "
              "1976)")
      .type_name("FILE.csv");
  command.option("-o,--output", options->output, "The rates by altitude").type_name("OUT.csv");
  command.option("--plot", options->plot, "Draw them").type_name("OUT.svg|OUT.png");
  command.flag("--overwrite", options->overwrite, "Replace outputs that exist");
  command.runs([options] { return run_electrons(*options); });
}

}  // namespace vegard::apps
