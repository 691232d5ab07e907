#include "fit/search/coarse_search.h"

#include <algorithm>
#include <cmath>

#include "fit/parameters/volume_starts.h"

namespace vegard::fit {
namespace {

constexpr int kOverallDescents = 2;
// Ranges of the overall trials: of logarithms, and degrees.
constexpr double kDistances = 1.4, kSearchApart = 0.6, kEnergies = 3.0, kBearings = 24.0;
constexpr double kFootprintDistances = 0.8, kFootprintEnergies = 1.6;
constexpr int kTrialsPerFootprintTrial = 4;

using sim::ParameterRole;
using Values = std::vector<double>;

/// Whether the number shapes the profile as a whole, rather than what varies along the arc.
bool is_overall(const FreeNumber& n) {
  if (is_of_volume(n)) return false;
  return n.has_role(ParameterRole::centre) || n.has_role(ParameterRole::energy) ||
         n.has_role(ParameterRole::bearing) || n.has_role(ParameterRole::energy_flux) ||
         n.has_role(ParameterRole::line_brightness) || !n.has_path();
}

bool is_amplitude(const FreeNumber& n) { return n.has_role(ParameterRole::amplitude); }

/// Returns the range of the overall trials of a bearing, degrees: between limits that the user has set, most
/// of it.
double turned_by(const FreeNumber& n) {
  return n.limited() ? std::max(kBearings, 0.6 * (n.max - n.min)) : kBearings;
}

/// Point `i` of the overall trials. All sheets together go out or in and turn; then each has a distance and
/// an energy of its own. One draw moves both components of a centre: along its own direction.
Values overall_trial(const CoarseSearch& coarse, const std::vector<std::size_t>& which, Values values,
                     int i) {
  const int sheets = static_cast<int>(coarse.scene().sheets.size());
  const std::vector<double> u = even_point(i, 1 + 2 * sheets, coarse.scene().seed);
  for (std::size_t j : which) {
    const FreeNumber& n = coarse.free()[j];
    const int s = std::max(0, n.id.sheet());
    const double distance =
        std::exp((u[1] - 0.5) * kDistances) * (s > 0 ? std::exp((u[1 + 2 * s] - 0.5) * kSearchApart) : 1.0);
    if (n.has_role(ParameterRole::centre)) values[j] *= distance;
    if (n.has_role(ParameterRole::energy)) values[j] *= std::exp((u[2 + 2 * s] - 0.5) * kEnergies);
    if (!n.has_path())
      values[j] = n.logarithmic() ? n.min * std::pow(n.max / n.min, u[1]) : n.min + u[1] * (n.max - n.min);
    if (n.has_role(ParameterRole::bearing)) values[j] += (u[0] - 0.5) * turned_by(n);
    values[j] = n.within_limits(values[j]);
  }
  return values;
}

Values nearly_straight(const std::vector<FreeNumber>& free, Values values) {
  for (std::size_t j : indices(free, is_amplitude))
    values[j] = free[j].within_limits(kNearlyStraight * values[j]);
  return values;
}

}  // namespace

Trial best_overall(CoarseSearch& coarse, const Trial& start) {
  const std::vector<std::size_t> which = indices(coarse.free(), is_overall);
  const auto sheets = static_cast<int>(coarse.scene().sheets.size());
  if (which.empty() || sheets == 0) return start;
  coarse.tell("overall", 0.02);
  const Values straight = nearly_straight(coarse.free(), start.values);
  std::vector<Trial> trials = {coarse.tried(straight)};
  for (int i = 0; i < sheets * coarse.scene().fit.overall_trials && !coarse.exhausted(); ++i)
    trials.push_back(coarse.tried(overall_trial(coarse, which, straight, i)));
  sort_by_chi2(trials);
  std::vector<Trial> ends;
  for (int i = 0; i < kOverallDescents && i < static_cast<int>(trials.size()) && !coarse.exhausted(); ++i)
    ends.push_back(coarse.descended(trials[i], which, "overall"));
  if (ends.empty()) ends.push_back(trials.front());
  sort_by_chi2(ends);
  coarse.record(ends.front(), "overall");
  return ends.front();
}

std::vector<Trial> other_footprints(CoarseSearch& coarse, const Trial& from) {
  std::vector<Trial> trials;
  coarse.tell("volumes", 0.35);
  const sim::Scene& scene = coarse.scene();
  for (int i = 0; i < scene.fit.overall_trials / kTrialsPerFootprintTrial && !coarse.exhausted(); ++i) {
    const std::vector<double> u = even_point(i, 2, scene.seed + 2);
    trials.push_back(coarse.tried(moved_footprints(scene, coarse.free(), from.values,
                                                   std::exp((u[0] - 0.5) * kFootprintDistances),
                                                   std::exp((u[1] - 0.5) * kFootprintEnergies))));
  }
  sort_by_chi2(trials);
  return trials;
}

}  // namespace vegard::fit
