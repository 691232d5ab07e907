#include "apps/commands/commands.h"

#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "apps/commands/electrons/electron_options.h"
#include "apps/commands/electrons/electron_plot.h"
#include "apps/commands/electrons/electron_texts.h"
#include "apps/options/exit_code.h"
#include "apps/options/file_names.h"
#include "apps/options/json_answer.h"
#include "apps/options/refusals.h"
#include "apps/options/standard_streams.h"
#include "apps/output/plot_file.h"
#include "sim/base/file/csv_table.h"
#include "sim/base/file/input_file.h"
#include "sim/base/file/whole_file.h"
#include "sim/light/tables/ionisation.h"
#include "sim/light/transport/electron_transport.h"

namespace vegard::apps {
namespace {

struct ElectronsRequest {
  ElectronOptions electrons;
  std::string output, plot;
  bool overwrite = false;
};

/// Fang's ion pairs of the same electrons, from 0.1 keV up, as far as the formula goes.
std::vector<double> fang_rates(const sim::FieldAir& column, const sim::EnergyGrid& grid,
                               const std::vector<double>& flux) {
  constexpr double kMinEv = 100.0;
  std::vector<double> rates(column.size(), 0.0);
  for (std::size_t m = 0; m < column.size(); ++m) {
    const sim::StoppingAir air = sim::stopping_air(column, m);
    for (std::size_t j = 0; j < grid.size(); ++j) {
      if (flux[j] <= 0.0 || grid.energy_ev[j] < kMinEv) continue;
      const double mw_m2 = flux[j] * grid.energy_ev[j] / sim::kEvPerErg;
      rates[m] += mw_m2 * std::exp(sim::log_ionisation(air, 1e-3 * grid.energy_ev[j]).value);
    }
  }
  return rates;
}

int run_electrons(const ElectronsRequest& request) {
  const PlotFormat format = plot_format(request.plot, "--plot");
  for (const auto& [key, file] : {std::pair{"--output", request.output}, std::pair{"--plot", request.plot}})
    for (const std::string& input : {request.electrons.table, air_file(request.electrons.atmosphere)})
      if (same_file(file, input)) refuse_same_file(key, file, "an input");
  if (same_file(request.plot, request.output)) refuse_same_file("--plot", request.plot, "another output");
  const ElectronOptions& electrons = request.electrons;
  const sim::IncidentSpectrum spectrum = spectrum_of(electrons);
  const sim::AirTable air = air_of(electrons);
  std::optional<sim::WholeFile> output, plot;
  if (!request.output.empty()) output.emplace(request.output, request.overwrite);
  if (format != PlotFormat::none) plot.emplace(request.plot, request.overwrite);

  const sim::FieldAir column = sim::field_air(air, electrons.dip_deg);
  const sim::Degradation degradation =
      sim::degradation(sim::energy_grid(1e3 * sim::highest_energy_kev(spectrum)));
  const std::vector<double> flux = sim::incident_flux(spectrum, degradation.grid, electrons.flux_mw_m2);
  const sim::PitchAngles angles = pitch_angles_of(electrons);
  const sim::ElectronRates rates = sim::electron_transport(degradation, column, flux, angles);

  require_balance(electrons, rates.budget.missing_share());

  ElectronRun run;
  run.electrons = electron_words(electrons, spectrum);
  run.atmosphere = air_words(electrons);
  if (angles == sim::PitchAngles::isotropic && electrons.dip_deg == 90.0)
    run.fang_cm3_s = fang_rates(column, degradation.grid, flux);
  if (output) output->write(electron_rates_csv(run, column, rates));
  if (plot)
    plot->write(plot_bytes(
        electron_plot(column, rates, run.fang_cm3_s, run.electrons + "; " + run.atmosphere), format));
  if (output) output->commit();
  if (plot) plot->commit();
  answer_with(electron_budget_json(run, column, rates));
  json_answer()["outputs"] = json_names({request.output, request.plot});
  say_result(electron_budget_text(run, column, rates));
  return good;
}

}  // namespace

void add_electrons_command(Program& program) {
  const auto options = std::make_shared<ElectronsRequest>();
  const Command command = program.add(
      "electrons", "Follow electrons down through the air: ion pairs, excitations and energy by altitude");
  add_electron_options(command, options->electrons);
  command.option("-o,--output", options->output, "Write the rates by altitude").type_name("OUT.csv");
  command.option("--plot", options->plot, "Draw the rates").type_name("OUT.svg|OUT.png");
  command.flag("--overwrite", options->overwrite, "Replace outputs that exist");
  command.runs([options] { return run_electrons(*options); });
}

}  // namespace vegard::apps
