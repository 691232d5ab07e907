#include "sim/emit/aurora/sheet.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "sim/base/number/constants.h"
#include "sim/base/number/distributions.h"
#include "sim/base/number/random.h"
#include "sim/emit/aurora/sheet_curve.h"
#include "sim/light/electron.h"

namespace vegard::sim {
namespace {

double phase_laid_out(const Sheet& sheet, const BeamPlace& place, int layer, double instant_s) {
  const double layer_part = sheet.layers > 1 ? static_cast<double>(layer) / (sheet.layers - 1) : 0.0;
  return kTwoPi / sheet.wavelength_km *
             (place.s_of_phase * sheet.length_km - sheet.sine_speed_km_s * instant_s) +
         sheet.phase_rad + sheet.phase_shift_rad * layer_part;
}

/// Van der Corput's sequence in base 2: the bits of i mirrored at the point.
double van_der_corput(std::uint32_t i) {
  i = (i >> 16) | (i << 16);
  i = ((i >> 8) & 0x00ff00ffu) | ((i & 0x00ff00ffu) << 8);
  i = ((i >> 4) & 0x0f0f0f0fu) | ((i & 0x0f0f0f0fu) << 4);
  i = ((i >> 2) & 0x33333333u) | ((i & 0x33333333u) << 2);
  i = ((i >> 1) & 0x55555555u) | ((i & 0x55555555u) << 1);
  return (static_cast<double>(i) + 0.5) / 4294967296.0;
}

}  // namespace

double line_length_km(const Sheet& sheet) {
  return is_curve(sheet) ? curve_layout(sheet).length_km : sheet.length_km;
}

StretchOfSheet stretch_of(const Sheet& sheet, double instant_s) {
  // Along a curve places count from its start, and drift with it.
  if (is_curve(sheet)) {
    const double length = line_length_km(sheet);
    return {0.5 * length, length, 0.0};
  }
  const double bearing = sheet.bearing_deg * kRadiansPerDegree;
  const double east = sheet.center_km.east + sheet.drift_km_s.east * instant_s;
  const double north = sheet.center_km.north + sheet.drift_km_s.north * instant_s;
  const double drifted =
      (sheet.drift_km_s.east * std::sin(bearing) + sheet.drift_km_s.north * std::cos(bearing)) * instant_s;
  return {east * std::sin(bearing) + north * std::cos(bearing), sheet.length_km, drifted};
}

StretchOfSheet moved(const StretchOfSheet& stretch, const Sheet& sheet, double later_s) {
  if (is_curve(sheet)) return stretch;
  const double bearing = sheet.bearing_deg * kRadiansPerDegree;
  const double way =
      (sheet.drift_km_s.east * std::sin(bearing) + sheet.drift_km_s.north * std::cos(bearing)) * later_s;
  return {stretch.center_km + way, stretch.length_km, stretch.drifted_km + way};
}

double aside_laid_out_km(const Sheet& sheet, const BeamPlace& place, int layer, double instant_s) {
  return sheet.thickness_km * std::sin(phase_laid_out(sheet, place, layer, instant_s)) +
         sheet.width_km * place.across;
}

double slope_laid_out(const Sheet& sheet, const BeamPlace& place, int layer, double instant_s) {
  return sheet.thickness_km * kTwoPi / sheet.wavelength_km *
         std::cos(phase_laid_out(sheet, place, layer, instant_s));
}

double path_step_of(const Sheet& sheet) {
  const std::optional<double> energy_kev = mean_energy_kev(sheet);
  return sheet.step_rule == PathStepRule::energy && energy_kev ? path_step_of(*energy_kev) : sheet.path_step;
}

int beams_per_layer(const Sheet& sheet) {
  if (sheet.beams_per_km <= 0.0) return sheet.beams;
  return std::clamp(static_cast<int>(std::lround(sheet.beams_per_km * line_length_km(sheet))), 1,
                    kSheetMaxBeams);
}

std::uint32_t layer_address(int sheet_index, int arc, int layer) {
  return (static_cast<std::uint32_t>(sheet_index) << 16) | (static_cast<std::uint32_t>(arc) << 8) |
         static_cast<std::uint32_t>(layer);
}

LayerPlaces::LayerPlaces(const Sheet& sheet, std::uint32_t layer_address, std::uint64_t seed, double beyond,
                         const SheetNodes& nodes)
    : in_nodes_(!nodes.beams.empty()),
      drawn_(beams_per_layer(sheet)),
      nodes_(nodes),
      across_(normal_nodes(nodes.across)),
      seed_(seed),
      address_(layer_address),
      rule_(sheet.spacing_rule),
      jitter_(sheet.spacing_jitter),
      shift_(uniform(random_words(seed, Stream::cross_section, 0, layer_address)[0])) {
  if (in_nodes_) {
    lay_out_nodes(beyond);
    return;
  }
  const int own = drawn_;
  // An odd number of beams more puts both ends into the middle of a beam: at a border the light has a kink.
  const int more =
      rule_ == SpacingRule::literal || beyond <= 0.0 ? 0 : 2 * static_cast<int>(beyond * own) + 1;
  beams_ = own + more;
  beyond_ = 0.5 * more / own;
  if (rule_ == SpacingRule::stratified) return;
  double sum = 0.0;
  for (int i = 0; i < beams_; ++i) {
    if (i % kSumEvery == 0) sums_.push_back(sum);
    sum += step(i).length;
  }
  sums_.push_back(sum);
}

void LayerPlaces::lay_out_nodes(double beyond) {
  beyond_ = rule_ == SpacingRule::literal ? 0.0 : std::max(0.0, beyond);
  const auto parts = static_cast<double>(nodes_.beams.size());
  double before = 0.0;
  const auto add = [&](double from, double beams) {
    from_.push_back(from);
    before_.push_back(before);
    before += beams;
  };
  if (beyond_ > 0.0) add(-beyond_, nodes_.beams.front() * parts * beyond_);
  for (std::size_t k = 0; k < nodes_.beams.size(); ++k) add(static_cast<double>(k) / parts, nodes_.beams[k]);
  if (beyond_ > 0.0) add(1.0, nodes_.beams.back() * parts * beyond_);
  add(1.0 + beyond_, 0.0);
  // With an odd number no beam begins where that of an even line does: at a border the light has a kink.
  beams_ = (static_cast<int>(std::ceil(before)) | 1) * nodes_.across;
  for (int k = 0; k < kRecurrences; ++k)
    recurrence_from_[k] =
        uniform(random_words(0, Stream::cross_section, static_cast<std::uint32_t>(k), address_)[1]);
}

LayerPlaces::Step LayerPlaces::step(int beam) const {
  const Words words = random_words(seed_, Stream::beam_spacing, static_cast<std::uint32_t>(beam), address_);
  const double u = uniform(words[0]), even = 1.0 / beams_;
  return {rule_ == SpacingRule::literal ? even * (u > 0.5 ? 1.0 + u : 1.0 - u)
                                        : even * (1.0 + jitter_ * (2.0 * u - 1.0)),
          jitter_ * (u - 0.5), uniform(words[1])};
}

double LayerPlaces::on_line(double share) const {
  const double beams = share * before_.back();
  const auto next = std::upper_bound(before_.begin() + 1, before_.end() - 1, beams);
  const auto part = static_cast<std::size_t>(next - before_.begin()) - 1;
  const double in_part = before_[part + 1] - before_[part];
  return from_[part] + (from_[part + 1] - from_[part]) * (beams - before_[part]) / in_part;
}

BeamPlace LayerPlaces::place_in_nodes(int beam) const {
  // Steps of additive recurrences, from place to place along and from node to node across: the golden
  // section, which fills every stretch of a line most evenly, and other irrational numbers.
  constexpr double kStep[kRecurrences] = {0.6180339887498949, 0.4142135623730951, 0.2360679774997898};
  constexpr double kStepAcross[kRecurrences] = {0.0, 0.7548776662466927, 0.6710436067037893};
  const int many = nodes_.across, along = beam / many, side = beam % many;
  const auto recurrence = [&](int which) {
    const double at = recurrence_from_[which] + along * kStep[which] +
                      side * (which == 0 ? 1.0 / many : kStepAcross[which]);
    return std::clamp(at - std::floor(at), 1e-9, 1.0 - 1e-9);
  };
  const double even = static_cast<double>(many) / beams_, at = (along + 0.5) * even;
  BeamPlace place;
  if (rule_ == SpacingRule::literal) {
    // Steps are (1 - u) or (1 + u) times the even one, u below or above a half: of mean 5/4 and variance
    // 13/48. A beam stands before its step.
    const double before = std::max(0.0, at - 0.5 / drawn_);
    place.s = 1.25 * before + std::sqrt(13.0 / 48.0 * before / drawn_) * normal_quantile(recurrence(1));
    place.s_of_phase = before;
    place.from = place.s;
    place.to = place.s + even;
  } else {
    place.from = on_line(along * even);
    place.to = on_line((along + 1) * even);
    place.s = place.s_of_phase = 0.5 * (place.from + place.to);
  }
  place.across = across_[side].place;
  place.weight = across_[side].weight;
  place.node = recurrence(0);
  place.ray = normal_quantile(recurrence(2));
  // One side's beams stand off by the same, so that they stay evenly spaced; those of all sides of two layers
  // by the mean and the variance of the tube.
  place.along_in_tube = ((static_cast<unsigned>(side) + address_) & 1u) != 0 ? -1.0 : 1.0;
  return place;
}

void LayerPlaces::fill(int first, int count, BeamPlace* out) const {
  if (in_nodes_) {
    for (int i = first; i < first + count; ++i) out[i - first] = place_in_nodes(i);
    return;
  }
  const double even = 1.0 / beams_, all = sums_.empty() ? 1.0 : sums_.back();
  const auto scaled = [&](double at) { return at / all * (1.0 + 2.0 * beyond_) - beyond_; };
  double s = sums_.empty() ? 0.0 : sums_[first / kSumEvery];
  for (int i = first; i < first + count; ++i) {
    const Step step = this->step(i);
    BeamPlace& place = out[i - first];
    switch (rule_) {
      case SpacingRule::stratified:
        place.s = scaled((i + 0.5 + step.shift) * even);
        place.from = scaled(i * even);
        place.to = scaled((i + 1) * even);
        break;
      case SpacingRule::tied:
        place.s = scaled(s + 0.5 * step.length);
        place.from = scaled(s);
        place.to = scaled(s + step.length);
        break;
      case SpacingRule::literal:
        place.s = place.from = s;
        place.to = s + even;
        break;
    }
    place.s_of_phase = rule_ == SpacingRule::literal ? i * even : place.s;
    s += step.length;
    double across = van_der_corput(static_cast<std::uint32_t>(i)) + shift_;
    if (across >= 1.0) across -= 1.0;
    place.across = normal_quantile(across);
    place.depth = step.depth;
  }
}

}  // namespace vegard::sim
