#include "fit/answer/derived.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "sim/base/number/constants.h"
#include "sim/base/text.h"
#include "sim/emit/aurora/foot_line.h"
#include "sim/emit/aurora/sheet_curve.h"
#include "sim/light/electron.h"
#include "sim/light/line_light.h"
#include "sim/scene/emitters/emitter_kinds.h"
#include "sim/scene/lines/emission_lines.h"
#include "sim/scene/structs/line_of.h"

namespace vegard::fit {
namespace {

constexpr double kRedNm = 630.0, kBlueNm = 427.8;
constexpr double kMinShareOfVariance =
    0.1;  // of the variance, of a free number that a derived one depends on

double wavelength_ratio(const sim::Sheet& sheet) { return sheet.wavelength_km / (2.0 * sheet.thickness_km); }

/// What a number will be called, and the words for when it has no value.
struct Label {
  std::string name, unit, why_none;
  Quantity quantity = Quantity::other;
  bool is_detail = false, is_longitude = false, is_lateral = false;
};

/// Numbers that are worked out together.
struct Group {
  std::vector<Label> labels;
  DeltaMethod::Numbers numbers;  ///< as many as labels
};

Group one(const Label& label, const std::function<double(const sim::Scene&)>& number) {
  return {{label}, [number](const sim::Scene& x) { return std::vector<double>{number(x)}; }};
}

/// A number that nothing can be said of.
Group none(const Label& label) {
  return one(label, [](const sim::Scene&) { return sim::kNaN; });
}

/// Of a sheet whose energy varies along its curve what its mean has. Of one that is as bright as given only
/// altitudes and ratios are asked for, which rounding must not let depend on the brightness.
sim::LineLight light_of(double wavelength_nm, const sim::Scene& scene, int sheet) {
  const sim::Sheet& given = scene.sheets[sheet];
  if (given.point_energy_kev.empty() && !sim::is_as_bright_as_given(given.profile))
    return sim::line_light(wavelength_nm, scene, sheet);
  sim::Scene even = scene;
  even.sheets[sheet] = sim::evened_sheet(given);
  even.sheets[sheet].line_kilorayleigh = 1.0;
  return sim::line_light(wavelength_nm, even, sheet);
}

void add_energies(const sim::Scene& best, int s, const std::string& suffix, std::vector<Group>& groups) {
  const sim::Sheet& sheet = best.sheets[s];
  // A form has an energy for its steps and its power, but its light does not determine it.
  if (!sim::mean_energy_kev(sheet) || sheet.profile == sim::ProfileKind::form) {
    groups.push_back(none({"mean electron energy" + suffix, "keV",
                           "the height profile is not that of known electrons", Quantity::energy}));
    return;
  }
  // For mono-energetic and Gaussian electrons it is the mean energy itself.
  if (sheet.profile == sim::ProfileKind::maxwellian)
    groups.push_back(one({"characteristic energy E0" + suffix, "keV", "", Quantity::energy},
                         [s](const sim::Scene& x) { return sim::evened_sheet(x.sheets[s]).energy_kev; }));
  groups.push_back(
      one({"mean electron energy" + suffix, "keV", "", Quantity::energy},
          [s](const sim::Scene& x) { return *sim::mean_energy_kev(sim::evened_sheet(x.sheets[s])); }));
}

/// Altitudes of the line that shows the border, the peaks of all lines.
void add_altitudes(const sim::Scene& best, int s, const std::string& suffix, std::vector<Group>& groups) {
  const double border = sim::border_line_nm(best, s);
  std::vector<double> lines;
  if (border > 0.0) lines.push_back(border);
  for (const double line : best.emission.lines)
    if (sim::line_index(lines, line) < 0 && sim::has_line(line, best, s)) lines.push_back(line);
  for (const double nm : lines) {
    const std::string line = sim::line_words(nm);
    const bool is_detail = nm != border;
    Group group{{{"peak altitude of " + line + suffix, "km", "it is brightest at an end of its profile",
                  Quantity::altitude, is_detail}},
                {}};
    if (!is_detail) {
      group.labels.push_back({"lower border of " + line + " (a tenth of the peak)" + suffix, "km",
                              "the light has not fallen to a tenth at 80 km, where its profile ends",
                              Quantity::altitude});
      group.labels.push_back(
          {"half-width of " + line + " below its peak" + suffix, "km", "", Quantity::width, true});
      group.labels.push_back(
          {"half-width of " + line + " above its peak" + suffix, "km", "", Quantity::width, true});
    }
    group.numbers = [nm, s, is_detail](const sim::Scene& x) {
      const sim::LineLight light = light_of(nm, x, s);
      std::vector<double> numbers = {light.peak_at_an_end ? sim::kNaN : light.peak_km};
      if (!is_detail)
        numbers.insert(numbers.end(), {light.lower_border_km, light.half_below_km, light.half_above_km});
      return numbers;
    };
    groups.push_back(std::move(group));
  }
}

void add_ratios(const sim::Scene& best, int s, const std::string& suffix, std::vector<Group>& groups) {
  for (const double nm : {kRedNm, kBlueNm}) {
    const Label label{fmt::format("I({:.1f})/I({:.1f}) along the field{}", nm, sim::kGreenNm, suffix), "", "",
                      Quantity::ratio};
    Label absent = label;
    for (const double needed : {nm, sim::kGreenNm})
      if (!sim::has_line(needed, best, s))
        absent.why_none = "the height profile has no " + sim::line_words(needed);
    if (!absent.why_none.empty()) {
      groups.push_back(none(absent));
      continue;
    }
    absent.why_none = "557.7 nm is dark";
    groups.push_back(one(absent, [nm, s](const sim::Scene& x) {
      const double green = light_of(sim::kGreenNm, x, s).column_rayleigh;
      return green > 0.0 ? light_of(nm, x, s).column_rayleigh / green : sim::kNaN;
    }));
  }
}

/// Of a sine: its bearing and its numbers, as far as they were asked for.
void add_lateral(const sim::Scene& best, const std::vector<FreeNumber>& free, int s,
                 const std::string& suffix, std::vector<Group>& groups) {
  if (sim::is_curve(best.sheets[s])) return;
  const auto is_free = [&](const char* key) {
    const std::string path = "sheet." + best.sheets[s].name + "." + key;
    return std::any_of(free.begin(), free.end(), [&](const FreeNumber& n) { return n.path == path; });
  };
  const auto add = [&](const char* key, const char* name, const char* unit, Quantity quantity,
                       double sim::Sheet::*number) {
    if (is_free(key))
      groups.push_back(one({name + suffix, unit, "", quantity, true, false, true},
                           [s, number](const sim::Scene& x) { return x.sheets[s].*number; }));
  };
  add("bearing_deg", "bearing", "deg", Quantity::azimuth, &sim::Sheet::bearing_deg);
  add("length_km", "length", "km", Quantity::width, &sim::Sheet::length_km);
  add("width_km", "width", "km", Quantity::width, &sim::Sheet::width_km);
  add("wavelength_km", "wavelength", "km", Quantity::width, &sim::Sheet::wavelength_km);
  add("thickness_km", "amplitude", "km", Quantity::width, &sim::Sheet::thickness_km);
  add("phase_rad", "phase", "rad", Quantity::phase, &sim::Sheet::phase_rad);
}

void add_feet(const sim::Scene& best, int s, const std::string& suffix, std::vector<Group>& groups) {
  if (!sim::is_latitude_given(best)) {
    groups.push_back(
        none({"geographic coordinates of the feet" + suffix, "deg",
              "the site is not given: site.latitude_deg and site.longitude_deg", Quantity::place}));
    return;
  }
  const std::string beyond = "the foot lies beyond the edge of the Earth";
  const bool with_longitude = sim::is_longitude_given(best);
  Group group;
  for (const char* which : {"the nearest foot", "the middle foot", "the first foot", "the last foot"}) {
    const bool is_detail = which != std::string("the nearest foot");
    const std::string foot = std::string(" of ") + which + suffix;
    group.labels.push_back({"latitude" + foot, "deg", beyond, Quantity::place, is_detail});
    if (!with_longitude) continue;
    group.labels.push_back({"longitude" + foot, "deg", beyond, Quantity::place, is_detail, true});
    group.labels.push_back({"geomagnetic latitude" + foot, "deg", beyond, Quantity::place, is_detail});
  }
  group.numbers = [s, with_longitude](const sim::Scene& x) {
    const sim::FootPoints feet = sim::foot_points(x.sheets[s], x.time.start_s);
    std::vector<double> numbers;
    for (const sim::EastNorth& foot : {feet.nearest, feet.middle, feet.start, feet.end}) {
      const sim::PlaceOnEarth place = sim::place_of_foot(x, foot);
      numbers.push_back(place.latitude_deg);
      if (!with_longitude) continue;
      // Differences go by the longitude from the site, which does not jump at 180 degrees.
      numbers.push_back(x.site.longitude_deg + place.longitude_from_site_deg);
      numbers.push_back(place.magnetic_latitude_deg);
    }
    return numbers;
  };
  groups.push_back(std::move(group));
  if (!with_longitude)
    groups.push_back(none({"longitude and geomagnetic latitude of the feet" + suffix, "deg",
                           "site.longitude_deg is not given", Quantity::place}));
}

/// Of a curve that is drawn; the box's middle is added to its points.
double nearest_on_spline_km(const sim::Footprint& f) {
  double nearest = std::numeric_limits<double>::infinity();
  const std::size_t points = std::min(f.east_km.size(), f.north_km.size());
  const auto point = [&](std::size_t i) {
    return sim::EastNorth{f.center_km.east + f.east_km[i % points],
                          f.center_km.north + f.north_km[i % points]};
  };
  for (std::size_t i = 0; i + (f.closed ? 0 : 1) < points; ++i) {
    const sim::EastNorth a = point(i), b = point(i + 1);
    const double east = b.east - a.east, north = b.north - a.north;
    const double square = east * east + north * north;
    const double t = square > 0.0 ? std::clamp(-(a.east * east + a.north * north) / square, 0.0, 1.0) : 0.0;
    nearest = std::min(nearest, std::hypot(a.east + t * east, a.north + t * north));
  }
  return nearest;
}

void add_footprints(const sim::Scene& best, std::vector<Group>& groups) {
  for (std::size_t i = 0; i < best.footprints.size(); ++i) {
    const sim::Footprint& footprint = best.footprints[i];
    const std::string suffix = " of the " + footprint.name + " footprint";
    if (footprint.shape == sim::FootprintShape::box && footprint.source == sim::FootprintSource::spline)
      groups.push_back(one({"distance" + suffix, "km", "", Quantity::distance},
                           [i](const sim::Scene& x) { return nearest_on_spline_km(x.footprints[i]); }));
    if (footprint.profile == sim::ProfileKind::maxwellian)
      groups.push_back(one({"characteristic energy E0" + suffix, "keV", "", Quantity::energy},
                           [i](const sim::Scene& x) { return x.footprints[i].energy_kev; }));
  }
}

std::vector<Group> groups_of(const sim::Scene& best, const std::vector<FreeNumber>& free) {
  std::vector<Group> groups;
  for (int s = 0; s < static_cast<int>(best.sheets.size()); ++s) {
    const std::string suffix = " of the " + best.sheets[s].name + " sheet";
    groups.push_back(one({"distance" + suffix, "km", "", Quantity::distance}, [s](const sim::Scene& x) {
      return nearest_distance_km(x.sheets[s], x.time.start_s);
    }));
    // Differences go by the turn from the best scene's, which does not jump in the north.
    const double middle_deg = nearest_azimuth_deg(best.sheets[s], best.time.start_s);
    groups.push_back(one({"azimuth of the nearest point" + suffix, "deg", "", Quantity::azimuth},
                         [s, middle_deg](const sim::Scene& x) {
                           return middle_deg +
                                  std::remainder(
                                      nearest_azimuth_deg(x.sheets[s], x.time.start_s) - middle_deg, 360.0);
                         }));
    add_energies(best, s, suffix, groups);
    add_altitudes(best, s, suffix, groups);
    add_ratios(best, s, suffix, groups);
    if (best.sheets[s].layers > 1 && !sim::is_curve(best.sheets[s]))
      groups.push_back(
          one({"largest distance between the boundaries" + suffix, "km", "", Quantity::width, true},
              [s](const sim::Scene& x) { return boundary_separation_km(x.sheets[s]); }));
    if (!sim::is_curve(best.sheets[s]))
      groups.push_back(one({"wavelength over twice the amplitude" + suffix, "", "", Quantity::ratio, true},
                           [s](const sim::Scene& x) { return wavelength_ratio(x.sheets[s]); }));
    add_lateral(best, free, s, suffix, groups);
    add_feet(best, s, suffix, groups);
  }
  add_footprints(best, groups);
  return groups;
}

}  // namespace

std::optional<double> DerivedNumber::error() const {
  if (!sigma || !systematic) return sigma;
  return std::hypot(*sigma, *systematic);
}

double nearest_distance_km(const sim::Sheet& sheet, double instant_s) {
  const sim::EastNorth foot = sim::foot_points(sheet, instant_s).nearest;
  return std::hypot(foot.east, foot.north);
}

double lower_border_km(double wavelength_nm, const sim::Scene& scene, int sheet) {
  return light_of(wavelength_nm, scene, sheet).lower_border_km;
}

HalfWidths half_widths_km(double wavelength_nm, const sim::Scene& scene, int sheet) {
  const sim::LineLight light = light_of(wavelength_nm, scene, sheet);
  return {light.half_below_km, light.half_above_km};
}

double peak_altitude_km(double wavelength_nm, const sim::Scene& scene, int sheet) {
  return light_of(wavelength_nm, scene, sheet).peak_km;
}

double nearest_azimuth_deg(const sim::Sheet& sheet, double instant_s) {
  const sim::EastNorth foot = sim::foot_points(sheet, instant_s).nearest;
  const double azimuth = std::atan2(foot.east, foot.north) / sim::kRadiansPerDegree;
  return azimuth < 0.0 ? azimuth + 360.0 : azimuth;
}

double boundary_separation_km(const sim::Sheet& sheet) {
  return 2.0 * sheet.thickness_km * std::abs(std::sin(0.5 * sheet.phase_shift_rad));
}

std::vector<std::string> unusual_sheets(const sim::Scene& scene) {
  std::vector<std::string> notes;
  for (const sim::Sheet& sheet : scene.sheets) {
    if (sim::is_curve(sheet)) continue;
    const double ratio = wavelength_ratio(sheet);
    if (ratio >= kMinWavelengthRatio && ratio <= kMaxWavelengthRatio) continue;
    notes.push_back(fmt::format(
        "the wavelength of the {} sheet is {:.3g} times twice its amplitude; nature prefers {} to {}",
        sheet.name, ratio, kMinWavelengthRatio, kMaxWavelengthRatio));
  }
  return notes;
}

std::vector<DerivedNumber> derived_numbers(const sim::Scene& best, const std::vector<FreeNumber>& free,
                                           const std::vector<double>& values, const ValueUncertainty& known) {
  const DeltaMethod estimates(best, free, values, known);
  std::vector<DerivedNumber> result;
  for (const Group& group : groups_of(best, free)) {
    const std::vector<DeltaMethod::Estimate> found = estimates(group.numbers);
    for (std::size_t i = 0; i < found.size(); ++i) {
      const Label& label = group.labels[i];
      DerivedNumber d;
      d.name = label.name;
      d.value = found[i].value;
      d.unit = label.unit;
      d.is_detail = label.is_detail;
      d.quantity = label.quantity;
      d.is_lateral = label.is_lateral;
      for (std::size_t j = 0; j < found[i].share.size(); ++j)
        if (found[i].share[j] >= kMinShareOfVariance) d.depends_on.push_back(free[j].label());
      if (!std::isfinite(d.value)) {
        d.value = sim::kNaN;
        d.why_none = label.why_none;
      } else {
        if (label.is_longitude) d.value = sim::wrapped_longitude_deg(d.value);
        d.sigma = found[i].sigma;
        d.by_mode = found[i].by_mode;
        // What the picture leaves open may matter so little that the number is good between all limits.
        if (!d.sigma && found[i].within_limits &&
            trust_of(d.quantity, d.value, *found[i].within_limits) == Trust::good)
          d.sigma = found[i].within_limits;
        if (!d.sigma)
          d.why_no_sigma = found[i].moves ? "the data do not determine it" : "it follows from what was fixed";
      }
      result.push_back(std::move(d));
    }
  }
  return result;
}

std::vector<sim::FootBand> foot_bands(const sim::Scene& best, const std::vector<FreeNumber>& free,
                                      const std::vector<double>& values, const ValueUncertainty& known) {
  const DeltaMethod estimates(best, free, values, known);
  std::vector<sim::FootBand> bands;
  for (std::size_t s = 0; s < best.sheets.size(); ++s) {
    sim::FootBand band{best.sheets[s].name, sim::band_places_km(best.sheets[s]), {}};
    if (sim::is_curve(best.sheets[s])) {
      bands.push_back(std::move(band));
      continue;
    }
    for (const DeltaMethod::Estimate& aside : estimates([&](const sim::Scene& x) {
           return sim::aside_km(best.sheets[s], x.sheets[s], x.time.start_s, band.along_km);
         })) {
      if (!aside.sigma) break;
      band.sigma_km.push_back(*aside.sigma);
    }
    if (band.sigma_km.size() != band.along_km.size()) band.sigma_km.clear();
    bands.push_back(std::move(band));
  }
  return bands;
}

namespace {

/// Whether the scene has emitters with such light.
bool has_light(const sim::Scene& scene, sim::LightKind light) {
  const std::vector<sim::EmitterKind>& kinds = sim::emitter_kinds();
  return std::any_of(kinds.begin(), kinds.end(), [&](const sim::EmitterKind& kind) {
    return kind.light == light && sim::is_in_scene(kind, scene);
  });
}

}  // namespace

std::string light_noun(const sim::Scene& scene) {
  using sim::LightKind;
  if (!scene.sheets.empty() || has_light(scene, LightKind::aurora)) return "aurora";
  if (scene.sun.shown) return "solar light";
  return has_light(scene, LightKind::any) || !has_light(scene, LightKind::nebula) ? "aurora" : "nebula";
}

std::string sources_of(const sim::Scene& scene) {
  using sim::LightKind;
  std::vector<std::string> sources;
  if (!scene.sheets.empty()) sources.emplace_back("sheets");
  if (has_light(scene, LightKind::aurora) || has_light(scene, LightKind::nebula) ||
      has_light(scene, LightKind::any))
    sources.emplace_back("volumes");
  if (scene.sun.shown) sources.emplace_back("Sun");
  return sources.empty() ? "sheets" : sim::joined(sources, ", ", " and ");
}

}  // namespace vegard::fit
