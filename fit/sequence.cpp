#include "fit/sequence.h"

#include <algorithm>
#include <cmath>

#include "fit/answer/energy_flux.h"
#include "fit/parameters/free_parameters.h"
#include "sim/scene/table/parameter_id.h"

namespace vegard::fit {
namespace {

/// Starts at the values of another frame. Entries for a vector become one for each of its components.
sim::Scene started_at(const sim::Scene& scene, const std::vector<double>& values) {
  const std::vector<FreeNumber> free = free_numbers(scene);
  sim::Scene warm = scene;
  warm.fit.free.clear();
  for (const sim::FreeParameter& entry : scene.fit.free) {
    if (entry.path.empty()) {  // a number that only expressions use
      warm.fit.free.push_back(entry);
      for (std::size_t j = 0; j < free.size() && j < values.size(); ++j)
        if (free[j].name == entry.name)
          warm.fit.free.back().start = std::clamp(values[j], free[j].min, free[j].max);
      continue;
    }
    for (const sim::ParameterPath& path : sim::resolve(scene, entry.path)) {
      sim::FreeParameter one = entry;
      one.path = path.text;
      for (std::size_t j = 0; j < free.size() && j < values.size(); ++j)
        if (free[j].id == path.id) one.start = std::clamp(values[j], free[j].min, free[j].max);
      warm.fit.free.push_back(one);
    }
  }
  return warm;
}

bool is_better(const FitResult& a, const FitResult& b) {
  return a.verdict != b.verdict ? a.verdict < b.verdict : a.chi2 < b.chi2;
}

}  // namespace

FrameFit fit_frame(const sim::Scene& scene, const Photo& photo, double time_s, const SequenceRow* before,
                   const FitOptions& options) {
  sim::Scene of_frame = scene;
  of_frame.time.start_s = time_s;
  const bool has_answer =
      before != nullptr && (before->verdict == Verdict::good || before->verdict == Verdict::doubtful);
  if (!has_answer) return {fit_photo(of_frame, photo, options), true};

  sim::Scene warm = started_at(of_frame, before->values);
  warm.fit.scan_points = 0;
  FrameFit frame{fit_photo(warm, photo, options), false};
  if (frame.result.verdict == Verdict::good || frame.result.verdict == Verdict::interrupted) return frame;
  warm.fit.scan_points = scene.fit.scan_points;
  FitResult searched = fit_photo(before->verdict == Verdict::good ? warm : of_frame, photo, options);
  if (is_better(searched, frame.result)) frame = {std::move(searched), true};
  return frame;
}

SequenceRow sequence_row(const std::string& frame, double time_s, const sim::Scene& scene,
                         const FrameFit& fit, const Photo& photo) {
  const FitResult& result = fit.result;
  SequenceRow row;
  row.frame = frame;
  row.time_s = time_s;
  row.photo_sha256 = photo.sha256;
  row.decoding = photo.decoding;
  row.verdict = result.verdict;
  row.searched = fit.searched;
  row.physics = result.physics;
  row.chi2_per_dof = result.dof > 0 ? result.chi2 / result.dof : 0.0;
  for (const FittedParameter& p : result.parameters) {
    row.values.push_back(p.value);
    if (!p.of_profile)
      row.numbers.push_back({p.path, p.unit, p.value, p.sigma, p.by_mode, p.relative && p.value > 0.0});
  }
  const FittedPhoto& fitted = result.photos.front();
  const auto put_flux = [&](sim::ParameterRole role, const auto& found, std::size_t index) {
    const std::string path = sim::path_of(fitted.best, sim::parameter_with(role, static_cast<int>(index)));
    const auto is_it = [&](const auto& own) { return own.path == path; };
    if (std::any_of(result.parameters.begin(), result.parameters.end(), is_it) ||
        std::any_of(result.tied.begin(), result.tied.end(), is_it))
      return;
    std::string why_none;
    if (const auto flux = found(scene, fitted, static_cast<int>(index), why_none))
      row.numbers.push_back({path, "mW m\u207b\u00b2", flux->mw_m2, flux->sigma, flux->by_mode, true});
  };
  for (std::size_t s = 0; s < fitted.best.sheets.size(); ++s)
    put_flux(sim::ParameterRole::energy_flux, found_flux, s);
  for (std::size_t f = 0; f < fitted.best.footprints.size(); ++f)
    put_flux(sim::ParameterRole::footprint_energy_flux, found_flux_of_footprint, f);
  // Q stands above, under the path that it has where it is free; what a number never has needs no column.
  for (const DerivedNumber& d : result.derived)
    if (d.name.compare(0, 13, "energy flux Q") != 0 && d.why_none.empty())
      row.numbers.push_back(
          {d.name, d.unit, d.value, d.sigma, d.by_mode, error_scale(d.quantity).relative && d.value > 0.0});
  for (SequenceNumber& n : row.numbers)
    if (!std::all_of(n.by_mode.begin(), n.by_mode.end(), [](double x) { return std::isfinite(x); }))
      n.by_mode.clear();
  return row;
}

}  // namespace vegard::fit
