#include "fit/stability.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>

#include "fit/answer/verdict.h"
#include "fit/fit.h"
#include "fit/parameters/free_parameters.h"
#include "sim/base/error.h"
#include "sim/base/number/constants.h"
#include "sim/base/parallel.h"

namespace vegard::fit {
namespace {

constexpr double kSideLeftOut = 1.0 / 3.0, kTopLeftOut = 0.25, kBottomLeftOut = 0.1;
constexpr double kFewerBands = 0.5, kMoreBands = 1.5;
constexpr double kHazeFactor = 2.0, kClearDepth = 0.02, kHazyDepth = 0.2;
constexpr double kTransferCurvePower = 1.1;
constexpr double kModelErrorFactor = 2.0;
constexpr double kRefuted = 2.0;  // times chi2 per degree of freedom
constexpr double kShareOfStability = 0.95;

void vary_region(const sim::Scene& from, const std::vector<Photo>& photos, std::vector<Variation>& all) {
  const bool is_upright = from.fit.profile_along == sim::ProfileAlong::columns ||
                          from.fit.profile_along == sim::ProfileAlong::elevation ||
                          from.fit.profile_along == sim::ProfileAlong::field;
  if (!is_upright || photos.size() != 1) return;
  std::array<int, 4> whole = from.fit.roi_px;
  const sim::PictureSize file_size = size_of_file(photos.front());
  if (whole == std::array<int, 4>{0, 0, 0, 0}) whole = {0, 0, file_size.width, file_size.height};
  const auto add = [&](const char* name, double left, double right, double top, double bottom) {
    Variation v{"region", name, from};
    const auto cut = [](double share, int length) { return static_cast<int>(std::lround(share * length)); };
    std::array<int, 4>& roi = v.scene.fit.roi_px;
    roi = {whole[0] + cut(left, whole[2]), whole[1] + cut(top, whole[3]),
           whole[2] - cut(left, whole[2]) - cut(right, whole[2]),
           whole[3] - cut(top, whole[3]) - cut(bottom, whole[3])};
    // Bands stay as wide as they were.
    v.scene.fit.bands = std::max(1, cut(static_cast<double>(roi[2]) / whole[2], from.fit.bands));
    if (roi[2] > 0 && roi[3] > 0) all.push_back(std::move(v));
  };
  add("without its left third", kSideLeftOut, 0.0, 0.0, 0.0);
  add("without its right third", 0.0, kSideLeftOut, 0.0, 0.0);
  add("without its upper quarter", 0.0, 0.0, kTopLeftOut, 0.0);
  add("without its lowest tenth", 0.0, 0.0, 0.0, kBottomLeftOut);
}

void vary_bands(const sim::Scene& from, std::vector<Variation>& all) {
  for (const double factor : {kFewerBands, kMoreBands}) {
    Variation v{"bands", "", from};
    v.scene.fit.bands = std::max(1, static_cast<int>(std::lround(factor * from.fit.bands)));
    if (v.scene.fit.bands == from.fit.bands) continue;
    v.name = std::to_string(v.scene.fit.bands) + " in place of " + std::to_string(from.fit.bands);
    all.push_back(std::move(v));
  }
}

void vary_sky(const sim::Scene& from, std::vector<Variation>& all) {
  static const char* const kNames[] = {"a level alone", "level and gradient", "level, gradient, curvature"};
  for (const int terms : {from.fit.sky_terms - 1, from.fit.sky_terms + 1}) {
    if (terms < 1 || terms > 3) continue;
    Variation v{"sky", kNames[terms - 1], from};
    v.scene.fit.sky_terms = terms;
    all.push_back(std::move(v));
  }
}

void vary_air(const sim::Scene& from, std::vector<Variation>& all) {
  if (from.sheets.empty() && from.footprints.empty()) return;
  for (const FreeNumber& number : free_numbers(from))
    if (number.id.role() == sim::ParameterRole::aerosol_depth) return;  // the fit has found it
  const bool has_air = from.air.model != sim::AirModel::none;
  const auto add = [&](const char* name, double depth) {
    Variation v{"air", name, from};
    v.scene.air.model = sim::AirModel::standard;
    v.scene.air.aerosol_optical_depth = depth;
    all.push_back(std::move(v));
  };
  if (!has_air) {
    add("clear, in place of none", kClearDepth);
    add("hazy, in place of none", kHazyDepth);
    return;
  }
  add("half the haze", from.air.aerosol_optical_depth / kHazeFactor);
  add("twice the haze", from.air.aerosol_optical_depth * kHazeFactor);
}

/// That is not the fit's own to find.
bool is_out_of_a_curve(const Photo& photo) {
  return photo.unknowns == 0 && (photo.srgb || photo.tone != nullptr);
}

void vary_curve(const sim::Scene& from, const std::vector<Photo>& photos, std::vector<Variation>& all) {
  if (std::none_of(photos.begin(), photos.end(), is_out_of_a_curve)) return;
  all.push_back({"curve", "steeper by a tenth", from, kTransferCurvePower});
  all.push_back({"curve", "flatter by a tenth", from, 1.0 / kTransferCurvePower});
}

void vary_model_error(const sim::Scene& from, std::vector<Variation>& all) {
  if (from.fit.model_error <= 0.0) return;
  all.push_back({"model error", "half of it", from});
  all.back().scene.fit.model_error /= kModelErrorFactor;
  all.push_back({"model error", "twice as large", from});
  all.back().scene.fit.model_error = std::min(1.0, kModelErrorFactor * from.fit.model_error);
}

/// Light that came out of a display's curve, with another one. What was linear in its file is that.
std::vector<Photo> recurved(const std::vector<Photo>& photos, double power) {
  std::vector<Photo> all = photos;
  for (Photo& photo : all) {
    if (!is_out_of_a_curve(photo)) continue;
    for (float& light : photo.linear.data)
      light = light > 0.0F ? std::pow(light, static_cast<float>(power)) : light;
  }
  return all;
}

FitResult fitted_again(const Variation& variation, const std::vector<Photo>& photos,
                       const FitOptions& options) {
  const auto fit = [&](const std::vector<Photo>& pictures) {
    return variation.scene.fit.photos.empty() ? fit_photo(variation.scene, pictures.front(), options)
                                              : fit_photos(variation.scene, pictures, options);
  };
  return variation.transfer_curve_power == 1.0 ? fit(photos)
                                               : fit(recurved(photos, variation.transfer_curve_power));
}

/// The shift of an angle is the shorter way round.
double shift_of(double value, double from, const std::string& unit) {
  return unit == "deg" ? std::remainder(value - from, 360.0) : value - from;
}

/// A refit's answer to the numbers of the first one, which stand in the same order.
void take(const FitResult& first, const FitResult& again, StabilityRow& row) {
  row.chi2_per_dof = again.dof > 0 ? again.chi2 / again.dof : sim::kNaN;
  if (again.verdict == Verdict::failed || again.verdict == Verdict::interrupted) {
    row.problem = again.verdict_line;
    return;
  }
  // Other regions, bands and errors make chi2 of other data.
  const bool same_data = row.choice == "sky" || row.choice == "air" || row.choice == "curve";
  row.is_refuted = same_data && first.dof > 0 && row.chi2_per_dof > kRefuted * first.chi2 / first.dof;
  for (const DerivedNumber& d : first.derived) {
    const auto same = std::find_if(again.derived.begin(), again.derived.end(),
                                   [&](const DerivedNumber& other) { return other.name == d.name; });
    StabilityRow::Shift shift;
    if (same != again.derived.end() && std::isfinite(same->value) && std::isfinite(d.value)) {
      shift.by = shift_of(same->value, d.value, d.unit);
      if (d.sigma && same->sigma)
        shift.variance_by_chance = std::abs(*same->sigma * *same->sigma - *d.sigma * *d.sigma);
    }
    row.derived.push_back(shift);
  }
}

StabilityRow row_of(const FitResult& first, const Variation& variation, const std::vector<Photo>& photos,
                    const FitOptions& options) {
  StabilityRow row;
  row.choice = variation.choice;
  row.name = variation.name;
  try {
    take(first, fitted_again(variation, photos, options), row);
  } catch (const sim::Error& error) {
    row.problem = error.details().problem;
  }
  return row;
}

/// Side by side, each by itself: the rows do not depend on how many threads there are.
std::vector<StabilityRow> rows_of(const FitResult& first, const std::vector<Variation>& variations,
                                  const std::vector<Photo>& photos, const FitOptions& options) {
  FitOptions alone;
  alone.threads = 1;
  alone.max_evaluations = options.max_evaluations;
  alone.stop = options.stop;
  std::vector<StabilityRow> rows(variations.size());
  std::mutex telling;
  sim::parallel_for(variations.size(), options.threads, [&](std::size_t i, int) {
    if (options.stop != nullptr && options.stop->load()) return;
    if (options.progress) {
      const std::scoped_lock lock(telling);
      options.progress("stability", first.evaluations, first.chi2 / std::max(1, first.dof),
                       kShareOfStability);
    }
    rows[i] = row_of(first, variations[i], photos, alone);
  });
  return rows;
}

}  // namespace

std::vector<Variation> variations_of(const sim::Scene& best, const std::vector<Photo>& photos) {
  sim::Scene from = best;
  from.fit.scan_points = 0;  // begins at the answer, where a descent is all that is asked
  std::vector<Variation> all;
  vary_region(from, photos, all);
  vary_bands(from, all);
  vary_sky(from, all);
  vary_air(from, all);
  vary_curve(from, photos, all);
  vary_model_error(from, all);
  return all;
}

std::optional<double> systematic_error(const std::vector<StabilityRow>& rows, std::size_t derived) {
  struct Sum {
    double squares = 0.0, by_chance = 0.0;
    int count = 0;
  };
  std::map<std::string, Sum> by_choice;
  for (const StabilityRow& row : rows) {
    if (row.is_refuted || derived >= row.derived.size() || !std::isfinite(row.derived[derived].by)) continue;
    Sum& sum = by_choice[row.choice];
    sum.squares += row.derived[derived].by * row.derived[derived].by;
    sum.by_chance += row.derived[derived].variance_by_chance;
    ++sum.count;
  }
  if (by_choice.empty()) return {};
  double variance = 0.0;
  for (const auto& [choice, sum] : by_choice)
    variance += std::max(0.0, sum.squares - sum.by_chance) / sum.count;
  return std::sqrt(variance);
}

void assess_stability(const std::vector<Photo>& photos, const FitOptions& options, FitResult& result) {
  if (result.verdict == Verdict::failed || result.verdict == Verdict::interrupted ||
      result.validation_interrupted)
    return;
  std::vector<StabilityRow> rows = rows_of(result, variations_of(result.best, photos), photos, options);
  if (options.stop != nullptr && options.stop->load()) {
    result.validation_interrupted = true;
    return;
  }
  for (std::size_t i = 0; i < result.derived.size(); ++i)
    if (result.derived[i].sigma) result.derived[i].systematic = systematic_error(rows, i);
  result.stability = std::move(rows);
  assess_quantities(result);
}

}  // namespace vegard::fit
