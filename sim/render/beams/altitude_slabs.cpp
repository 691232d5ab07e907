#include "sim/render/beams/altitude_slabs.h"

#include <algorithm>
#include <cstddef>

namespace vegard::sim {
namespace {

constexpr double kMaxGrowth = 2.0, kMaxRise = 1.4;
constexpr double kAlike = 1.0 + 1e-3;  // variances that cannot tell two slabs apart

}  // namespace

std::vector<AltitudeSlab> altitude_slabs(const SpreadProfile& spread, const SpreadProfile& calm,
                                         double min_km2, double max_km2, double top_km) {
  const auto variance = [&](int a) { return std::min<double>(spread.variance_km2[a], max_km2); };
  const auto altitude = [](int a) { return HeightProfile::altitude_km(a); };
  constexpr int kEnd = HeightProfile::kAltitudes;
  int top = 0;
  while (top + 1 < kEnd && altitude(top) < top_km) ++top;

  std::vector<int> nodes;  // where slabs are at home, from the first that is spread
  int a = 0;
  while (a <= top && variance(a) < min_km2) ++a;
  if (a <= top) nodes.push_back(a);
  while (!nodes.empty() && nodes.back() < top && variance(nodes.back()) < max_km2) {
    const int last = nodes.back();
    int next = last + 1;
    while (next < top && variance(next + 1) <= kMaxGrowth * variance(last) &&
           altitude(next + 1) <= kMaxRise * altitude(last))
      ++next;
    nodes.push_back(next);
  }

  std::vector<AltitudeSlab> slabs(nodes.size() + 1);
  std::vector<std::vector<float>> shares(slabs.size(), std::vector<float>(kEnd, 0.0f));
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    AltitudeSlab& slab = slabs[n + 1];
    slab.altitude_km = altitude(nodes[n]);
    slab.variance_km2 = variance(nodes[n]);
    slab.calm_variance_km2 = std::min<double>(calm.variance_km2[nodes[n]], max_km2);
    slab.lifetime_s = spread.lifetime_s[nodes[n]];
  }
  for (int at = 0; at < kEnd; ++at) {
    std::size_t lower = 0;  // and the slab after it
    while (lower < nodes.size() && at >= nodes[lower]) ++lower;
    double upper_share = 0.0;
    if (lower < nodes.size()) {
      const int from = lower == 0 ? 0 : nodes[lower - 1], to = nodes[lower];
      const double low = lower == 0 ? 0.0 : variance(from), high = variance(to);
      upper_share = high > low * kAlike ? (variance(at) - low) / (high - low)
                                        : static_cast<double>(at - from) / (to - from);
      upper_share = std::clamp(upper_share, 0.0, 1.0);
      shares[lower + 1][at] = static_cast<float>(upper_share);
    }
    shares[lower][at] = 1.0f - static_cast<float>(upper_share);
  }
  for (std::size_t s = 0; s < slabs.size(); ++s)
    slabs[s].share = std::make_shared<const std::vector<float>>(std::move(shares[s]));
  slabs.front().altitude_km = HeightProfile::kBottomKm;
  return slabs;
}

void take_altitude_share(const Emission& emission, HeightProfile& profile) {
  if (emission.altitude_share.empty()) return;
  for (int l = 0; l < profile.lines; ++l) {
    const std::vector<float>* share = emission.altitude_share[static_cast<std::size_t>(l)].get();
    for (int a = 0; a < HeightProfile::kAltitudes; ++a) {
      const std::size_t at = static_cast<std::size_t>(a) * profile.stride + l;
      const float part = share == nullptr ? 0.0f : (*share)[a];
      profile.rate[at] *= part;
      if (!profile.d_rate_d_ln_energy.empty()) profile.d_rate_d_ln_energy[at] *= part;
    }
  }
}

}  // namespace vegard::sim
