#include "fit/map/curtains/curtains.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "fit/map/curtains/ridge_evidence.h"
#include "fit/map/curtains/ridge_section.h"
#include "fit/map/curtains/ridge_trace.h"
#include "fit/map/lower_border.h"
#include "sim/base/number/constants.h"
#include "sim/base/number/quantile.h"
#include "sim/light/tables/emission_tables.h"

namespace vegard::fit {
namespace {

constexpr double kSmooth_px = 2.0;
constexpr double kHigh = 0.15, kLow = 0.06;  // of the brightest ridge (its upper hundredth): begin and go on
constexpr double kMinMean = 0.12;            // of a curtain's own, likewise
constexpr double kFaintHigh = 0.05, kFaintLow = 0.03, kMinFaintMean = 0.04;  // of those below
constexpr double kMinLength_km = 30.0;
constexpr double kStep_km = 5.0;
constexpr double kAround_km = 10.0;    // about the map's light, where replicates are brought to as much
constexpr double kMostScale = 3.0;     // more than the emission tables leave open
constexpr double kSides_km = 6.0;      // of a ridge that must be in view, or as much as its cell is deep
constexpr double kMinPiece_km = 10.0;  // of a ridge that is joined to others
constexpr double kFoundHeight = 0.5;   // of the best map's ridge, that a perturbed solution must have
constexpr double kFoundIn = 0.8;       // of the perturbed solutions, for a point and for a whole curtain
constexpr double kBranchLight = 0.5;   // of the light of the curtain at which it begins
constexpr double kBranchGap = 1.5;     // of the resolution, from a branch to its curtain
constexpr double kHalfWidthReach_km = 100.0;
// What the green light of even the narrowest spectra fills, at half of its peak, and where it begins.
constexpr double kThinLayer_km = 15.0, kBorder_km = 105.0;
constexpr double kFwhm = 2.3548200450309493;  // of a Gaussian, in standard deviations

/// Whether the perturbed solutions have the curtain as well: its flux, summed over its length and width, is
/// above its standard error. True without any.
bool is_in_all(double best, const std::vector<double>& others) {
  double squares = 0.0;
  for (const double other : others) squares += std::pow(other - best, 2);
  return others.empty() || std::sqrt(squares / static_cast<double>(others.size())) <= best;
}

double product(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

/// The highest value within the smoothing's full width at half maximum: ridges nearer than that are one.
std::vector<double> highest_around(const RasterGrid& raster, const std::vector<double>& values) {
  constexpr double kReach = kFwhm * kSmooth_px;
  constexpr int kReachPx = static_cast<int>(kReach);
  std::vector<double> highest = values;
  for (int j = -kReachPx; j <= kReachPx; ++j)
    for (int i = -kReachPx; i <= kReachPx; ++i) {
      if (std::hypot(i, j) > kReach || (i == 0 && j == 0)) continue;
      for (int row = std::max(0, -j); row < std::min(raster.rows, raster.rows - j); ++row) {
        const std::size_t to = static_cast<std::size_t>(row) * raster.columns,
                          from = static_cast<std::size_t>(row + j) * raster.columns;
        for (int column = std::max(0, -i); column < std::min(raster.columns, raster.columns - i); ++column)
          highest[to + column] = std::max(highest[to + column], values[from + column + i]);
      }
    }
  return highest;
}

/// A map's flux on a raster, smoothed to look for ridges.
struct SmoothedFlux {
  RasterFlux flux;
  std::vector<double> smooth;
};

/// Mean square of differences from the best map: of the replicates with the map's spectrum, and of those with
/// another.
class MeanSquare {
 public:
  void add(double difference, bool other_spectrum) {
    sum_[other_spectrum ? 1 : 0] += difference * difference;
    ++count_[other_spectrum ? 1 : 0];
  }
  bool has_any() const { return count_[0] + count_[1] > 0; }
  /// What other spectra add comes on top.
  double root() const {
    if (!has_any()) return sim::kNaN;
    const double same = count_[0] > 0 ? sum_[0] / count_[0] : sum_[1] / count_[1];
    const double other = count_[1] > 0 ? sum_[1] / count_[1] : 0.0;
    return std::sqrt(std::max(same, other));
  }

 private:
  double sum_[2] = {0.0, 0.0};
  int count_[2] = {0, 0};
};

/// The replicates' differences from the best map at one point of a curtain.
struct SectionSpread {
  MeanSquare aside, flux, ln_energy, width, border;
  double found_in = 0.0;  ///< share with a ridge there

  void add(const RidgeSection& replicate, const RidgeSection& best, bool other_spectrum) {
    flux.add(replicate.flux - best.flux, other_spectrum);
    if (!(replicate.flux > 0.0)) return;  // where there is no light, it has no place and no energy
    aside.add(replicate.aside_km - best.aside_km, other_spectrum);
    ln_energy.add(replicate.ln_energy - best.ln_energy, other_spectrum);
    width.add(replicate.width_km - best.width_km, other_spectrum);
  }
};

double energy_of_curtain(const Curtain& curtain) {
  double sum = 0.0;
  for (const CurtainPoint& p : curtain.points) sum += p.flux_mw_m2.value * p.width_km.value;
  return sum;
}

void sort_by_energy(std::vector<Curtain>& curtains) {
  std::stable_sort(curtains.begin(), curtains.end(), [](const Curtain& a, const Curtain& b) {
    return energy_of_curtain(a) > energy_of_curtain(b);
  });
}

/// Takes the ends that are out of view away: they are guesses.
void trim_to_view(std::vector<CurtainPoint>& points) {
  while (!points.empty() && !points.back().border_in_view) points.pop_back();
  points.erase(points.begin(), std::find_if(points.begin(), points.end(),
                                            [](const CurtainPoint& p) { return p.border_in_view; }));
}

/// A ridge of the raster, and what is known of all of its points.
struct TracedRidge {
  RidgeLine feet;
  double length_km = 0.0;
  std::vector<CurtainPoint> points;
  std::vector<double> height, place_error_km;
};

struct RidgesOfMap {
  std::vector<Curtain> curtains, faint;
};

class CurtainFinder {
 public:
  explicit CurtainFinder(const MapResult& result)
      : result_(result),
        raster_(raster_over(result)),
        best_(smoothed_flux(result.cells)),
        in_view_(rasterised(result, raster_, {result.border_in_view.begin(), result.border_in_view.end()})),
        field_(raster_, best_.smooth) {
    const std::vector<double> around =
        smoothed_raster(raster_, best_.flux.flux, kAround_km / raster_.step_km);
    const double light = product(around, best_.smooth);
    for (const std::vector<CellFlux>& replicate : result.replicates) {
      replicates_.push_back(smoothed_flux(replicate));
      const double scale = light / std::max(1e-30, product(around, replicates_.back().smooth));
      scales_.push_back(std::clamp(scale, 1.0 / kMostScale, kMostScale));
    }
    for (std::size_t r = 0; r < replicates_.size(); ++r) {
      borders_.emplace_back(r < result.replicate_values.size()
                                ? scene_with(result.scene, result.numbers, result.replicate_values[r])
                                : result.scene,
                            spectrum_of(r));
    }
    make_nulls();
    for (int c = 0; c < result.grid.cells(); ++c)
      if (result.border_in_view[static_cast<std::size_t>(c)] != 0) area_km2_ += result.grid.area_km2(c);
  }

  RidgesOfMap find() {
    std::vector<RidgeLine> bright, faint;
    std::vector<std::uint8_t> used(raster_.size(), 0);
    for (const std::size_t seed : seeds()) {
      const bool is_bright = field_.smooth[seed] >= kHigh * brightest_;
      if (used[seed] || (!is_bright && field_.smooth[seed] < kFaintHigh * brightest_)) continue;
      RidgeLine ridge = followed_ridge(field_, used, static_cast<int>(seed % raster_.columns),
                                       static_cast<int>(seed / raster_.columns),
                                       (is_bright ? kLow : kFaintLow) * brightest_);
      double length = 0.0;
      if (is_of_one_station(result_))
        ridge = without_ends_along_sight(
            ridge, [&](sim::EastNorth foot) { return resolution_along_sight_km(foot); });
      if (ridge.size() < 3 || (evenly_spaced(ridge, kStep_km, length), length) < kMinPiece_km) continue;
      (is_bright ? bright : faint).push_back(std::move(ridge));
    }
    const auto resolution = [&](sim::EastNorth foot) { return resolution_km(foot); };
    RidgesOfMap ridges;
    for (const RidgeLine& line : joined_lines(std::move(bright), resolution)) sort_in(line, true, ridges);
    for (const RidgeLine& line : joined_lines(std::move(faint), resolution)) sort_in(line, false, ridges);
    sort_by_energy(ridges.curtains);
    set_branches_apart(ridges);
    sort_by_energy(ridges.faint);
    return ridges;
  }

 private:
  SmoothedFlux smoothed_flux(const std::vector<CellFlux>& cells) const {
    RasterFlux flux = raster_flux(result_, raster_, cells);
    std::vector<double> smooth = smoothed_raster(raster_, flux.flux, kSmooth_px);
    return {std::move(flux), std::move(smooth)};
  }

  const sim::ElectronSpectrum& spectrum_of(std::size_t replicate) const {
    return replicate < result_.replicate_spectra.size() ? result_.replicate_spectra[replicate]
                                                        : result_.spectrum;
  }
  bool is_other_spectrum(std::size_t replicate) const {
    return spectrum_of(replicate).kind != result_.spectrum.kind;
  }

  /// Maps of what chance alone makes: what one replicate has above the highest place nearby of another of the
  /// same spectrum.
  void make_nulls() {
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    std::map<sim::ElectronSpectrum::Kind, std::size_t> waiting;
    for (std::size_t r = 0; r < replicates_.size(); ++r) {
      const auto kind = spectrum_of(r).kind;
      const auto other = waiting.find(kind);
      if (other == waiting.end()) {
        waiting[kind] = r;
        continue;
      }
      pairs.emplace_back(other->second, r);
      waiting.erase(other);
    }
    if (pairs.empty() && replicates_.size() > 1) pairs.emplace_back(0, 1);
    // Where the picture is not explained, the map's errors are larger than the noise that was drawn.
    const double unexplained = std::sqrt(std::max(1.0, result_.chi2_per_value()));
    // A ridge whose place differs a little is in both of them.
    const auto add = [&](const std::vector<double>& a, double scale_a, const std::vector<double>& b,
                         double scale_b) {
      std::vector<double> chance = highest_around(raster_, b);
      for (std::size_t i = 0; i < a.size(); ++i)
        chance[i] = unexplained * std::max(0.0, scale_a * a[i] - scale_b * chance[i]);
      nulls_.push_back(std::move(chance));
    };
    for (const auto& [a, b] : pairs) {
      add(replicates_[a].smooth, scales_[a], replicates_[b].smooth, scales_[b]);
      add(replicates_[b].smooth, scales_[b], replicates_[a].smooth, scales_[a]);
    }
    if (pairs.empty() && !replicates_.empty()) add(replicates_[0].smooth, scales_[0], best_.smooth, 1.0);
  }

  double cell_km(sim::EastNorth foot) const {
    const int cell = result_.grid.cell_at(foot.east, foot.north);
    return cell < 0 ? raster_.step_km : result_.grid.depth_km(cell);
  }

  /// Full width at half of its height of a curtain without width.
  double resolution_km(sim::EastNorth foot) const {
    return std::hypot(kFwhm * kSmooth_px * raster_.step_km, cell_km(foot));
  }

  /// Light at one elevation may be at the top of a layer that is near or at the foot of one that is farther.
  double resolution_along_sight_km(sim::EastNorth foot) const {
    const double distance = std::hypot(foot.east, foot.north);
    const double tangent =
        std::max(0.02, kBorder_km / std::max(1.0, distance) - 0.5 * distance / sim::kEarthRadiusKm);
    return std::hypot(resolution_km(foot), kThinLayer_km / tangent);
  }

  /// A ridge has two sides. Light that ends where the view ends, or at the end of the ground, has been put
  /// there for want of a better place.
  bool has_both_sides(std::size_t i) const {
    const sim::EastNorth at = raster_.place(field_.at_x[i], field_.at_y[i]);
    const int cell = result_.grid.cell_at(at.east, at.north);
    const double reach = std::max(kSides_km, cell < 0 ? 0.0 : result_.grid.depth_km(cell));
    for (const double side : {-reach, reach}) {
      const sim::EastNorth beside{at.east + side * field_.along_y[i], at.north - side * field_.along_x[i]};
      if (!is_border_in_view(result_, beside) || !result_.grid.reaches(beside.east, beside.north))
        return false;
    }
    return true;
  }

  /// The ridge points in view, brightest first. Those without two sides are no ridge points any more.
  std::vector<std::size_t> seeds() {
    std::vector<std::size_t> order;
    std::vector<double> heights;
    for (std::size_t i = 0; i < raster_.size(); ++i) {
      if (!field_.is_ridge[i] || in_view_[i] <= 0.5) continue;
      if (!has_both_sides(i)) {
        field_.is_ridge[i] = 0;
        continue;
      }
      order.push_back(i);
      heights.push_back(field_.smooth[i]);
    }
    if (order.empty()) return order;
    brightest_ = sim::nth_value(heights, heights.size() - 1 - heights.size() / 100);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return field_.smooth[a] > field_.smooth[b]; });
    return order;
  }

  /// Makes curtains of a ridge, or of its parts that count, and puts them where they belong.
  void sort_in(const RidgeLine& line, bool is_bright, RidgesOfMap& ridges) const {
    TracedRidge ridge;
    ridge.feet = evenly_spaced(line, kStep_km, ridge.length_km);
    if (ridge.length_km < kMinLength_km || !measure(ridge)) return;
    for (const auto& [first, last] : parts_that_count(ridge)) {
      double mean = 0.0;
      for (std::size_t i = first; i < last; ++i)
        mean += raster_value(raster_, field_.smooth, ridge.feet[i]) / static_cast<double>(last - first);
      std::optional<Curtain> curtain = curtain_of(ridge, first, last);
      if (!curtain || mean < kMinFaintMean * brightest_) continue;
      const bool is_tested = !replicates_.empty();
      const bool is_sure = !is_tested || (is_found(*curtain) && curtain->probability >= kCurtainProbability);
      const bool is_curtain =
          is_bright && mean >= kMinMean * brightest_ && is_sure && !curtain->is_diffuse_patch;
      (is_curtain ? ridges.curtains : ridges.faint).push_back(std::move(*curtain));
    }
  }

  /// Light that is put nearer or farther than its curtain makes a branch of it, which a picture from one side
  /// hardly tells from a fold.
  void set_branches_apart(RidgesOfMap& ridges) const {
    std::vector<Curtain> kept;
    for (Curtain& curtain : ridges.curtains) {
      curtain.is_branch = std::any_of(kept.begin(), kept.end(), [&](const Curtain& brighter) {
        return energy_of_curtain(curtain) < kBranchLight * energy_of_curtain(brighter) &&
               (touches(curtain.points.front().foot_km, brighter) ||
                touches(curtain.points.back().foot_km, brighter));
      });
      (curtain.is_branch ? ridges.faint : kept).push_back(std::move(curtain));
    }
    ridges.curtains = std::move(kept);
  }

  bool touches(sim::EastNorth end, const Curtain& curtain) const {
    const double reach = kBranchGap * resolution_km(end);
    return std::any_of(curtain.points.begin(), curtain.points.end(), [&](const CurtainPoint& p) {
      return std::hypot(p.foot_km.east - end.east, p.foot_km.north - end.north) < reach;
    });
  }

  static bool is_found(const Curtain& curtain) {
    double sum = 0.0;
    for (const CurtainPoint& p : curtain.points) sum += p.found_in;
    return sum >= kFoundIn * static_cast<double>(curtain.points.size());
  }

  /// Fills a ridge's points; false if its share of the flux is below its error.
  bool measure(TracedRidge& ridge) const {
    double whole = 0.0;  // flux, over length and width
    std::vector<double> whole_of_replicates(replicates_.size(), 0.0);
    for (std::size_t i = 0; i < ridge.feet.size(); ++i) {
      const sim::EastNorth foot = ridge.feet[i], across = across_line(ridge.feet, i);
      const RidgeSection best = ridge_section(raster_, best_.smooth, best_.flux, foot, across, kStep_km);
      whole += best.flux * best.width_km;
      SectionSpread spread;
      const double border =
          result_.altitude_scale *
          lower_border(result_.scene, std::exp(best.ln_energy), result_.spectrum).altitude_km;
      for (std::size_t r = 0; r < replicates_.size(); ++r) {
        const RidgeSection other =
            ridge_section(raster_, replicates_[r].smooth, replicates_[r].flux, foot, across, kStep_km);
        whole_of_replicates[r] += scales_[r] * other.flux * other.width_km;
        spread.add(other, best, is_other_spectrum(r));
        if (other.flux > 0.0) spread.border.add(border_km(other.ln_energy, r) - border, is_other_spectrum(r));
      }
      if (!replicates_.empty() && !spread.aside.has_any()) {
        // No perturbed solution has light here: all is open.
        spread.aside.add(resolution_km(foot), false);
        spread.ln_energy.add(1.0, false);
        spread.width.add(best.width_km, false);
        spread.border.add(kThinLayer_km, false);
      }
      const double place = replicates_.empty() ? 0.0 : spread.aside.root();
      ridge.place_error_km.push_back(place);
      ridge.height.push_back(height_at(best_.smooth, foot, across, place).height);
      int found = 0;
      for (std::size_t r = 0; r < replicates_.size(); ++r)
        found += scales_[r] * height_at(replicates_[r].smooth, foot, across, place).height >=
                 kFoundHeight * ridge.height.back();
      spread.found_in = replicates_.empty()
                            ? sim::kNaN
                            : static_cast<double>(found) / static_cast<double>(replicates_.size());
      ridge.points.push_back(point_at(foot, across, best, spread));
    }
    return is_in_all(whole, whole_of_replicates);
  }

  /// Within the error of its place, or what is not resolved.
  RidgeHeight height_at(const std::vector<double>& values, sim::EastNorth foot, sim::EastNorth across,
                        double place_error_km) const {
    const double resolution = resolution_km(foot);
    return ridge_height(raster_, values, foot, across, std::hypot(0.5 * resolution, place_error_km),
                        1.5 * resolution);
  }

  /// From which point to before which. Stretches that do not count split a ridge if they are longer than the
  /// gaps over which pieces are joined.
  std::vector<std::pair<std::size_t, std::size_t>> parts_that_count(const TracedRidge& ridge) const {
    std::vector<std::pair<std::size_t, std::size_t>> parts;
    const std::size_t count = ridge.points.size();
    if (replicates_.empty()) return {{0, count}};
    const double step = ridge.length_km / std::max<double>(1.0, static_cast<double>(count) - 1.0);
    for (std::size_t i = 0; i < count; ++i) {
      if (ridge.points[i].found_in < kFoundIn) continue;
      const double gap = parts.empty() ? 0.0 : static_cast<double>(i + 1 - parts.back().second) * step;
      if (parts.empty() || gap > kJoinedGap * resolution_km(ridge.feet[i]))
        parts.emplace_back(i, i + 1);
      else
        parts.back().second = i + 1;
    }
    // None counts: what is left is for the table of faint ones.
    if (parts.empty()) parts.emplace_back(0, count);
    return parts;
  }

  std::optional<Curtain> curtain_of(const TracedRidge& ridge, std::size_t first, std::size_t last) const {
    Curtain curtain;
    curtain.points.assign(ridge.points.begin() + static_cast<std::ptrdiff_t>(first),
                          ridge.points.begin() + static_cast<std::ptrdiff_t>(last));
    trim_to_view(curtain.points);
    if (curtain.points.size() < 3) return {};
    curtain.length_km = ridge.length_km * (static_cast<double>(curtain.points.size()) - 1.0) /
                        (static_cast<double>(ridge.feet.size()) - 1.0);
    if (curtain.length_km < kMinLength_km) return {};
    double height = 0.0, resolution = 0.0;
    std::vector<std::vector<double>> nulls(nulls_.size());
    std::vector<double> widths;
    for (std::size_t i = first; i < last; ++i) {
      const sim::EastNorth across = across_line(ridge.feet, i);
      const auto share = 1.0 / static_cast<double>(last - first);
      height += ridge.height[i] * share;
      resolution += resolution_km(ridge.feet[i]) * share;
      widths.push_back(width_at_half_km(ridge.feet[i], across));
      for (std::size_t n = 0; n < nulls_.size(); ++n)
        nulls[n].push_back(height_at(nulls_[n], ridge.feet[i], across, ridge.place_error_km[i]).height);
    }
    curtain.width_at_half_km = sim::median(widths);
    curtain.is_diffuse_patch = is_diffuse_patch(curtain.width_at_half_km, curtain.length_km, resolution);
    curtain.probability = ridge_probability(height, nulls, curtain.length_km / resolution,
                                            area_km2_ / (curtain.length_km * resolution));
    return curtain;
  }

  double width_at_half_km(sim::EastNorth foot, sim::EastNorth across) const {
    const double half = 0.5 * raster_value(raster_, best_.smooth, foot);
    double width = 0.0;
    for (const double side : {-1.0, 1.0}) {
      double t = 0.0;
      while (t < kHalfWidthReach_km &&
             raster_value(raster_, best_.smooth,
                          {foot.east + side * t * across.east, foot.north + side * t * across.north}) > half)
        t += 1.0;
      width += t;
    }
    return width;
  }

  /// By a replicate's own tables and spectrum, of electrons with the mean energy that those of the map's have
  /// at this E0.
  double border_km(double ln_energy, std::size_t replicate) const {
    const double e0 = std::exp(ln_energy) * sim::mean_energy_over_e0(result_.spectrum) /
                      sim::mean_energy_over_e0(spectrum_of(replicate));
    return result_.altitude_scale * borders_[replicate].altitude_km(e0);
  }

  CurtainPoint point_at(sim::EastNorth foot, sim::EastNorth across, const RidgeSection& best,
                        const SectionSpread& spread) const {
    CurtainPoint p;
    p.foot_km = foot;
    p.distance_km = std::hypot(foot.east, foot.north);
    p.azimuth_deg = std::atan2(foot.east, foot.north) / sim::kRadiansPerDegree;
    if (p.azimuth_deg < 0.0) p.azimuth_deg += 360.0;
    p.border_in_view = raster_value(raster_, in_view_, foot) > 0.5;
    p.found_in = spread.found_in;
    // A ridge's place is not known better than a part of the cells it is made of.
    p.lateral_error_km = std::hypot(spread.aside.root(), cell_km(foot) / std::sqrt(12.0));
    const double towards =
        p.distance_km > 0.0 ? (across.east * foot.east + across.north * foot.north) / p.distance_km : 1.0;
    p.distance_error_km = p.lateral_error_km * std::max(0.3, std::abs(towards));
    p.flux_mw_m2 = {best.flux, spread.flux.root()};
    const double ln_error = kEnergyInflation * spread.ln_energy.root();
    p.energy_kev = {std::exp(best.ln_energy), std::exp(best.ln_energy) * ln_error};
    const std::vector<double>& nodes = result_.energies_kev;
    if (nodes.size() > 1) {
      if (best.ln_energy < std::log(nodes[1])) p.energy_limit = -1;
      if (best.ln_energy > std::log(nodes[nodes.size() - 2])) p.energy_limit = 1;
    }
    // What is narrower than a part of a pixel has no width of its own.
    p.width_km = {std::max(best.width_km, 0.25 * raster_.step_km), spread.width.root()};
    LowerBorder border = lower_border(result_.scene, p.energy_kev.value, result_.spectrum);
    border.altitude_km *= result_.altitude_scale;
    p.lower_border_km = {border.altitude_km,
                         replicates_.empty() ? sim::kNaN : kEnergyInflation * spread.border.root()};
    // A border that is higher is farther away at the same elevation.
    p.distance_error_km =
        std::hypot(p.distance_error_km, p.lower_border_km.error * p.distance_km / p.lower_border_km.value);
    p.at_edge = is_at_edge(result_, foot) || (std::isfinite(p.distance_error_km) && may_be_beyond(p));
    return p;
  }

  /// Whether the map's ground ends within two standard errors of a point.
  bool may_be_beyond(const CurtainPoint& p) const {
    const double farther = 1.0 + 2.0 * p.distance_error_km / std::max(1e-9, p.distance_km);
    return !result_.grid.reaches(farther * p.foot_km.east, farther * p.foot_km.north);
  }

  const MapResult& result_;
  const RasterGrid raster_;
  const SmoothedFlux best_;
  const std::vector<double> in_view_;
  std::vector<SmoothedFlux> replicates_;
  /// A factor for each replicate that brings its light, near that of the best map, to as much. What is not
  /// known of the emission tables changes the brightness of everything, and makes no ridges.
  std::vector<double> scales_;
  std::vector<std::vector<double>> nulls_;  // smoothed
  std::vector<LowerBorderTable> borders_;   // by replicate
  RidgeField field_;
  double brightest_ = 0.0;  // ridge, its upper hundredth
  double area_km2_ = 0.0;   // in view
};

RidgesOfMap ridges_of_map(const MapResult& result) {
  if (result.grid.cells() == 0) return {};
  return CurtainFinder(result).find();
}

}  // namespace

bool is_at_edge(const MapResult& result, sim::EastNorth foot_km) {
  const int cell = result.grid.cell_at(foot_km.east, foot_km.north);
  // The farthest two cells, or what the smoothing of ridges mixes with them.
  const double reach = std::max(kFwhm * kSmooth_px * 2.0, cell < 0 ? 0.0 : 2.0 * result.grid.depth_km(cell));
  const double distance = std::hypot(foot_km.east, foot_km.north);
  if (is_of_one_station(result))
    return distance > 0.0 && !result.grid.reaches(foot_km.east * (1.0 + reach / distance),
                                                  foot_km.north * (1.0 + reach / distance));
  for (const auto& [east, north] : {std::pair{reach, 0.0}, {-reach, 0.0}, {0.0, reach}, {0.0, -reach}})
    if (!result.grid.reaches(foot_km.east + east, foot_km.north + north)) return true;
  return false;
}

std::vector<Curtain> find_curtains(const MapResult& result) { return ridges_of_map(result).curtains; }

std::vector<Curtain> find_faint_curtains(const MapResult& result) { return ridges_of_map(result).faint; }

}  // namespace vegard::fit
