#include "apps/commands/electrons/electron_plot.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace vegard::apps {
namespace {

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

}  // namespace

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

}  // namespace vegard::apps
