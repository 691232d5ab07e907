#include "apps/commands/electrons/electron_texts.h"

#include <algorithm>
#include <cstddef>

#include <fmt/format.h>

#include "apps/options/json_answer.h"
#include "sim/base/file/csv_text.h"

namespace vegard::apps {
namespace {

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

}  // namespace

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

}  // namespace vegard::apps
