#include "fit/report/quenching_plot.h"

#include <cmath>
#include <set>
#include <string>

#include <fmt/format.h>

#include "sim/light/excited_atom.h"
#include "sim/scene/lines/emission_lines.h"

namespace vegard::fit {
namespace {

constexpr double kBottomKm = 80.0, kTopKm = 500.0, kQuenchingStepKm = 2.0;

/// "630.0 and 636.4 nm, O, 110 s"
std::string label_of(const sim::EmissionLine& line) {
  std::string names;
  for (const sim::EmissionLine& other : sim::emission_lines())
    if (std::string(other.table_column) == line.table_column)
      names += fmt::format("{}{:.1f}", names.empty() ? "" : " and ", other.wavelength_nm);
  return fmt::format("{} nm, {}, T = {} s", names, line.species,
                     line.lifetime_s < 100.0 ? fmt::format("{:.2g}", line.lifetime_s)
                                             : fmt::format("{:.0f}", line.lifetime_s));
}

}  // namespace

Plot quenching_plot() {
  Plot plot;
  plot.title = "Quenching of the slow lines";
  plot.note =
      "U.S. Standard Atmosphere 1976; without collisions an atom lives T; electrons and NO are left out";
  Panel shine, life;
  shine.x.label = "share of the excited atoms that shine, τ/T";
  shine.x.min = 0.0;
  shine.x.max = 1.05;
  shine.y.label = "altitude (km)";
  life.x.label = "log₁₀(mean life τ in seconds)";
  life.y = shine.y;
  std::set<std::string> drawn;
  for (const sim::EmissionLine& line : sim::emission_lines()) {
    if (sim::is_prompt(line) || !drawn.insert(line.table_column).second) continue;
    Series share, lifetime;
    share.label = label_of(line);
    share.colour = line_ink(line.wavelength_nm);
    lifetime.label = share.label;
    lifetime.colour = share.colour;
    for (double altitude = kBottomKm; altitude <= kTopKm; altitude += kQuenchingStepKm) {
      const double tau = sim::effective_lifetime_s(line, sim::standard_air(altitude));
      share.x.push_back(tau / line.lifetime_s);
      lifetime.x.push_back(std::log10(tau));
      share.y.push_back(altitude);
      lifetime.y.push_back(altitude);
    }
    shine.series.push_back(share);
    life.series.push_back(lifetime);
  }
  plot.panels = {shine, life};
  return plot;
}

}  // namespace vegard::fit
