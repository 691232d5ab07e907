#include "sim/base/number/chain/surrogate_transition.h"

#include <cmath>
#include <limits>

#include "sim/base/number/random.h"

namespace vegard::sim {
namespace {

constexpr double kIndependentOfSurrogate = 0.5;       // of its steps
constexpr double kLongestWalk = 2.0, kOctaves = 4.0;  // of the random walk's length
constexpr std::uint32_t kFirstIndex = 1u << 24;       // the third index of its random numbers,
constexpr std::uint32_t kIndicesOfStep = 1u << 12;    // and how many of them a step may take

}  // namespace

double finite_or_minus_infinity(double log_density) {
  return std::isfinite(log_density) ? log_density : -std::numeric_limits<double>::infinity();
}

SurrogateTransition::SurrogateTransition(const LogDensity& surrogate, const StudentProposal& student,
                                         std::uint64_t seed)
    : surrogate_(surrogate), student_(student), seed_(seed) {}

double SurrogateTransition::walk(std::vector<double>& at, int steps, std::uint32_t step,
                                 std::uint32_t walker) const {
  const double before = finite_or_minus_infinity(surrogate_(at));
  if (!std::isfinite(before)) return 0.0;
  const std::size_t d = at.size();
  double here = before;
  std::vector<double> there;
  for (int s = 0; s < steps; ++s) {
    const std::uint32_t index = kFirstIndex + static_cast<std::uint32_t>(s) * kIndicesOfStep;
    const Words w = random_words(seed_, Stream::ensemble, step, walker, index);
    double log_factor = 0.0;
    if (uniform(w[2]) < kIndependentOfSurrogate) {
      there = student_.draw(seed_, step, walker, index + 1);
      log_factor = student_.log_density(at) - student_.log_density(there);
    } else {
      const double length =
          kLongestWalk * std::exp2(-kOctaves * uniform(w[3])) * 2.38 / std::sqrt(static_cast<double>(d));
      const Eigen::VectorXd by =
          length * (student_.root() * normal_numbers(seed_, step, walker, index + 1, d));
      there = at;
      for (std::size_t j = 0; j < d; ++j) there[j] += by(static_cast<Eigen::Index>(j));
    }
    const double density = finite_or_minus_infinity(surrogate_(there));
    if (std::log(fine_uniform(w[0], w[1])) >= log_factor + density - here) continue;
    at.swap(there);
    here = density;
  }
  return before - here;
}

}  // namespace vegard::sim
