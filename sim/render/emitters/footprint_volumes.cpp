#include "sim/render/emitters/footprint_volumes.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "sim/emit/footprint/footprint_emitter.h"
#include "sim/emit/footprint/map/footprint_map.h"
#include "sim/emit/footprint/map/make_footprint.h"
#include "sim/light/profile_table.h"
#include "sim/render/beams/altitude_slabs.h"
#include "sim/render/emitters/emitter_makers.h"
#include "sim/scene/file/named_files.h"
#include "sim/scene/rows/complaint.h"
#include "sim/scene/rows/value_words.h"
#include "sim/scene/structs/footprint.h"
#include "sim/scene/structs/line_of.h"
#include "sim/view/colour/line_colours.h"

namespace vegard::sim {
namespace {

/// The least and the greatest ln(energy) of footprints' grids.
struct EnergyRange {
  double least = 0.0, most = 0.0;
  template <class T>
  void take(const FootprintGrid<T>& grid) {
    for (const T& ln : grid.ln_energy) {
      least = std::min(least, value_of(ln));
      most = std::max(most, value_of(ln));
    }
  }
};

/// Reduces a footprint's light to the part that a part of a scene has; colours are not light of excited
/// atoms.
void take_part(const Scene& scene, const Footprint& f, const LightShare& of_lines, ProfileTable& table) {
  if (!of_lines.empty())
    for (HeightProfile& profile : table.of_energy) multiply_by_share(of_lines, profile);
  const auto& shares = scene.emission.altitude_share;
  if (shares.empty()) return;
  if (f.light == FootprintLight::lines) {
    for (HeightProfile& profile : table.of_energy) take_altitude_share(scene.emission, profile);
  } else if (std::any_of(shares.begin(), shares.end(), [](const auto& share) { return share != nullptr; })) {
    for (HeightProfile& profile : table.of_energy) {
      std::fill(profile.rate.begin(), profile.rate.end(), 0.0f);
      std::fill(profile.d_rate_d_ln_energy.begin(), profile.d_rate_d_ln_energy.end(), 0.0f);
    }
  }
}

struct Profiles {
  ProfileTable usual;
  ProfileChanges changes;
};

Profiles profiles_of(const Scene& scene, const Footprint& f, const EnergyRange& range, bool with_slopes,
                     const LightShare& of_lines) {
  Profiles profiles;
  profiles.usual = footprint_profiles(scene, f, range.least, range.most);
  if (!with_slopes) {
    take_part(scene, f, of_lines, profiles.usual);
    return profiles;
  }
  profiles.changes = profile_changes(scene.emission.lines, scene, f, profiles.usual);
  if (f.light == FootprintLight::colours)
    for (ProfileTable* table : {&profiles.changes.by_flux, &profiles.changes.by_oxygen})
      *table = colours_table(*table, colour_ladder(scene, f));
  for (ProfileTable* table : {&profiles.usual, &profiles.changes.by_flux, &profiles.changes.by_oxygen})
    take_part(scene, f, of_lines, *table);
  return profiles;
}

/// The map that a footprint is made of, or null.
const PrecipitationMap* map_of(const Footprint& f, const VolumeFiles& files) {
  if (f.source != FootprintSource::precipitation) return nullptr;
  const auto found = files.maps.find(f.file);
  return found == files.maps.end() ? nullptr : &found->second;
}

}  // namespace

namespace {

template <class T>
void dim(FootprintGrid<T>& grid, double share) {
  if (share == 1.0) return;
  for (T& flux : grid.flux_mw_m2) flux = flux * share;
}

/// The map of a box, the mean over instants, with that share of its light, and in `own` the footprint with
/// what the map says itself.
template <class T>
PlaneFootprint<T> plane_at(const Scene& scene, const Footprint& f, const VolumeFiles& files,
                           const NumberAs<T>& number, const std::vector<double>& instants_s, double share,
                           int threads, Footprint& own) {
  const PrecipitationMap* precipitation = map_of(f, files);
  own = precipitation != nullptr ? with_map(f, *precipitation) : f;
  const auto at = [&](double instant_s) {
    if (precipitation == nullptr)
      return make_plane_footprint<T>(scene, f, footprint_pictures(files, f), number, threads, instant_s);
    PlaneFootprint<T> map = precipitation_plane<T>(f, *precipitation);
    const EastNorth drift = drifted_km(f, instant_s);
    map.west_km += drift.east;
    map.south_km += drift.north;
    return map;
  };
  std::vector<PlaneFootprint<T>> maps{at(instants_s.front())};
  if (instants_s.size() > 1) {
    const EastNorth drift = drifted_km(f, instants_s.front());
    const EastNorth rest{maps[0].west_km - drift.east, maps[0].south_km - drift.north};
    std::vector<EastNorth> corners;
    for (const double instant : instants_s) {
      const EastNorth way = drifted_km(f, instant);
      corners.push_back({rest.east + way.east, rest.north + way.north});
      if (!only_drifts(f) && corners.size() > 1) maps.push_back(at(instant));
    }
    maps = {mean_of(maps, corners)};
  }
  dim(maps[0].grid, share);
  return std::move(maps[0]);
}

}  // namespace

template <class T>
std::unique_ptr<Emitter<T>> footprint_emitter(const Scene& scene, const Footprint& f,
                                              const VolumeFiles& files, const NumberAs<T>& number,
                                              int threads, const FootprintLook& look) {
  constexpr bool kSlopes = !std::is_same_v<T, double>;
  const std::vector<double> instants =
      look.instants_s.empty() ? std::vector<double>{scene.time.start_s} : look.instants_s;
  const double instant = instants.front();
  EnergyRange range;
  if (f.model == FootprintModel::curtain) {
    for (const double energy : f.point_energy) {
      range.least = std::min(range.least, std::log(energy));
      range.most = std::max(range.most, std::log(energy));
    }
    const Profiles profiles = profiles_of(scene, f, range, kSlopes, look.of_lines);
    return curtain_emitter<T>(scene, f, profiles.usual, profiles.changes, number,
                              {drifted_km(f, instant), turned_deg(scene, f, instant), look.share, instant});
  }
  if (f.shape == FootprintShape::shell) {
    CubeFootprint<double> map = make_cube_footprint(scene, f, footprint_pictures(files, f), threads, instant);
    for (FootprintGrid<double>& face : map.face) {
      range.take(face);
      dim(face, look.share);
    }
    const Profiles profiles = profiles_of(scene, f, range, kSlopes, look.of_lines);
    return cube_footprint_emitter<T>(scene, f, std::move(map), profiles.usual, profiles.changes, number,
                                     threads);
  }
  Footprint own;
  PlaneFootprint<T> map = plane_at<T>(scene, f, files, number, instants, look.share, threads, own);
  range.take(map.grid);
  // Numbers of the scene are known by their place in it.
  const Footprint& drawn = map_of(f, files) != nullptr ? own : f;
  const Profiles profiles = profiles_of(scene, drawn, range, kSlopes, look.of_lines);
  return plane_footprint_emitter<T>(scene, drawn, std::move(map), profiles.usual, profiles.changes, number,
                                    threads);
}

template std::unique_ptr<Emitter<double>> footprint_emitter(const Scene&, const Footprint&,
                                                            const VolumeFiles&, const NumberAs<double>&, int,
                                                            const FootprintLook&);
template std::unique_ptr<Emitter<FreeDual>> footprint_emitter(const Scene&, const Footprint&,
                                                              const VolumeFiles&, const NumberAs<FreeDual>&,
                                                              int, const FootprintLook&);

FootprintParts footprint_parts(const Scene& scene, const Footprint& f, const VolumeFiles& files, int threads,
                               const FootprintLook& look) {
  const std::vector<double> instants =
      look.instants_s.empty() ? std::vector<double>{scene.time.start_s} : look.instants_s;
  FootprintParts parts{f, {}, {}, {}};
  EnergyRange range;
  if (f.shape == FootprintShape::shell) {
    parts.cube = make_cube_footprint(scene, f, footprint_pictures(files, f), threads, instants.front());
    for (FootprintGrid<double>& face : parts.cube.face) {
      range.take(face);
      dim(face, look.share);
    }
  } else {
    parts.plane = plane_at<double>(scene, f, files, plain_number, instants, look.share, threads, parts.drawn);
    range.take(parts.plane.grid);
  }
  parts.profiles = profiles_of(scene, parts.drawn, range, false, look.of_lines).usual;
  return parts;
}

std::unique_ptr<LightField> footprint_field(const Scene& scene, const Footprint& f, const VolumeFiles& files,
                                            int threads) {
  const double instant = scene.time.start_s, share = substorm_share(scene, f, instant);
  FootprintParts parts = footprint_parts(scene, f, files, threads, {{instant}, share, {}});
  if (f.shape == FootprintShape::shell)
    return cube_footprint_field(scene, f, std::move(parts.cube), parts.profiles, threads);
  return plane_footprint_field(scene, parts.drawn, std::move(parts.plane), parts.profiles, threads);
}

namespace {

/// Throws if the past states of a footprint that moves would take too much memory.
void check_memory_of_looks(const Scene& scene, const Footprint& f, std::size_t number_bytes) {
  const double bytes = map_bytes(scene, f, number_bytes);
  // make_plane_footprint() refuses one map that is too large by itself.
  if (bytes <= std::max(kMaxMapBytes, map_cells(f) * bytes_per_cell(f, number_bytes))) return;
  const bool is_shell = f.shape == FootprintShape::shell;
  const std::string key = "footprint." + f.name + (is_shell ? ".face_cells" : ".cell_km");
  throw scene_error(
      {"the footprint's maps of the exposure's instants, and of the past whose light lags, would take " +
           short_real_text(std::round(bytes * 1e-8) * 0.1) + " GB",
       "at most 4 GB",
       std::string(is_shell ? "fewer face_cells" : "a larger cell_km") +
           ", fewer time.instants, or emission.lag = \"none\""},
      {scene.file, line_of(scene, key), key});
}

template <class T>
void add_footprints(const EmitterInputs<T>& in, Emitters<T>& all) {
  for (const Footprint& footprint : in.scene.footprints) {
    check_memory_of_looks(in.scene, footprint, sizeof(T));
    for (const FootprintLook& look : footprint_looks(in.scene, footprint))
      all.push_back(footprint_emitter<T>(in.scene, footprint, in.files, in.number, in.threads, look));
  }
}

void add_footprint_fields(const FieldInputs& in, std::vector<NamedField>& all) {
  for (const Footprint& footprint : in.scene.footprints)
    all.push_back({"footprint '" + footprint.name + "'",
                   footprint_field(in.scene, footprint, in.files, in.threads), FieldFrame::ground});
}

std::optional<Complaint> why_footprint_has_no_field(const Scene& scene) {
  for (const Footprint& footprint : scene.footprints)
    if (footprint.model == FootprintModel::curtain)
      return Complaint{"the footprint '" + footprint.name + "' is a curtain without thickness",
                       "model = \"volume\"", ""};
  return std::nullopt;
}

}  // namespace

EmitterMaker footprint_maker() {
  return {"footprint", add_footprints<double>, add_footprints<FreeDual>, add_footprint_fields,
          why_footprint_has_no_field};
}

FootprintPictures footprint_pictures(const VolumeFiles& files, const Footprint& f) {
  FootprintPictures pictures;
  const auto set = [&](const std::string& key, const Image*& one, std::array<const Image*, 6>& six) {
    const std::vector<std::string> names = picture_files(f, key);
    const auto find = [&](const std::string& name) -> const Image* {
      const auto found = files.pictures.find(name);
      return found == files.pictures.end() ? nullptr : &found->second;
    };
    if (names.size() == 1) one = find(names[0]);
    if (names.size() == six.size())
      for (std::size_t face = 0; face < six.size(); ++face) six[face] = find(names[face]);
  };
  set(f.image, pictures.flux, pictures.face);
  set(f.energy_image, pictures.energy, pictures.energy_face);
  return pictures;
}

ColourLadder colour_ladder(const Scene& scene, const Footprint& f) {
  std::vector<std::array<double, 3>> of_line;
  for (const Vector3& colour : line_colours_at_unit_gain(scene))
    of_line.push_back({colour[0], colour[1], colour[2]});
  return {line_amounts(of_line, f.low_colour), line_amounts(of_line, f.high_colour), f.low_km, f.high_km};
}

ProfileTable footprint_profiles(const Scene& scene, const Footprint& f, double ln_least, double ln_most) {
  const ProfileTable usual = profile_table(scene.emission.lines, scene, f, ln_least, ln_most);
  return f.light == FootprintLight::colours ? colours_table(usual, colour_ladder(scene, f)) : usual;
}

}  // namespace vegard::sim
