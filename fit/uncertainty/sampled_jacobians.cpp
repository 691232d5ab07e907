#include "fit/uncertainty/sampled_jacobians.h"

#include <algorithm>
#include <cstdint>
#include <memory>

namespace vegard::fit {
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
