// Spectra from made densities: what is found, and whether intervals hold.
#include "fit/radar/density_inversion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>

#include "fit/radar/profile_solution.h"
#include "sim/base/error.h"
#include "sim/base/number/constants.h"
#include "sim/base/number/distributions.h"
#include "sim/base/number/random.h"

namespace vegard::fit::density_inversion_test {
namespace {

std::vector<double> altitudes() {
  std::vector<double> all;
  for (double altitude = 85.0; altitude <= 150.0; altitude += 5.0) all.push_back(altitude);
  return all;
}

const DensityPhysics& physics() {
  static const DensityPhysics one(sim::emission_tables("vegard"), {}, sim::RecombinationLaw::chemistry,
                                  altitudes());
  return one;
}

double random_of(std::uint32_t made, std::uint32_t number) {
  return sim::uniform(sim::random_words(5, sim::Stream::search, made, number)[0]);
}
double normal(std::uint32_t made, std::uint32_t number) {
  return sim::normal_quantile(random_of(made, number));
}

/// Energy flux by bin: a Maxwellian, a Gaussian and a kappa distribution in turn.
Eigen::VectorXd made_flux(int kind, double e0_kev, double flux_mw_m2) {
  Eigen::VectorXd flux(static_cast<Eigen::Index>(physics().bins().count()));
  for (Eigen::Index j = 0; j < flux.size(); ++j) {
    const double e = physics().bins().middle_kev(static_cast<std::size_t>(j)) / e0_kev;
    flux[j] = kind == 0   ? std::pow(e, 3.0) * std::exp(-e)
              : kind == 1 ? e * e * std::exp(-0.5 * std::pow((e - 2.0) / 0.8, 2.0))
                          : std::pow(e, 3.0) * std::pow(1.0 + e / 4.0, -5.0);
  }
  return flux * (flux_mw_m2 / flux.sum());
}

/// The density in balance with pairs and with a factor on the recombination.
double balanced(std::size_t place, double pairs, double factor) {
  double ln_density = 11.0;
  for (int i = 0; i < 100; ++i) {
    const double coefficient =
        factor * physics().recombination(place, std::exp(ln_density)).coefficient_cm3_s;
    ln_density = 0.5 * ln_density + 0.25 * std::log(pairs / coefficient);
  }
  return std::exp(ln_density);
}

struct Truth {
  double energy_flux = 0.0, mean_energy = 0.0;
};
Truth truth_of(const Eigen::VectorXd& flux) {
  const EnergyRange range = known_energies(physics(), {});
  double sum = 0.0, number = 0.0;
  for (std::size_t j = range.first; j < range.first + range.count; ++j) {
    sum += flux[static_cast<Eigen::Index>(j)];
    number += flux[static_cast<Eigen::Index>(j)] / physics().bins().middle_kev(j);
  }
  return {sum, sum / number};
}

bool holds(const SampledNumber& number, double truth) {
  return truth >= number.low68 && truth <= number.high68;
}

// Other physics in each, by draws that the inversion does not use, and noise of 5 % and 3e9 m^-3.
TEST(DensityInversion, IntervalsHold) {
  constexpr std::uint32_t kMade = 24;
  DensityTable table;
  table.altitude_km = altitudes();
  std::vector<Truth> truths;
  for (std::uint32_t made = 0; made < kMade; ++made) {
    const Eigen::VectorXd flux =
        made_flux(static_cast<int>(made % 3), 1.5 * std::pow(6.0, random_of(made, 1)),
                  std::pow(30.0, random_of(made, 2)));
    truths.push_back(truth_of(flux));
    const Eigen::VectorXd pairs = physics().pairs() * flux;
    Eigen::VectorXd usual(pairs.size());
    for (Eigen::Index i = 0; i < pairs.size(); ++i)
      usual[i] = balanced(static_cast<std::size_t>(i), pairs[i], 1.0);
    const DensityPhysics::Change change = physics().drawn(1, 1000 + made, flux, usual);
    DensityProfile profile;
    profile.time_s = sim::kNaN;
    for (Eigen::Index i = 0; i < pairs.size(); ++i) {
      const double density = balanced(static_cast<std::size_t>(i), pairs[i] * std::exp(change.ln_pairs[i]),
                                      std::exp(change.ln_recombination[i]));
      const double sigma = 0.05 * density + 3e3;
      profile.density_cm3.push_back(density + sigma * normal(made, 10 + static_cast<std::uint32_t>(i)));
      profile.sigma_cm3.push_back(sigma);
    }
    table.profiles.push_back(profile);
  }
  DensityInversionOptions options;
  options.samples = 200;
  const std::vector<DensitySpectrum> found = invert_densities(physics(), table, options);
  std::uint32_t flux_held = 0, energy_held = 0, contradicting = 0;
  for (std::uint32_t made = 0; made < kMade; ++made) {
    flux_held += holds(found[made].energy_flux_mw_m2, truths[made].energy_flux) ? 1u : 0u;
    energy_held += holds(found[made].mean_energy_kev, truths[made].mean_energy) ? 1u : 0u;
    contradicting += found[made].contradicts() ? 1u : 0u;
  }
  // By the binomial distribution 24 intervals that hold in 68 % are outside of 10 to 22 by chance 0.003.
  EXPECT_GE(flux_held, 10u);
  EXPECT_LE(flux_held, 22u);
  EXPECT_GE(energy_held, 10u);
  EXPECT_LE(energy_held, 22u);
  EXPECT_EQ(contradicting, 0u);  // by chance 0.06
}

/// Profiles 10 s apart of electrons whose energy flux by bin is given, with noise of 2 % and 3e9 m^-3.
DensityTable made_sequence(const std::vector<Eigen::VectorXd>& fluxes) {
  DensityTable table;
  table.altitude_km = altitudes();
  constexpr double kStepS = 10.0, kRelative = 0.02, kLeastSigmaCm3 = 3e3;
  constexpr int kParts = 10;  // of a step, in which recombination follows the density
  std::vector<double> now;
  for (std::size_t i = 0; i < table.altitude_km.size(); ++i)
    now.push_back(balanced(i, (physics().pairs() * fluxes.front())[static_cast<Eigen::Index>(i)], 1.0));
  for (std::size_t t = 0; t < fluxes.size(); ++t) {
    const Eigen::VectorXd pairs = physics().pairs() * fluxes[t];
    DensityProfile profile;
    profile.time_s = kStepS * static_cast<double>(t);
    for (std::size_t i = 0; i < now.size(); ++i) {
      double mean = 0.0;
      for (int part = 0; part < kParts; ++part) {
        const sim::GrownDensity grown =
            sim::grown_density(pairs[static_cast<Eigen::Index>(i)],
                               physics().recombination(i, now[i]).coefficient_cm3_s, now[i], kStepS / kParts);
        now[i] = grown.end.value;
        mean += grown.mean.value / kParts;
      }
      const double sigma = kRelative * mean + kLeastSigmaCm3;
      profile.density_cm3.push_back(
          mean + sigma * normal(static_cast<std::uint32_t>(100 + t), static_cast<std::uint32_t>(i)));
      profile.sigma_cm3.push_back(sigma);
    }
    table.profiles.push_back(profile);
  }
  return table;
}

/// The flux rises from 2 to 20 mW m^-2 at once, after two profiles.
DensityTable onset() {
  const Eigen::VectorXd few = made_flux(0, 3.0, 2.0), many = 10.0 * few;
  return made_sequence({few, few, many, many, many});
}

// Electrons above 85 km need some 10 s to become as many as they will be: a steady state asks for too little.
TEST(DensityInversion, InTimeFindsTheFluxOfAnOnset) {
  const DensityTable table = onset();
  DensityInversionOptions options;
  options.has_uncertainty = false;
  options.samples = 300;
  const double truth = truth_of(made_flux(0, 3.0, 20.0)).energy_flux;
  const double steady = invert_densities(physics(), table, options)[2].energy_flux_mw_m2.value;
  options.is_steady = false;
  const std::vector<DensitySpectrum> in_time = invert_densities(physics(), table, options);
  EXPECT_LT(steady, 0.7 * truth);
  // Within its 95 % interval at the onset, and within 10 % when the density has followed.
  EXPECT_GT(in_time[2].energy_flux_mw_m2.high95, truth);
  EXPECT_NEAR(in_time[2].energy_flux_mw_m2.value, truth, 0.15 * truth);
  EXPECT_NEAR(in_time[4].energy_flux_mw_m2.value, truth, 0.1 * truth);
}

// ln Q takes steps of 0.4, ln E0 of 0.15.
TEST(DensityInversion, IntervalsInTimeHold) {
  constexpr std::uint32_t kTimes = 12;
  std::vector<Eigen::VectorXd> fluxes;
  double ln_flux = std::log(6.0), ln_e0 = std::log(3.0);
  for (std::uint32_t t = 0; t < kTimes; ++t) {
    fluxes.push_back(made_flux(0, std::exp(ln_e0), std::exp(ln_flux)));
    ln_flux += 0.4 * normal(800 + t, 0);
    ln_e0 += 0.15 * normal(800 + t, 1);
  }
  DensityInversionOptions options;
  options.is_steady = options.has_uncertainty = false;
  options.samples = 200;
  const std::vector<DensitySpectrum> found = invert_densities(physics(), made_sequence(fluxes), options);
  std::uint32_t flux_held = 0, energy_held = 0;
  for (std::uint32_t t = 0; t < kTimes; ++t) {
    flux_held += holds(found[t].energy_flux_mw_m2, truth_of(fluxes[t]).energy_flux) ? 1u : 0u;
    energy_held += holds(found[t].mean_energy_kev, truth_of(fluxes[t]).mean_energy) ? 1u : 0u;
  }
  // By the binomial distribution 12 intervals that hold in 68 % are outside of 4 to 11 by chance 0.013.
  EXPECT_GE(flux_held, 4u);
  EXPECT_LE(flux_held, 11u);
  EXPECT_GE(energy_held, 4u);
  EXPECT_LE(energy_held, 11u);
}

// A profile with four altitudes, and one that no electrons make; the others have their numbers.
TEST(DensityInversion, HasNoNumbersWhereThereIsNoAnswer) {
  DensityTable table = onset();
  table.profiles.resize(4);
  for (std::size_t i = 4; i < table.altitude_km.size(); ++i) {
    table.profiles[0].density_cm3[i] = table.profiles[0].sigma_cm3[i] = sim::kNaN;
    table.profiles[2].density_cm3[i] *= i % 2 == 0 ? 0.3 : 3.0;
  }
  DensityInversionOptions options;
  options.has_uncertainty = false;
  options.samples = 50;
  for (const bool is_steady : {true, false}) {
    options.is_steady = is_steady;
    const std::vector<DensitySpectrum> found = invert_densities(physics(), table, options);
    EXPECT_FALSE(found[0].has_numbers() || found[0].contradicts());
    EXPECT_TRUE(found[1].has_numbers() && found[3].has_numbers());
    EXPECT_FALSE(found[2].has_numbers());
    EXPECT_TRUE(found[2].contradicts());
    EXPECT_TRUE(std::isnan(found[2].flux_cm2_s_kev[20].high95));
  }
}

DensityTable table_at_times(int times) {
  DensityTable table;
  table.altitude_km = altitudes();
  for (int t = 0; t < times; ++t) table.profiles.push_back({60.0 * t, {}, {}});
  return table;
}

// Errors whose squares are beyond numbers, and densities as no electrons make them.
TEST(DensityInversion, HasNoNumbersWithoutAFiniteAnswer) {
  struct Case {
    double density_cm3, sigma_cm3;
  };
  DensityInversionOptions options;
  options.samples = 5;
  for (const Case& made : {Case{0.0, 1e-300}, Case{1e24, 1e3}}) {
    DensityTable table = table_at_times(2);
    for (DensityProfile& profile : table.profiles) {
      profile.density_cm3.assign(table.altitude_km.size(), made.density_cm3);
      profile.sigma_cm3.assign(table.altitude_km.size(), made.sigma_cm3);
    }
    for (const bool is_steady : {true, false}) {
      options.is_steady = is_steady;
      for (const DensitySpectrum& one : invert_densities(physics(), table, options)) {
        EXPECT_FALSE(one.has_numbers()) << made.density_cm3 << " " << made.sigma_cm3;
        EXPECT_TRUE(std::isnan(one.energy_flux_mw_m2.value));
        EXPECT_TRUE(one.degrees_of_freedom >= 0.0 || std::isnan(one.degrees_of_freedom));
      }
    }
  }
}

// As exact as a density may be, its flux is no better known than physics is, so smaller errors change little.
TEST(DensityInversion, SmallErrorsLeaveTheUncertaintyOfPhysics) {
  const Eigen::VectorXd flux = made_flux(0, 4.0, 8.0), pairs = physics().pairs() * flux;
  DensityTable table = table_at_times(2);
  for (DensityProfile& profile : table.profiles) {
    const double sigma_cm3 = profile.time_s == 0.0 ? 1e3 : 1e2;  // 1e9 and 1e8 m^-3
    for (std::size_t i = 0; i < table.altitude_km.size(); ++i)
      profile.density_cm3.push_back(balanced(i, pairs[static_cast<Eigen::Index>(i)], 1.0));
    profile.sigma_cm3.assign(table.altitude_km.size(), sigma_cm3);
  }
  DensityInversionOptions options;
  options.samples = 300;
  const std::vector<DensitySpectrum> found = invert_densities(physics(), table, options);
  std::vector<double> width;
  for (const DensitySpectrum& one : found) {
    EXPECT_TRUE(one.has_numbers());
    EXPECT_TRUE(holds(one.energy_flux_mw_m2, truth_of(flux).energy_flux));
    width.push_back(one.energy_flux_mw_m2.high68 - one.energy_flux_mw_m2.low68);
  }
  EXPECT_GT(width[1], 0.75 * width[0]);  // each by its samples within 10 %
  EXPECT_GT(width[1], 1.0);              // physics alone: some 9 % of 7.9 to both sides
}

TEST(DensityInversion, NoiseHasNoMeanEnergyAndUpperEndsOfFlux) {
  constexpr double kSigmaCm3 = 1e4;
  DensityTable table = table_at_times(3);
  for (std::uint32_t t = 0; t < 3; ++t) {
    DensityProfile& profile = table.profiles[t];
    for (std::uint32_t i = 0; i < table.altitude_km.size(); ++i)
      profile.density_cm3.push_back(kSigmaCm3 * normal(700 + t, i));
    profile.sigma_cm3.assign(table.altitude_km.size(), kSigmaCm3);
  }
  DensityProfile of_one_sigma = table.profiles.front();
  of_one_sigma.density_cm3.assign(table.altitude_km.size(), kSigmaCm3);
  const double flux = needed_flux_mw_m2(physics(), of_one_sigma);
  DensityInversionOptions options;
  options.samples = 100;
  for (const bool is_steady : {true, false}) {
    options.is_steady = is_steady;
    for (const DensitySpectrum& one : invert_densities(physics(), table, options)) {
      EXPECT_EQ(one.verdict, DensityVerdict::no_electrons);
      EXPECT_TRUE(std::isnan(one.mean_energy_kev.value) && std::isnan(one.mean_energy_kev.high95));
      EXPECT_TRUE(std::isnan(one.energy_flux_mw_m2.value) && std::isnan(one.energy_flux_mw_m2.low95));
      // That of one standard deviation everywhere would be seen, but not by much.
      EXPECT_GT(one.energy_flux_mw_m2.high95, 0.2 * flux);
      EXPECT_LT(one.energy_flux_mw_m2.high95, 20.0 * flux);
    }
  }
  // Nor are electrons of high energy seen in the density that others make.
  table = onset();
  table.profiles.resize(1);
  options.is_steady = true;
  options.has_uncertainty = false;
  options.least_kev = 45.0;
  const DensitySpectrum fast = invert_densities(physics(), table, options).front();
  EXPECT_EQ(fast.verdict, DensityVerdict::no_electrons);
  EXPECT_TRUE(std::isnan(fast.energy_flux_mw_m2.value) && std::isnan(fast.mean_energy_kev.value));
  EXPECT_LT(fast.energy_flux_mw_m2.high95, 1.0);  // of 2 mW m^-2 in all
}

TEST(DensityInversion, TellsItsProgress) {
  DensityTable table = onset();
  DensityInversionOptions options;
  options.has_uncertainty = false;
  options.samples = 5;
  options.threads = 1;
  for (const bool is_steady : {true, false}) {
    std::vector<double> shares;
    options.is_steady = is_steady;
    options.progress = [&](double share) { shares.push_back(share); };
    invert_densities(physics(), table, options);
    EXPECT_EQ(shares.size(), is_steady ? 5u : 25u);
    EXPECT_EQ(shares.back(), 1.0);
  }
}

TEST(DensityInversion, SaysWhatAltitudesDoNotTell) {
  DensityTable table = onset();
  table.profiles.resize(1);
  DensityInversionOptions options;
  options.has_uncertainty = false;
  options.samples = 100;
  const DensitySpectrum one = invert_densities(physics(), table, options).front();
  const EnergyRange range = known_energies(physics(), options);
  EXPECT_GT(range.first, 0u);
  EXPECT_TRUE(std::isnan(one.flux_cm2_s_kev[0].high95));  // 0.1 keV stop far above 150 km
  EXPECT_TRUE(std::isfinite(one.flux_cm2_s_kev[range.first + 5].value));
  // Of 50 keV there are next to none: no value, and an upper end.
  const SampledNumber& fast = one.flux_cm2_s_kev[32];
  EXPECT_TRUE(std::isnan(fast.value));
  EXPECT_TRUE(std::isfinite(fast.high95));
  options.least_kev = 0.1;
  options.most_kev = 0.2;
  EXPECT_THROW(known_energies(physics(), options), sim::Error);
}

TEST(DensityInversion, IsTheSameForAllNumbersOfThreads) {
  DensityTable table = onset();
  table.profiles.resize(3);
  DensityInversionOptions options;
  options.samples = 20;
  for (const bool is_steady : {true, false}) {
    options.is_steady = is_steady;
    options.threads = 1;
    const std::vector<DensitySpectrum> one = invert_densities(physics(), table, options);
    options.threads = 3;
    const std::vector<DensitySpectrum> three = invert_densities(physics(), table, options);
    for (std::size_t p = 0; p < one.size(); ++p)
      EXPECT_EQ(one[p].energy_flux_mw_m2.low95, three[p].energy_flux_mw_m2.low95);
  }
}

SpectrumProblem some_problem(double seconds) {
  const auto places = static_cast<Eigen::Index>(altitudes().size());
  SpectrumProblem problem;
  problem.seconds = seconds;
  problem.density_cm3 = Eigen::VectorXd::LinSpaced(places, 1e5, 4e5);
  problem.one_over_sigma = Eigen::VectorXd::Constant(places, 1e-4);
  problem.about_cm3 = problem.density_cm3;
  problem.ln_recombination = Eigen::VectorXd::Constant(places, std::log(3e-7));
  problem.recombination_slope = Eigen::VectorXd::Constant(places, -0.2);
  problem.modes = {Eigen::MatrixXd::Constant(places, 2, 0.1), Eigen::MatrixXd::Constant(places, 2, -0.2)};
  const Eigen::Index all = spectrum_numbers(physics()) + 2 + (std::isinf(seconds) ? 0 : places);
  problem.state = {Eigen::VectorXd::Constant(all, 0.1), Eigen::MatrixXd::Constant(all, all, 0.01)};
  problem.state.root += 0.5 * Eigen::MatrixXd::Identity(all, all);
  if (!std::isinf(seconds)) problem.state.mean.tail(places).setConstant(std::log(2e5));
  return problem;
}

TEST(SpectrumPosterior, GradientIsThatOfDifferences) {
  constexpr double kStep = 1e-5;
  for (const double seconds : {std::numeric_limits<double>::infinity(), 5.0}) {
    const SpectrumProblem problem = some_problem(seconds);
    const SpectrumPosterior posterior(physics(), problem);
    Eigen::VectorXd at(posterior.unknowns()), gradient, unused;
    for (Eigen::Index i = 0; i < at.size(); ++i) at[i] = 0.3 * normal(900, static_cast<std::uint32_t>(i));
    posterior.energy(at, gradient);
    for (Eigen::Index i = 0; i < at.size(); ++i) {
      Eigen::VectorXd more = at, less = at;
      more[i] += kStep;
      less[i] -= kStep;
      const double difference =
          (posterior.energy(more, unused) - posterior.energy(less, unused)) / (2.0 * kStep);
      EXPECT_NEAR(gradient[i], difference, 1e-6 * gradient.norm()) << i << " " << seconds;
    }
  }
}

}  // namespace
}  // namespace vegard::fit::density_inversion_test
