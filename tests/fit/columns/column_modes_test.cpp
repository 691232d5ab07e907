// The modes of the tables' uncertainty in the inversion of line brightnesses.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "fit/columns/column_inversion.h"
#include "sim/base/number/distributions.h"
#include "sim/base/number/random.h"
#include "sim/light/height_profile.h"

namespace vegard::fit::column_modes_test {
namespace {

const ColumnModel& model() {
  static const ColumnModel lines(sim::emission_tables("vegard"), {427.8, 557.7, 630.0}, {});
  return lines;
}

const ColumnChi2& chi2() {
  static const ColumnChi2 of_energy_and_flux(model(), {true, true, false}, {});
  return of_energy_and_flux;
}

double normal(std::uint32_t draw, std::uint32_t number) {
  return sim::normal_quantile(sim::uniform(sim::random_words(11, sim::Stream::search, draw, number)[0]));
}

/// Brightnesses of electrons with other physics, a draw of the modes, and errors of 3 %.
ColumnData drawn_data(const ColumnPoint& truth, std::uint32_t draw) {
  ColumnData data;
  const Eigen::MatrixXd modes = model().modes_at(truth);
  for (std::size_t l = 0; l < model().lines(); ++l) {
    double ln = model().at(l, truth).ln_rayleigh;
    for (int k = 0; k < model().modes(); ++k)
      ln += modes(static_cast<Eigen::Index>(l), k) * normal(draw, static_cast<std::uint32_t>(k));
    const double rayleigh = std::exp(ln);
    data.sigma[l] = 0.03 * rayleigh;
    data.rayleigh[l] = rayleigh + data.sigma[l] * normal(draw, 100 + static_cast<std::uint32_t>(l));
  }
  return data;
}

// The definition: the least over the coefficients, here by going along one coefficient after the other.
TEST(ColumnModes, Chi2IsTheLeastOverTheCoefficients) {
  ASSERT_GT(model().modes(), 2);
  const ColumnPoint truth = {std::log(3.0), std::log(5.0), 0.0}, other = {std::log(3.4), std::log(4.6), 0.0};
  const ColumnData data = drawn_data(truth, 1);
  std::vector<double> a(static_cast<std::size_t>(model().modes()), 0.0);
  const Eigen::MatrixXd modes = model().modes_at(other);
  const auto sum = [&] {
    double chi = 0.0;
    for (std::size_t l = 0; l < model().lines(); ++l) {
      double ln = model().at(l, other).ln_rayleigh;
      for (std::size_t k = 0; k < a.size(); ++k)
        ln += modes(static_cast<Eigen::Index>(l), static_cast<Eigen::Index>(k)) * a[k];
      chi += std::pow((std::exp(ln) - data.rayleigh[l]) / data.sigma[l], 2);
    }
    for (const double one : a) chi += one * one;
    return chi;
  };
  double least = sum();
  for (double step = 0.5; step > 1e-6; step *= 0.7)
    for (int round = 0; round < 200; ++round) {
      bool moved = false;
      for (double& one : a)
        for (const double by : {step, -step}) {
          one += by;
          const double there = sum();
          if (there < least) {
            least = there;
            moved = true;
          } else {
            one -= by;
          }
        }
      if (!moved) break;
    }
  // chi2 has the spline of the covariances M M^T over the energies, the sum here the covariance of the
  // splined M; a coordinate search ends a little above the minimum.
  EXPECT_NEAR(chi2().at(data, other), least, 1e-3 * (1.0 + least));
}

// Against the simulator's own profiles, of which each mode is asked for by its coefficient; the table has a
// smoothed value between the nodes, and the profile's steps are those of floats.
TEST(ColumnModes, AreThoseOfTheProfiles) {
  const sim::EmissionTables& tables = sim::emission_tables("vegard");
  for (const double energy_kev : {0.7, 3.3}) {
    const ColumnPoint point = {std::log(energy_kev), 0.0, 0.0};
    const Eigen::MatrixXd modes = model().modes_at(point);
    for (const int mode : {0, 2, 5}) {
      std::vector<double> coefficients(static_cast<std::size_t>(mode) + 1, 0.0);
      const auto rayleigh = [&](double coefficient, int line) {
        coefficients.back() = coefficient;
        const sim::HeightProfile profile =
            sim::maxwellian_profile({tables, 1.0, coefficients}, model().lines_nm(), energy_kev);
        return sim::column_below(profile, line, sim::HeightProfile::kTopKm).rayleigh;
      };
      for (int line = 0; line < 3; ++line)
        EXPECT_NEAR(modes(line, mode), std::log(rayleigh(0.1, line) / rayleigh(-0.1, line)) / 0.2, 3e-3)
            << energy_kev << " keV, mode " << mode << ", line " << line;
    }
  }
}

TEST(ColumnModes, CovarianceIsThatOfTheModes) {
  ColumnModelOptions options;
  options.soft_kev = 0.3;
  const ColumnModel soft(sim::emission_tables("vegard"), {427.8, 557.7, 630.0}, options);
  for (const ColumnModel* one : {&model(), &soft}) {
    const ColumnPoint point = {1.3, 0.7, 0.0, one == &soft ? -0.8 : 0.0};
    ColumnLights lights;
    LineCovariance covariance, other;
    one->at(point, lights);
    one->ln_covariance(point, lights, covariance);
    const Eigen::MatrixXd modes = one->modes_at(point), product = modes * modes.transpose();
    constexpr double kStep = 1e-5;
    for (Eigen::Index l = 0; l < 3; ++l)
      for (Eigen::Index m = 0; m < 3; ++m) {
        const std::size_t place = static_cast<std::size_t>(l) * kMaxColumnLines + static_cast<std::size_t>(m);
        // Of the spline of squares and the square of the spline.
        EXPECT_NEAR(covariance.value[place], product(l, m), 2e-3 * std::sqrt(product(l, l) * product(m, m)));
        for (std::size_t k = 0; k < kColumnUnknowns; ++k) {
          if (!covariance.depends_on[k]) continue;
          double ends[2];
          for (const int side : {0, 1}) {
            ColumnPoint beside = point;
            beside[k] += side == 0 ? -kStep : kStep;
            one->at(beside, lights);
            one->ln_covariance(beside, lights, other);
            ends[side] = other.value[place];
          }
          EXPECT_NEAR(covariance.slope[k][place], (ends[1] - ends[0]) / (2.0 * kStep), 1e-6) << k;
        }
      }
  }
}

// What is known of the modes and of a line's factor moves the light and sets its covariance.
TEST(ColumnModes, KnowledgeMovesAndNarrows) {
  const Eigen::Index modes = model().modes(), lines = 3;
  CommonLight common{Eigen::VectorXd::Constant(modes + lines, 0.4),
                     0.25 * Eigen::MatrixXd::Identity(modes + lines, modes + lines),
                     Eigen::Vector3d(0.1, 0.0, 0.2)};
  const ColumnModel known(model(), common);
  const ColumnPoint point = {model().ln_energies()[60], 0.5, 0.0};
  const Eigen::VectorXd change =
      model().modes_at(point) * common.mean.head(modes) + 0.4 * common.factor_error;
  ColumnLights lights, moved;
  LineCovariance wide, narrow;
  model().at(point, lights);
  model().ln_covariance(point, lights, wide);
  known.at(point, moved);
  known.ln_covariance(point, moved, narrow);
  for (Eigen::Index l = 0; l < lines; ++l) {
    const auto line = static_cast<std::size_t>(l);
    // modes_at() is smoothed over the neighbouring nodes.
    EXPECT_NEAR(moved[line].ln_rayleigh - lights[line].ln_rayleigh, change(l), 2e-3);
    const std::size_t diagonal = line * kMaxColumnLines + line;
    EXPECT_NEAR(narrow.value[diagonal], 0.25 * (wide.value[diagonal] + std::pow(common.factor_error(l), 2)),
                1e-12);
  }
}

TEST(ColumnModes, TheMinimumIsOne) {
  const ColumnData data = drawn_data({std::log(2.0), std::log(8.0), 0.0}, 2);
  const ColumnValley best = chi2().valleys(data).front();
  for (const double by : {-0.01, 0.01}) {
    EXPECT_GT(chi2().at(data, {best.at[0] + by, best.at[1], 0.0}), best.chi2);
    EXPECT_GT(chi2().at(data, {best.at[0], best.at[1] + by, 0.0}), best.chi2);
  }
}

// Far from any light of the tables the changes by the modes are large, and steps long; a hundred of them end
// within a per cent of the least chi2, which contradicts the tables all the same.
TEST(ColumnModes, TheMinimumIsFoundWhereLinesContradict) {
  ColumnModelOptions options;
  options.soft_kev = 0.2;
  const ColumnModel soft(sim::emission_tables("vegard"), {427.8, 557.7, 630.0}, options);
  const ColumnPoint held = {0.0, 0.0, 0.0, std::log(0.2)};
  const ColumnChi2 both(soft, {true, true, false, false}, held);
  for (const double green : {500.0, 12800.0, 90000.0}) {
    const ColumnData data = {{2300.0, green, 330.0}, {50.0, 0.02 * green, 16.5}};
    const double least = both.valleys(data).front().chi2;
    for (const double energy_kev : {0.2, 0.7, 1.0, 2.0, 4.0, 8.0, 16.0}) {
      const ColumnChi2 flux(soft, {false, true, false, false},
                            {std::log(energy_kev), 0.0, 0.0, held[kLnSoft]});
      EXPECT_LE(least, 1.01 * flux.valleys(data).front().chi2) << green << " R, " << energy_kev << " keV";
    }
  }
}

// 240 draws of the modes and of the errors; the share of intervals that hold the truth has the standard error
// 3.0 % (68 %) and 1.4 % (95 %). Three of these are allowed, and a per cent for chi2 being no parabola.
TEST(ColumnModes, IntervalsHoldTheTruthOfOtherPhysics) {
  constexpr std::uint32_t kDraws = 240;
  int in68 = 0, in95 = 0, contradictions = 0;
  for (std::uint32_t draw = 0; draw < kDraws; ++draw) {
    const double energy_kev =
        0.6 * std::pow(15.0, sim::uniform(sim::random_words(5, sim::Stream::search, draw)[0]));
    const ColumnInversion answer =
        invert_columns(chi2(), drawn_data({std::log(energy_kev), std::log(6.0), 0.0}, draw));
    const ColumnEstimate& energy = answer.solutions.front().of[kLnEnergy];
    const auto holds = [&](const OpenInterval& interval) {
      return (!interval.lower || *interval.lower <= energy_kev) &&
             (!interval.upper || *interval.upper >= energy_kev);
    };
    in68 += holds(energy.interval68) ? 1 : 0;
    in95 += holds(energy.interval95) ? 1 : 0;
    contradictions += answer.verdict == ColumnVerdict::contradiction ? 1 : 0;
  }
  EXPECT_NEAR(static_cast<double>(in68) / kDraws, 0.683, 0.10);
  EXPECT_NEAR(static_cast<double>(in95) / kDraws, 0.954, 0.052);
  EXPECT_LT(contradictions, 6);
}

TEST(ColumnModes, CorrectionsAreWhatTheDataAsk) {
  const ColumnPoint truth = {std::log(3.0), std::log(5.0), 0.0};
  ColumnData data;
  for (std::size_t l = 0; l < model().lines(); ++l) {
    data.rayleigh[l] = std::exp(model().at(l, truth).ln_rayleigh) * (l == 1 ? 0.7 : 1.0);
    data.sigma[l] = 0.02 * data.rayleigh[l];
  }
  const ColumnValley best = chi2().valleys(data).front();
  const std::vector<LineCorrection> corrections = chi2().corrections(data, best);
  ASSERT_EQ(corrections.size(), 3u);
  EXPECT_LT(corrections[1].factor, corrections[0].factor);
  for (const LineCorrection& line : corrections) {
    EXPECT_GT(line.ln_sigma, 0.0);
    EXPECT_LE(line.ln_sigma, line.ln_sigma_of_tables * (1.0 + 1e-12));
  }
  // The lines are as the corrected tables have them, within their errors.
  const ColumnInversion answer = invert_columns(chi2(), data);
  for (std::size_t l = 0; l < 3; ++l)
    EXPECT_NEAR(answer.solutions.front().rayleigh[l] / data.rayleigh[l], 1.0, 0.02);
}

}  // namespace
}  // namespace vegard::fit::column_modes_test
