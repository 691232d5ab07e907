// The program's light beside GLOW's own columns, as Markdown (docs/validation.md has some of it):
//
//     build/release/tests/glow_table
//
// GLOW's: data/glow/column_brightness.csv, the model's full columns at Q = 1 mW m^-2.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

#include "sim/scene/lines/emission_lines.h"
#include "tests/support/glow.h"

namespace vegard::bench {
namespace {

constexpr double kLowestHighEnergyKev = 17.0;  // above it more than 1 % of 427.8 nm lies below 80 km

std::vector<sim::EmissionLine> lines_with_columns() {
  std::vector<sim::EmissionLine> lines;
  for (const sim::EmissionLine& line : sim::emission_lines())
    if (line.ratio == 1.0) lines.push_back(line);
  return lines;
}

/// The altitude of the table at which a line is brightest, at one of its energies.
double brightest_row_km(const std::string& column, double energy_kev) {
  const sim::EmissionTable& table = tests::glow().tables.maxwellian();
  const std::vector<sim::Emission1d> rates = table.at_energy(column, energy_kev);
  const auto brightest =
      std::max_element(rates.begin(), rates.end(),
                       [](const sim::Emission1d& a, const sim::Emission1d& b) { return a.rate < b.rate; });
  return table.altitudes_km()[static_cast<std::size_t>(brightest - rates.begin())];
}

void print_columns(const tests::GlowColumns& glow) {
  fmt::print(
      "| E0, keV | peak, km: 630.0 | 557.7 | 427.8 | column, R: 630.0 | 557.7 | 427.8 | 630.0/427.8 | "
      "557.7/427.8 |\n|---|---|---|---|---|---|---|---|---|\n");
  const std::vector<double>& energies = glow.energies_kev();
  for (const std::size_t i : {0u, 7u, 14u, 20u, 26u, 30u, 34u, 40u, 44u, 46u}) {
    fmt::print("| {:.4g} |", energies[i]);
    double own[3], theirs[3];
    const double lines[] = {630.0, 557.7, 427.8};
    for (int l = 0; l < 3; ++l) {
      const sim::HeightProfile profile = sim::maxwellian_profile(tests::glow(), {lines[l]}, energies[i]);
      fmt::print(" {:.1f} / {:.0f} |", sim::peak_altitude_km(profile),
                 brightest_row_km(sim::find_emission_line(lines[l])->table_column, energies[i]));
      own[l] = tests::program_column(lines[l], energies[i]).rayleigh;
      theirs[l] = glow.rayleigh(lines[l])[i];
    }
    for (int l = 0; l < 3; ++l) fmt::print(" {:.5g} / {:.5g} |", own[l], theirs[l]);
    for (int l = 0; l < 2; ++l) fmt::print(" {:.4g} / {:.4g} |", own[l] / own[2], theirs[l] / theirs[2]);
    fmt::print("\n");
  }
}

struct Largest {
  double deviation = 0.0, at_kev = 0.0;
  void take(double d, double energy_kev) {
    if (std::abs(d) > std::abs(deviation)) deviation = d, at_kev = energy_kev;
  }
  std::string percent() const { return fmt::format("{:+.2f} % ({:.3g} keV)", 100.0 * deviation, at_kev); }
  std::string number() const { return fmt::format("{:+.4f} ({:.3g} keV)", deviation, at_kev); }
};

void print_deviations(const tests::GlowColumns& glow) {
  fmt::print(
      "\n| line | at the table's energies | between them, beside a spline through GLOW's columns | at "
      "energies "
      "left out of the table | d ln(column)/d ln E0 less GLOW's differences | below 80 km at 17.8 / 20 keV "
      "|\n|---|---|---|---|---|---|\n");
  const sim::EmissionTable half = tests::every_second_energy();
  const std::vector<double>& energies = glow.energies_kev();
  for (const sim::EmissionLine& line : lines_with_columns()) {
    const double nm = line.wavelength_nm;
    const std::vector<double>& theirs = glow.rayleigh(nm);
    Largest sampled, between, left_out, slope;
    for (std::size_t i = 0; i < energies.size() && energies[i] < kLowestHighEnergyKev; ++i) {
      const sim::Column column = tests::program_column(nm, energies[i]);
      sampled.take(column.rayleigh / theirs[i] - 1.0, energies[i]);
      if (i > 0)
        slope.take(column.d_rayleigh_d_ln_energy / column.rayleigh - glow.difference(nm, i), energies[i]);
      if (i % 2 == 1)
        left_out.take(tests::column_of(half, line.table_column, energies[i]) / theirs[i] - 1.0, energies[i]);
      const double middle = std::sqrt(energies[i] * energies[i + 1]);
      if (middle < kLowestHighEnergyKev)
        between.take(
            tests::program_column(nm, middle).rayleigh / std::exp(glow.log_at(nm, middle).value) - 1.0,
            middle);
    }
    const auto below = [&](std::size_t i) {
      return 100.0 * (1.0 - tests::program_column(nm, energies[i]).rayleigh / theirs[i]);
    };
    fmt::print("| {:.1f} | {} | {} | {} | {} | {:.1f} / {:.1f} % |\n", nm, sampled.percent(),
               between.percent(), left_out.percent(), slope.number(), below(45), below(46));
  }
}

}  // namespace
}  // namespace vegard::bench

int main() {
  const vegard::tests::GlowColumns glow;
  vegard::bench::print_columns(glow);
  vegard::bench::print_deviations(glow);
  return 0;
}
