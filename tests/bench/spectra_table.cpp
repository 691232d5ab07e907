// Maxwellians made out of mono-energetic electrons beside those of GLOW's tables: the tables of
// docs/validation.md, "Mono-energetic electrons". Prints Markdown; with --plot OUT.svg draws height profiles
// of the spectra side by side.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "fit/report/plot/plot.h"
#include "sim/light/spectrum_profile.h"
#include "sim/light/tables/emission_table.h"
#include "sim/light/tables/emission_tables.h"
#include "sim/light/tables/mono_table.h"
#include "sim/scene/lines/emission_lines.h"
#include "tests/support/glow.h"

namespace vegard::bench {
namespace {

using Curve = std::vector<double>;  ///< at the altitudes of the tables

const sim::EmissionTable& glow() { return tests::glow().tables.maxwellian(); }

/// By trapezoids, times 1e5 cm per km.
double column(const Curve& curve) {
  const Curve& z = glow().altitudes_km();
  double sum = 0.0;
  for (std::size_t a = 0; a + 1 < z.size(); ++a)
    sum += 0.5 * (curve[a] + curve[a + 1]) * (z[a + 1] - z[a]) * 1e5;
  return sum;
}

/// Of the parabola through the logarithms about the largest.
double peak_km(const Curve& curve) {
  const Curve& z = glow().altitudes_km();
  const auto i = static_cast<std::size_t>(std::max_element(curve.begin(), curve.end()) - curve.begin());
  if (i == 0 || i + 1 == curve.size()) return z[i];
  const double below = std::log(curve[i] / curve[i - 1]) / (z[i] - z[i - 1]);
  const double above = std::log(curve[i + 1] / curve[i]) / (z[i + 1] - z[i]);
  return 0.5 * (z[i - 1] + z[i]) - below * 0.5 * (z[i + 1] - z[i - 1]) / (above - below);
}

/// The share of the light that is elsewhere when both have the same column.
double difference_of_shape(const Curve& a, const Curve& b) {
  Curve off;
  const double of_a = column(a), of_b = column(b);
  for (std::size_t i = 0; i < a.size(); ++i) off.push_back(0.5 * std::abs(a[i] / of_a - b[i] / of_b));
  return column(off);
}

Curve of_tables(const std::string& name, double e0) {
  Curve curve;
  for (const sim::Emission1d& emission : glow().at_energy(name, e0)) curve.push_back(emission.rate);
  return curve;
}

/// The Maxwellian made out of pieces; rates_of(energy) are logarithms at the altitudes of the tables.
template <class RatesOf>
Curve of_pieces(double e0, const RatesOf& rates_of) {
  Curve curve(glow().altitudes_km().size(), 0.0);
  for (const sim::SpectrumPiece& piece : sim::maxwellian_pieces(e0)) {
    if (piece.share < 1e-12) continue;
    const auto rates = rates_of(piece.energy_kev);
    for (std::size_t a = 0; a < curve.size(); ++a) curve[a] += piece.share * std::exp(rates[a].value);
  }
  return curve;
}

std::vector<sim::LogRate> ion_pairs(double energy_kev) {
  std::vector<sim::LogRate> rates;
  for (const sim::StoppingAir& air : tests::glow().tables.air())
    rates.push_back(sim::log_ionisation(air, energy_kev));
  return rates;
}

Curve profile_curve(const sim::HeightProfile& profile) {
  Curve curve;
  for (const double z : glow().altitudes_km())
    curve.push_back(profile.rate[static_cast<std::size_t>(std::lround((z - 80.0) / 0.25)) * profile.stride]);
  return curve;
}

/// Below the peak, where the light has fallen to a tenth of it; km below the peak.
double tenth_below_km(const sim::HeightProfile& profile) {
  int peak = 0;
  const auto rate = [&](int a) { return profile.rate[static_cast<std::size_t>(a) * profile.stride]; };
  for (int a = 0; a < sim::HeightProfile::kAltitudes; ++a)
    if (rate(a) > rate(peak)) peak = a;
  int a = peak;
  while (a > 0 && rate(a) > 0.1f * rate(peak)) --a;
  return (peak - a) * sim::HeightProfile::kStepKm;
}

constexpr double kEnergies[] = {0.1, 0.22387, 0.50119, 1.0, 1.9953, 3.1623, 5.0119, 10.0, 19.953};

void print_ionisation() {
  fmt::print(
      "| E0 (keV) | GLOW: eV per pair | peak (km) | Fang 2010: eV per pair | peak off by (km) | shape off by "
      "| "
      "with s(E): peak off by (km) | shape off by |\n|---|---|---|---|---|---|---|---|\n");
  constexpr double kEv = 6.241509074e11;  // per cm^2 and s in 1 mW m^-2
  for (const double e0 : kEnergies) {
    const Curve tables = of_tables("ionisation_electron", e0), fang = of_pieces(e0, ion_pairs);
    const Curve ranged =
        of_pieces(e0, [](double energy) { return ion_pairs(sim::range_energy_kev(energy)); });
    fmt::print("| {:.3g} | {:.1f} | {:.1f} | {:.1f} | {:+.1f} | {:.1f} % | {:+.1f} | {:.1f} % |\n", e0,
               kEv / column(tables), peak_km(tables), kEv / column(fang), peak_km(fang) - peak_km(tables),
               100.0 * difference_of_shape(fang, tables), peak_km(ranged) - peak_km(tables),
               100.0 * difference_of_shape(ranged, tables));
  }
}

void print_lines() {
  std::vector<double> lines;
  for (const sim::EmissionLine& line : sim::emission_lines())
    if (sim::is_auroral(line)) lines.push_back(line.wavelength_nm);
  fmt::print("\n| E0 (keV) |");
  for (const double line : lines) fmt::print(" {:.1f} |", line);
  fmt::print("\n|---|");
  for (std::size_t l = 0; l < lines.size(); ++l) fmt::print("---|");
  fmt::print("\n");
  for (const double e0 : kEnergies) {
    fmt::print("| {:.3g} |", e0);
    for (const double line : lines) {
      const std::string name = sim::find_emission_line(line)->table_column;
      const Curve tables = of_tables(name, e0);
      const Curve made =
          of_pieces(e0, [&](double energy) { return tests::glow().tables.mono().at_energy(name, energy); });
      fmt::print(" {:+.1f} %, {:+.1f} km, {:.1f} % |", 100.0 * (column(made) / column(tables) - 1.0),
                 peak_km(made) - peak_km(tables), 100.0 * difference_of_shape(made, tables));
    }
    fmt::print("\n");
  }
}

double reach(bool as_in_glow, double energy) { return as_in_glow ? sim::range_energy_kev(energy) : energy; }

/// The choices that were open, before the one correction: whose ion pairs a line's light is per, and how deep
/// the electrons reach.
void print_choices() {
  struct Choice {
    const char* words;
    bool per_glows_pair, reaches_as_in_glow;
  };
  constexpr Choice kChoices[] = {{"Fang 2010, light per ion pair of GLOW", true, false},
                                 {"the same, light per ion pair of its own Maxwellian", false, false},
                                 {"with s(E), light per ion pair of GLOW", true, true},
                                 {"with s(E), light per ion pair of its own Maxwellian", false, true}};
  constexpr double kSome[] = {0.50119, 1.9953, 10.0};
  fmt::print("\n| 427.8 nm |");
  for (const double e0 : kSome) fmt::print(" E0 {:.1f} keV |", e0);
  fmt::print("\n|---|---|---|---|\n");
  for (const Choice& choice : kChoices) {
    const auto pairs = [&](double energy) { return ion_pairs(reach(choice.reaches_as_in_glow, energy)); };
    const auto light = [&](double energy) {
      const double e0 = std::clamp(0.5 * energy, glow().energies_kev().front(), glow().energies_kev().back());
      const Curve line = of_tables("ver_4278", e0);
      const Curve per = choice.per_glows_pair ? of_tables("ionisation_electron", e0) : of_pieces(e0, pairs);
      std::vector<sim::LogRate> rates = pairs(energy);
      // Both with the floor that the tables' lines have.
      const double floor = 1e-6 * *std::max_element(per.begin(), per.end());
      for (std::size_t a = 0; a < rates.size(); ++a)
        rates[a].value += std::log(line[a] / std::max(per[a], floor));
      return rates;
    };
    fmt::print("| {} |", choice.words);
    for (const double e0 : kSome) {
      const Curve tables = of_tables("ver_4278", e0), made = of_pieces(e0, light);
      fmt::print(" {:+.1f} %, {:+.1f} km, {:.1f} % |", 100.0 * (column(made) / column(tables) - 1.0),
                 peak_km(made) - peak_km(tables), 100.0 * difference_of_shape(made, tables));
    }
    fmt::print("\n");
  }
}

void print_spectra() {
  fmt::print(
      "\n| mean energy (keV) | Maxwellian: peak, tenth below it (km), column (R) | Gaussian, spread 0.2 | "
      "one energy "
      "|\n|---|---|---|---|\n");
  for (const double mean : {0.5, 1.0, 2.0, 5.0, 10.0, 20.0}) {
    fmt::print("| {:g} |", mean);
    for (const sim::HeightProfile& profile : {sim::maxwellian_profile(tests::glow(), {557.7}, 0.5 * mean),
                                              sim::gaussian_profile(tests::glow(), {557.7}, mean, 0.2),
                                              sim::mono_profile(tests::glow(), {557.7}, mean)}) {
      fmt::print(" {:.1f}, {:.2f}, {:.0f} |", peak_km(profile_curve(profile)), tenth_below_km(profile),
                 sim::column_below(profile, 0, 640.0).rayleigh);
    }
    fmt::print("\n");
  }
}

fit::Series series(const std::string& label, int colour, const sim::HeightProfile& profile) {
  fit::Series s;
  s.label = label;
  s.colour = fit::distinct_colour(colour);
  for (int a = 0; a < sim::HeightProfile::kAltitudes; ++a) {
    if (sim::HeightProfile::altitude_km(a) > 200.0) break;
    s.x.push_back(profile.rate[static_cast<std::size_t>(a) * profile.stride]);
    s.y.push_back(sim::HeightProfile::altitude_km(a));
  }
  return s;
}

fit::Plot spectra_plot() {
  fit::Plot plot;
  plot.title = "Light of 557.7 nm by the electrons' spectrum";
  plot.note = "per 1 mW/m^2";
  for (const double mean : {2.0, 10.0}) {
    fit::Panel panel;
    panel.title = fmt::format("mean energy {:g} keV", mean);
    panel.x.label = "photons per cm^3 and s";
    panel.y.label = "altitude (km)";
    panel.series.push_back(
        series("Maxwellian", 0, sim::maxwellian_profile(tests::glow(), {557.7}, 0.5 * mean)));
    panel.series.push_back(
        series("Gaussian, spread 0.2", 1, sim::gaussian_profile(tests::glow(), {557.7}, mean, 0.2)));
    panel.series.push_back(series("one energy", 2, sim::mono_profile(tests::glow(), {557.7}, mean)));
    plot.panels.push_back(panel);
  }
  return plot;
}

}  // namespace
}  // namespace vegard::bench

int main(int argc, char** argv) {
  vegard::bench::print_ionisation();
  vegard::bench::print_choices();
  vegard::bench::print_lines();
  vegard::bench::print_spectra();
  if (argc == 3 && std::string(argv[1]) == "--plot")
    std::ofstream(argv[2]) << vegard::fit::plot_svg(vegard::bench::spectra_plot());
  return 0;
}
