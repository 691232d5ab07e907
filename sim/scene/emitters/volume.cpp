// [[volume]]: light from files of voxels.
#include <algorithm>

#include "sim/scene/emitters/element_rules.h"
#include "sim/scene/emitters/emitter_kinds.h"
#include "sim/scene/rows/row.h"

namespace vegard::sim {
namespace {

template <class Value>
Row row(const char* key, Value Volume::*value) {
  return Row("volume", key, &Scene::volumes, value);
}

std::vector<Declaration> volume_rows() {
  // clang-format off
  return {
      row("name", &Volume::name).means("name in paths"),
      row("file", &Volume::file).names_file().means("OpenVDB file (grids emission_5577, density …) or pbrt volumegrid (`.pbrt`, `.volumegrid`, `.txt`), relative to the scene's file"),
      row("frame", &Volume::frame).one_of<VolumeFrame>({{"site", VolumeFrame::site}, {"sun", VolumeFrame::sun}})
          .means("frame of the file: the ground, in km, or the Sun, in sun.unit_km"),
      row("shift_km", &Volume::shift_km).of({"east", "north", "up"}).in("km").within(-1e5, 1e5).may_be_free(ParameterScale::linear)
          .means("shift; on the Sun along x, y and z"),
      row("gain", &Volume::gain).within(0, 1e9).may_be_free(ParameterScale::logarithmic).means("factor on its light"),
      row("extinction_per_km", &Volume::extinction_per_km).in("km⁻¹").within(0, 1e6).may_be_free(ParameterScale::linear)
          .means("extinction of density 1 of the grid \"density\"; 0: none"),
      row("density_rayleigh", &Volume::density_rayleigh).by_line().in("R").within(0, 1e12).may_be_free(ParameterScale::linear)
          .means("light of density 1 per line and km (on the Sun: sun.unit_km), instead of emission grids; empty: none"),
      row("step_voxels", &Volume::step_voxels).within(0.05, 8).means("step of the march, in edges of a voxel"),
      row("albedo", &Volume::albedo).within(0, 1).may_be_free(ParameterScale::linear).means("share of scattering, once, in the extinction; 0: none"),
      row("asymmetry", &Volume::asymmetry).within(-0.99, 0.99).may_be_free(ParameterScale::linear).means("mean cosine of the scattering angle (g of Henyey and Greenstein): 0 to all sides, above 0 forwards"),
      row("lamp_kind", &Volume::lamp).one_of<VolumeLamp>({{"none", VolumeLamp::none}, {"direction", VolumeLamp::direction}, {"point", VolumeLamp::point}, {"sun", VolumeLamp::sun}})
          .means("lamp: none, parallel light, a point, or the scene's Sun"),
      row("lamp_azimuth_deg", &Volume::lamp_azimuth_deg).in("deg").within(-720, 720).means("direction of parallel light, from north to the east; on the Sun heliographic longitude"),
      row("lamp_elevation_deg", &Volume::lamp_elevation_deg).in("deg").within(-90, 90).means("the same above the horizon; on the Sun heliographic latitude"),
      row("lamp_km", &Volume::lamp_km).of({"east", "north", "up"}).in("km").within(-1e9, 1e9)
          .means("place of a point; on the Sun x, y and z of its frame"),
      row("lamp_flux", &Volume::lamp_flux).by_line().in("10⁶ cm⁻² s⁻¹").within(0, 1e18)
          .means("photons of the lamp per line: of parallel light, or of a point at 1 km (sun.unit_km on the Sun)"),
  };
  // clang-format on
}

void check_the_volume(const Scene& scene, const Volume& volume) {
  const auto refuse = [&](const Complaint& complaint, const char* key) {
    complain(complaint, {scene.file, 0, "volume." + volume.name + "." + key});
  };
  if (volume.file.empty()) refuse({"the volume names no file", "file = \"NAME.vdb\"", ""}, "file");
  if (volume.frame == VolumeFrame::sun && !scene.sun.shown)
    refuse({"it stands on the Sun, which is not in the scene", "shown = true in [sun]", ""}, "frame");
  if (!volume.density_rayleigh.empty() && volume.density_rayleigh.size() != scene.emission.lines.size())
    refuse({std::to_string(volume.density_rayleigh.size()) + " numbers for " +
                std::to_string(scene.emission.lines.size()) + " emission lines",
            "one per line of emission.lines, in its order", ""},
           "density_rayleigh");
  if (volume.lamp == VolumeLamp::none) return;
  if (volume.lamp == VolumeLamp::sun) {
    if (!scene.sun.shown) refuse({"the Sun is not in the scene", "shown = true in [sun]", ""}, "lamp_kind");
    if (all_zero(scene.sun.photosphere_rayleigh))
      refuse({"the scene's Sun is dark", "photosphere_rayleigh in [sun]", "or another lamp"}, "lamp_kind");
    return;
  }
  if (volume.lamp_flux.size() != scene.emission.lines.size())
    refuse({std::to_string(volume.lamp_flux.size()) + " numbers for " +
                std::to_string(scene.emission.lines.size()) + " emission lines",
            "one per line of emission.lines, in its order", ""},
           "lamp_flux");
}

std::optional<Complaint> why_volume_inert(const Scene& scene, const ParameterPath& path) {
  const std::string& key = path.row->key;
  if (path.row->table == "sun") {
    // What a lamp is worked out from is known by its value alone.
    for (const Volume& volume : scene.volumes)
      if (volume.lamp == VolumeLamp::sun &&
          (is_one_of(key, {"photosphere_rayleigh", "limb_darkening", "limb_darkening_square"}) ||
           (volume.frame == VolumeFrame::site &&
            is_one_of(key, {"azimuth_deg", "elevation_deg", "distance_km"}))))
        return Complaint{
            "the Sun lights the volume '" + volume.name + "', whose derivative by " + key + " is not known",
            "another number", "leave it out of fit.free, or set the volume's lamp to another"};
    return std::nullopt;
  }
  if (path.row->table != "volume") return std::nullopt;
  const Volume& volume = scene.volumes[static_cast<std::size_t>(path.element)];
  const std::string name = "volume." + volume.name;
  const bool scatters = volume.albedo > 0.0 || frees(scene, name + ".albedo"),
             absorbs = volume.extinction_per_km > 0.0 || frees(scene, name + ".extinction_per_km");
  const bool of_lamp = key.rfind("lamp_", 0) == 0;
  if (key == "albedo" || key == "asymmetry" || of_lamp) {
    if (volume.lamp == VolumeLamp::none) return inert("no lamp lights the volume", key, "name a lamp");
    if (!absorbs) return inert("the volume has no extinction", key, "give it an extinction_per_km");
    if (key != "albedo" && !scatters) return inert("the volume scatters nothing", key, "give it an albedo");
  }
  const bool is_direction = is_one_of(key, {"lamp_azimuth_deg", "lamp_elevation_deg"});
  if ((is_direction && volume.lamp != VolumeLamp::direction) ||
      (key == "lamp_km" && volume.lamp != VolumeLamp::point) ||
      (key == "lamp_flux" && volume.lamp == VolumeLamp::sun))
    return inert("the lamp is of another kind", key, "leave it out");
  const bool stands = volume.lamp == VolumeLamp::point ||
                      (volume.lamp == VolumeLamp::sun && volume.frame == VolumeFrame::sun);
  if (key == "shift_km" && stands && scatters && absorbs)
    return Complaint{"the volume is moved against its lamp, by which the derivative is not known",
                     "a lamp far off", "leave shift_km out of fit.free"};
  return std::nullopt;
}

void check_volumes(const Scene& scene) {
  for (const Volume& volume : scene.volumes) check_the_volume(scene, volume);
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
  kind.check = check_volumes;
  kind.why_inert = why_volume_inert;
  kind.on_sun = volumes_on_sun;
  kind.light_locations = where_volumes_are;
  return kind;
}

}  // namespace vegard::sim
