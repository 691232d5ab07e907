#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "sim/base/error.h"
#include "sim/scene/parameter_declarations.h"
#include "sim/scene/parameter_table.h"
#include "sim/scene/value_check.h"
#include "sim/scene/value_words.h"

namespace vegard::sim {
namespace {

std::vector<ParameterPath> resolve_at(const Scene& scene, const FreeParameter& free) {
  try {
    return resolve(scene, free.path);
  } catch (const Error& error) {
    ErrorDetails details = error.details();
    details.file = scene.file;
    details.line = free.line;
    throw Error(error.kind(), details);
  }
}

/// Start, min and max of one scalar. A logarithmic parameter cannot start from or end at 0.
void check_numbers(const Scene& scene, const FreeParameter& free, const ParameterPath& path) {
  const Declaration& d = declaration_of(*path.row);
  const Origin origin{scene.file, free.line, path.text};
  const auto check = [&](const char* what, double number) {
    std::optional<Complaint> complaint = number_complaint(d, number);
    if (!complaint && d.scale == ParameterScale::logarithmic && number <= 0.0) {
      complaint = Complaint{real_text(number) + " has no logarithm, on whose scale this parameter is fitted",
                            "a number above 0", ""};
    }
    if (!complaint) return;
    complaint->problem = std::string(what) + ": " + complaint->problem;
    complain(*complaint, origin);
  };
  if (free.min) check("min", *free.min);
  if (free.max) check("max", *free.max);
  const double start = free.start.value_or(*real_value(scene, path));
  check(free.start ? "start" : "start (the scene's value)", start);
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const double min = free.min.value_or(-infinite), max = free.max.value_or(infinite);
  if (min >= max)
    complain({"min " + real_text(min) + " is not below max " + real_text(max), "min < max", ""}, origin);
  if (start < min || start > max) {
    complain(
        {(free.start ? "start " : "the scene's value ") + real_text(start) + " is not between min and max",
         "min <= start <= max", free.start ? "" : "give a start or change the value itself"},
        origin);
  }
}

void check_prior(const Scene& scene, const FreeParameter& free) {
  if (!free.prior) return;
  const Origin origin{scene.file, free.line, free.path};
  if (!std::isfinite(free.prior->mean)) {
    complain(
        {"prior: the mean " + real_text(free.prior->mean) + " is no usable number", "a finite number", ""},
        origin);
  }
  if (!(std::isfinite(free.prior->sigma) && free.prior->sigma > 0.0)) {
    complain({"prior: the sigma " + real_text(free.prior->sigma) + " is no width", "a number above 0", ""},
             origin);
  }
}

/// Whether any coefficient of a sheet's free-form profile is free.
bool has_free_spline(const Scene& scene, int sheet) {
  for (const FreeParameter& free : scene.fit.free)
    for (const ParameterPath& path : resolve_at(scene, free))
      if (path.row->table == sheet_table && path.row->key == "spline_rate" && path.sheet == sheet)
        return true;
  return false;
}

/// A parameter that the light does not depend on in this scene, or that another stands for.
std::optional<Complaint> why_it_counts_for_nothing(const Scene& scene, const ParameterPath& path) {
  const std::string expected = "a parameter that the light depends on";
  const std::string& key = path.row->key;
  if (path.row->table == "field" && scene.field.model == "dipole") {
    return Complaint{"the field is a dipole's, so " + key + " counts for nothing", expected,
                     "leave it out of fit.free, or set field.model to \"uniform\""};
  }
  if (path.row->table == "air" && scene.air.model == "none") {
    return Complaint{"there is no air, so " + key + " counts for nothing", expected,
                     "leave it out of fit.free, or set air.model to \"standard\""};
  }
  if (path.row->table != sheet_table) return std::nullopt;
  const Sheet& sheet = scene.sheets[path.sheet];
  if (key == "energy_kev" && sheet.profile == "file") {
    return Complaint{
        "the sheet's profile comes from a file, so the energy of its electrons counts for nothing", expected,
        "leave it out of fit.free, or set profile to a spectrum of electrons"};
  }
  if (key == "energy_spread" && sheet.profile != "gaussian") {
    return Complaint{"the sheet's profile is \"" + sheet.profile + "\", so energy_spread counts for nothing",
                     expected, "leave it out of fit.free, or set profile to \"gaussian\""};
  }
  if (key == "energy_flux_mw_m2" && sheet.brightness_kilorayleigh > 0.0) {
    return Complaint{"the sheet's brightness is given, so its energy flux counts for nothing", expected,
                     "leave it out of fit.free, or brightness_kilorayleigh (and ibc) out of the sheet"};
  }
  if (key == "energy_flux_mw_m2" && sheet.profile == "spline" && has_free_spline(scene, path.sheet)) {
    return Complaint{
        "the sheet's spline_rate is free, so its energy flux counts for nothing: their product "
        "is the light",
        expected, "leave energy_flux_mw_m2 out of fit.free"};
  }
  if (key == "fold_stage" && sheet.fold_spacing_km == 0.0) {
    return Complaint{"the sheet has no folds, so their stage counts for nothing", expected,
                     "leave it out of fit.free, or set fold_spacing_km"};
  }
  if (key == "arc_spacing_km" && sheet.arcs == 1) {
    return Complaint{"the sheet is a single arc, so the spacing of arcs counts for nothing", expected,
                     "leave it out of fit.free, or set arcs"};
  }
  if (key == "spline_rate" && sheet.profile != "spline") {
    return Complaint{"the sheet's profile is \"" + sheet.profile + "\", so spline_rate counts for nothing",
                     expected, "leave it out of fit.free, or set the profile to \"spline\""};
  }
  if (key == "energy_kev" && sheet.profile == "spline") {
    return Complaint{"the sheet's profile is free, so the electrons' energy counts for nothing", expected,
                     "leave it out of fit.free; sheet." + sheet.name + ".spline_rate is the light"};
  }
  if ((key == "peak_km" || key == "lower_km" || key == "upper_km") && sheet.profile != "form") {
    return Complaint{"the sheet's profile is \"" + sheet.profile + "\", so " + key + " counts for nothing",
                     expected, "leave it out of fit.free, or set the profile to \"form\""};
  }
  return std::nullopt;
}

}  // namespace

void check_free_parameters(const Scene& scene) {
  std::map<std::string, const FreeParameter*> owners;
  for (const FreeParameter& free : scene.fit.free) {
    if (!free.photo.empty()) continue;  // checked in the photograph's own scene (check_photos)
    for (const ParameterPath& path : resolve_at(scene, free)) {
      const Origin origin{scene.file, free.line, path.text};
      if (!path.row->can_be_free) {
        complain({"this parameter cannot be free", "one that `vegard params` lists as free", ""}, origin);
      }
      if (const auto idle = why_it_counts_for_nothing(scene, path)) complain(*idle, origin);
      const auto [owner, is_first] = owners.emplace(path.text, &free);
      if (!is_first) {
        complain({"free twice, first as '" + owner->second->path + "'" +
                      (owner->second->line > 0 ? " in line " + std::to_string(owner->second->line) : ""),
                  "each parameter once", ""},
                 origin);
      }
      check_numbers(scene, free, path);
    }
    check_prior(scene, free);
  }
}

}  // namespace vegard::sim
