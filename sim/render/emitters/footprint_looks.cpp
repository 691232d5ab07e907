#include "sim/render/emitters/footprint_looks.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "sim/base/number/constants.h"
#include "sim/emit/aurora/change_times.h"
#include "sim/emit/aurora/motion.h"
#include "sim/scene/structs/footprint_size.h"

namespace vegard::sim {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kLooksPerChange = 2.0;
constexpr int kMaxLooks = 64, kMaxCurtains = 16, kMaxMaps = 8, kMaxFlowsOrShells = 2;
constexpr int kLevelLooks = 8;

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

/// Instants of an interval of age, evenly in the logarithm of the age, before those of the exposure in turn.
std::vector<double> past(const std::vector<double>& instants, const AgeIntervals& ages, int age, int count) {
  std::vector<double> all;
  const int ends = static_cast<int>(instants.size());
  for (int k = 0; k < count; ++k)
    all.push_back(instants[count < ends ? k * ends / count : k % ends] - ages.age_s(age, (k + 0.5) / count));
  return all;
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

/// Of one that stays as it is but for the substorm's level: which light is how bright.
LightShare of_levels(const Scene& scene, const Footprint& f, const std::vector<double>& instants,
                     const AgeIntervals& ages, const std::vector<LightShare>& shares) {
  LightShare sum = shares[0];
  for (int age = 0; age < ages.count(); ++age) {
    const double level = mean_level(scene, f, age == 0 ? instants : past(instants, ages, age, kLevelLooks));
    for (std::size_t l = 0; l < sum.size(); ++l)
      for (std::size_t a = 0; a < sum[l].size(); ++a) {
        const float part = static_cast<float>(level) * shares[age][l][a];
        sum[l][a] = age == 0 ? part : sum[l][a] + part;
      }
  }
  return sum;
}

/// One look, or several: where a footprint is no map in a box each of its instants is an emitter, and a map
/// of the whole way of one that drifts far would be mostly dark.
void add_parts(const Scene& scene, const Footprint& f, const std::vector<double>& then, const LightShare& of,
               std::vector<FootprintLook>& looks) {
  std::size_t at_a_time = 1;
  if (f.model == FootprintModel::volume && f.shape == FootprintShape::box) {
    const double way_km =
                     std::hypot(f.drift_km_s.east, f.drift_km_s.north) * std::abs(then.front() - then.back()),
                 parts = std::max(1.0, std::ceil(way_km / std::max(f.size_km.east, f.size_km.north)));
    at_a_time = static_cast<std::size_t>(std::ceil(static_cast<double>(then.size()) / parts));
  }
  for (std::size_t first = 0; first < then.size(); first += at_a_time) {
    const auto begin = then.begin() + static_cast<std::ptrdiff_t>(first);
    const std::vector<double> some(
        begin, begin + static_cast<std::ptrdiff_t>(std::min(at_a_time, then.size() - first)));
    const double share = static_cast<double>(some.size()) / static_cast<double>(then.size());
    looks.push_back({some, mean_level(scene, f, some) * share, of});
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
    const double wanted =
        std::max(std::ceil(kLooksPerChange * stretch_s / change_s), static_cast<double>(ends.size()));
    std::vector<double> then =
        past(ends, ages, age, static_cast<int>(std::min(wanted, static_cast<double>(max_looks(f)))));
    add_parts(scene, f, then, shares[age], looks);
  }
  return looks;
}

}  // namespace vegard::sim
