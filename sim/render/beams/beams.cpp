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

// In an interval of age one beam stands for this many of a layer's. It is odd, so that the beams stay evenly
// spaced across the layer (LayerPlaces). A line that is still bright at an age is so over some five
// intervals, so that with seven its noise is little more than that of prompt light; and slow lines are the
// widely blurred ones.
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

/// Packs one chunk, beam by beam. T is double for light only, PlaceDual with the data for derivatives.
template <class T>
class BeamLayout::Packer {
 public:
  Packer(const BeamLayout& layout, const Scene& scene, const Chunk& chunk, const KernelScene& kernel,
         const Seeds* seeds, PackedChunk& out)
      : layout_(layout),
        scene_(scene),
        chunk_(chunk),
        k_(kernel),
        seeds_(seeds),
        out_(out),
        sheet_(scene.sheets[chunk.sheet]),
        over_time_(layout.past_[chunk.sheet][chunk.age]),
        laid_out_(over_time_.sheet),
        curve_laid_out_(layout.curves_[chunk.sheet]),
        profiles_(profiles_of_sheet(scene, chunk.sheet)),
        arc_address_(layer_address(chunk.sheet, chunk.arc, 0)),
        first_profile_(layout.ages_.first_profile(scene, chunk.sheet, chunk.age)),
        tube_end_(tube_variance_at_end(kernel.deflection)),
        instant_(layout.instants_s_[chunk.instant]),
        stretch_(layout.stretches_[chunk.instant][chunk.sheet]),
        light_(laid_out_, arc_address_, layout.seed_, instant_, stretch_.drifted_km),
        folds_(laid_out_, arc_address_, layout.seed_, instant_, stretch_.drifted_km),
        spirals_(Curls::spirals(laid_out_, arc_address_, layout.seed_, instant_, stretch_.drifted_km)),
        reads_elsewhere_(light_.reads_elsewhere() || over_time_.draws_ray_length),
        any_light_(light_.any() || over_time_.draws_ray_length) {
    find_shape();
    for (int i = 0; i < 3; ++i) {
      fall_.along[i] = k_.fall.along[i].v;
      fall_.across1[i] = k_.fall.across1[i].v;
      fall_.across2[i] = k_.fall.across2[i].v;
    }
  }

  void run() {
    out_.groups.clear();
    out_.chains.clear();
    out_.axes.clear();
    out_.places.resize(chunk_.count);
    for (int layer = 0; layer < sheet_.layers; ++layer) pack_layer(layer);
    for (std::size_t g = 0; g < out_.axes.size(); ++g) out_.groups[g].axes = &out_.axes[g];
  }

 private:
  /// The common state of a layer's beams, and their groups that are not full yet.
  struct Layer {
    int number;
    BeamsOfAge of_age;
    LayerStructure structures;
    std::optional<SheetCurve<double>> curve;
    std::optional<SheetCurve<FreeDual>> free_curve;
    std::vector<OpenGroup> open;
  };
  /// A beam on its way into a group.
  struct PlacedBeam {
    int number;
    BeamPlace& place;
    CurveFoot<double> on_curve;  ///< of sheets whose course is a curve
    BeamFoot<double> foot;
    FallFrame<double> fall;
    BeamLight light;
    double top_km, bottom_km;
    Beam<double> beam;
    PlaceInTube<double> in_tube;
    CurveFoot<FreeDual> free_foot;
  };

  void pack_layer(int number) {
    const LayerPlaces& places = layout_.places_[chunk_.sheet][chunk_.arc][number];
    places.fill(chunk_.first, chunk_.count, out_.places.data());
    if (number == 0 && chunk_.age == 0)
      light_.remember(stretch_.along_km(out_.places.front().s), stretch_.along_km(out_.places.back().s));
    const double at = layout_.instants_s_[chunk_.instant];
    const Curls curls(laid_out_, address_of(number), layout_.seed_, at, stretch_.drifted_km);
    Layer layer{
        number, BeamsOfAge(places.size(), chunk_.age, k_.nodes.any()), {folds_, curls, spirals_}, {}, {}, {}};
    if (is_curve(sheet_)) {
      const auto [first, last] = pieces_of(curve_laid_out_, out_.places);
      layer.curve.emplace(curve_nodes<double>(sheet_, at, NoSeeds()), first, last);  // moved as a whole
      if (seeds_ != nullptr)
        layer.free_curve.emplace(curve_nodes<FreeDual>(sheet_, at, *seeds_), first, last);
    }
    for (int b = chunk_.first; b < chunk_.first + chunk_.count; ++b)
      if (layer.of_age.has(b)) pack_beam(b, layer);
  }

  void pack_beam(int number, Layer& layer) {
    if (chunk_.age > 0) go_back(number, layer);
    PlacedBeam placed{number, out_.places[number - chunk_.first], {}, {}, {}, {}, 0.0, 0.0, {}, {}, {}};
    if (!find_foot(layer, placed)) return;
    const bool starts_elsewhere =
        laid_out_.border_rule == BorderRule::start && laid_out_.border_amplitude_km > 0.0 && !k_.nodes.any();
    if (starts_elsewhere) find_drawn_light(layer, placed);
    if (!start(placed)) return;
    if (k_.nodes.any()) find_place_in_tube(layer, placed);
    if constexpr (std::is_same_v<T, PlaceDual>) {
      if (layer.free_curve)
        placed.free_foot = curve_foot(*layer.free_curve, free_shape_, curve_laid_out_, placed.place);
      else
        placed.free_foot.foot = foot_on_sheet(free_shape_, layer, placed.place);
    }
    if (k_.nodes.any()) {
      if (any_light_) placed.light = mean_light(layout_.sheets_[chunk_.sheet], placed.place.ray);
    } else {
      if (!starts_elsewhere) find_drawn_light(layer, placed);
      if (over_time_.draws_ray_length) placed.light.stretch_above = drawn_ray_length(layer, number);
    }
    const RungShare<FreeDual> share =
        rung_share(profiles_.ladder, placed.on_curve.ln_energy, placed.free_foot.ln_energy);
    for (int rung = share.rung; rung < share.rung + share.rungs; ++rung)
      put_into_group(layer, placed, rung, share);
  }

  /// Goes to the time at which the electrons of a beam fell, whose light is only now seen.
  void go_back(int beam, Layer& layer) {
    const double age_s =
        layout_.ages_.age_s(chunk_.sheet, chunk_.age,
                            even_place(beam / layer.of_age.every, chunk_.age, layer.number, kStepOfAge));
    instant_ = layout_.instants_s_[chunk_.instant] - age_s;
    stretch_ = moved(layout_.stretches_[chunk_.instant][chunk_.sheet], layout_.sheets_[chunk_.sheet], -age_s);
    find_shape();
    moved_km_ =
        scene_.blur.model == BlurModel::physical
            ? EastNorth{1e-3 * scene_.blur.wind_m_s.east * age_s, 1e-3 * scene_.blur.wind_m_s.north * age_s}
            : EastNorth{};
    if (is_curve(sheet_)) {
      moved_km_.east -= sheet_.drift_km_s.east * age_s;
      moved_km_.north -= sheet_.drift_km_s.north * age_s;
    }
    if (light_.any() && !k_.nodes.any())
      past_light_.emplace(laid_out_, arc_address_, layout_.seed_, instant_, stretch_.drifted_km);
    if (layer.structures.any())
      layer.structures = LayerStructure(laid_out_, arc_address_, address_of(layer.number), layout_.seed_,
                                        instant_, stretch_.drifted_km);
  }

  void find_shape() {
    shape_ = shape_of(scene_, chunk_.sheet, chunk_.arc, instant_, NoSeeds());
    if (seeds_ != nullptr) free_shape_ = shape_of(scene_, chunk_.sheet, chunk_.arc, instant_, *seeds_);
  }

  template <class N>
  BeamFoot<N> foot_on_sheet(const SheetShape<N>& shape, const Layer& layer, const BeamPlace& place) const {
    return beam_foot(shape, stretch_, place, layer.number, sheet_.layers,
                     sheet_.spacing_rule == SpacingRule::literal,
                     layer.structures.any() ? &layer.structures : nullptr);
  }

  /// Returns false for a beam that is dark or too far away.
  bool find_foot(const Layer& layer, PlacedBeam& placed) const {
    if (layer.curve) placed.on_curve = curve_foot(*layer.curve, shape_, curve_laid_out_, placed.place);
    BeamFoot<double>& foot = placed.foot;
    foot = layer.curve ? placed.on_curve.foot : foot_on_sheet(shape_, layer, placed.place);
    foot.east_km += moved_km_.east;
    foot.north_km += moved_km_.north;
    if (foot.flux_km2_mw_m2 <= 0.0) return false;
    if (foot.east_km * foot.east_km + foot.north_km * foot.north_km > kFarthestKm * kFarthestKm) return false;
    placed.fall = k_.beams_own_field ? k_.field.at(foot.east_km, foot.north_km) : fall_;
    return true;
  }

  /// The light that the processes along the arc give the beam; unchanged if there are none.
  void find_drawn_light(const Layer& layer, PlacedBeam& placed) {
    ArcLight& then = past_light_ ? *past_light_ : light_;
    if (!then.any()) return;
    const BeamPlace& place = placed.place;
    placed.light = then.at(stretch_.along_km(place.s),
                           layer.curve ? width_laid_out_km(laid_out_, curve_laid_out_, place.s) * place.across
                                       : aside_laid_out_km(laid_out_, place, layer.number, instant_));
  }

  double drawn_ray_length(const Layer& layer, int beam) const {
    const double place = even_place(beam / layer.of_age.every, chunk_.age, layer.number, kStepOfRay);
    return mean_light(layout_.sheets_[chunk_.sheet], normal_quantile(place)).stretch_above;
  }

  /// Returns false for a beam that does not descend or cannot be seen. A field line that does not descend
  /// would be negative light; one that grazes the Earth never comes down to the bottom, and has no length.
  bool start(PlacedBeam& placed) const {
    placed.top_km = sheet_.top_km + placed.light.start_shift_km;
    placed.bottom_km = HeightProfile::kBottomKm + placed.light.start_shift_km;
    placed.beam = start_beam(placed.foot.east_km, placed.foot.north_km, placed.fall, k_.observer_altitude_km,
                             placed.top_km, placed.bottom_km, k_.sphere_km);
    if (placed.beam.vertical <= 0.0 || !(placed.beam.length_km > 0.0)) return false;
    return k_.film.columns == 0 || !out_of_sight(placed.beam, placed.fall.along, k_);
  }

  void find_place_in_tube(const Layer& layer, PlacedBeam& placed) const {
    BeamPlace& place = placed.place;
    EastNorth tangent{shape_.along_east, shape_.along_north}, aside{-shape_.along_north, shape_.along_east};
    if (layer.curve) {
      tangent = {placed.on_curve.along[0], placed.on_curve.along[1]};
      aside = {-tangent.north, tangent.east};
    } else {
      const double slope = slope_laid_out(laid_out_, place, layer.number, instant_) * shape_.side;
      tangent = {tangent.east + slope * aside.east, tangent.north + slope * aside.north};
    }
    aside = {aside.east * shape_.side, aside.north * shape_.side};
    placed.in_tube =
        place_in_tube(placed.fall, tangent, aside, layer.curve ? placed.on_curve.width_km : shape_.width_km,
                      place.across, place.along_in_tube);
    // The width of both, sqrt(w² + v), grows so much less with w; v where most light is.
    const double width2 = placed.in_tube.width_km * placed.in_tube.width_km,
                 tube2 = tube_end_ * placed.beam.length_km * placed.beam.length_km;
    if (width2 > 0.0) place.width_slope = std::sqrt(width2 / (width2 + tube2));
  }

  /// Appends an empty group to the chunk.
  std::size_t make_group(const Layer& layer, int rung) {
    BeamGroup& fresh = out_.groups.emplace_back();
    leave_empty(fresh, seeds_ != nullptr);
    fresh.layer_address = address_of(layer.number);
    fresh.profile = first_profile_ + rung;
    fresh.reads_elsewhere = reads_elsewhere_;
    fresh.peak_km = layout_.peak_km(chunk_.sheet, profiles_.ladder, rung);
    if (seeds_ != nullptr) out_.chains.emplace_back(GroupChain{});
    if (k_.beams_own_field) out_.axes.emplace_back(GroupAxes{});
    return out_.groups.size() - 1;
  }

  /// Puts the beam, with its share of a profile, into a group of that profile.
  void put_into_group(Layer& layer, const PlacedBeam& placed, int rung, const RungShare<FreeDual>& share) {
    OpenGroup& with = group_with_room(layer.open, rung, [&] { return make_group(layer, rung); });
    const int at = with.used++;
    BeamGroup& group = out_.groups[with.group];
    const FreeDual part = share.of(rung);
    if constexpr (std::is_same_v<T, PlaceDual>)
      put_with_derivatives(placed, with.group, at, part, share.rungs);
    else
      put_beam(placed.beam, placed.fall, with.group, at);
    double& flux = group.flux_km2_mw_m2[at];
    flux = placed.foot.flux_km2_mw_m2;
    if (share.rungs > 1) flux *= part.v;
    flux *= placed.place.weight;
    if (chunk_.age > 0) flux *= layer.of_age.weight;
    if (any_light_) {
      flux *= placed.light.factor;
      group.altitude_shift_km[at] = placed.light.altitude_shift_km;
      group.stretch_above[at] = placed.light.stretch_above;
    }
    group.end_of_path[at] = k_.nodes.any() ? 1.0 : 1.0 - placed.place.depth * sheet_.path_spread;
    if (k_.nodes.any())
      group.first_node[at] = (1.0 + k_.nodes.offset) * std::pow(k_.nodes.shrink, placed.place.node);
    for (int i = 0; i < 2; ++i) {
      group.tube_along[i][at] = placed.in_tube.along[i];
      group.tube_across[i][at] = placed.in_tube.across[i];
    }
    group.sheet_width_km[at] = placed.in_tube.width_km;
    group.index[at] = static_cast<std::uint32_t>(placed.number);
  }

  template <class N>
  void put_beam(const Beam<N>& beam, const FallFrame<N>& fall, std::size_t in, int at) {
    BeamGroup& group = out_.groups[in];
    if (k_.beams_own_field) put(fall, at, out_.axes[in]);
    for (int i = 0; i < 3; ++i) put(beam.start_in_enu_km[i], at, group.start_in_enu_km[i]);
    put(beam.length_km, at, group.length_km);
    put(light_per_path(sheet_, beam.vertical), at, group.vertical);
  }

  void put_with_derivatives(const PlacedBeam& placed, std::size_t in, int at, const FreeDual& part,
                            int rungs) {
    PlaceDual east(placed.foot.east_km), north(placed.foot.north_km);
    east.d.t[foot_east] = 1.0;
    north.d.t[foot_north] = 1.0;
    const FallFrame<PlaceDual> fall = k_.beams_own_field ? k_.field.at(east, north) : k_.fall;
    put_beam(
        start_beam(east, north, fall, k_.observer_altitude_km, placed.top_km, placed.bottom_km, k_.sphere_km),
        fall, in, at);
    const BeamFoot<FreeDual>& foot = placed.free_foot.foot;
    GroupChain& chain = out_.chains[in];
    narrow(foot.east_km.d, 1.0, chain.foot_east[at]);
    narrow(foot.north_km.d, 1.0, chain.foot_north[at]);
    const FreeDual flux = rungs == 1 ? foot.flux_km2_mw_m2 : foot.flux_km2_mw_m2 * part;
    narrow(flux.d, flux.v > 0.0 ? 1.0 / flux.v : 0.0, chain.log_flux[at]);
  }

  std::uint32_t address_of(int layer) const { return layer_address(chunk_.sheet, chunk_.arc, layer); }

  const BeamLayout& layout_;
  const Scene& scene_;
  const Chunk& chunk_;
  const KernelScene& k_;
  const Seeds* seeds_;
  PackedChunk& out_;
  const Sheet& sheet_;
  const SheetOverTime& over_time_;
  const Sheet& laid_out_;
  const CurveLayout& curve_laid_out_;
  const ProfilesOfSheet profiles_;
  const std::uint32_t arc_address_;
  const int first_profile_;
  const double tube_end_;
  FallFrame<double> fall_;  ///< of the uniform field
  // For light of an age, these belong to the time at which the present beam's electrons fell.
  double instant_;
  StretchOfSheet stretch_;
  SheetShape<double> shape_;
  SheetShape<FreeDual> free_shape_;
  EastNorth moved_km_;                  ///< how far the atoms have been carried since
  std::optional<ArcLight> past_light_;  ///< null: `light_`
  ArcLight light_;
  const Folds folds_;
  const Curls spirals_;
  const bool reads_elsewhere_, any_light_;
};

void BeamLayout::pack(const Scene& scene, const Chunk& chunk, const KernelScene& kernel,
                      PackedChunk& out) const {
  Packer<double>(*this, scene, chunk, kernel, nullptr, out).run();
}
void BeamLayout::pack(const Scene& scene, const Chunk& chunk, const KernelScene& kernel, const Seeds& seeds,
                      PackedChunk& out) const {
  Packer<PlaceDual>(*this, scene, chunk, kernel, &seeds, out).run();
}

}  // namespace vegard::sim
