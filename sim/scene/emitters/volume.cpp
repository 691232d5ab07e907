// [[volume]]: light from files of voxels.
#include <algorithm>

#include "sim/scene/emitters/element_rules.h"
#include "sim/scene/emitters/emitter_kinds.h"

namespace vegard::sim {
namespace {

bool scatters(const Volume& v, const Scene& scene) {
  return v.albedo > 0.0 || frees(scene, "volume." + v.name + ".albedo");
}
bool absorbs(const Volume& v, const Scene& scene) {
  return v.extinction_per_km > 0.0 || frees(scene, "volume." + v.name + ".extinction_per_km");
}

/// A row whose number the light scattered by a volume depends on.
Row<Volume> lit(Row<Volume> row) {
  return row
      .inert_if([](const Volume& v) { return v.lamp == VolumeLamp::none; }, "no lamp lights the volume",
                "name a lamp")
      .inert_if([](const Volume& v, const Scene& scene) { return !absorbs(v, scene); },
                "the volume has no extinction", "give it an extinction_per_km");
}
Row<Volume> scattered(const Row<Volume>& row) {
  return lit(row).inert_if([](const Volume& v, const Scene& scene) { return !scatters(v, scene); },
                           "the volume scatters nothing", "give it an albedo");
}

/// Whether the light of the lamp changes as the volume is moved.
bool is_moved_against_lamp(const Volume& v, const Scene& scene) {
  const bool stands =
      v.lamp == VolumeLamp::point || (v.lamp == VolumeLamp::sun && v.frame == VolumeFrame::sun);
  return stands && scatters(v, scene) && absorbs(v, scene);
}

template <class Value>
Row<Volume> row(const char* key, Value Volume::*value) {
  return Row("volume", key, &Scene::volumes, value);
}

std::vector<Declaration> volume_rows() {
  const char* const other_kind = "the lamp is of another kind";
  // clang-format off
  return {
      row("name", &Volume::name).means("name in paths"),
      row("file", &Volume::file).names_file().means("OpenVDB (grids emission_5577, density …) or pbrt volumegrid (`.pbrt`, `.volumegrid`, `.txt`)"),
      row("frame", &Volume::frame).one_of<VolumeFrame>({{"site", VolumeFrame::site}, {"sun", VolumeFrame::sun}})
          .means("axes of the file: the ground, in km, or the Sun, in sun.unit_km"),
      row("shift_km", &Volume::shift_km).of({"east", "north", "up"}).in("km").within(-1e5, 1e5).may_be_free(ParameterScale::linear)
          .means("on the Sun along x, y and z")
          .not_free_if(is_moved_against_lamp, {"the volume is moved against its lamp, by which the derivative is not known", "a lamp far off", "leave shift_km out of fit.free"}),
      row("gain", &Volume::gain).within(0, 1e9).may_be_free(ParameterScale::logarithmic).means("factor on its light"),
      row("extinction_per_km", &Volume::extinction_per_km).in("km⁻¹").within(0, 1e6).may_be_free(ParameterScale::linear)
          .means("of density 1 of the grid \"density\"; 0: none"),
      row("density_rayleigh", &Volume::density_rayleigh).by_line().in("R").within(0, 1e12).may_be_free(ParameterScale::linear)
          .means("light of density 1 per line and km (on the Sun: sun.unit_km), instead of emission grids"),
      row("step_voxels", &Volume::step_voxels).within(0.05, 8).means("step of the march, in voxels"),
      lit(row("albedo", &Volume::albedo)).within(0, 1).may_be_free(ParameterScale::linear).means("share of scattering in the extinction"),
      scattered(row("asymmetry", &Volume::asymmetry)).within(-0.99, 0.99).may_be_free(ParameterScale::linear).means("mean cosine of scattering (g of Henyey and Greenstein): 0 to all sides, above 0 forwards"),
      scattered(row("lamp_kind", &Volume::lamp)).one_of<VolumeLamp>({{"none", VolumeLamp::none}, {"direction", VolumeLamp::direction}, {"point", VolumeLamp::point}, {"sun", VolumeLamp::sun}})
          .means("none, parallel light, a point, or the scene's Sun"),
      scattered(row("lamp_azimuth_deg", &Volume::lamp_azimuth_deg)).in("deg").within(-720, 720).means("of parallel light; on the Sun heliographic longitude")
          .inert_if([](const Volume& v) { return v.lamp != VolumeLamp::direction; }, other_kind, "leave it out"),
      scattered(row("lamp_elevation_deg", &Volume::lamp_elevation_deg)).in("deg").within(-90, 90).means("of parallel light; on the Sun heliographic latitude")
          .inert_if([](const Volume& v) { return v.lamp != VolumeLamp::direction; }, other_kind, "leave it out"),
      scattered(row("lamp_km", &Volume::lamp_km)).of({"east", "north", "up"}).in("km").within(-1e9, 1e9)
          .means("of a point; on the Sun x, y, z of its frame")
          .inert_if([](const Volume& v) { return v.lamp != VolumeLamp::point; }, other_kind, "leave it out"),
      scattered(row("lamp_flux", &Volume::lamp_flux)).by_line().in("10⁶ cm⁻² s⁻¹").within(0, 1e18)
          .means("photons per line: of parallel light, or of a point at 1 km (sun.unit_km on the Sun)")
          .inert_if([](const Volume& v) { return v.lamp == VolumeLamp::sun; }, other_kind, "leave it out"),
  };
  // clang-format on
}

void check_the_volume(const Scene& scene, const Volume& volume) {
  const ElementCheck check(scene, "volume." + volume.name);
  if (volume.file.empty())
    throw check.error_at({"the volume names no file", "file = \"NAME.vdb\"", ""}, "file");
  if (volume.frame == VolumeFrame::sun && !scene.sun.shown)
    throw check.error_at({"it stands on the Sun, which is not in the scene", "shown = true in [sun]", ""},
                         "frame");
  check.check_lines(volume.density_rayleigh, true, "density_rayleigh");
  if (volume.lamp == VolumeLamp::none) return;
  if (volume.lamp == VolumeLamp::sun) {
    if (!scene.sun.shown)
      throw check.error_at({"the Sun is not in the scene", "shown = true in [sun]", ""}, "lamp_kind");
    if (all_zero(scene.sun.photosphere_rayleigh))
      throw check.error_at({"the scene's Sun is dark", "photosphere_rayleigh in [sun]", "or another lamp"},
                           "lamp_kind");
    return;
  }
  check.check_lines(volume.lamp_flux, false, "lamp_flux");
}

OnSun volumes_on_sun(const Scene& scene) {
  const bool any = std::any_of(scene.volumes.begin(), scene.volumes.end(),
                               [](const Volume& v) { return v.frame == VolumeFrame::sun; });
  return any ? OnSun::uneven : OnSun::nothing;
}

std::vector<LightLocation> where_volumes_are(const Scene& scene) {
  std::vector<LightLocation> all;
  for (const Volume& v : scene.volumes)
    all.push_back({LightLocation::Known::file,
                   "volume '" + v.name + "'",
                   {},
                   0.0,
                   0.0,
                   "stands where " + v.file + " has it"});
  return all;
}

std::optional<Complaint> volumes_stay_at(Scene& scene, const Site& home) {
  for (Volume& volume : scene.volumes) {
    if (volume.frame == VolumeFrame::sun)
      return Complaint{"a volume on the Sun is not carried over to another site", "photographs from one site",
                       ""};
    if (!volume.home) volume.home = home;
  }
  return std::nullopt;
}

/// Those about a site are aurora, which goes by the substorm; those on the Sun turn with it.
bool volumes_move(const Scene& scene) {
  return std::any_of(scene.volumes.begin(), scene.volumes.end(), [&](const Volume& volume) {
    return volume.frame == VolumeFrame::site ? scene.substorm.quiet < 1.0 : turns_with_sun(scene);
  });
}

}  // namespace

EmitterKind volume_kind() {
  EmitterKind kind;
  kind.table = "volume";
  kind.repeated = {repeated_table_of(kind.table, &Scene::volumes)};
  kind.moves = volumes_move;
  kind.stay_at = volumes_stay_at;
  kind.rows = volume_rows;
  kind.check = check_each<&Scene::volumes, check_the_volume>;
  kind.on_sun = volumes_on_sun;
  kind.light_locations = where_volumes_are;
  return kind;
}

}  // namespace vegard::sim
