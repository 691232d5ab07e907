#include "sim/render/beams/beams.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <type_traits>

#include "sim/emit/aurora/beam.h"
#include "sim/emit/aurora/beam_light.h"
#include "sim/emit/aurora/dipole.h"
#include "sim/emit/aurora/motion.h"
#include "sim/light/electron.h"
#include "sim/light/sheet_profile.h"
#include "sim/scene/emitters/emitter_kinds.h"

namespace vegard::sim {
namespace {

constexpr double kFarthestKm = 4000;  // a foot farther than this is far below the horizon

/// True if nothing that falls from this beam can reach the film: both ends, and whatever strays from the line
/// between them by the pitch angles, are beyond the same edge.
bool out_of_sight(const Beam<double>& beam, const double along[3], const KernelScene& k) {
  const double slack_km = 0.05;  // far above the rounding of the kernel's floats
  const double stray = 1.25 * beam.length_km *
                       (std::abs(k.deflection.loss_cone_rad.v) + std::abs(k.deflection.pitch_step_rad.v));
  double start[3], end[3];
  for (int i = 0; i < 3; ++i) {
    start[i] = end[i] = 0.0;
    for (int j = 0; j < 3; ++j) {
      start[i] += k.view.camera_from_enu[i][j].v * beam.start_in_enu_km[j];
      end[i] += k.view.camera_from_enu[i][j].v * (beam.start_in_enu_km[j] + beam.length_km * along[j]);
    }
  }
  for (int edge = 0; edge < k.edges.count; ++edge) {
    const double* n = k.edges.outward[edge];
    const auto beyond = [n](const double at[3]) { return at[0] * n[0] + at[1] * n[1] + at[2] * n[2]; };
    const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    if (std::min(beyond(start), beyond(end)) > (stray + slack_km) * length) return true;
  }
  return false;
}

void put(const PlaceDual& from, int place, GroupNumber& to) {
  to.value[place] = from.v;
  for (int k = 0; k < place_inputs; ++k) to.tangent[k][place] = from.d.t[k];
}
void put(double from, int place, GroupNumber& to) { to.value[place] = from; }

template <class T>
void put(const FallFrame<T>& from, int place, GroupAxes& to) {
  for (int i = 0; i < 3; ++i) {
    put(from.along[i], place, to.axis[0][i]);
    put(from.across1[i], place, to.axis[1][i]);
    put(from.across2[i], place, to.axis[2][i]);
  }
}

/// A group of empty places; the derivatives are only looked at if there are any.
void leave_empty(BeamGroup& group, bool with_derivatives) {
  for (GroupNumber* number : {&group.start_in_enu_km[0], &group.start_in_enu_km[1], &group.start_in_enu_km[2],
                              &group.length_km, &group.vertical}) {
    std::fill_n(number->value, kGroup, 0.0);
    if (with_derivatives) std::fill_n(number->tangent[0], place_inputs * kGroup, 0.0);
  }
  std::fill_n(group.flux_km2_mw_m2, kGroup, 0.0);
  std::fill_n(group.end_of_path, kGroup, 0.0);
  std::fill_n(group.altitude_shift_km, kGroup, 0.0);
  std::fill_n(group.stretch_above, kGroup, 1.0);
  std::fill_n(group.index, kGroup, 0u);
}

void narrow(const Tangents<double, kTangentWidth>& from, double scale, float* to) {
  for (int i = 0; i < kTangentWidth; ++i) to[i] = static_cast<float>(from.t[i] * scale);
}

/// The vertical extent of a stretch of path, over which a beam's energy is spread. Where the brightness along
/// the field is given, the beam is weaker by what that line of sight is longer than the vertical.
template <class T>
T light_per_path(const Sheet& sheet, const T& vertical) {
  return has_given_brightness(sheet) ? vertical * vertical : vertical;
}

}  // namespace

bool has_footprint_of_sheets(const Scene& scene) { return has_emitters_of_sheets(scene); }

BeamLayout::BeamLayout(const Scene& scene, double beyond)
    : instants_s_(instants_s(scene.time)), sheets_(scene.sheets), seed_(scene.seed) {
  const bool stretched = std::any_of(sheets_.begin(), sheets_.end(),
                                     [](const Sheet& sheet) { return sheet.ray_length_contrast > 0.0; });
  peak_km_.assign(sheets_.size(), 0.0);
  if (stretched) {
    const std::vector<HeightProfile> profiles = height_profiles(scene);
    std::transform(profiles.begin(), profiles.end(), peak_km_.begin(), peak_altitude_km);
  }
  stretches_.resize(instants_s_.size());
  for (std::size_t s = 0; s < scene.sheets.size(); ++s) {
    const Sheet& sheet = scene.sheets[s];
    const std::optional<double> energy_kev = mean_energy_kev(sheet);
    path_steps_.push_back(sheet.step_rule == PathStepRule::energy && energy_kev ? path_step_of(*energy_kev)
                                                                                : sheet.path_step);
    places_.emplace_back();
    for (int arc = 0; arc < sheet.arcs; ++arc) {
      places_.back().emplace_back();
      for (int layer = 0; layer < sheet.layers; ++layer)
        places_.back().back().emplace_back(sheet, layer_address(static_cast<int>(s), arc, layer), scene.seed,
                                           beyond);
    }
    const int beams = places_.back().front().front().size();
    for (int i = 0; i < instants(); ++i) {
      stretches_[i].push_back(stretch_of(sheet, instants_s_[i]));
      if (has_footprint_of_sheets(scene)) continue;
      for (int arc = 0; arc < sheet.arcs; ++arc)
        for (int first = 0; first < beams; first += LayerPlaces::kSumEvery)
          chunks_.push_back(
              {i, static_cast<int>(s), arc, first, std::min(LayerPlaces::kSumEvery, beams - first)});
    }
  }
}

void BeamLayout::pack(const Scene& scene, const Chunk& chunk, const KernelScene& kernel,
                      PackedChunk& out) const {
  pack_as<double>(scene, chunk, kernel, nullptr, out);
}
void BeamLayout::pack(const Scene& scene, const Chunk& chunk, const KernelScene& kernel, const Seeds& seeds,
                      PackedChunk& out) const {
  pack_as<PlaceDual>(scene, chunk, kernel, &seeds, out);
}

template <class T>
void BeamLayout::pack_as(const Scene& scene, const Chunk& chunk, const KernelScene& k, const Seeds* seeds,
                         PackedChunk& out) const {
  out.groups.clear();
  out.chains.clear();
  out.axes.clear();
  out.places.resize(chunk.count);
  const Sheet& sheet = scene.sheets[chunk.sheet];
  const bool literal = sheet.spacing_rule == SpacingRule::literal;
  const double instant = instants_s_[chunk.instant];
  const StretchOfSheet& stretch = stretches_[chunk.instant][chunk.sheet];
  const SheetShape<double> shape = shape_of(scene, chunk.sheet, chunk.arc, instant, NoSeeds());
  SheetShape<FreeDual> free_shape;
  if (seeds != nullptr) free_shape = shape_of(scene, chunk.sheet, chunk.arc, instant, *seeds);
  FallFrame<double> fall;
  for (int i = 0; i < 3; ++i) {
    fall.along[i] = k.fall.along[i].v;
    fall.across1[i] = k.fall.across1[i].v;
    fall.across2[i] = k.fall.across2[i].v;
  }
  const Sheet& laid_out = sheets_[chunk.sheet];
  const std::uint32_t arc_address = layer_address(chunk.sheet, chunk.arc, 0);
  ArcLight light(laid_out, arc_address, seed_, instant, stretch.drifted_km);
  const Folds folds(laid_out, arc_address, seed_, instant, stretch.drifted_km);
  for (int layer = 0; layer < sheet.layers; ++layer) {
    places_[chunk.sheet][chunk.arc][layer].fill(chunk.first, chunk.count, out.places.data());
    if (layer == 0)
      light.remember(stretch.along_km(out.places.front().s), stretch.along_km(out.places.back().s));
    const LayerStructure structures{folds, Curls(laid_out, layer_address(chunk.sheet, chunk.arc, layer),
                                                 seed_, instant, stretch.drifted_km)};
    const LayerStructure* structure =
        structures.folds.any() || structures.curls.any() ? &structures : nullptr;
    int place_in_group = kGroup;
    for (int b = chunk.first; b < chunk.first + chunk.count; ++b) {
      const BeamPlace& place = out.places[b - chunk.first];
      const BeamFoot<double> foot = beam_foot(shape, stretch, place, layer, sheet.layers, literal, structure);
      if (foot.flux_km2_mw_m2 <= 0.0) continue;
      if (foot.east_km * foot.east_km + foot.north_km * foot.north_km > kFarthestKm * kFarthestKm) continue;
      const FallFrame<double> own =
          k.beams_own_field ? dipole_fall_frame(k.dipole, foot.east_km, foot.north_km) : fall;
      const Beam<double> plain = start_beam(foot.east_km, foot.north_km, own, k.observer_altitude_km,
                                            sheet.top_km, HeightProfile::kBottomKm);
      // A field line that does not descend would be negative light; one that grazes the Earth never comes
      // down to the bottom, and has no length.
      if (plain.vertical <= 0.0 || !(plain.length_km > 0.0)) continue;
      if (k.film.columns > 0 && out_of_sight(plain, own.along, k)) continue;
      if (place_in_group == kGroup) {
        place_in_group = 0;
        out.groups.emplace_back();
        BeamGroup& fresh = out.groups.back();
        leave_empty(fresh, seeds != nullptr);
        fresh.layer_address = layer_address(chunk.sheet, chunk.arc, layer);
        fresh.sheet = chunk.sheet;
        fresh.reads_elsewhere = light.reads_elsewhere();
        fresh.peak_km = peak_km_[chunk.sheet];
        if (seeds != nullptr) out.chains.emplace_back(GroupChain{});
        if (k.beams_own_field) out.axes.emplace_back(GroupAxes{});
      }
      BeamGroup& group = out.groups.back();
      if constexpr (std::is_same_v<T, PlaceDual>) {
        PlaceDual east(foot.east_km), north(foot.north_km);
        east.d.t[foot_east] = 1.0;
        north.d.t[foot_north] = 1.0;
        const FallFrame<PlaceDual> own_fall =
            k.beams_own_field ? dipole_fall_frame(k.dipole, east, north) : k.fall;
        if (k.beams_own_field) put(own_fall, place_in_group, out.axes.back());
        const Beam<PlaceDual> beam =
            start_beam(east, north, own_fall, k.observer_altitude_km, sheet.top_km, HeightProfile::kBottomKm);
        for (int i = 0; i < 3; ++i) put(beam.start_in_enu_km[i], place_in_group, group.start_in_enu_km[i]);
        put(beam.length_km, place_in_group, group.length_km);
        put(light_per_path(sheet, beam.vertical), place_in_group, group.vertical);
        const BeamFoot<FreeDual> free_foot =
            beam_foot(free_shape, stretch, place, layer, sheet.layers, literal, structure);
        GroupChain& chain = out.chains.back();
        narrow(free_foot.east_km.d, 1.0, chain.foot_east[place_in_group]);
        narrow(free_foot.north_km.d, 1.0, chain.foot_north[place_in_group]);
        const double flux = free_foot.flux_km2_mw_m2.v;
        narrow(free_foot.flux_km2_mw_m2.d, flux > 0.0 ? 1.0 / flux : 0.0, chain.log_flux[place_in_group]);
      } else {
        if (k.beams_own_field) put(own, place_in_group, out.axes.back());
        for (int i = 0; i < 3; ++i) put(plain.start_in_enu_km[i], place_in_group, group.start_in_enu_km[i]);
        put(plain.length_km, place_in_group, group.length_km);
        put(light_per_path(sheet, plain.vertical), place_in_group, group.vertical);
      }
      group.flux_km2_mw_m2[place_in_group] = foot.flux_km2_mw_m2;
      if (light.any()) {
        const BeamLight shone =
            light.at(stretch.along_km(place.s), aside_laid_out_km(laid_out, place, layer, instant));
        group.flux_km2_mw_m2[place_in_group] *= shone.factor;
        group.altitude_shift_km[place_in_group] = shone.altitude_shift_km;
        group.stretch_above[place_in_group] = shone.stretch_above;
      }
      group.end_of_path[place_in_group] = 1.0 - place.depth * sheet.path_spread;
      group.index[place_in_group] = static_cast<std::uint32_t>(b);
      ++place_in_group;
    }
  }
  for (std::size_t g = 0; g < out.axes.size(); ++g) out.groups[g].axes = &out.axes[g];
}

}  // namespace vegard::sim
