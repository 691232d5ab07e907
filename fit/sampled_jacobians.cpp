#include "fit/sampled_jacobians.h"

#include <cstdint>
#include <memory>

namespace vegard::fit {
namespace {

constexpr int kSamplings = 12;

}  // namespace

std::vector<std::vector<double>> sampled_jacobians(const std::vector<Observation>& observations,
                                                   const std::vector<FreeNumber>& free,
                                                   const std::vector<double>& values,
                                                   const std::vector<PhaseAnchor>& anchors, int threads) {
  std::vector<std::vector<double>> jacobians;
  EvaluationLog closing;
  for (int sampling = 0; sampling < kSamplings; ++sampling) {
    std::vector<std::unique_ptr<Comparison>> others;
    std::vector<CostTerm> terms = cost_terms(observations, free, Detail::full);
    for (std::size_t o = 0; o < terms.size(); ++o) {
      // Beams are laid out where the answer is.
      terms[o].map.put(values, terms[o].scene);
      terms[o].scene.seed += static_cast<std::uint64_t>(sampling);
      others.push_back(
          std::make_unique<Comparison>(terms[o].scene, *observations[o].photo, *observations[o].full,
                                       Comparison::Resolution{1.0, kProfileSmoothing_px, threads}));
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
