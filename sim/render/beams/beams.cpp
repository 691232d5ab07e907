#include "sim/render/beams/beams.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <type_traits>
#include <utility>

#include "sim/base/number/distributions.h"
#include "sim/emit/aurora/beam.h"
#include "sim/emit/aurora/beam_light.h"
#include "sim/emit/aurora/curve_foot.h"
#include "sim/emit/aurora/motion.h"
#include "sim/emit/aurora/place_in_tube.h"
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
  std::fill_n(group.first_node, kGroup, 0.0);
  std::fill_n(group.tube_along[0], 2 * kGroup, 0.0);
  std::fill_n(group.tube_across[0], 2 * kGroup, 0.0);
  std::fill_n(group.sheet_width_km, kGroup, 0.0);
  std::fill_n(group.index, kGroup, 0u);
}

void narrow(const Tangents<double, kTangentWidth>& from, double scale, float* to) {
  for (int i = 0; i < kTangentWidth; ++i) to[i] = static_cast<float>(from.t[i] * scale);
}

/// The group of a layer that beams of a profile go into.
struct OpenGroup {
  int rung = 0;
  std::size_t group = 0;
  int used = kGroup;
};

/// The one of that profile; `make` appends a fresh one where there is none with room.
template <class Make>
OpenGroup& group_with_room(std::vector<OpenGroup>& open, int rung, const Make& make) {
  auto found = std::find_if(open.begin(), open.end(), [&](const OpenGroup& g) { return g.rung == rung; });
  if (found == open.end()) found = open.insert(open.end(), {rung, 0, kGroup});
  if (found->used == kGroup) {
    found->group = make();
    found->used = 0;
  }
  return *found;
}

/// How a beam of an energy between two rungs of its sheet's ladder is shared out among them: it falls twice
/// along the same path, with the two profiles, so that its light is linear in ln(E), exactly and with its
/// derivative. (So it is everywhere between the ends of the ladder, which no energy is beyond but one outside
/// of the emission tables.)
template <class Share>
struct RungShare {
  int rung = 0, rungs = 1;
  Share upper{};  ///< of the second

  Share of(int which) const { return which == rung ? 1.0 - upper : upper; }
};

RungShare<FreeDual> rung_share(const EnergyLadder& ladder, double ln_energy, const FreeDual& free_ln_energy) {
  // A beam without light would have no derivative of its logarithm: none has less than that.
  constexpr double kMinShare = 1e-4;
  if (ladder.count == 0) return {};
  const double at = ln_energy / EnergyLadder::kLnStep - ladder.first;
  RungShare<FreeDual> share;
  share.rung = std::clamp(static_cast<int>(std::floor(at)), 0, ladder.count - 2);
  share.rungs = 2;
  if (at > 0.0 && at < ladder.count - 1) share.upper = free_ln_energy * (1.0 / EnergyLadder::kLnStep);
  share.upper.v = std::clamp(at - share.rung, kMinShare, 1.0 - kMinShare);
  return share;
}

// Of beams whose light has an age: so many of a layer's stand for one each. It is odd, so that those across
// the layer stay even (LayerPlaces). A line that is still bright at an age is so over some five intervals, so
// that with seven its noise is little more than that of prompt light; and slow lines are the widely blurred
// ones.
constexpr int kThinning = 7;

/// Which beams of a layer stand for its light of an age.
struct BeamsOfAge {
  int every = 1, first = 0;
  double weight = 1.0;

  BeamsOfAge(int beams, int age, bool in_nodes) {
    if (age == 0 || in_nodes) return;
    every = std::min(kThinning, (beams - 1) / 2 * 2 + 1);
    first = 3 * age % every;
    weight = static_cast<double>(beams) / ((beams - first + every - 1) / every);
  }
  bool has(int beam) const { return beam % every == first; }
};

/// An even sequence over (0, 1), by the golden section along a layer; others are shifted against it.
double even_place(int beam, int age, int layer, double step) {
  const double at = beam * step + age * 0.7548776662466927 + layer * 0.5698402909980532;
  return std::clamp(at - std::floor(at), 1e-6, 1.0 - 1e-6);
}
constexpr double kStepOfAge = 0.6180339887498949, kStepOfRay = 0.4142135623730951;

/// The vertical extent of a stretch of path, over which a beam's energy is spread. Where the brightness along
/// the field is given, the beam is weaker by what that line of sight is longer than the vertical.
template <class T>
T light_per_path(const Sheet& sheet, const T& vertical) {
  return has_given_brightness(sheet) ? vertical * vertical : vertical;
}

}  // namespace

bool has_footprint_of_sheets(const Scene& scene) { return has_emitters_of_sheets(scene); }

BeamLayout::BeamLayout(const Scene& scene, double beyond, std::vector<SheetNodes> nodes)
    : nodes_(std::move(nodes)),
      instants_s_(instants_s(scene.time)),
      ages_(has_footprint_of_sheets(scene) ? LightAges() : LightAges(scene)),
      sheets_(scene.sheets),
      seed_(scene.seed) {
  const bool stretched = std::any_of(sheets_.begin(), sheets_.end(),
                                     [](const Sheet& sheet) { return sheet.ray_length_contrast > 0.0; });
  peak_km_.resize(sheets_.size());
  if (stretched) {
    const std::vector<HeightProfile> profiles = height_profiles(scene);
    for (int s = 0; s < static_cast<int>(sheets_.size()); ++s) {
      const ProfilesOfSheet own = profiles_of_sheet(scene, s);
      first_rung_.push_back(own.ladder.first);
      for (int rung = 0; rung < own.count(); ++rung)
        peak_km_[s].push_back(peak_altitude_km(profiles[own.first + rung]));
    }
  }
  stretches_.resize(instants_s_.size());
  for (std::size_t s = 0; s < scene.sheets.size(); ++s) {
    const Sheet& sheet = scene.sheets[s];
    path_steps_.push_back(path_step_of(sheet));
    places_.emplace_back();
    curves_.push_back(is_curve(sheet) ? curve_layout(sheet) : CurveLayout{});
    const double dark = is_curve(sheet) ? 0.0 : beyond;  // a curve's ends carry their beams along
    for (int arc = 0; arc < sheet.arcs; ++arc) {
      places_.back().emplace_back();
      for (int layer = 0; layer < sheet.layers; ++layer)
        places_.back().back().emplace_back(sheet, layer_address(static_cast<int>(s), arc, layer), scene.seed,
                                           dark, nodes_.empty() ? SheetNodes{} : nodes_[s]);
    }
    const int beams = places_.back().front().front().size();
    past_.emplace_back();
    for (int age = 0; age < ages_.count(static_cast<int>(s)); ++age)
      past_.back().push_back(age == 0 ? SheetOverTime{sheet}
                                      : sheet_over(sheet, ages_.age_s(static_cast<int>(s), age, 1.0) -
                                                              ages_.from_s(static_cast<int>(s), age)));
    for (int i = 0; i < instants(); ++i) {
      stretches_[i].push_back(stretch_of(sheet, instants_s_[i]));
      if (has_footprint_of_sheets(scene)) continue;
      for (int arc = 0; arc < sheet.arcs; ++arc)
        for (int first = 0; first < beams; first += LayerPlaces::kSumEvery)
          chunks_.push_back(
              {i, static_cast<int>(s), arc, first, std::min(LayerPlaces::kSumEvery, beams - first)});
      for (int arc = 0; arc < sheet.arcs; ++arc)
        for (int age = 1; age < ages_.count(static_cast<int>(s)); ++age)
          for (int first = 0; first < beams; first += LayerPlaces::kSumEvery)
            chunks_.push_back(
                {i, static_cast<int>(s), arc, first, std::min(LayerPlaces::kSumEvery, beams - first), age});
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

std::vector<HeightProfile> BeamLayout::profiles(const Scene& scene) const {
  std::vector<HeightProfile> all = height_profiles(scene);
  ages_.split(scene, all);
  return all;
}

double BeamLayout::peak_km(int sheet, const EnergyLadder& ladder, int rung) const {
  const std::vector<double>& peaks = peak_km_[sheet];
  if (peaks.empty()) return 0.0;
  // A fit may have led to other rungs than those of the layout.
  const int laid_out = ladder.first + rung - first_rung_[sheet];
  return peaks[ladder.count == 0 ? 0 : std::clamp(laid_out, 0, static_cast<int>(peaks.size()) - 1)];
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
  double instant = instants_s_[chunk.instant];  // of light of an age, from beam to beam that of its electrons
  StretchOfSheet stretch = stretches_[chunk.instant][chunk.sheet];
  SheetShape<double> shape = shape_of(scene, chunk.sheet, chunk.arc, instant, NoSeeds());
  SheetShape<FreeDual> free_shape;
  if (seeds != nullptr) free_shape = shape_of(scene, chunk.sheet, chunk.arc, instant, *seeds);
  FallFrame<double> fall;
  for (int i = 0; i < 3; ++i) {
    fall.along[i] = k.fall.along[i].v;
    fall.across1[i] = k.fall.across1[i].v;
    fall.across2[i] = k.fall.across2[i].v;
  }
  const double tube_end = tube_variance_at_end(k.deflection);
  const SheetOverTime& over_time = past_[chunk.sheet][chunk.age];
  const Sheet& laid_out = over_time.sheet;
  const CurveLayout& curve_laid_out = curves_[chunk.sheet];
  const ProfilesOfSheet profiles = profiles_of_sheet(scene, chunk.sheet);
  const std::uint32_t arc_address = layer_address(chunk.sheet, chunk.arc, 0);
  ArcLight light(laid_out, arc_address, seed_, instant, stretch.drifted_km);
  const Folds folds(laid_out, arc_address, seed_, instant, stretch.drifted_km);
  const Curls spirals = Curls::spirals(laid_out, arc_address, seed_, instant, stretch.drifted_km);
  const bool reads_elsewhere = light.reads_elsewhere() || over_time.draws_ray_length;
  const bool any_light = light.any() || over_time.draws_ray_length;
  const int first_profile = ages_.first_profile(scene, chunk.sheet, chunk.age);
  // To the time at which a beam's electrons fell, whose light is only now seen.
  std::optional<ArcLight> past_light;
  EastNorth moved_km;
  const auto go_back = [&](int beam, int layer, LayerStructure& structures) {
    const int every =
        BeamsOfAge(places_[chunk.sheet][chunk.arc][layer].size(), chunk.age, k.nodes.any()).every;
    const double age_s =
        ages_.age_s(chunk.sheet, chunk.age, even_place(beam / every, chunk.age, layer, kStepOfAge));
    instant = instants_s_[chunk.instant] - age_s;
    stretch = moved(stretches_[chunk.instant][chunk.sheet], sheets_[chunk.sheet], -age_s);
    shape = shape_of(scene, chunk.sheet, chunk.arc, instant, NoSeeds());
    if (seeds != nullptr) free_shape = shape_of(scene, chunk.sheet, chunk.arc, instant, *seeds);
    moved_km = scene.blur.model == BlurModel::physical ? EastNorth{1e-3 * scene.blur.wind_m_s.east * age_s,
                                                                   1e-3 * scene.blur.wind_m_s.north * age_s}
                                                       : EastNorth{};
    if (is_curve(sheet)) {
      moved_km.east -= sheet.drift_km_s.east * age_s;
      moved_km.north -= sheet.drift_km_s.north * age_s;
    }
    if (light.any() && !k.nodes.any())
      past_light.emplace(laid_out, arc_address, seed_, instant, stretch.drifted_km);
    if (structures.any())
      structures = LayerStructure(laid_out, arc_address, layer_address(chunk.sheet, chunk.arc, layer), seed_,
                                  instant, stretch.drifted_km);
  };
  for (int layer = 0; layer < sheet.layers; ++layer) {
    const LayerPlaces& places = places_[chunk.sheet][chunk.arc][layer];
    places.fill(chunk.first, chunk.count, out.places.data());
    const BeamsOfAge of_age(places.size(), chunk.age, k.nodes.any());
    if (layer == 0 && chunk.age == 0)
      light.remember(stretch.along_km(out.places.front().s), stretch.along_km(out.places.back().s));
    LayerStructure structures{folds,
                              Curls(laid_out, layer_address(chunk.sheet, chunk.arc, layer), seed_,
                                    instants_s_[chunk.instant], stretch.drifted_km),
                              spirals};
    const LayerStructure* structure = structures.any() ? &structures : nullptr;
    std::optional<SheetCurve<double>> curve;
    std::optional<SheetCurve<FreeDual>> free_curve;
    if (is_curve(sheet)) {
      const auto [first, last] = pieces_of(curve_laid_out, out.places);
      const double at = instants_s_[chunk.instant];  // it keeps its shape, and is moved as a whole
      curve.emplace(curve_nodes<double>(sheet, at, NoSeeds()), first, last);
      if (seeds != nullptr) free_curve.emplace(curve_nodes<FreeDual>(sheet, at, *seeds), first, last);
    }
    std::vector<OpenGroup> open;
    for (int b = chunk.first; b < chunk.first + chunk.count; ++b) {
      if (!of_age.has(b)) continue;
      BeamPlace& place = out.places[b - chunk.first];
      if (chunk.age > 0) go_back(b, layer, structures);
      CurveFoot<double> on_curve;
      if (curve) on_curve = curve_foot(*curve, shape, curve_laid_out, place);
      BeamFoot<double> foot =
          curve ? on_curve.foot : beam_foot(shape, stretch, place, layer, sheet.layers, literal, structure);
      foot.east_km += moved_km.east;
      foot.north_km += moved_km.north;
      if (foot.flux_km2_mw_m2 <= 0.0) continue;
      if (foot.east_km * foot.east_km + foot.north_km * foot.north_km > kFarthestKm * kFarthestKm) continue;
      const FallFrame<double> own = k.beams_own_field ? k.field.at(foot.east_km, foot.north_km) : fall;
      BeamLight shone;
      const auto shine = [&] {
        ArcLight& then = past_light ? *past_light : light;
        if (then.any())
          shone = then.at(stretch.along_km(place.s),
                          curve ? width_laid_out_km(laid_out, curve_laid_out, place.s) * place.across
                                : aside_laid_out_km(laid_out, place, layer, instant));
      };
      const bool starts_elsewhere =
          laid_out.border_rule == BorderRule::start && laid_out.border_amplitude_km > 0.0 && !k.nodes.any();
      if (starts_elsewhere) shine();
      const double top_km = sheet.top_km + shone.start_shift_km,
                   bottom_km = HeightProfile::kBottomKm + shone.start_shift_km;
      const Beam<double> plain = start_beam(foot.east_km, foot.north_km, own, k.observer_altitude_km, top_km,
                                            bottom_km, k.sphere_km);
      // A field line that does not descend would be negative light; one that grazes the Earth never comes
      // down to the bottom, and has no length.
      if (plain.vertical <= 0.0 || !(plain.length_km > 0.0)) continue;
      if (k.film.columns > 0 && out_of_sight(plain, own.along, k)) continue;
      PlaceInTube<double> in_tube;
      if (k.nodes.any()) {
        EastNorth tangent{shape.along_east, shape.along_north}, aside{-shape.along_north, shape.along_east};
        if (curve) {
          tangent = {on_curve.along[0], on_curve.along[1]};
          aside = {-tangent.north, tangent.east};
        } else {
          const double slope = slope_laid_out(laid_out, place, layer, instant) * shape.side;
          tangent = {tangent.east + slope * aside.east, tangent.north + slope * aside.north};
        }
        aside = {aside.east * shape.side, aside.north * shape.side};
        in_tube = place_in_tube(own, tangent, aside, curve ? on_curve.width_km : shape.width_km, place.across,
                                place.along_in_tube);
        // The width of both, sqrt(w² + v), grows so much less with w; v where most light is.
        const double width2 = in_tube.width_km * in_tube.width_km,
                     tube2 = tube_end * plain.length_km * plain.length_km;
        if (width2 > 0.0) place.width_slope = std::sqrt(width2 / (width2 + tube2));
      }
      CurveFoot<FreeDual> free_foot;
      if constexpr (std::is_same_v<T, PlaceDual>) {
        if (free_curve)
          free_foot = curve_foot(*free_curve, free_shape, curve_laid_out, place);
        else
          free_foot.foot = beam_foot(free_shape, stretch, place, layer, sheet.layers, literal, structure);
      }
      if (k.nodes.any()) {
        if (any_light) shone = mean_light(sheets_[chunk.sheet], place.ray);
      } else {
        if (!starts_elsewhere) shine();
        if (over_time.draws_ray_length)
          shone.stretch_above =
              mean_light(sheets_[chunk.sheet],
                         normal_quantile(even_place(b / of_age.every, chunk.age, layer, kStepOfRay)))
                  .stretch_above;
      }
      const RungShare<FreeDual> share = rung_share(profiles.ladder, on_curve.ln_energy, free_foot.ln_energy);
      for (int rung = share.rung; rung < share.rung + share.rungs; ++rung) {
        OpenGroup& with = group_with_room(open, rung, [&] {
          out.groups.emplace_back();
          BeamGroup& fresh = out.groups.back();
          leave_empty(fresh, seeds != nullptr);
          fresh.layer_address = layer_address(chunk.sheet, chunk.arc, layer);
          fresh.profile = first_profile + rung;
          fresh.reads_elsewhere = reads_elsewhere;
          fresh.peak_km = peak_km(chunk.sheet, profiles.ladder, rung);
          if (seeds != nullptr) out.chains.emplace_back(GroupChain{});
          if (k.beams_own_field) out.axes.emplace_back(GroupAxes{});
          return out.groups.size() - 1;
        });
        const int place_in_group = with.used++;
        BeamGroup& group = out.groups[with.group];
        const FreeDual part = share.of(rung);
        if constexpr (std::is_same_v<T, PlaceDual>) {
          PlaceDual east(foot.east_km), north(foot.north_km);
          east.d.t[foot_east] = 1.0;
          north.d.t[foot_north] = 1.0;
          const FallFrame<PlaceDual> own_fall = k.beams_own_field ? k.field.at(east, north) : k.fall;
          if (k.beams_own_field) put(own_fall, place_in_group, out.axes[with.group]);
          const Beam<PlaceDual> beam =
              start_beam(east, north, own_fall, k.observer_altitude_km, top_km, bottom_km, k.sphere_km);
          for (int i = 0; i < 3; ++i) put(beam.start_in_enu_km[i], place_in_group, group.start_in_enu_km[i]);
          put(beam.length_km, place_in_group, group.length_km);
          put(light_per_path(sheet, beam.vertical), place_in_group, group.vertical);
          GroupChain& chain = out.chains[with.group];
          narrow(free_foot.foot.east_km.d, 1.0, chain.foot_east[place_in_group]);
          narrow(free_foot.foot.north_km.d, 1.0, chain.foot_north[place_in_group]);
          const FreeDual flux =
              share.rungs == 1 ? free_foot.foot.flux_km2_mw_m2 : free_foot.foot.flux_km2_mw_m2 * part;
          narrow(flux.d, flux.v > 0.0 ? 1.0 / flux.v : 0.0, chain.log_flux[place_in_group]);
        } else {
          if (k.beams_own_field) put(own, place_in_group, out.axes[with.group]);
          for (int i = 0; i < 3; ++i) put(plain.start_in_enu_km[i], place_in_group, group.start_in_enu_km[i]);
          put(plain.length_km, place_in_group, group.length_km);
          put(light_per_path(sheet, plain.vertical), place_in_group, group.vertical);
        }
        group.flux_km2_mw_m2[place_in_group] = foot.flux_km2_mw_m2;
        if (share.rungs > 1) group.flux_km2_mw_m2[place_in_group] *= part.v;
        group.flux_km2_mw_m2[place_in_group] *= place.weight;
        if (chunk.age > 0) group.flux_km2_mw_m2[place_in_group] *= of_age.weight;
        if (any_light) {
          group.flux_km2_mw_m2[place_in_group] *= shone.factor;
          group.altitude_shift_km[place_in_group] = shone.altitude_shift_km;
          group.stretch_above[place_in_group] = shone.stretch_above;
        }
        group.end_of_path[place_in_group] = k.nodes.any() ? 1.0 : 1.0 - place.depth * sheet.path_spread;
        if (k.nodes.any())
          group.first_node[place_in_group] = (1.0 + k.nodes.offset) * std::pow(k.nodes.shrink, place.node);
        for (int i = 0; i < 2; ++i) {
          group.tube_along[i][place_in_group] = in_tube.along[i];
          group.tube_across[i][place_in_group] = in_tube.across[i];
        }
        group.sheet_width_km[place_in_group] = in_tube.width_km;
        group.index[place_in_group] = static_cast<std::uint32_t>(b);
      }
    }
  }
  for (std::size_t g = 0; g < out.axes.size(); ++g) out.groups[g].axes = &out.axes[g];
}

}  // namespace vegard::sim
