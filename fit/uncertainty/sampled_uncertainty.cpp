#include "fit/uncertainty/sampled_uncertainty.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>

#include "fit/parameters/free_parameters.h"
#include "sim/base/number/constants.h"
#include "sim/scene/table/free_entry_keys.h"

namespace vegard::fit {
namespace {

using Rows = std::vector<std::vector<double>>;

std::vector<double> flat(const Rows& rows) {
  std::vector<double> all;
  for (const std::vector<double>& row : rows) all.insert(all.end(), row.begin(), row.end());
  return all;
}

Rows rows_of(const std::vector<double>& all, std::size_t length) {
  Rows rows;
  for (std::size_t at = 0; length > 0 && at + length <= all.size(); at += length)
    rows.emplace_back(all.begin() + static_cast<std::ptrdiff_t>(at),
                      all.begin() + static_cast<std::ptrdiff_t>(at + length));
  return rows;
}

}  // namespace

double limit_variance(const FreeNumber& n, double slope) {
  const double turn = wrap_period(n);
  const double of_turn = turn > 0.0 && slope > 0.0 ? turn * turn / (12.0 * slope * slope)
                                                   : std::numeric_limits<double>::infinity();
  const double of_limits = std::isfinite(n.min) && std::isfinite(n.max)
                               ? sim::kPi * sim::kPi / 3.0
                               : std::numeric_limits<double>::infinity();
  return std::min(of_turn, of_limits);
}

Uncertainty no_uncertainty(std::size_t coordinates, double inflation) {
  Uncertainty u;
  u.inflation = inflation;
  u.sigma.assign(coordinates, std::numeric_limits<double>::quiet_NaN());
  u.correlation.assign(coordinates, std::vector<double>(coordinates, 0.0));
  u.covariance = u.correlation;
  return u;
}

Uncertainty sampled_uncertainty(const std::vector<Observation>& observations,
                                const std::vector<FreeNumber>& free, const std::vector<double>& values,
                                const SplinePrior& prior, const std::vector<PhaseAnchor>& anchors,
                                double inflation, const std::vector<std::vector<double>>& jacobians) {
  const std::size_t n = free.size();
  const ProfileCost::Options anchored = {{}, {}, prior, 1.0, anchors};
  EvaluationLog closing;
  const ProfileCost here(free, cost_terms(observations, free, Detail::full), closing, anchored);
  PriorKnowledge known = no_prior_knowledge(n);
  std::vector<double> by_value = here.prior_jacobian(values);
  here.by_coordinates(values, by_value);
  for (std::size_t r = 0; r < by_value.size() / n; ++r)
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t k = 0; k < n; ++k)
        known.information[j * n + k] += by_value[r * n + j] * by_value[r * n + k];
  for (std::size_t j = 0; j < n; ++j) {
    known.limit_variance[j] = limit_variance(free[j], free[j].slope(free[j].coordinate(values[j])));
    known.has_prior[j] = free[j].prior && free[j].prior->law != sim::PriorLaw::uniform;
  }
  for (const SplineLine& line : prior.lines)
    for (const int j : line.numbers) known.has_prior[j] = true;
  return uncertainty(jacobians, here.data_residuals(), static_cast<int>(n), known, inflation);
}

namespace {

/// d (coordinate of the phase at the sheet's start) / d (coordinate of the wavelength) at a fixed phase in
/// view.
double phase_by_wavelength(const PhaseAnchor& a, const std::vector<FreeNumber>& moved,
                           const std::vector<double>& values) {
  const auto slope_of = [&](int j) { return moved[j].slope(moved[j].coordinate(values[j])); };
  return -a.slope(values[a.wavelength]) * slope_of(a.wavelength) / slope_of(a.phase);
}

}  // namespace

void without_anchors(const std::vector<PhaseAnchor>& anchors, const std::vector<FreeNumber>& moved,
                     const std::vector<double>& values, std::vector<double>& jacobian) {
  for (const PhaseAnchor& a : anchors) {
    const double by_wavelength = phase_by_wavelength(a, moved, values);
    for (std::size_t row = 0; row < jacobian.size(); row += moved.size())
      jacobian[row + a.wavelength] -= by_wavelength * jacobian[row + a.phase];
  }
}

void without_anchors(const std::vector<PhaseAnchor>& anchors, const std::vector<FreeNumber>& moved,
                     const std::vector<double>& values, Uncertainty& u) {
  const std::size_t n = moved.size();
  for (const PhaseAnchor& a : anchors) {
    const double by_wavelength = phase_by_wavelength(a, moved, values);
    for (std::size_t k = 0; k < n; ++k)
      u.covariance[a.phase][k] += by_wavelength * u.covariance[a.wavelength][k];
    for (std::size_t k = 0; k < n; ++k)
      u.covariance[k][a.phase] += by_wavelength * u.covariance[k][a.wavelength];
    for (std::vector<double>& direction : u.undetermined)
      direction[a.phase] += by_wavelength * direction[a.wavelength];
    if (std::isnan(u.sigma[a.wavelength])) u.sigma[a.phase] = u.sigma[a.wavelength];
  }
  for (std::size_t j = 0; j < n; ++j)
    if (!std::isnan(u.sigma[j])) u.sigma[j] = std::sqrt(std::max(0.0, u.covariance[j][j]));
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t k = 0; k < n; ++k) {
      const double both = u.sigma[j] * u.sigma[k];
      u.correlation[j][k] = both > 0.0 ? u.covariance[j][k] / both : 0.0;
    }
}

StepOutput output_of(const Uncertainty& u) {
  StepOutput output;
  output.numbers["sigma"] = u.sigma;
  output.numbers["correlation"] = flat(u.correlation);
  output.numbers["covariance"] = flat(u.covariance);
  output.numbers["undetermined"] = flat(u.undetermined);
  output.numbers["inflation"] = {u.inflation};
  output.numbers["by bands"] = u.by_bands;
  return output;
}

Uncertainty uncertainty_of(const StepOutput& output, std::size_t free) {
  Uncertainty u;
  u.sigma = output.numbers_at("sigma", free);
  u.correlation = rows_of(output.numbers_at("correlation", free * free), free);
  u.covariance = rows_of(output.numbers_at("covariance", free * free), free);
  u.undetermined = rows_of(output.numbers_at("undetermined"), free);
  if (free * u.undetermined.size() != output.numbers_at("undetermined").size())
    throw output.error_at("undetermined");
  u.inflation = output.number_at("inflation");
  u.by_bands = output.numbers_at("by bands", free);
  return u;
}

namespace {

constexpr std::uint64_t kSamplings = 12;
constexpr double kFineness = 2.0;  // of means over all draws

/// Light of drawn beams is a sum over random numbers, that of volumes is not.
bool is_sampled(const std::vector<Observation>& observations) {
  return std::any_of(observations.begin(), observations.end(),
                     [](const Observation& o) { return !o.scene.sheets.empty() && is_drawn(o.scene); });
}

}  // namespace

std::vector<std::vector<double>> sampled_jacobians(const std::vector<Observation>& observations,
                                                   const std::vector<FreeNumber>& free,
                                                   const std::vector<double>& values,
                                                   const std::vector<PhaseAnchor>& anchors, int threads) {
  std::vector<std::vector<double>> jacobians;
  EvaluationLog closing;
  for (std::uint64_t sampling = 0; sampling < kSamplings; ++sampling) {
    if (sampling > 0 && !is_sampled(observations)) break;
    std::vector<std::unique_ptr<Comparison>> others;
    std::vector<CostTerm> terms = cost_terms(observations, free, Detail::full);
    for (std::size_t o = 0; o < terms.size(); ++o) {
      // Beams are laid out where the answer is.
      terms[o].map.put(values, terms[o].scene);
      others.push_back(std::make_unique<Comparison>(
          terms[o].scene, *observations[o].photo, *observations[o].full,
          Comparison::Resolution{1.0, kProfileSmoothing_px, threads, {}, sampling, kFineness}));
      terms[o].comparison = others.back().get();
    }
    const ProfileCost cost(free, terms, closing, {{}, {}, {}, 1.0, anchors});
    jacobians.emplace_back();
    cost.data_jacobian(cost.at(values, true), jacobians.back());
    cost.by_coordinates(values, jacobians.back());
  }
  return jacobians;
}

}  // namespace vegard::fit
