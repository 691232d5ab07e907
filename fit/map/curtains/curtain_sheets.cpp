#include "fit/map/curtains/curtain_sheets.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sim/base/text.h"
#include "sim/emit/aurora/sheet_curve.h"
#include "sim/render/ground/sight_lines.h"
#include "sim/scene/emitters/emitter_kinds.h"
#include "sim/scene/table/photo_scene.h"

namespace vegard::fit {
namespace {

// Of the choice of points: how far the curve may be off the ridge, and its light off the ridge's (of the
// largest); how near and how far apart points may stand.
constexpr double kOffRidge_km = 1.5, kOffLight = 0.2;
constexpr double kMinApart_km = 12.0, kMaxApart_km = 45.0;
constexpr double kEnergyKnots_km = 50.0, kWidthKnots_km = 150.0;
constexpr double kMaxAside_km = 25.0;  // how far a point may go from the ridge
constexpr double kSampled_km = 1.0;
// An end of which this is out of view goes on by so much, in the direction of its last stretch.
constexpr double kLookBeyond_km = 20.0, kGoesOn_km = 60.0, kLastStretch_km = 20.0;
constexpr double kLowerBorder_km = 105.0;  // of the light that has to be in view
constexpr double kBeamsPerKm = 6.0;
constexpr double kDimmestPoint = 1e-5, kSoftestCurve_kev = 0.11, kHardestCurve_kev = 19.0,
                 kThinnestCurve_km = 0.2, kThickestCurve_km = 50.0;

/// Length of the ridge up to each of its points.
std::vector<double> lengths_along(const Ridge& ridge) {
  std::vector<double> at = {0.0};
  for (std::size_t i = 1; i < ridge.points.size(); ++i) {
    const sim::EastNorth &a = ridge.points[i - 1].foot_km, &b = ridge.points[i].foot_km;
    at.push_back(at.back() + std::hypot(b.east - a.east, b.north - a.north));
  }
  return at;
}

double light_per_km(const RidgePoint& p) { return p.flux_mw_m2 * p.width_km; }

/// Means over the stretch of a ridge that a chosen point represents: half the way to its neighbours.
RidgePoint mean_about(const Ridge& ridge, const std::vector<double>& at, std::size_t before, std::size_t here,
                      std::size_t after) {
  const double low = 0.5 * (at[before] + at[here]), high = 0.5 * (at[here] + at[after]);
  double count = 0.0, light = 0.0, ln_energy = 0.0, width = 0.0;
  for (std::size_t i = before; i <= after; ++i) {
    if (i != here && (at[i] < low || at[i] > high)) continue;
    const RidgePoint& p = ridge.points[i];
    count += 1.0;
    light += light_per_km(p);
    ln_energy += light_per_km(p) * std::log(p.energy_kev);
    width += light_per_km(p) * p.width_km;
  }
  RidgePoint mean = ridge.points[here];
  if (!(light > 0.0)) return mean;
  mean.energy_kev = std::exp(ln_energy / light);
  mean.width_km = width / light;
  mean.flux_mw_m2 = light / count / mean.width_km;
  return mean;
}

/// The curve alone, to look at it.
sim::Sheet curve_through(const Ridge& ridge, const std::vector<std::size_t>& chosen) {
  sim::Sheet sheet;
  sheet.course = sim::SheetCourse::curve;
  for (const std::size_t i : chosen) {
    sheet.east_km.push_back(ridge.points[i].foot_km.east);
    sheet.north_km.push_back(ridge.points[i].foot_km.north);
  }
  return sheet;
}

/// Which points of a ridge the curve goes through.
std::vector<std::size_t> chosen_points(const Ridge& ridge, const std::vector<double>& at) {
  const std::size_t last = ridge.points.size() - 1;
  std::vector<std::size_t> chosen = {0, last};
  double brightest = 0.0;
  for (const RidgePoint& p : ridge.points) brightest = std::max(brightest, light_per_km(p));
  for (;;) {
    const int samples = static_cast<int>(at.back() / kSampled_km) + 2;
    const std::vector<sim::EastNorth> curve = sim::curve_feet(curve_through(ridge, chosen), 0.0, samples);
    std::size_t worst = 0;
    double most = 1.0;
    for (std::size_t k = 0; k + 1 < chosen.size(); ++k) {
      const std::size_t a = chosen[k], b = chosen[k + 1];
      const RidgePoint from = mean_about(ridge, at, k > 0 ? chosen[k - 1] : a, a, b),
                       to = mean_about(ridge, at, a, b, k + 2 < chosen.size() ? chosen[k + 2] : b);
      const bool is_long = at[b] - at[a] > kMaxApart_km;
      for (std::size_t i = a + 1; i < b; ++i) {
        if (at[i] - at[a] < kMinApart_km || at[b] - at[i] < kMinApart_km) continue;
        double off_km = 1e9;
        for (const sim::EastNorth& foot : curve)
          off_km = std::min(off_km, std::hypot(foot.east - ridge.points[i].foot_km.east,
                                               foot.north - ridge.points[i].foot_km.north));
        // Light over three points of the ridge, which single rays do not rule.
        const double light = (light_per_km(ridge.points[i - 1]) + light_per_km(ridge.points[i]) +
                              light_per_km(ridge.points[i + 1])) /
                             3.0;
        const double t = (at[i] - at[a]) / (at[b] - at[a]);
        const double off_light = std::abs(light - (1.0 - t) * light_per_km(from) - t * light_per_km(to));
        double badness = std::max(off_km / kOffRidge_km, off_light / (kOffLight * brightest));
        // Of a long stretch the middle, unless elsewhere it is bad.
        if (is_long) badness = std::max(badness, 1.0 + 2.0 * std::min(t, 1.0 - t));
        if (badness > most) {
          most = badness;
          worst = i;
        }
      }
    }
    if (worst == 0) return chosen;
    chosen.insert(std::lower_bound(chosen.begin(), chosen.end(), worst), worst);
  }
}

std::string path_of_point(const sim::Sheet& sheet, const char* key, int point) {
  return fmt::format("sheet.{}.{}.{}", sheet.name, key, point);
}

std::string across_name(const std::string& sheet) { return sheet + "_across_km_"; }

void free_path(sim::Scene& scene, const std::string& path) {
  sim::FreeParameter free;
  free.path = path;
  scene.fit.free.push_back(free);
}

void add_tie(sim::Scene& scene, const std::string& path, const std::string& equals) {
  sim::TiedParameter tied;
  tied.path = path;
  tied.equals = equals;
  scene.fit.tied.push_back(tied);
}

/// So far beyond one end of a ridge, as its last stretch points.
sim::EastNorth beyond(const Ridge& ridge, bool at_start, double by_km) {
  const std::size_t count = ridge.points.size();
  const auto foot = [&](std::size_t i) { return ridge.points[at_start ? i : count - 1 - i].foot_km; };
  const sim::EastNorth end = foot(0);
  double east = 0.0, north = 0.0, way = 0.0;
  for (std::size_t i = 1; i < count && way < kLastStretch_km; ++i) {
    east = end.east - foot(i).east;
    north = end.north - foot(i).north;
    way = std::hypot(east, north);
  }
  if (!(way > 0.0)) return end;
  return {end.east + by_km * east / way, end.north + by_km * north / way};
}

/// Whether light over a foot would be in a part of some picture that is compared.
bool is_in_view(const sim::Scene& scene, sim::EastNorth foot_km) {
  const auto sees = [&](const sim::Scene& own) {
    double x = 0.0, y = 0.0;
    if (!sim::pixel_over_foot(own, scene.site, foot_km, kLowerBorder_km, x, y)) return false;
    const auto& [left, top, width, height] = own.fit.roi_px;
    return width == 0 || (x >= left && x < left + width && y >= top && y < top + height);
  };
  if (scene.fit.photos.empty()) return sees(scene);
  return std::any_of(scene.fit.photos.begin(), scene.fit.photos.end(),
                     [&](const sim::PhotoEntry& entry) { return sees(sim::scene_of_photo(scene, entry)); });
}

/// The point next to the first or last one of a curve that is beyond the picture; any other is its own.
int leader_of(const sim::Sheet& sheet, int point, const CurtainEnds& ends) {
  const int last = static_cast<int>(sheet.east_km.size()) - 1;
  if (point == 0 && ends.before) return 1;
  return point == last && ends.after ? last - 1 : point;
}

/// Ties points beyond the picture to those next to them.
void tie_ends(sim::Scene& scene, const sim::Sheet& sheet, const char* key, const CurtainEnds& ends) {
  for (const int i : {0, static_cast<int>(sheet.east_km.size()) - 1})
    if (const int leader = leader_of(sheet, i, ends); leader != i)
      add_tie(scene, path_of_point(sheet, key, i), path_of_point(sheet, key, leader));
}

/// Frees the knots of a list, and ties what lies between them.
void free_knots(sim::Scene& scene, const sim::Sheet& sheet, const char* key, double apart_km,
                const CurtainEnds& ends) {
  tie_ends(scene, sheet, key, ends);
  const std::vector<double> at = sim::curve_layout(sheet).at;
  const std::vector<int> knots = knots_of_sheet(sheet, apart_km, ends);
  for (const int k : knots) free_path(scene, path_of_point(sheet, key, k));
  for (std::size_t k = 0; k + 1 < knots.size(); ++k)
    for (int i = knots[k] + 1; i < knots[k + 1]; ++i) {
      const double t = (at[i] - at[knots[k]]) / (at[knots[k + 1]] - at[knots[k]]);
      add_tie(scene, path_of_point(sheet, key, i),
              fmt::format("pow({}, {:.6f}) * pow({}, {:.6f})", path_of_point(sheet, key, knots[k]), 1.0 - t,
                          path_of_point(sheet, key, knots[k + 1]), t));
    }
}

/// Frees how far each point stands across the curve's direction there, to its left.
void free_across(sim::Scene& scene, const sim::Sheet& sheet, const CurtainEnds& ends) {
  const int last = static_cast<int>(sheet.east_km.size()) - 1;
  for (int i = 0; i <= last; ++i) {
    const int leader = leader_of(sheet, i, ends);
    const int before = std::max(0, leader - 1), after = std::min(last, leader + 1);
    const double east = sheet.east_km[after] - sheet.east_km[before],
                 north = sheet.north_km[after] - sheet.north_km[before], way = std::hypot(east, north);
    // Where the curve comes back to where it was, any direction is across.
    const double to_east = way > 0.0 ? -north / way : 0.0, to_north = way > 0.0 ? east / way : 1.0;
    sim::FreeParameter free;
    free.name = across_name(sheet.name) + std::to_string(leader);
    free.start = 0.0;
    free.min = -kMaxAside_km;
    free.max = kMaxAside_km;
    if (leader == i) scene.fit.free.push_back(free);
    add_tie(scene, path_of_point(sheet, "east_km", i),
            fmt::format("{:.6f} + {:.6f} * {}", sheet.east_km[i], to_east, free.name));
    add_tie(scene, path_of_point(sheet, "north_km", i),
            fmt::format("{:.6f} + {:.6f} * {}", sheet.north_km[i], to_north, free.name));
  }
}

/// One brightness of all has to be held, a gain is solved for: the first sheet's brightest that is free.
void hold_one_brightness(sim::Scene& scene) {
  if (scene.sheets.empty()) return;
  const sim::Sheet& first = scene.sheets.front();
  const auto names = [&](const std::string& path, int point) {
    return path == path_of_point(first, "point_brightness", point);
  };
  int held = -1;
  for (int i = 0; i < static_cast<int>(first.point_brightness.size()); ++i) {
    const bool is_tied = std::any_of(scene.fit.tied.begin(), scene.fit.tied.end(),
                                     [&](const sim::TiedParameter& t) { return names(t.path, i); });
    if (is_tied) continue;
    if (std::none_of(scene.fit.free.begin(), scene.fit.free.end(),
                     [&](const sim::FreeParameter& f) { return names(f.path, i); }))
      return;  // it is
    if (held < 0 || first.point_brightness[i] > first.point_brightness[held]) held = i;
  }
  std::vector<sim::FreeParameter>& free = scene.fit.free;
  free.erase(std::remove_if(free.begin(), free.end(),
                            [&](const sim::FreeParameter& f) { return names(f.path, held); }),
             free.end());
}

}  // namespace

CurtainEnds ends_out_of_view(const sim::Scene& scene, const Ridge& ridge) {
  return {!is_in_view(scene, beyond(ridge, true, kLookBeyond_km)),
          !is_in_view(scene, beyond(ridge, false, kLookBeyond_km))};
}

sim::Sheet sheet_of_ridge(const Ridge& ridge, const CurtainEnds& ends) {
  const std::vector<double> at = lengths_along(ridge);
  const std::vector<std::size_t> chosen = chosen_points(ridge, at);
  sim::Sheet sheet = curve_through(ridge, chosen);
  sheet.name = ridge.name;
  sheet.layers = 1;
  sheet.beams_per_km = kBeamsPerKm;
  std::vector<RidgePoint> means;
  for (std::size_t k = 0; k < chosen.size(); ++k)
    means.push_back(mean_about(ridge, at, chosen[k > 0 ? k - 1 : 0], chosen[k],
                               chosen[std::min(k + 1, chosen.size() - 1)]));
  double most = 0.0;
  for (const RidgePoint& p : means) most = std::max(most, p.flux_mw_m2);
  for (const RidgePoint& p : means) {
    sheet.point_brightness.push_back(std::max(kDimmestPoint, most > 0.0 ? p.flux_mw_m2 / most : 1.0));
    sheet.point_energy_kev.push_back(std::clamp(p.energy_kev, kSoftestCurve_kev, kHardestCurve_kev));
    sheet.point_width_km.push_back(std::clamp(p.width_km, kThinnestCurve_km, kThickestCurve_km));
  }
  sheet.energy_flux_mw_m2 = 1.0;
  double light = 0.0;
  for (std::size_t i = 1; i < at.size(); ++i)
    light += 0.5 * (light_per_km(ridge.points[i - 1]) + light_per_km(ridge.points[i])) * (at[i] - at[i - 1]);
  sheet.energy_flux_mw_m2 = std::clamp(light / light_of_curtain(sheet), 1e-6, 1e4);
  const auto go_on = [&](bool at_start) {
    const sim::EastNorth foot = beyond(ridge, at_start, kGoesOn_km);
    const auto add = [&](std::vector<double>& list, double value) {
      list.insert(at_start ? list.begin() : list.end(), value);
    };
    add(sheet.east_km, foot.east);
    add(sheet.north_km, foot.north);
    for (std::vector<double>* list :
         {&sheet.point_brightness, &sheet.point_energy_kev, &sheet.point_width_km})
      add(*list, at_start ? list->front() : list->back());
  };
  if (ends.before) go_on(true);
  if (ends.after) go_on(false);
  return sheet;
}

std::vector<int> knots_of_sheet(const sim::Sheet& sheet, double apart_km, const CurtainEnds& ends) {
  const sim::CurveLayout layout = sim::curve_layout(sheet);
  const int first = ends.before ? 1 : 0, last = static_cast<int>(layout.at.size()) - (ends.after ? 2 : 1);
  const double length = layout.at[last] - layout.at[first];
  const int stretches = std::max(1, static_cast<int>(length * layout.length_km / apart_km));
  std::vector<int> knots = {first};
  for (int k = 1; k < stretches; ++k) {
    const double wanted = layout.at[first] + length * k / stretches;
    int nearest = first;
    for (int i = first + 1; i < last; ++i)
      if (std::abs(layout.at[i] - wanted) < std::abs(layout.at[nearest] - wanted)) nearest = i;
    if (nearest > knots.back()) knots.push_back(nearest);
  }
  knots.push_back(last);
  return knots;
}

void add_curtain(sim::Scene& scene, const Ridge& ridge) {
  const CurtainEnds ends = ends_out_of_view(scene, ridge);
  const sim::Sheet sheet = sheet_of_ridge(ridge, ends);
  scene.sheets.push_back(sheet);
  free_across(scene, sheet, ends);
  tie_ends(scene, sheet, "point_brightness", ends);
  for (int i = 0; i < static_cast<int>(sheet.point_brightness.size()); ++i)
    if (leader_of(sheet, i, ends) == i) free_path(scene, path_of_point(sheet, "point_brightness", i));
  free_knots(scene, sheet, "point_energy_kev", kEnergyKnots_km, ends);
  free_knots(scene, sheet, "point_width_km", kWidthKnots_km, ends);
  hold_one_brightness(scene);
}

void drop_curtain(sim::Scene& scene, const std::string& name) {
  const auto is_of_it = [&](const std::string& path) {
    return sim::starts_with(path, "sheet." + name + ".");
  };
  std::vector<sim::Sheet>& sheets = scene.sheets;
  sheets.erase(std::remove_if(sheets.begin(), sheets.end(),
                              [&](const sim::Sheet& sheet) { return sheet.name == name; }),
               sheets.end());
  std::vector<sim::FreeParameter>& free = scene.fit.free;
  free.erase(std::remove_if(free.begin(), free.end(),
                            [&](const sim::FreeParameter& f) {
                              return is_of_it(f.path) ||
                                     (f.path.empty() && sim::starts_with(f.name, across_name(name)));
                            }),
             free.end());
  std::vector<sim::TiedParameter>& tied = scene.fit.tied;
  tied.erase(
      std::remove_if(tied.begin(), tied.end(), [&](const sim::TiedParameter& t) { return is_of_it(t.path); }),
      tied.end());
  hold_one_brightness(scene);
}

double light_of_curtain(const sim::Sheet& sheet) {
  const sim::Sheet even = sim::evened_sheet(sheet);
  return even.energy_flux_mw_m2 * even.width_km * even.length_km;
}

sim::Scene without_emitters(const sim::Scene& given) {
  sim::Scene scene = given;
  std::vector<std::string> tables = {"sheet"};
  for (const sim::EmitterKind& kind : sim::emitter_kinds()) {
    tables.push_back(kind.table);
    for (const sim::RepeatedTable& table : kind.repeated) tables.push_back(table.table);
  }
  const auto is_left_out = [&](const std::string& path) {
    return std::find(tables.begin(), tables.end(), path.substr(0, path.find('.'))) != tables.end();
  };
  const auto names_left_out = [&](const std::string& expression) {
    return std::any_of(tables.begin(), tables.end(), [&](const std::string& table) {
      return expression.find(table + ".") != std::string::npos;
    });
  };
  scene.sheets.clear();
  sim::remove_emitters(scene);
  std::vector<sim::FreeParameter>& free = scene.fit.free;
  free.erase(std::remove_if(free.begin(), free.end(),
                            [&](const sim::FreeParameter& f) { return is_left_out(f.path); }),
             free.end());
  std::vector<sim::TiedParameter>& tied = scene.fit.tied;
  tied.erase(std::remove_if(tied.begin(), tied.end(),
                            [&](const sim::TiedParameter& t) {
                              return is_left_out(t.path) || names_left_out(t.equals);
                            }),
             tied.end());
  // Numbers without a path that no tie uses any more.
  free.erase(std::remove_if(free.begin(), free.end(),
                            [&](const sim::FreeParameter& f) {
                              return f.path.empty() &&
                                     std::none_of(tied.begin(), tied.end(), [&](const sim::TiedParameter& t) {
                                       return t.equals.find(f.name) != std::string::npos;
                                     });
                            }),
             free.end());
  for (sim::PhotoEntry& entry : scene.fit.photos)
    entry.set.erase(std::remove_if(entry.set.begin(), entry.set.end(),
                                   [&](const auto& changed) { return is_left_out(changed.first); }),
                    entry.set.end());
  scene.fit.band_brightness = false;
  scene.fit.scan_points = 0;
  scene.fit.polish_descents = 1;
  return scene;
}

sim::Scene scene_of_ridges(const sim::Scene& given, const std::vector<Ridge>& ridges) {
  sim::Scene scene = without_emitters(given);
  for (const Ridge& ridge : ridges) add_curtain(scene, ridge);
  return scene;
}

}  // namespace vegard::fit
