#include "fit/survey/survey_frame.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "fit/answer/trust.h"
#include "fit/map/curtains/curtains.h"
#include "fit/map/curtains/map_verdicts.h"
#include "fit/map/map_fit.h"
#include "fit/photo/photo.h"
#include "sim/emit/aurora/foot_line.h"
#include "sim/scene/structs/line_of.h"

namespace vegard::fit {
namespace {

constexpr double kMegawattPerMw_km2 = 1e-3;  // 1 mW m^-2 on 1 km^2 is a kilowatt

/// Returns the standard deviation over the replicates; none where there are too few.
std::optional<double> spread(const MapResult& map,
                             const std::function<double(const std::vector<CellFlux>&)>& number) {
  std::vector<double> values;
  for (const std::vector<CellFlux>& cells : map.replicates) values.push_back(number(cells));
  if (values.size() < 2) return std::nullopt;
  double mean = 0.0, sum = 0.0;
  for (const double v : values) mean += v / static_cast<double>(values.size());
  for (const double v : values) sum += (v - mean) * (v - mean);
  return finite_or_none(std::sqrt(sum / static_cast<double>(values.size() - 1)));
}

struct Totals {
  double power_mw = 0.0, ln_energy = 0.0;  ///< the mean by energy flux
};

Totals totals_of(const MapResult& map, const std::vector<CellFlux>& cells) {
  Totals totals;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const double power = kMegawattPerMw_km2 * cells[c].flux_mw_m2 * map.grid.area_km2(static_cast<int>(c));
    totals.power_mw += power;
    if (power > 0.0) totals.ln_energy += power * cells[c].ln_energy;
  }
  if (totals.power_mw > 0.0) totals.ln_energy /= totals.power_mw;
  return totals;
}

struct Trusts {
  std::optional<std::string> distance, energy, flux;
};

Trusts trusts_of(const std::vector<QuantityVerdict>& verdicts) {
  Trusts trusts;
  for (const QuantityVerdict& v : verdicts) {
    if (v.quantity == "distance of the curtains") trusts.distance = trust_name(v.trust);
    if (v.quantity == "energy along the curtains") trusts.energy = trust_name(v.trust);
    if (v.quantity == "energy flux along the curtains") trusts.flux = trust_name(v.trust);
  }
  return trusts;
}

void add_curtain(const Curtain& curtain, int item, const sim::Scene& scene, const Trusts& trusts,
                 WorkAnswer& answer) {
  const auto put = [&](const char* name, const char* unit, double value, double sigma,
                       const std::optional<std::string>& trust) {
    answer.quantities.push_back({item, name, unit, finite_or_none(value), finite_or_none(sigma), trust, {}});
  };
  const double unknown = std::nan("");
  put("length", "km", curtain.length_km, unknown, {});
  const CurtainPoint* nearest = nullptr;
  for (const CurtainPoint& p : curtain.points)
    if (p.border_in_view && (nearest == nullptr || p.distance_km < nearest->distance_km)) nearest = &p;
  if (nearest == nullptr) return;
  put("distance of the nearest point", "km", nearest->distance_km, nearest->distance_error_km,
      trusts.distance);
  put("azimuth of the nearest point", "deg", nearest->azimuth_deg, unknown, {});
  if (sim::is_latitude_given(scene))
    put("latitude of the nearest point", "deg", sim::place_of_foot(scene, nearest->foot_km).latitude_deg,
        unknown, trusts.distance);
  put("characteristic energy E0", "keV", nearest->energy_kev.value, nearest->energy_kev.error, trusts.energy);
  put("energy flux", "mW m\u207b\u00b2", nearest->flux_mw_m2.value, nearest->flux_mw_m2.error, trusts.flux);
  put("lower border", "km", nearest->lower_border_km.value, nearest->lower_border_km.error, trusts.energy);
}

}  // namespace

std::optional<WorkAnswer> map_answer(const Photo& photo, const sim::Scene& scene, const MapOptions& options) {
  std::optional<MapResult> made;
  try {
    made = map_photos(scene, {photo}, options);
  } catch (const MapStopped&) {
    return std::nullopt;
  }
  const MapResult& map = *made;
  if (map.interrupted) return std::nullopt;
  const std::vector<Curtain> curtains = find_curtains(map);
  const std::vector<QuantityVerdict> verdicts = map_verdicts(map, curtains);
  const Trusts trusts = trusts_of(verdicts);
  WorkAnswer answer;
  answer.work = SurveyWork::map;
  answer.words = verdict_line(verdicts);
  answer.verdict = std::all_of(verdicts.begin(), verdicts.end(),
                               [](const QuantityVerdict& v) { return v.trust == Trust::good; })
                       ? "good"
                       : "doubtful";
  const auto put = [&](const char* name, const char* unit, double value, std::optional<double> sigma,
                       const std::optional<std::string>& trust = std::nullopt) {
    answer.quantities.push_back({0, name, unit, finite_or_none(value), sigma, trust, {}});
  };
  const Totals totals = totals_of(map, map.cells);
  put("power", "MW", totals.power_mw,
      spread(map, [&](const std::vector<CellFlux>& cells) { return totals_of(map, cells).power_mw; }),
      trusts.flux);
  if (totals.power_mw > 0.0) {
    const std::optional<double> ln_sigma =
        spread(map, [&](const std::vector<CellFlux>& cells) { return totals_of(map, cells).ln_energy; });
    const double energy_kev = std::exp(totals.ln_energy);
    put("mean characteristic energy E0", "keV", energy_kev,
        ln_sigma ? std::optional(kEnergyInflation * energy_kev * *ln_sigma) : std::nullopt, trusts.energy);
  }
  double in_view = 0.0;
  for (std::size_t c = 0; c < map.cells.size(); ++c)
    if (map.border_in_view[c] != 0)
      in_view += kMegawattPerMw_km2 * map.cells[c].flux_mw_m2 * map.grid.area_km2(static_cast<int>(c));
  if (totals.power_mw > 0.0)
    put("share of the energy flux with its lower border in view", "", in_view / totals.power_mw, {});
  put("chi2 per value", "", map.chi2_per_value(), {});
  put("curtains", "", static_cast<double>(curtains.size()), {});
  for (std::size_t i = 0; i < std::min<std::size_t>(curtains.size(), kSurveyCurtains); ++i)
    add_curtain(curtains[i], static_cast<int>(i) + 1, map.scene, trusts, answer);
  return answer;
}

}  // namespace vegard::fit
