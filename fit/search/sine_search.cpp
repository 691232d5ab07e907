#include "fit/search/sine_search.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "fit/parameters/parameter_map.h"
#include "fit/parameters/volume_starts.h"
#include "fit/search/coarse_search.h"
#include "sim/base/number/constants.h"
#include "sim/base/number/dense_solvers.h"
#include "sim/scene/table/parameter_id.h"

namespace vegard::fit {
namespace {

constexpr int kPhases = 12;                  // where the sine's amplitude is fixed
constexpr double kScanRange = 1.1;           // of log(wavelength): a factor 0.58 to 1.73 about the start
constexpr int kSines = 8, kSinesOfEach = 3;  // of one sheet alone, and of each of several
constexpr int kExchangeRounds = 3, kExchangeDescents = 2;
constexpr double kExchangeGain = 1e-3;  // of chi2
constexpr int kCourseRounds = 2;
constexpr double kNearWaveNumber = 2e-3;  // per km, by which a round may move it: half a wave in 250 km
constexpr double kDamping = 1e-4;

using sim::ParameterRole;
using Values = std::vector<double>;

bool is_periodic(const FreeNumber& n) {
  return n.has_role(ParameterRole::wavelength) || n.has_role(ParameterRole::phase);
}

/// A phase, by whole turns between its limits if it can be, else nearest to 0.
double turned_inside(const FreeNumber& n, double phase_rad) {
  double near = std::remainder(phase_rad, 2.0 * sim::kPi);
  if (n.limited()) near += 2.0 * sim::kPi * std::ceil((n.min - near) / (2.0 * sim::kPi));
  return n.within_limits(near);
}

sim::Scene scene_with(const sim::Scene& start, const std::vector<FreeNumber>& free, const Values& values) {
  sim::Scene scene = start;
  ParameterMap(start, free).put(values, scene);
  return scene;
}

/// The wavelength at a share of the scan. Between limits that the user has set, even steps of the wave
/// number, by which the phase at the ends of what is in view goes; else a range about the start.
double scanned_wavelength(const FreeNumber& n, double start_km, double share) {
  if (n.limited()) return 1.0 / (1.0 / n.max + share * (1.0 / n.min - 1.0 / n.max));
  return start_km * std::exp(kScanRange * (share - 0.5));
}

/// Least squares of residual + J step, where J has a column for every number but the sine's wavelength and
/// phase, and a last one for the amplitude a quarter turn away. Returns the step.
Eigen::VectorXd linear_step(const std::vector<FreeNumber>& free, const SineNumbers& sine,
                            const std::vector<double>& residual, const std::vector<double>& in_phase,
                            const std::vector<double>& quadrature) {
  const std::size_t n = free.size();
  const auto m = static_cast<Eigen::Index>(n + 1);
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(m, m);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(m), row(m);
  for (std::size_t k = 0; k < residual.size(); ++k) {
    for (std::size_t j = 0; j < n; ++j)
      row(static_cast<Eigen::Index>(j)) = is_searched(free[j]) ? in_phase[k * n + j] : 0.0;
    row(static_cast<Eigen::Index>(n)) = quadrature[k * n + sine.thickness];
    row(sine.phase) = 0.0;
    if (sine.wavelength >= 0) row(sine.wavelength) = 0.0;
    normal.selfadjointView<Eigen::Lower>().rankUpdate(row);
    right -= row * residual[k];
  }
  normal = normal.selfadjointView<Eigen::Lower>();
  for (Eigen::Index j = 0; j < m; ++j)
    normal(j, j) = normal(j, j) * (1.0 + kDamping) + (normal(j, j) > 0.0 ? 0.0 : 1.0);
  return sim::solve_symmetric(normal, right);
}

}  // namespace

SineNumbers sine_numbers(const std::vector<FreeNumber>& free, int sheet) {
  SineNumbers sine;
  for (std::size_t j = 0; j < free.size(); ++j) {
    if (free[j].id.sheet() != sheet) continue;
    if (free[j].has_role(ParameterRole::wavelength)) sine.wavelength = static_cast<int>(j);
    if (free[j].has_role(ParameterRole::phase)) sine.phase = static_cast<int>(j);
    if (free[j].has_role(ParameterRole::amplitude)) sine.thickness = static_cast<int>(j);
  }
  return sine;
}

void take_sine(const sim::Scene& start, const std::vector<FreeNumber>& free, const SineThroughOffsets& found,
               int s, std::vector<double>& values) {
  const sim::Scene scene = scene_with(start, free, values);
  const sim::Sheet& sheet = scene.sheets[s];
  const double bearing = sheet.bearing_deg * sim::kPi / 180.0,
               side = scene.field.inclination_deg < 0.0 ? -1.0 : 1.0;
  const double along[2] = {std::sin(bearing), std::cos(bearing)};
  const double aside[2] = {-side * along[1], side * along[0]};
  int centre[2] = {-1, -1};
  for (std::size_t j = 0; j < free.size(); ++j)
    if (free[j].has_role(ParameterRole::centre) && free[j].id.sheet() == s)
      centre[free[j].id.component] = static_cast<int>(j);
  const auto move = [&](int j, double by) {
    if (j >= 0) values[j] = free[j].within_limits(values[j] + by);
  };
  // The centre moves aside; if one of its components is held, the other goes further. If it follows from a
  // number without a place in the scene, that moves.
  double shift[2] = {found.offset_km * aside[0], found.offset_km * aside[1]};
  if (centre[0] < 0 && centre[1] < 0) {
    shift[0] = shift[1] = 0.0;
    for (std::size_t j = 0; j < free.size(); ++j) {
      if (free[j].has_path()) continue;
      std::vector<double> further = values;
      further[j] = free[j].within_limits(values[j] + 1.0);
      const sim::EastNorth there = scene_with(start, free, further).sheets[s].center_km;
      const double by[2] = {there.east - sheet.center_km.east, there.north - sheet.center_km.north};
      const double sideways = by[0] * aside[0] + by[1] * aside[1];
      if (std::abs(sideways) < 0.2) continue;
      move(static_cast<int>(j), found.offset_km / sideways);
      for (int c = 0; c < 2; ++c) shift[c] = by[c] * found.offset_km / sideways;
      break;
    }
  } else if (centre[0] < 0 || centre[1] < 0) {
    const int only = centre[0] >= 0 ? 0 : 1;
    shift[1 - only] = 0.0;
    shift[only] = std::abs(aside[only]) > 0.2 ? found.offset_km / aside[only] : 0.0;
  }
  move(centre[0], shift[0]);
  move(centre[1], shift[1]);
  const double moved_along = shift[0] * along[0] + shift[1] * along[1];
  for (std::size_t j = 0; j < free.size(); ++j)
    if (free[j].id == sim::parameter_with(ParameterRole::bearing, s))
      move(static_cast<int>(j), -side * std::atan(found.slope) * 180.0 / sim::kPi);
  const SineNumbers sine = sine_numbers(free, s);
  if (sine.wavelength >= 0)
    values[sine.wavelength] = free[sine.wavelength].within_limits(found.wavelength_km);
  if (sine.thickness >= 0) values[sine.thickness] = free[sine.thickness].within_limits(found.amplitude_km);
  if (sine.phase >= 0) {
    const double mean_layer_shift = sheet.layers > 1 ? 0.5 * sheet.phase_shift_rad : 0.0;
    values[sine.phase] =
        turned_inside(free[sine.phase], found.phase_rad - mean_layer_shift +
                                            2.0 * sim::kPi * moved_along / found.wavelength_km);
  }
}

/// Two points are in one valley if their periodic parameters are: wavelengths within 5 %, phases within a
/// sixth of a turn, and their footprints at like distances.
bool in_one_valley(const sim::Scene& scene, const std::vector<FreeNumber>& free, const Values& a,
                   const Values& b) {
  for (std::size_t j : indices(free, is_periodic)) {
    if (free[j].has_role(ParameterRole::wavelength) && std::abs(std::log(a[j] / b[j])) > 0.05) return false;
    if (free[j].has_role(ParameterRole::phase) &&
        std::abs(std::remainder(a[j] - b[j], 2.0 * sim::kPi)) > sim::kPi / 3.0)
      return false;
  }
  return !footprints_differ(scene, free, a, b);
}

SineSearch::SineSearch(CoarseSearch& coarse)
    : coarse_(coarse), scene_(coarse.scene()), free_(coarse.free()) {}

SineNumbers SineSearch::sine_of(int sheet) const { return sine_numbers(free_, sheet); }

std::vector<int> SineSearch::waved_sheets() const {
  std::vector<int> waved;
  for (std::size_t s = 0; s < scene_.sheets.size(); ++s) {
    const SineNumbers sine = sine_of(static_cast<int>(s));
    if (sine.phase >= 0 && sine.thickness >= 0) waved.push_back(static_cast<int>(s));
  }
  return waved;
}

bool SineSearch::has_lost_a_sine(const Values& values) const {
  const std::vector<int> waved = waved_sheets();
  return scene_.fit.scan_points > 0 && waved.size() > 1 &&
         std::any_of(waved.begin(), waved.end(), [&](int s) {
           const int j = sine_of(s).thickness;
           return free_[j].at_limit(values[j]) && values[j] < free_[j].start;
         });
}

std::pair<double, double> SineSearch::wavelengths_of(const SineNumbers& sine, int sheet,
                                                     const Values& values) const {
  if (sine.wavelength < 0) {
    const double fixed = coarse_.scene_at(values).sheets[sheet].wavelength_km;
    return {fixed, fixed};
  }
  const FreeNumber& n = free_[sine.wavelength];
  return {scanned_wavelength(n, values[sine.wavelength], 1.0),
          scanned_wavelength(n, values[sine.wavelength], 0.0)};
}

std::vector<Values> SineSearch::starts_through_offsets(const Trial& straight, const std::vector<int>& waved) {
  const auto found = coarse_.offsets_at(straight.values);
  std::vector<Values> starts = {straight.values};
  for (const int s : waved) {
    const SineNumbers sine = sine_of(s);
    const auto [least, most] = wavelengths_of(sine, s, straight.values);
    const std::vector<SineThroughOffsets> sines =
        sines_through(found[s], 0.5 * coarse_.scene_at(straight.values).sheets[s].length_km, least, most,
                      free_[sine.thickness].start, waved.size() > 1 ? kSinesOfEach : kSines);
    std::vector<Values> more;
    for (const Values& start : starts)
      for (const SineThroughOffsets& candidate : sines) {
        more.push_back(start);
        take_sine(scene_, free_, candidate, s, more.back());
      }
    starts = std::move(more);
    if (starts.empty()) break;
  }
  return starts;
}

void SineSearch::correct_sines(const Trial& straight, const std::vector<int>& waved, Values& values) {
  const auto again = coarse_.offsets_at(values);
  for (const int s : waved) {
    const SineNumbers sine = sine_of(s);
    const double length = coarse_.scene_at(values).sheets[s].length_km;
    const double now = coarse_.scene_at(values).sheets[s].wavelength_km;
    const auto [least, most] = wavelengths_of(sine, s, straight.values);
    const double near = sine.wavelength >= 0 ? kNearWaveNumber : 0.0;
    const std::vector<SineThroughOffsets> sines =
        sines_through(again[s], 0.5 * length, std::max(least, 1.0 / (1.0 / now + near)),
                      1.0 / std::max(1.0 / most, 1.0 / now - near), free_[sine.thickness].start, 1);
    if (!sines.empty()) take_sine(scene_, free_, sines.front(), s, values);
  }
}

std::vector<Trial> SineSearch::by_lateral_offsets(const Trial& straight) {
  const std::vector<int> waved = waved_sheets();
  if (waved.empty()) return {};
  coarse_.tell("lateral offsets", 0.1);
  const std::vector<Values> starts = starts_through_offsets(straight, waved);
  if (starts.empty()) return {};
  std::vector<Trial> trials = {straight};
  for (std::size_t i = 0; i < starts.size() && !coarse_.exhausted(); ++i) {
    coarse_.tell("lateral offsets", 0.1 + 0.3 * static_cast<double>(i) / static_cast<double>(starts.size()));
    Trial best = coarse_.tried(starts[i]);
    Values values = starts[i];
    for (int round = 0; round < kCourseRounds && !coarse_.exhausted(); ++round) {
      correct_sines(straight, waved, values);
      const Trial next = coarse_.tried(values);
      if (next.chi2 < best.chi2) best = next;
    }
    trials.push_back(best);
  }
  sort_by_chi2(trials);
  coarse_.record(trials.front(), "lateral offsets");
  return trials;
}

void SineSearch::scan_phases(const Values& base, const SineNumbers& sine, double shift, Values values,
                             std::vector<Trial>& trials) {
  if (sine.phase >= 0 && sine.thickness >= 0) {
    trials.push_back(best_sine(values, sine));
    return;
  }
  for (int f = 0; sine.phase >= 0 && f < kPhases; ++f) {
    values[sine.phase] =
        free_[sine.phase].within_limits(base[sine.phase] + 2.0 * sim::kPi * (f + shift) / kPhases);
    trials.push_back(coarse_.tried(values));
  }
}

std::vector<Trial> SineSearch::scan(const Trial& from) {
  std::vector<Trial> trials = {from};
  const std::vector<double> shift = even_point(0, 2, scene_.seed + 1);
  for (std::size_t s = 0; s < scene_.sheets.size(); ++s) {
    const SineNumbers sine = sine_of(static_cast<int>(s));
    if (sine.wavelength < 0 && sine.phase < 0) continue;
    const Values base = trials.front().values;
    const int wavelengths = sine.wavelength < 0 ? 1 : scene_.fit.scan_points;
    for (int w = 0; w < wavelengths && !coarse_.exhausted(); ++w) {
      coarse_.tell("scan", 0.1 + 0.3 * w / wavelengths);
      Values values = base;
      if (sine.wavelength >= 0)
        values[sine.wavelength] = free_[sine.wavelength].within_limits(
            scanned_wavelength(free_[sine.wavelength], base[sine.wavelength], (w + shift[0]) / wavelengths));
      scan_phases(base, sine, shift[1], values, trials);
    }
    sort_by_chi2(trials);
  }
  coarse_.record(trials.front(), "scan");
  return trials;
}

Trial SineSearch::best_sine(Values values, const SineNumbers& sine) {
  const ProfileCost& cost = coarse_.cost();
  values[sine.phase] = free_[sine.phase].within_limits(0.0);
  const ProfileCost::Point point = cost.at(values, true);
  std::vector<double> in_phase, quadrature;
  cost.data_jacobian(point, in_phase);
  Values turned = values;
  turned[sine.phase] = free_[sine.phase].within_limits(0.5 * sim::kPi);
  cost.data_jacobian(cost.at(turned, true), quadrature);
  const Eigen::VectorXd step = linear_step(free_, sine, cost.data_residual(point), in_phase, quadrature);

  Values best = values;
  for (std::size_t j = 0; j < free_.size(); ++j) {
    const FreeNumber& number = free_[j];
    if (static_cast<int>(j) == sine.thickness || static_cast<int>(j) == sine.phase ||
        !std::isfinite(step(static_cast<Eigen::Index>(j))))
      continue;
    const double most = number.logarithmic() ? 0.3 * values[j] : std::max(0.1 * std::abs(values[j]), 5.0);
    best[j] = number.within_limits(values[j] + std::clamp(step(static_cast<Eigen::Index>(j)), -most, most));
  }
  const double a = step(sine.thickness) + values[sine.thickness], b = step(step.size() - 1);
  if (std::isfinite(a) && std::isfinite(b)) {
    const double usual = free_[sine.thickness].start;
    best[sine.thickness] =
        free_[sine.thickness].within_limits(std::clamp(std::hypot(a, b), 0.2 * usual, 3.0 * usual));
    best[sine.phase] = free_[sine.phase].within_limits(std::atan2(b, a));
  }
  return coarse_.tried(best);
}

void SineSearch::search_again(std::vector<Trial>& ends, const std::string& qualifier) {
  const std::vector<int> waved = waved_sheets();
  if (waved.size() < 2) return;
  for (int round = 0; round < kExchangeRounds; ++round) {
    bool any_better = false;
    const auto try_step = [&](const std::string& what, const std::function<std::vector<Trial>()>& work) {
      if (coarse_.exhausted()) return;
      coarse_.tell(what, 0.8);
      const std::vector<Trial> found = coarse_.step(what, 0, work);
      if (found.empty() || found.front().chi2 > (1.0 - kExchangeGain) * ends.front().chi2) return;
      ends.insert(ends.begin(), found.front());
      any_better = true;
    };
    const std::string exchange = " exchange " + std::to_string(round + 1) + qualifier;
    for (std::size_t i = 0; i + 1 < waved.size(); ++i) {
      const std::string name =
          "sheets " + std::to_string(waved[i] + 1) + " and " + std::to_string(waved[i + 1] + 1) + exchange;
      try_step(name, [&] { return with_sines_exchanged(ends.front(), waved[i], waved[i + 1], name); });
    }
    for (const int s : waved) {
      const std::string name = "sheet " + std::to_string(s + 1) + exchange;
      try_step(name, [&] { return with_another_sine(ends.front(), s, name); });
    }
    if (!any_better) return;
  }
}

std::vector<Trial> SineSearch::with_sines_exchanged(const Trial& from, int first, int second,
                                                    const std::string& stage) {
  const SineNumbers a = sine_of(first), b = sine_of(second);
  Values values = from.values;
  for (const auto& [i, j] :
       {std::pair(a.wavelength, b.wavelength), {a.phase, b.phase}, {a.thickness, b.thickness}}) {
    if (i < 0 || j < 0) return {};
    values[i] = free_[i].within_limits(from.values[j]);
    values[j] = free_[j].within_limits(from.values[i]);
  }
  if (in_one_valley(scene_, free_, from.values, values)) return {};
  const Trial end = coarse_.descended(coarse_.tried(values), coarse_.searched(), stage);
  coarse_.record(end, stage);
  return {end};
}

std::vector<Trial> SineSearch::with_another_sine(const Trial& from, int sheet, const std::string& stage) {
  const SineNumbers sine = sine_of(sheet);
  const auto [least, most] = wavelengths_of(sine, sheet, from.values);
  Values straight = from.values;
  straight[sine.thickness] = free_[sine.thickness].within_limits(kNearlyStraight * straight[sine.thickness]);
  std::vector<Trial> trials;
  for (const Values& values : {straight, from.values})
    for (const SineThroughOffsets& candidate : sines_through(
             coarse_.offsets_at(values)[sheet], 0.5 * coarse_.scene_at(values).sheets[sheet].length_km, least,
             most, free_[sine.thickness].start, kSines)) {
      Values other = from.values;
      take_sine(scene_, free_, candidate, sheet, other);
      const auto is_near = [&](const Trial& trial) {
        return in_one_valley(scene_, free_, trial.values, other);
      };
      if (!in_one_valley(scene_, free_, from.values, other) &&
          std::none_of(trials.begin(), trials.end(), is_near))
        trials.push_back(coarse_.tried(other));
    }
  sort_by_chi2(trials);
  std::vector<Trial> ends;
  for (int i = 0; i < kExchangeDescents && i < static_cast<int>(trials.size()) && !coarse_.exhausted(); ++i)
    ends.push_back(coarse_.descended(trials[i], coarse_.searched(), stage));
  sort_by_chi2(ends);
  if (!ends.empty()) coarse_.record(ends.front(), stage);
  return ends;
}

}  // namespace vegard::fit
