#include "sim/render/beams/derivative_passes.h"

#include <set>

#include "sim/light/sample.h"
#include "sim/render/beams/kernel_scene.h"

namespace vegard::sim {
namespace {

/// The local inputs that a number is, in some sheet.
std::set<int> local_inputs_of(const Scene& scene, const ParameterId& number) {
  std::set<int> inputs;
  for (std::size_t s = 0; s < scene.sheets.size(); ++s)
    if (const int k = local_input_of(scene, static_cast<int>(s), number); k >= 0) inputs.insert(k);
  return inputs;
}

}  // namespace

std::vector<DerivativePass> derivative_passes(const Scene& scene, const std::vector<ParameterId>& free) {
  constexpr std::size_t kMaxShared = kMaxCarried - beam_inputs;
  std::vector<DerivativePass> passes(1);
  std::set<int> shared;
  for (std::size_t i = 0; i < free.size(); ++i) {
    const std::set<int> own = local_inputs_of(scene, free[i]);
    std::set<int> together = shared;
    together.insert(own.begin(), own.end());
    if (passes.back().count == kTangentWidth || together.size() > kMaxShared) {
      passes.push_back({i, 0});
      together = own;
    }
    ++passes.back().count;
    shared = together;
  }
  return passes;
}

}  // namespace vegard::sim
