#include "fit/uncertainty/validated_values.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "fit/uncertainty/band_bootstrap.h"

namespace vegard::fit {
namespace {

constexpr std::size_t kMaxSamples = 4000;

std::optional<double> end_in_values(const std::optional<double>& coordinate, std::size_t j,
                                    const ReportedValues& reported) {
  if (!coordinate) return {};
  return reported.value(j, *coordinate);
}

/// Every so many samples, so that no more than kMaxSamples are left, of all walkers alike.
std::vector<double> thinned(const std::vector<double>& samples, std::size_t numbers, int walkers) {
  const std::size_t count = samples.size() / numbers;
  std::size_t stride = (count + kMaxSamples - 1) / kMaxSamples;
  if (stride < 2) return samples;
  while (std::gcd(stride, static_cast<std::size_t>(walkers)) != 1) ++stride;
  std::vector<double> kept;
  for (std::size_t i = 0; i < count; i += stride) {
    const auto begin = samples.begin() + static_cast<std::ptrdiff_t>(i * numbers);
    kept.insert(kept.end(), begin, begin + static_cast<std::ptrdiff_t>(numbers));
  }
  return kept;
}

}  // namespace

double ReportedValues::value(std::size_t j, double coordinate) const {
  return free[j].value(coordinate) + (values[j] - free[j].value(answer[j]));
}

ProfiledInterval in_values(const LikelihoodProfile& profile, const ReportedValues& reported) {
  ProfiledInterval p;
  p.parameter = profile.coordinate;
  p.lower68 = end_in_values(profile.interval68.lower, p.parameter, reported);
  p.upper68 = end_in_values(profile.interval68.upper, p.parameter, reported);
  p.lower95 = end_in_values(profile.interval95.lower, p.parameter, reported);
  p.upper95 = end_in_values(profile.interval95.upper, p.parameter, reported);
  for (const ProfilePoint& at : profile.path) {
    p.rise.push_back(at.rise);
    p.values.emplace_back();
    for (std::size_t j = 0; j < at.point.size(); ++j)
      p.values.back().push_back(reported.value(j, at.point[j]));
  }
  p.whole = profile.whole;
  p.found_better = profile.better.has_value();
  return p;
}

BootstrapErrors in_values(const BandBootstrap& bootstrap, const ReportedValues& reported) {
  BootstrapErrors b;
  b.bands = bootstrap.bands;
  b.replicates = bootstrap.replicates;
  b.failed = bootstrap.failed;
  const std::size_t n = reported.free.size();
  std::vector<double> values = bootstrap.samples;
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = reported.value(i % n, reported.answer[i % n] + values[i]);
  const SampleSummary s = summary_of_samples(values, n);
  b.sigma = s.sigma;
  b.interval68 = s.interval68;
  b.interval95 = s.interval95;
  b.correlation = s.correlation;
  return b;
}

ChainErrors in_values(const sim::EnsembleState& state, int burn_in, const ReportedValues& reported) {
  ChainErrors c;
  sim::EnsembleState converted = state;
  const std::size_t n = reported.free.size();
  for (std::size_t i = 0; i < converted.chain.size(); ++i)
    converted.chain[i] = reported.value(i % n, converted.chain[i]);
  const sim::EnsembleSummary e = sim::summary_of(converted);
  const SampleSummary s = summary_of_samples(converted.chain, n);
  c.walkers = e.walkers;
  c.burn_in = burn_in;
  c.steps = e.steps;
  c.acceptance = e.acceptance;
  c.median = s.median;
  c.sigma = s.sigma;
  c.interval68 = s.interval68;
  c.interval95 = s.interval95;
  c.correlation = s.correlation;
  c.autocorrelation_steps = e.autocorrelation_steps;
  c.effective = e.effective;
  c.r_hat = e.r_hat;
  c.long_enough = e.long_enough;
  c.samples = thinned(converted.chain, n, c.walkers);
  return c;
}

double log_flat_prior(const std::vector<FreeNumber>& free, const std::vector<double>& coordinates) {
  double sum = 0.0;
  for (std::size_t j = 0; j < free.size(); ++j) {
    const FreeNumber& n = free[j];
    if (!std::isfinite(n.min) || !std::isfinite(n.max)) continue;
    const double slope = n.slope(coordinates[j]);
    sum += n.logarithmic() ? std::log(slope / n.value(coordinates[j])) - std::log(std::log(n.max / n.min))
                           : std::log(slope) - std::log(n.max - n.min);
  }
  return sum;
}

}  // namespace vegard::fit
