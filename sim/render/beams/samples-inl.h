// From beams to samples: lets sixteen beams fall and computes, block by block, where the camera sees their
// points.
#if defined(VEGARD_SIM_RENDER_SAMPLES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VEGARD_SIM_RENDER_SAMPLES_INL_H_
#undef VEGARD_SIM_RENDER_SAMPLES_INL_H_
#else
#define VEGARD_SIM_RENDER_SAMPLES_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <type_traits>

#include "sim/base/number/dual-inl.h"
#include "sim/base/number/lanes-inl.h"
#include "sim/emit/aurora/fall-inl.h"
#include "sim/render/beams/kernel_types.h"
#include "sim/scene/structs/light.h"
#include "sim/view/camera/lens-inl.h"

HWY_BEFORE_NAMESPACE();
namespace vegard::sim {
namespace HWY_NAMESPACE {

constexpr int kBlockSteps = 32;

/// Samples of a group for kBlockSteps steps, ready for the film. Every number has kLocals derivatives.
template <class S, int kLocals>
struct SampleBlock {
  S column[kBlockSteps][1 + kLocals][kGroup];
  S row[kBlockSteps][1 + kLocals][kGroup];
  S light[kBlockSteps][1 + kLocals][kGroup];     ///< 0 where there is nothing to see
  S altitude[kBlockSteps][1 + kLocals][kGroup];  ///< in steps of the height profile above its bottom
  int first_step, end_step;                      ///< there is nothing to see outside these
};

// Loading and storing of numbers with kLocals derivatives. `inputs`: the local inputs with respect to which
// the derivatives are taken.
inline constexpr int kFirstInputs[kMaxCarried] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9};

template <class L, int kLocals>
using LaneDual = Dual<L, Tangents<L, kLocals>>;

template <class L>
HWY_INLINE void fetch(const GroupNumber& from, int first, L& to, const int* = nullptr) {
  to = LaneTraits<L>::load(from.value + first);
}
template <class L, int kLocals>
HWY_INLINE void fetch(const GroupNumber& from, int first, LaneDual<L, kLocals>& to, const int* inputs) {
  to.v = LaneTraits<L>::load(from.value + first);
  for (int k = 0; k < kLocals; ++k)
    to.d.t[k] = inputs[k] < place_inputs ? LaneTraits<L>::load(from.tangent[inputs[k]] + first) : L(0.0f);
}
template <class L, int kOwn>
HWY_INLINE void spread(const sim::Dual<double, sim::Tangents<double, kOwn>>& from, L& to,
                       const int* = nullptr) {
  to = L(from.v);
}
template <class L, int kLocals, int kOwn>
HWY_INLINE void spread(const sim::Dual<double, sim::Tangents<double, kOwn>>& from, LaneDual<L, kLocals>& to,
                       const int* inputs) {
  to.v = L(from.v);
  for (int k = 0; k < kLocals; ++k) to.d.t[k] = inputs[k] < kOwn ? L(from.d.t[inputs[k]]) : L(0.0f);
}
template <class L, class S>
HWY_INLINE void keep(const L& from, S (*to)[kGroup], int first) {
  LaneTraits<L>::store(from, to[0] + first);
}
template <class L, int kLocals, class S>
HWY_INLINE void keep(const LaneDual<L, kLocals>& from, S (*to)[kGroup], int first) {
  LaneTraits<L>::store(from.v, to[0] + first);
  for (int k = 0; k < kLocals; ++k) LaneTraits<L>::store(from.d.t[k], to[1 + k] + first);
}
/// Returns the number with its derivatives inside the mask, and zero outside.
template <class L, class M>
HWY_INLINE L only_where(M mask, const L& x) {
  return select(mask, x, L(0.0f));
}
template <class L, int kLocals, class M>
HWY_INLINE LaneDual<L, kLocals> only_where(M mask, const LaneDual<L, kLocals>& x) {
  LaneDual<L, kLocals> r;
  r.v = select(mask, x.v, L(0.0f));
  for (int k = 0; k < kLocals; ++k) r.d.t[k] = select(mask, x.d.t[k], L(0.0f));
  return r;
}

/// Selects one of two numbers with its derivatives, lane by lane.
template <class L, class M>
HWY_INLINE L select_where(M mask, const L& yes, const L& no) {
  return select(mask, yes, no);
}
template <class L, int kLocals, class M>
HWY_INLINE LaneDual<L, kLocals> select_where(M mask, const LaneDual<L, kLocals>& yes,
                                             const LaneDual<L, kLocals>& no) {
  LaneDual<L, kLocals> r;
  r.v = select(mask, yes.v, no.v);
  for (int k = 0; k < kLocals; ++k) r.d.t[k] = select(mask, yes.d.t[k], no.d.t[k]);
  return r;
}

/// Three axes that a beam falls along and is deflected across, in two frames.
template <class F>
struct BeamAxes {
  F in_enu[3][3];     ///< along, across1, across2
  F in_camera[3][3];  ///< the three axes in right, down, forward
};

/// The chain from beams to samples. Film: PinholeFilm or LensFilm; L: lane type; P: positions; C: what all
/// beams share; F: the beams' axes, C where the field is uniform, P where each beam has its own.
template <template <class> class Film, class L, class P, class C, class F, int kLocals>
class SampleMaker {
 public:
  using Traits = LaneTraits<L>;
  using Block = SampleBlock<typename Traits::Scalar, kLocals>;

  /// `inputs`: the kLocals local inputs with respect to which derivatives are taken, the beams' own first.
  explicit SampleMaker(const KernelScene& scene, const int* inputs = kFirstInputs)
      : scene_(scene), inputs_(inputs) {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) spread(scene.view.camera_from_enu[i][j], camera_from_enu_[i][j], inputs_);
    if (!scene.beams_own_field) {
      for (int i = 0; i < 3; ++i) {
        spread(scene.fall.along[i], axes_[0].in_enu[0][i], inputs_);
        spread(scene.fall.across1[i], axes_[0].in_enu[1][i], inputs_);
        spread(scene.fall.across2[i], axes_[0].in_enu[2][i], inputs_);
      }
      turn_to_camera(axes_[0]);
      std::fill(axes_ + 1, axes_ + kGroup, axes_[0]);
    }
    spread(scene.deflection.loss_cone_rad, deflection_.loss_cone_rad, inputs_);
    spread(scene.deflection.pitch_step_rad, deflection_.pitch_step_rad, inputs_);
    deflection_.law = scene.deflection.law;
    deflection_.path_step = scene.deflection.path_step;
    deflection_.rule = scene.deflection.rule;
    if (scene.nodes.any()) paths_ = {scene.nodes, MeanPath<C>(deflection_), -std::log(scene.nodes.shrink)};
    film_.set(scene.view.lens, scene.film,
              [this](const LocalDual& number, C& to) { spread(number, to, inputs_); });
    philox_keys(scene.seed, keys_);
    for (int i = 0; i < 3; ++i) up_[i] = scene.view.camera_from_enu[i][2].v;
    stray_ =
        1.25 * (std::abs(scene.deflection.loss_cone_rad.v) + std::abs(scene.deflection.pitch_step_rad.v));
  }

  void begin(const BeamGroup& group) {
    alive_ = true;
    reads_elsewhere_ = group.reads_elsewhere;
    peak_ = L((group.peak_km - HeightProfile::kBottomKm) / HeightProfile::kStepKm);
    for (int first = 0, part = 0; first < kGroup; first += Traits::lanes(), ++part) {
      P start[3], length, vertical;
      for (int i = 0; i < 3; ++i) fetch(group.start_in_enu_km[i], first, start[i], inputs_);
      fetch(group.length_km, first, length, inputs_);
      fetch(group.vertical, first, vertical, inputs_);
      if (scene_.beams_own_field) set_axes(*group.axes, first, axes_[part]);
      for (int i = 0; i < 3; ++i)
        start_in_camera_km_[part][i] = start[0] * camera_from_enu_[i][0] + start[1] * camera_from_enu_[i][1] +
                                       start[2] * camera_from_enu_[i][2];
      altitude_[part].start(start, L(scene_.observer_altitude_km), axes_[part].in_enu, scene_.sphere_km);
      volume_[part] = length * vertical * (Traits::load(group.flux_km2_mw_m2 + first) * L(0.1f));
      end_[part] = Traits::load(group.end_of_path + first);
      shift_[part] = Traits::load(group.altitude_shift_km + first) * L(1.0 / HeightProfile::kStepKm);
      stretch_above_[part] = Traits::load(group.stretch_above + first);
      if (scene_.nodes.any())
        beams_[part].start_in_nodes(
            length, Traits::load(group.first_node + first),
            {{Traits::load(group.tube_along[0] + first), Traits::load(group.tube_along[1] + first)},
             {Traits::load(group.tube_across[0] + first), Traits::load(group.tube_across[1] + first)},
             Traits::load(group.sheet_width_km + first)});
      else
        beams_[part].start(length, Traits::load_indices(group.index + first), group.layer_address, keys_);
      find_stretch_in_view(value_of(length), part);
    }
  }

  /// Fills a block. Returns false, with the block unchanged, if every beam has ended or can no longer be
  /// seen. Adds the number of points on paths to `points`. If kSee is false, the points are not projected.
  template <bool kSee = true>
  bool next_block(Block& block, std::uint64_t& points) {
    if (!alive_) return false;
    alive_ = false;
    block.first_step = kBlockSteps;
    block.end_step = 0;
    for (int first = 0, part = 0; first < kGroup; first += Traits::lanes(), ++part) {
      FallingBeams<L, P, C> beams = beams_[part];  // a copy: nothing that is stored can be part of it
      const L end = end_[part], first_in_view = first_in_view_[part], last_in_view = last_in_view_[part];
      L t(0.0f);
      bool over = false;  // nothing more to see of these beams
      for (int step = 0; step < kBlockSteps; step += 4) {
        if (over) {
          for (int i = 0; i < 4; ++i) Traits::store(L(0.0f), block.light[step + i][0] + first);
          continue;
        }
        const auto take = [&](int i, const FallenPoint<L, P>& point) {
          t = point.t;
          points += static_cast<std::uint64_t>(count(t <= end));
          if (!kSee || none(first_in_view <= t && t <= last_in_view)) {
            Traits::store(L(0.0f), block.light[step + i][0] + first);
            return;
          }
          block.first_step = std::min(block.first_step, step + i);
          block.end_step = std::max(block.end_step, step + i + 1);
          see(point, part, first, step + i, block);
        };
        if (scene_.nodes.any())
          beams.next_four_nodes(paths_, take);
        else
          beams.next_four(deflection_, keys_, take);
        over = none(t <= last_in_view);
      }
      alive_ = alive_ || !over;
      beams_[part] = beams;
    }
    return true;
  }

 private:
  HWY_INLINE void turn_to_camera(BeamAxes<F>& axes) const {
    for (int a = 0; a < 3; ++a)
      for (int i = 0; i < 3; ++i)
        axes.in_camera[a][i] = axes.in_enu[a][0] * camera_from_enu_[i][0] +
                               axes.in_enu[a][1] * camera_from_enu_[i][1] +
                               axes.in_enu[a][2] * camera_from_enu_[i][2];
  }

  HWY_INLINE void set_axes(const GroupAxes& own_axes, int first, BeamAxes<F>& axes) const {
    for (int a = 0; a < 3; ++a)
      for (int i = 0; i < 3; ++i) {
        P number;
        fetch(own_axes.axis[a][i], first, number, inputs_);
        axes.in_enu[a][i] = own(number);
      }
    turn_to_camera(axes);
  }
  /// Converts a number of a beam to the type of its axes. If the types differ, the field is uniform and this
  /// function is never called.
  static HWY_INLINE F own(const P& x) {
    if constexpr (std::is_same_v<F, P>)
      return x;
    else
      return F(value_of(x));
  }

  /// Finds the stretch of the path outside of which a beam certainly misses the film. A point strays from the
  /// straight line by no more than its path times the pitch angle; the film's edges are planes through the
  /// camera.
  HWY_INLINE void find_stretch_in_view(L length_km, int part) {
    const L slack_km(0.05f);  // far above the rounding of floats
    L start[3], way[3];
    for (int i = 0; i < 3; ++i) {
      start[i] = value_of(start_in_camera_km_[part][i]);
      way[i] = length_km * value_of(axes_[part].in_camera[0][i]);
    }
    L first(0.0f), last = end_[part];
    for (int edge = 0; edge < scene_.edges.count; ++edge) {
      const double* n = scene_.edges.outward[edge];
      const L length(std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]));
      const L beyond = start[0] * L(n[0]) + start[1] * L(n[1]) + start[2] * L(n[2]) - slack_km * length;
      const L grow = way[0] * L(n[0]) + way[1] * L(n[1]) + way[2] * L(n[2]) - length_km * L(stray_) * length;
      const L crossing = L(0.0f) - beyond / select(grow < L(0.0f), grow, L(-1e-30f));
      const L leaving = L(0.0f) - beyond / select(L(0.0f) < grow, grow, L(1e-30f));
      const auto outside = L(0.0f) < beyond;
      first = select(outside && first < crossing, crossing, first);
      last = select(beyond <= L(0.0f) && leaving < last, leaving, last);
    }
    first_in_view_[part] = first;
    last_in_view_[part] = last;
  }

  /// Returns the mask of points that the body's sphere does not hide. Seen from its centre the line of sight
  /// sinks by u = -up . point over its length l; it is nearest to the centre, at the square of the distance
  /// o^2 - (o u / l)^2 with o = R + observer's altitude, before it reaches the point if o u < l^2.
  HWY_INLINE auto before_the_earth(const P in_camera_km[3]) const {
    const double altitude = scene_.observer_altitude_km, from_centre = scene_.sphere_km + altitude;
    L length2(0.0f), sinks(0.0f);
    for (int i = 0; i < 3; ++i) {
      const L x = value_of(in_camera_km[i]);
      length2 = length2 + x * x;
      sinks = sinks - x * L(up_[i] * from_centre);
    }
    const L above_surface_km2(std::max(0.0, altitude * (altitude + 2.0 * scene_.sphere_km)));
    const L hidden = select(L(0.0f) < sinks && sinks < length2 && above_surface_km2 * length2 < sinks * sinks,
                            L(1.0f), L(0.0f));
    return hidden < L(0.5f);
  }

  /// Maps a column to that between the centres of two wide cells, where it changes only along the ramp around
  /// their border. The ramp is smooth; otherwise the few beams on it would add their sampling noise to every
  /// derivative with respect to a place.
  HWY_INLINE P on_ramp(const P& column) const {
    const L steep(static_cast<float>(scene_.film.cell_width_px / scene_.film.ramp_px));
    const L whole = round_to_nearest(value_of(column) - L(0.5f));
    const P share = (column - whole - L(0.5f)) * steep + L(0.5f);
    const P below = select_where(value_of(share) < L(1.0f), share, P(L(1.0f)));
    const P on = select_where(L(0.0f) < value_of(share), below, P(L(0.0f)));
    return on * on * (P(L(3.0f)) - on * L(2.0f)) + whole;
  }

  HWY_INLINE void see(const FallenPoint<L, P>& point, int part, int first, int step, Block& block) {
    const P way[3] = {point.along_km, point.across1_km, point.across2_km};
    P in_camera[3];
    for (int i = 0; i < 3; ++i)
      in_camera[i] = start_in_camera_km_[part][i] + way[0] * axes_[part].in_camera[0][i] +
                     (way[1] * axes_[part].in_camera[1][i] + way[2] * axes_[part].in_camera[2][i]);
    auto in_front = L(0.0f) < L(1.0f);
    SeenPoint<P> seen = film_.template see<L>(in_camera, in_front);
    if (scene_.earth_hides) in_front = in_front && before_the_earth(in_camera);
    P above = (altitude_km(altitude_[part].excess_km2(way), sphere_) -
               L(static_cast<float>(HeightProfile::kBottomKm))) *
              L(static_cast<float>(1.0 / HeightProfile::kStepKm));
    if (reads_elsewhere_) {
      above = above - shift_[part];
      const L shrink = select(peak_ < value_of(above), L(1.0f) / stretch_above_[part], L(1.0f));
      above = (above - peak_) * shrink + peak_;
    }
    const L h = value_of(above);
    if (scene_.film.ramp_px > 0.0) seen.column = on_ramp(seen.column);
    if (scene_.nearest_cell) {
      seen.column = P(round_to_nearest(value_of(seen.column)));
      seen.row = P(round_to_nearest(value_of(seen.row)));
    }
    const L x = value_of(seen.column), y = value_of(seen.row);
    const auto on_path = point.t <= end_[part];
    const L last_column(static_cast<float>(scene_.film.columns - 1)),
        last_row(static_cast<float>(scene_.film.rows - 1));
    const auto visible = on_path && in_front && L(0.0f) <= x && x < last_column && L(0.0f) <= y &&
                         y < last_row && L(0.0f) <= h &&
                         h < L(static_cast<float>(HeightProfile::kAltitudes - 1));
    const P geometry =
        scene_.unit_weight ? P(L(1.0f)) : volume_[part] * point.stretch * seen.per_steradian_cell;
    keep(seen.column, block.column[step], first);
    keep(seen.row, block.row[step], first);
    keep(only_where(visible, geometry), block.light[step], first);
    keep(above, block.altitude[step], first);
  }

  const KernelScene& scene_;
  const SphereScale sphere_{scene_.sphere_km};
  const int* inputs_;
  PhiloxKeys keys_;
  Deflection<C> deflection_;
  NodesOfPaths<C> paths_;
  BeamAxes<F> axes_[kGroup];
  C camera_from_enu_[3][3];
  Film<C> film_;
  FallingBeams<L, P, C> beams_[kGroup];
  P start_in_camera_km_[kGroup][3];
  BeamAltitude<P> altitude_[kGroup];
  P volume_[kGroup];  ///< flux * area * length * cosine; 0.1 rayleighs for every photon cm^-3 s^-1 and km
  L end_[kGroup], first_in_view_[kGroup], last_in_view_[kGroup];
  L shift_[kGroup], stretch_above_[kGroup], peak_;  ///< in steps of the height profile
  bool reads_elsewhere_ = false;
  bool alive_ = false;  ///< some beam of the group has not ended
  double up_[3];        ///< the vertical at the observer, in the camera's axes
  double stray_;        ///< largest distance from the straight line, as a fraction of the path
};

}  // namespace HWY_NAMESPACE
}  // namespace vegard::sim
HWY_AFTER_NAMESPACE();

#endif
