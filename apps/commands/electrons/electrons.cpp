#include "apps/commands/commands.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "apps/commands/electrons/electron_options.h"
#include "apps/options/exit_code.h"
#include "apps/options/file_names.h"
#include "apps/options/json_answer.h"
#include "apps/options/standard_streams.h"
#include "apps/output/plot_file.h"
#include "fit/report/plot/plot.h"
#include "sim/base/file/csv_table.h"
#include "sim/base/file/whole_file.h"
#include "sim/light/tables/ionisation.h"
#include "sim/light/transport/electron_transport.h"

namespace vegard::apps {
namespace {

/// The request in words, and the ionisation by the formula of Fang et al. 2010 at the column's altitudes
/// (empty if the electrons are not isotropic or the field is not vertical).
struct ElectronRun {
  std::string electrons;   ///< "Maxwellian, E0 5 keV, 1 mW m^-2, isotropic"
  std::string atmosphere;  ///< "U.S. Standard Atmosphere 1976"
  std::vector<double> fang_cm3_s;
};

struct Column {
  std::string name;
  const std::vector<double>* rate;
};

struct Peak {
  double altitude_km = 0.0, rate = 0.0;
};

Peak peak_of(const sim::FieldAir& column, const std::vector<double>& rate) {
  const auto highest = static_cast<std::size_t>(std::max_element(rate.begin(), rate.end()) - rate.begin());
  return {column.altitude_km[highest], rate[highest]};
}

std::vector<double> all_ion_pairs(const sim::FieldAir& column, const sim::ElectronRates& rates) {
  std::vector<double> all;
  for (std::size_t m = 0; m < column.size(); ++m) all.push_back(rates.all_ion_pairs(m));
  return all;
}

/// Returns CSV with a row per altitude from the bottom up: altitude_km, ion pairs (all, of each gas, Fang's),
/// energy, and a column for each excitation and ionised shell.
std::string electron_rates_csv(const ElectronRun& run, const sim::FieldAir& column,
                               const sim::ElectronRates& rates) {
  const std::vector<double> all = all_ion_pairs(column, rates);
  std::vector<Column> columns = {{"altitude_km", &column.altitude_km}, {"ion_pairs_cm3_s", &all}};
  for (std::size_t g = 0; g < sim::kGases; ++g)
    columns.push_back({"ion_pairs_" + sim::gas_collisions(static_cast<sim::Gas>(g)).name + "_cm3_s",
                       &rates.ion_pairs_cm3_s[g]});
  if (!run.fang_cm3_s.empty()) columns.push_back({"fang2010_cm3_s", &run.fang_cm3_s});
  columns.push_back({"deposited_eV_cm3_s", &rates.deposited_ev_cm3_s});
  for (std::size_t g = 0; g < sim::kGases; ++g) {
    const sim::GasCollisions& collisions = sim::gas_collisions(static_cast<sim::Gas>(g));
    for (std::size_t e = 0; e < collisions.excitations.size(); ++e)
      columns.push_back({collisions.excitations[e].name, &rates.excitation_cm3_s[g][e]});
    for (std::size_t s = 0; s < collisions.shells.size(); ++s)
      columns.push_back({collisions.shells[s].name, &rates.shell_cm3_s[g][s]});
  }
  std::string text =
      sim::csv_comment("electrons: " + run.electrons) + sim::csv_comment("atmosphere: " + run.atmosphere) +
      sim::csv_comment("rates: cm^-3 s^-1 where no unit is named, excitations before cascades");
  for (std::size_t c = 0; c < columns.size(); ++c)
    text += (c > 0 ? "," : "") + sim::csv_cell(columns[c].name);
  text += "\n";
  for (std::size_t m = 0; m < column.size(); ++m) {
    for (std::size_t c = 0; c < columns.size(); ++c)
      text += (c > 0 ? "," : "") + fmt::format("{:.6g}", (*columns[c].rate)[m]);
    text += "\n";
  }
  return text;
}

/// Returns lines of text: the energy budget, eV per ion pair, the peak, and the comparison with Fang's
/// formula.
std::string electron_budget_text(const ElectronRun& run, const sim::FieldAir& column,
                                 const sim::ElectronRates& rates) {
  const sim::ElectronBudget& budget = rates.budget;
  const auto line = [&](const char* what, double ev) {
    return fmt::format("  {:<44}{:8.2f} %\n", what, 100.0 * ev / budget.incident_ev);
  };
  std::string text = fmt::format("electrons: {}\natmosphere: {}, {:.0f} to {:.0f} km\n", run.electrons,
                                 run.atmosphere, column.altitude_km.front(), column.altitude_km.back());
  text += "of their energy:\n";
  text += line("excites molecules and atoms", budget.excitation_ev);
  text += line("ionises them", budget.ionisation_ev);
  text += line("is left in electrons below 0.3 eV", budget.thermal_ev);
  text += line("comes back through the top", budget.back_ev);
  text += line("leaves through the bottom", budget.through_ev);
  text += line("is missing (the error of the grids)", budget.missing_share() * budget.incident_ev);
  text += fmt::format("of their number {:.0f} % comes back, secondary electrons among it\n",
                      100.0 * budget.back_number / budget.incident_number);
  const Peak peak = peak_of(column, all_ion_pairs(column, rates));
  text += fmt::format("ion pairs: {:.3g} cm^-2 s^-1, {:.1f} eV each, most at {:.1f} km, {:.4g} cm^-3 s^-1\n",
                      budget.ion_pairs, budget.ev_per_ion_pair(), peak.altitude_km, peak.rate);
  if (run.fang_cm3_s.empty()) return text;
  const Peak fang = peak_of(column, run.fang_cm3_s);
  text += fmt::format("Fang et al. 2010: {:.3g} cm^-2 s^-1, most at {:.1f} km, {:.4g} cm^-3 s^-1\n",
                      sim::path_integral(column, run.fang_cm3_s), fang.altitude_km, fang.rate);
  return text;
}

/// The same as JSON.
std::string electron_budget_json(const ElectronRun& run, const sim::FieldAir& column,
                                 const sim::ElectronRates& rates) {
  const sim::ElectronBudget& budget = rates.budget;
  const Peak peak = peak_of(column, all_ion_pairs(column, rates));
  Json json = {{"electrons", run.electrons},
               {"atmosphere", run.atmosphere},
               {"bottom_km", column.altitude_km.front()},
               {"top_km", column.altitude_km.back()},
               {"share_of_energy",
                {{"excitation", budget.excitation_ev / budget.incident_ev},
                 {"ionisation", budget.ionisation_ev / budget.incident_ev},
                 {"thermal", budget.thermal_ev / budget.incident_ev},
                 {"back", budget.back_ev / budget.incident_ev},
                 {"through", budget.through_ev / budget.incident_ev},
                 {"missing", budget.missing_share()}}},
               {"share_of_number_back", budget.back_number / budget.incident_number},
               {"ion_pairs_cm2_s", budget.ion_pairs},
               {"ev_per_ion_pair", budget.ev_per_ion_pair()},
               {"peak_km", peak.altitude_km},
               {"peak_ion_pairs_cm3_s", peak.rate}};
  if (!run.fang_cm3_s.empty()) {
    const Peak fang = peak_of(column, run.fang_cm3_s);
    json["fang2010"] = {{"ion_pairs_cm2_s", sim::path_integral(column, run.fang_cm3_s)},
                        {"peak_km", fang.altitude_km},
                        {"peak_ion_pairs_cm3_s", fang.rate}};
  }
  return json.dump();
}

constexpr double kDecades = 4.0;  // below the largest rate that are drawn
constexpr std::size_t kStatesOfGas = 2;
constexpr double kMinLossEv = 1.5;  // of excitations that are drawn: vibration hides the others
constexpr double kHighestKm = 400.0;

double largest_rate(const std::vector<double>& rate) { return *std::max_element(rate.begin(), rate.end()); }

fit::Series series_of(const std::string& label, fit::Colour colour, const std::vector<double>& altitude_km,
                      const std::vector<double>& rate) {
  fit::Series series;
  series.label = label;
  series.colour = colour;
  for (std::size_t m = 0; m < rate.size(); ++m) {
    if (altitude_km[m] > kHighestKm) break;
    series.x.push_back(rate[m] > 0.0 ? std::log10(rate[m]) : std::numeric_limits<double>::quiet_NaN());
    series.y.push_back(altitude_km[m]);
  }
  return series;
}

fit::Panel rate_panel(const char* title, double most) {
  fit::Panel panel;
  panel.title = title;
  panel.x.label = "log10(rate in cm^-3 s^-1)";
  panel.y.label = "altitude (km)";
  if (most > 0.0) {
    panel.x.max = std::log10(most) + 0.2;
    panel.x.min = std::log10(most) - kDecades;
  }
  return panel;
}

/// Two panels, altitude upwards: ion pairs of each gas, of all gases and, if not empty, `fang_cm3_s`; and for
/// each gas the two most frequent excitations of 1.5 eV or more.
fit::Plot electron_plot(const sim::FieldAir& column, const sim::ElectronRates& rates,
                        const std::vector<double>& fang_cm3_s, const std::string& note) {
  std::vector<double> all;
  for (std::size_t m = 0; m < column.size(); ++m) all.push_back(rates.all_ion_pairs(m));
  double most_excited = 0.0;
  for (const auto& gas : rates.excitation_cm3_s)
    for (const std::vector<double>& rate : gas) most_excited = std::max(most_excited, largest_rate(rate));
  fit::Panel ions = rate_panel("Ion pairs", largest_rate(all)),
             excitations = rate_panel("Excitations", most_excited);
  ions.series.push_back(series_of("all", fit::distinct_colour(0), column.altitude_km, all));
  for (std::size_t g = 0; g < sim::kGases; ++g) {
    const sim::GasCollisions& collisions = sim::gas_collisions(static_cast<sim::Gas>(g));
    ions.series.push_back(series_of(collisions.name, fit::distinct_colour(static_cast<int>(g) + 1),
                                    column.altitude_km, rates.ion_pairs_cm3_s[g]));
    std::vector<std::size_t> order;
    for (std::size_t e = 0; e < collisions.excitations.size(); ++e)
      if (collisions.excitations[e].curve.loss_ev >= kMinLossEv) order.push_back(e);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return largest_rate(rates.excitation_cm3_s[g][a]) > largest_rate(rates.excitation_cm3_s[g][b]);
    });
    order.resize(std::min(order.size(), kStatesOfGas));
    for (std::size_t state = 0; state < order.size(); ++state) {
      const std::size_t e = order[state];
      excitations.series.push_back(series_of(collisions.excitations[e].name,
                                             fit::distinct_colour(static_cast<int>(g) + 1),
                                             column.altitude_km, rates.excitation_cm3_s[g][e]));
      if (state > 0) excitations.series.back().mark = fit::Mark::dashed_line;
    }
  }
  if (!fang_cm3_s.empty()) {
    fit::Series fang = series_of("Fang et al. 2010", fit::distinct_colour(4), column.altitude_km, fang_cm3_s);
    fang.mark = fit::Mark::dashed_line;
    ions.series.push_back(fang);
  }
  fit::Plot plot;
  plot.title = "Electrons in the air";
  plot.note = note;
  plot.panels = {ions, excitations};
  return plot;
}

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
  protect_outputs({{"--output", request.output}, {"--plot", request.plot}},
                  {request.electrons.table, air_file(request.electrons.atmosphere)});
  const ElectronOptions& electrons = request.electrons;
  const sim::IncidentSpectrum spectrum = spectrum_of(electrons);
  const sim::AirTable air = air_of_choice(electrons.atmosphere);
  sim::WholeFiles outputs({request.output, request.plot}, request.overwrite);

  const sim::FieldAir column = sim::field_air(air, electrons.dip_deg);
  const sim::Degradation degradation =
      sim::degradation(sim::energy_grid(1e3 * sim::highest_energy_kev(spectrum)));
  const std::vector<double> flux = sim::incident_flux(spectrum, degradation.grid, electrons.flux_mw_m2);
  const sim::PitchAngles angles = pitch_angles_of(electrons);
  const sim::ElectronRates rates = sim::electron_transport(degradation, column, flux, angles);

  require_balance(electrons, rates.budget.missing_share());

  ElectronRun run;
  run.electrons = electron_words(electrons, spectrum);
  run.atmosphere = words_of_air(electrons.atmosphere);
  if (angles == sim::PitchAngles::isotropic && electrons.dip_deg == 90.0)
    run.fang_cm3_s = fang_rates(column, degradation.grid, flux);
  if (!request.output.empty()) outputs.write(request.output, electron_rates_csv(run, column, rates));
  if (format != PlotFormat::none)
    outputs.write(request.plot, plot_bytes(electron_plot(column, rates, run.fang_cm3_s,
                                                         run.electrons + "; " + run.atmosphere),
                                           format));
  outputs.commit();
  answer_with(electron_budget_json(run, column, rates));
  json_answer()["outputs"] = json_names(outputs.written());
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
