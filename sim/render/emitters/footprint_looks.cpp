#include "sim/render/emitters/footprint_volumes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>

#include "sim/base/number/constants.h"
#include "sim/emit/aurora/motion.h"
#include "sim/emit/footprint/map/bulge.h"
#include "sim/scene/structs/footprint.h"

namespace vegard::sim {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kLooksPerChange = 2.0;
constexpr int kMaxLooks = 64, kMaxCurtains = 16, kMaxMaps = 8, kMaxFlowsOrShells = 4;
constexpr int kLevelLooks = 8, kMaxLevelLooks = 4096;

bool is_of_sheets(const Footprint& f) { return f.source == FootprintSource::sheets; }

double narrowest_km(const Footprint& f, double sphere_km) {
  if (f.source == FootprintSource::spline) return drawn_width_km(f, sphere_km);
  constexpr double kEdgePerRadius = 1.5707963267948966;  // of a face of the cube about the sphere
  return f.shape == FootprintShape::shell ? sphere_km * kEdgePerRadius / f.face_cells : f.cell_km;
}

int max_looks(const Footprint& f) {
  if (f.flow_turns_per_s > 0.0 || (f.shape == FootprintShape::shell && f.model == FootprintModel::volume))
    return kMaxFlowsOrShells;
  if (f.model == FootprintModel::curtain) return kMaxCurtains;
  return only_drifts(f) ? kMaxLooks : kMaxMaps;
}

double mean_level(const Scene& scene, const Footprint& f, const std::vector<double>& instants) {
  double sum = 0.0;
  for (const double instant : instants) sum += substorm_share(scene, f, instant);
  return sum / static_cast<double>(instants.size());
}

/// Instants of an interval of age: the exposure's less ages that are even in their logarithm, in groups of
/// neighbours, of which each is its mean. At least `wanted` groups, as many as there are instants or a
/// multiple of it, so that no group holds what lies far apart; but at most `max`.
std::vector<double> past(const std::vector<double>& instants, const AgeIntervals& ages, int age,
                         double wanted, int max) {
  const int ends = static_cast<int>(instants.size());
  int count = max;
  if (ends <= max) {
    const double most_each = max / ends;  // whole
    count = ends * static_cast<int>(std::clamp(std::ceil(wanted / ends), 1.0, most_each));
  }
  std::vector<double> fine;
  for (const double instant : instants)
    for (int k = 0; k < count; ++k) fine.push_back(instant - ages.age_s(age, (k + 0.5) / count));
  std::sort(fine.begin(), fine.end());
  std::vector<double> means;
  for (auto first = fine.begin(); first != fine.end(); first += ends)
    means.push_back(std::accumulate(first, first + ends, 0.0) / ends);
  return means;
}

/// Without a past.
std::vector<FootprintLook> of_exposure(const Scene& scene, const Footprint& f,
                                       const std::vector<double>& instants) {
  if (is_of_sheets(f) || !moves_by_itself(f)) return {{{}, mean_level(scene, f, instants), {}}};
  std::vector<FootprintLook> looks;
  for (const double instant : instants)
    looks.push_back(
        {{instant}, substorm_share(scene, f, instant) / static_cast<double>(instants.size()), {}});
  return looks;
}

/// Returns the share of each line's light of a footprint that only the substorm's level changes.
LightShare of_levels(const Scene& scene, const Footprint& f, const std::vector<double>& instants,
                     const AgeIntervals& ages, const std::vector<LightShare>& shares) {
  LightShare sum = shares[0];
  for (int age = 0; age < ages.count(); ++age) {
    const double level =
        mean_level(scene, f, age == 0 ? instants : past(instants, ages, age, kLevelLooks, kMaxLevelLooks));
    for (std::size_t l = 0; l < sum.size(); ++l)
      for (std::size_t a = 0; a < sum[l].size(); ++a) {
        const float part = static_cast<float>(level) * shares[age][l][a];
        sum[l][a] = age == 0 ? part : sum[l][a] + part;
      }
  }
  return sum;
}

bool is_box_of_cells(const Footprint& f) {
  return f.model == FootprintModel::volume && f.shape == FootprintShape::box;
}

/// One look, or several: where a footprint is no map in a box each of its instants is an emitter, and a map
/// of the whole way of one that drifts far would be mostly dark, so that one map goes no further than its
/// size.
void add_parts(const Scene& scene, const Footprint& f, std::vector<double> then,
               const LightShare& share_of_look, std::vector<FootprintLook>& looks) {
  std::sort(then.begin(), then.end());
  const double speed_km_s = std::hypot(f.drift_km_s.east, f.drift_km_s.north),
               longest_km = is_box_of_cells(f) ? std::max(f.size_km.east, f.size_km.north) : 0.0;
  const auto goes_with = [&](double first_s, double instant_s) {
    return is_box_of_cells(f) && speed_km_s * (instant_s - first_s) <= longest_km;
  };
  for (std::size_t first = 0; first < then.size();) {
    std::vector<double> some{then[first]};
    for (++first; first < then.size() && goes_with(some.front(), then[first]); ++first)
      some.push_back(then[first]);
    const double share = static_cast<double>(some.size()) / static_cast<double>(then.size());
    const double level = mean_level(scene, f, some);
    looks.push_back({std::move(some), level * share, share_of_look});
  }
}

}  // namespace

double substorm_share(const Scene& scene, const Footprint& f, double instant_s) {
  return is_of_sheets(f) ? 1.0 : substorm_level(scene.substorm, instant_s);
}

double soonest_change_s(const Scene& scene, const Footprint& f) {
  double change_s = kNever;
  if (const double drift = std::hypot(f.drift_km_s.east, f.drift_km_s.north); drift > 0.0)
    change_s = narrowest_km(f, scene.body.radius_km) / drift;
  if (f.source == FootprintSource::noise && f.noise_lifetime_s > 0.0)
    change_s = std::min(change_s, f.noise_lifetime_s);
  if (has_rays(f) && f.ray_lifetime_s > 0.0) change_s = std::min(change_s, f.ray_lifetime_s);
  if (f.bulge_km > 0.0) change_s = std::min(change_s, bulge_change_s(f, scene.substorm));
  if (f.flow_turns_per_s > 0.0) change_s = std::min(change_s, 1.0 / (kTwoPi * f.flow_turns_per_s));
  if (is_of_sheets(f)) {
    for (const Sheet& sheet : scene.sheets)
      change_s = std::min(change_s, soonest_change_s(sheet, scene.substorm));
  } else if (scene.substorm.quiet < 1.0) {
    change_s =
        std::min({change_s, scene.substorm.growth_s, scene.substorm.expansion_s, scene.substorm.recovery_s});
  }
  return change_s;
}

std::vector<FootprintLook> footprint_looks(const Scene& scene, const Footprint& f) {
  const std::vector<double> instants = instants_s(scene.time);
  std::vector<FootprintLook> looks = of_exposure(scene, f, instants);
  if (scene.emission.lag == EmissionLag::none || f.light == FootprintLight::colours) return looks;
  const double change_s = soonest_change_s(scene, f);
  const AgeIntervals ages(scene, f.top_km, change_s);
  if (ages.count() == 1) return looks;
  const std::vector<LightShare> shares = ages.shares();
  if (!is_of_sheets(f) && !moves_by_itself(f))
    return {{{}, 1.0, of_levels(scene, f, instants, ages, shares)}};
  for (FootprintLook& look : looks) look.of_lines = shares[0];
  // The map of sheets is that of the whole exposure.
  const std::vector<double> ends = is_of_sheets(f) ? std::vector<double>{scene.time.start_s} : instants;
  for (int age = 1; age < ages.count(); ++age) {
    const double stretch_s = ages.age_s(age, 1.0) - ages.age_s(age, 0.0);
    const double wanted = std::ceil(kLooksPerChange * (stretch_s + ends.back() - ends.front()) / change_s);
    add_parts(scene, f, past(ends, ages, age, wanted, max_looks(f)), shares[age], looks);
  }
  return looks;
}

double map_bytes(const Scene& scene, const Footprint& f, std::size_t number_bytes) {
  if (f.model == FootprintModel::curtain) return 0.0;
  double cells = 0.0;
  for (const FootprintLook& look : footprint_looks(scene, f)) {
    if (f.shape == FootprintShape::shell || look.instants_s.size() < 2) {
      cells += map_cells(f);
      continue;
    }
    const auto [first, last] = std::minmax_element(look.instants_s.begin(), look.instants_s.end());
    const double way_s = *last - *first;
    cells += (std::ceil((f.size_km.east + std::abs(f.drift_km_s.east) * way_s) / f.cell_km) + 1.0) *
             (std::ceil((f.size_km.north + std::abs(f.drift_km_s.north) * way_s) / f.cell_km) + 1.0);
  }
  // The map around the Earth has no derivatives.
  return cells * bytes_per_cell(f, f.shape == FootprintShape::shell ? sizeof(double) : number_bytes);
}

}  // namespace vegard::sim
