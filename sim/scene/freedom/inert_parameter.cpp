#include "sim/scene/freedom/inert_parameter.h"

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include "sim/scene/emitters/emitter_kinds.h"
#include "sim/scene/freedom/free_path.h"
#include "sim/scene/lines/emission_lines.h"
#include "sim/scene/table/parameter_table.h"

namespace vegard::sim {
namespace {

/// Whether any coefficient of a sheet's free-form profile is free.
bool has_free_spline(const Scene& scene, int sheet) {
  for (const FreeParameter& free : scene.fit.free)
    for (const ParameterPath& path : paths_of(scene, free))
      if (path.row->role == ParameterRole::profile_coefficient && path.element == sheet) return true;
  return false;
}

/// Whether the brightness is free at every point of a sheet's curve.
bool has_free_brightness(const Scene& scene, int sheet) {
  const std::size_t points = scene.sheets[static_cast<std::size_t>(sheet)].point_brightness.size();
  std::set<int> free_points;
  for (const FreeParameter& free : scene.fit.free)
    for (const ParameterPath& path : paths_of(scene, free))
      if (path.sheet() == sheet && path.row->key == "point_brightness") free_points.insert(path.component);
  return points > 0 && free_points.size() == points;
}

/// Whether anything shines by the emission tables.
bool has_electrons(const Scene& scene) {
  const auto is_lit_by_tables = [](const auto& each) { return is_of_electrons(each.profile); };
  return std::any_of(scene.footprints.begin(), scene.footprints.end(), is_lit_by_tables) ||
         std::any_of(scene.sheets.begin(), scene.sheets.end(), is_lit_by_tables);
}

/// Of a line that is not drawn, that nothing makes shine, or of numbers of a layer that it does not have.
std::optional<Complaint> why_own_line_is_inert(const Scene& scene, const ParameterPath& path) {
  const OwnLine& own = scene.own_lines[static_cast<std::size_t>(path.element)];
  const std::string& key = path.row->key;
  const bool follows = own.follows_nm > 0.0, has_layer = own.rayleigh_per_mw_m2 > 0.0;
  if (key == "wavelength_nm" && line_index(scene.emission.lines, own.wavelength_nm) < 0)
    return Complaint{"the line is not among emission.lines, so it is not drawn", "its wavelength there", ""};
  const bool may_be_dark = std::all_of(scene.sheets.begin(), scene.sheets.end(), [](const Sheet& sheet) {
    return sheet.profile != ProfileKind::file && sheet.profile != ProfileKind::spline;
  });
  const bool shines_otherwise = scene.sun.shown || !scene.nebulae.empty() || !scene.volumes.empty() ||
                                !scene.loops.empty() || !scene.coronae.empty() || !scene.bundles.empty() ||
                                !scene.ejections.empty();
  if (key == "wavelength_nm" && !follows && !has_layer && may_be_dark && !shines_otherwise &&
      !(scene.sheets.empty() && scene.footprints.empty()))
    return Complaint{"nothing makes the line shine",
                     "follows_nm and ratio, rayleigh_per_mw_m2, or a column of it in a sheet's profile_file",
                     ""};
  const char* expected = "a number that the light depends on";
  if (key == "ratio" && !follows)
    return Complaint{"the line follows no other, so its ratio has no effect", expected, "set follows_nm"};
  if ((key == "peak_km" || key == "scale_height_km") && !has_layer)
    return Complaint{"the line has no layer of its own, so " + key + " has no effect", expected,
                     "set rayleigh_per_mw_m2"};
  return std::nullopt;
}

/// Of a flux in a fit that frees what it is multiplied by.
std::optional<Complaint> why_flux_is_replaced(const Scene& scene, const ParameterPath& path) {
  const std::string& key = path.row->key;
  const std::string expected = "a parameter that the light depends on";
  if (path.row->table != sheet_table) return std::nullopt;
  const Sheet& sheet = scene.sheets[path.sheet()];
  if (key == "energy_flux_mw_m2" && sheet.course == SheetCourse::curve &&
      has_free_brightness(scene, path.sheet()))
    return Complaint{
        "all of the sheet's point_brightness is free, so its energy flux has no effect: their "
        "product is the light",
        expected, "leave energy_flux_mw_m2 out of fit.free, or hold one of point_brightness"};
  if (key == "energy_flux_mw_m2" && sheet.profile == ProfileKind::spline &&
      has_free_spline(scene, path.sheet())) {
    return Complaint{
        "the sheet's spline_rate is free, so its energy flux has no effect: their product "
        "is the light",
        expected, "leave energy_flux_mw_m2 out of fit.free"};
  }
  return std::nullopt;
}

}  // namespace

std::optional<Complaint> inert_parameter_complaint(const Scene& scene, const ParameterPath& path) {
  for (const EmitterKind& kind : emitter_kinds())
    if (kind.why_inert != nullptr)
      if (auto complaint = kind.why_inert(scene, path)) return complaint;
  if (auto complaint = why_flux_is_replaced(scene, path)) return complaint;
  return inert_number_complaint(scene, path);
}

std::optional<Complaint> inert_number_complaint(const Scene& scene, const ParameterPath& path) {
  for (const EmitterKind& kind : emitter_kinds())
    if (kind.why_inert != nullptr)
      if (auto complaint = kind.why_inert(scene, path); complaint && complaint->is_inert) return complaint;
  const std::string expected = "a parameter that the light depends on";
  const std::string& key = path.row->key;
  if (path.row->table == "field" && key != "model") {
    const bool of_the_pole = key.rfind("pole_", 0) == 0;
    if (scene.field.model != (of_the_pole ? FieldModel::dipole : FieldModel::uniform)) {
      const char* field = scene.field.model == FieldModel::uniform  ? "the same everywhere"
                          : scene.field.model == FieldModel::dipole ? "a dipole's"
                                                                    : "the reference field";
      return Complaint{std::string("the field is ") + field + ", so " + key + " has no effect", expected,
                       std::string("leave it out of fit.free, or set field.model to \"") +
                           (of_the_pole ? "dipole" : "uniform") + "\""};
    }
  }
  if (path.row->table == "camera") {
    const LensModel model = scene.camera.model;
    const bool pinhole = model == LensModel::pinhole, radial = key == "k1" || key == "k2" || key == "k3";
    if ((key == "hfov_deg" || key == "focal_px") &&
        (model == LensModel::equirectangular || model == LensModel::cube))
      return Complaint{"the camera is a panorama (\"" + word_of(model) + "\"), so " + key + " has no effect",
                       expected, "a panorama sees all around; its scale is camera.width"};
    if ((key == "hfov_deg" && !pinhole) || (key == "focal_px" && pinhole) ||
        (radial && !pinhole && model != LensModel::polynomial)) {
      return Complaint{"the lens is \"" + word_of(model) + "\", so " + key + " has no effect", expected,
                       radial    ? "leave it out of fit.free, or set camera.model to \"polynomial\""
                       : pinhole ? "a pinhole has camera.hfov_deg"
                                 : "this lens has camera.focal_px"};
    }
  }
  if (path.row->table == "air" && scene.air.model == AirModel::none) {
    return Complaint{"there is no air, so " + key + " has no effect", expected,
                     "leave it out of fit.free, or set air.model to \"standard\""};
  }
  if (path.row->role == ParameterRole::oxygen_factor && !has_electrons(scene)) {
    return Complaint{"nothing shines by the emission tables, so " + key + " has no effect", expected,
                     "leave it out of fit.free, or set a sheet's profile to a spectrum of electrons"};
  }
  if (path.row->role == ParameterRole::blur_width && scene.blur.model == BlurModel::physical) {
    return Complaint{"the blur is physical, so " + key + " has no effect", expected,
                     "leave it out of fit.free, or set blur.model to \"angle\""};
  }
  if (path.row->role == ParameterRole::blur_width && scene.blur.widths == BlurWidths::paper) {
    return Complaint{"the widths of the blur are the paper's, so " + key + " has no effect", expected,
                     "leave it out of fit.free, or set blur.widths to \"given\""};
  }
  if (path.row->table == "line") return why_own_line_is_inert(scene, path);
  if (path.row->table != sheet_table) return std::nullopt;
  const Sheet& sheet = scene.sheets[path.sheet()];
  if (sheet.course == SheetCourse::curve) {
    static const std::set<std::string> kOfSine = {"center_km",       "bearing_deg",    "length_km",
                                                  "thickness_km",    "wavelength_km",  "phase_rad",
                                                  "phase_shift_rad", "arc_spacing_km", "fold_stage"};
    if (kOfSine.count(key) > 0)
      return Complaint{"the sheet's course is a curve, so " + key + " has no effect", expected,
                       "leave it out of fit.free; the curve has east_km and north_km of its points"};
    for (const auto& [list, of_points] :
         {std::pair{&sheet.point_energy_kev, "energy_kev"}, {&sheet.point_width_km, "width_km"}})
      if (key == of_points && !list->empty())
        return Complaint{"the sheet has point_" + key + ", so " + key + " has no effect", expected,
                         "leave it out of fit.free, or free numbers of point_" + key};
  }
  if (key == "energy_kev" && sheet.profile == ProfileKind::file) {
    return Complaint{"the sheet's profile comes from a file, so the energy of its electrons has no effect",
                     expected, "leave it out of fit.free, or set profile to a spectrum of electrons"};
  }
  if (key == "energy_kev" && sheet.profile == ProfileKind::layer) {
    return Complaint{
        "the sheet's light is in layers of the scene's own lines, so the energy of its electrons counts "
        "for nothing",
        expected, "leave it out of fit.free, or set profile to a spectrum of electrons"};
  }
  if (key == "energy_spread" && sheet.profile != ProfileKind::gaussian) {
    return Complaint{
        "the sheet's profile is \"" + word_of(sheet.profile) + "\", so energy_spread has no effect", expected,
        "leave it out of fit.free, or set profile to \"gaussian\""};
  }
  if (key == "energy_flux_mw_m2" && sheet.brightness_kilorayleigh > 0.0) {
    return Complaint{"the sheet's brightness is given, so its energy flux has no effect", expected,
                     "leave it out of fit.free, or brightness_kilorayleigh (and ibc) out of the sheet"};
  }
  if (key == "fold_stage" && sheet.fold_spacing_km == 0.0) {
    return Complaint{"the sheet has no folds, so their stage has no effect", expected,
                     "leave it out of fit.free, or set fold_spacing_km"};
  }
  if (key == "arc_spacing_km" && sheet.arcs == 1) {
    return Complaint{"the sheet is a single arc, so the spacing of arcs has no effect", expected,
                     "leave it out of fit.free, or set arcs"};
  }
  if (key == "spline_rate" && sheet.profile != ProfileKind::spline) {
    return Complaint{
        "the sheet's profile is \"" + word_of(sheet.profile) + "\", so spline_rate has no effect", expected,
        "leave it out of fit.free, or set the profile to \"spline\""};
  }
  if (key == "energy_kev" && sheet.profile == ProfileKind::spline) {
    return Complaint{"the sheet's profile is free, so the electrons' energy has no effect", expected,
                     "leave it out of fit.free; sheet." + sheet.name + ".spline_rate is the light"};
  }
  if ((key == "peak_km" || key == "lower_km" || key == "upper_km") && sheet.profile != ProfileKind::form) {
    return Complaint{
        "the sheet's profile is \"" + word_of(sheet.profile) + "\", so " + key + " has no effect", expected,
        "leave it out of fit.free, or set the profile to \"form\""};
  }
  return std::nullopt;
}

}  // namespace vegard::sim
