#include "sim/emit/footprint/footprint_emitter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <type_traits>
#include <vector>

#include "sim/base/number/constants.h"
#include "sim/base/number/dual.h"
#include "sim/base/number/vec3.h"
#include "sim/emit/footprint/curtain_rays.h"
#include "sim/emit/footprint/foot_projection.h"
#include "sim/emit/footprint/map/bulge.h"
#include "sim/emit/footprint/map/curve.h"
#include "sim/emit/footprint/scalar_march.h"
#include "sim/light/segment_tree.h"
#include "sim/scene/structs/footprint.h"

namespace vegard::sim {
namespace {

constexpr double kCurtainMinCosine = 0.052;  // 3 degrees

// Boxes about walls: the altitudes at which a wall's ends are found, and what is added for rounding.
constexpr int kBoxAltitudes = 9;
constexpr double kBoxMargin_km = 0.01;
/// Half the edge of a box that every ray passes.
constexpr double kEverywhere_km = 1e30;

/// A piece of a wall, about the body's centre.
template <class T>
struct Wall {
  Vec3<T> from, way;  ///< feet of its two edges
  Vec3<T> normal;     ///< of length 1
  T beyond;           ///< normal . from
  T thickness_km;     ///< along the normal, of flux 1
  T flux[2], ln_energy[2];
  T along_km[2];  ///< from the curve's beginning
};

/// A curve as it was before a bulge moved it: rays go by distances along it, and so stay where they are.
class StillCurve {
 public:
  StillCurve() = default;

  /// `still`: the curve through `points` points. `moved`: as it is, through points that were at `places` of
  /// it.
  template <class T>
  StillCurve(const CurvePieces<T, 3>& still, std::size_t points, const CurvePieces<T, 3>& moved,
             const std::vector<double>& places) {
    const std::size_t count = still.pieces.size();
    if (count == 0) return;
    std::vector<double> place, along_km;
    for (std::size_t i = 0; i < (still.is_closed ? count + 1 : count); ++i) {
      const CurvePiece<T, 3>& piece = still.pieces[i % count];
      if (i > 0)
        length_km_ += length3(minus3(values3(piece.middle.at), values3(still.pieces[i - 1].middle.at)));
      place.push_back(piece.place + (i < count ? 0.0 : static_cast<double>(points)));
      along_km.push_back(length_km_);
    }
    for (const CurvePiece<T, 3>& piece : moved.pieces) {
      const auto before = static_cast<std::size_t>(piece.place), next = before + 1;
      const double share = piece.place - static_cast<double>(before);
      const double to = next < places.size() ? places[next] : places[0] + static_cast<double>(points);
      double at = places[before] + share * (to - places[before]);
      if (still.is_closed && at < place.front()) at += static_cast<double>(points);
      if (still.is_closed && at >= place.back()) at -= static_cast<double>(points);
      const auto after = std::clamp<std::size_t>(
          std::upper_bound(place.begin(), place.end(), at) - place.begin(), 1, place.size() - 1);
      const double part = std::clamp((at - place[after - 1]) / (place[after] - place[after - 1]), 0.0, 1.0);
      along_km_.push_back(along_km[after - 1] + part * (along_km[after] - along_km[after - 1]));
    }
  }

  bool is_there() const { return !along_km_.empty(); }
  double length_km() const { return length_km_; }

  /// Of the wall from piece i to the next, distances of its edges. Over a closed curve's end they go on.
  std::optional<std::array<double, 2>> ends(std::size_t i) const {
    if (!is_there()) return std::nullopt;
    const double from = along_km_[i], to = along_km_[(i + 1) % along_km_.size()];
    return std::array<double, 2>{from, to < from ? to + length_km_ : to};
  }

 private:
  double length_km_ = 0.0;
  std::vector<double> along_km_;  ///< of the moved curve's pieces
};

template <class T>
class CurtainEmitter : public Emitter<T> {
 public:
  CurtainEmitter(const Scene& scene, const Footprint& f, const ProfileTable& profiles,
                 const ProfileChanges& changes, const NumberAs<T>& number, const FootprintAt& at, MarchBy by)
      : profile_(profiles, f.top_km, 0.0),
        rays_(scene, f, profile_.bottom_km(), at.turned_deg),
        rule_(rule_of_foot<T>(scene, f, number, at.turned_deg)),
        foot_radius_(rule_.sphere_km + kFootAltitudeKm),
        foot_(of_profile(profile_)),
        marcher_(foot_),
        tries_all_(by == MarchBy::reference) {
    foot_.ln_energy_shift = (number(f.energy_kev) - f.energy_kev) * (1.0 / f.energy_kev);
    foot_.flux_shift = number(f.energy_flux_mw_m2) - f.energy_flux_mw_m2;
    foot_.oxygen_shift = number(scene.emission.oxygen_factor) - scene.emission.oxygen_factor;
    const auto step_profile = [&](const ProfileTable& table) {
      return table.of_energy.empty() ? nullptr : std::make_unique<StepProfile>(table, f.top_km, 0.0);
    };
    by_flux_ = step_profile(changes.by_flux);
    by_oxygen_ = step_profile(changes.by_oxygen);
    foot_.profile_by_flux = by_flux_.get();
    foot_.profile_by_oxygen = by_oxygen_.get();
    foot_.projection = rule_.projection;
    foot_.sphere_km = rule_.sphere_km;
    std::copy_n(rule_.axis, 3, foot_.axis);
    foot_.patches = rule_.patches ? rule_.patches->data() : nullptr;
    build(scene, f, number, at);
  }
  CurtainEmitter(const CurtainEmitter&) = delete;
  CurtainEmitter& operator=(const CurtainEmitter&) = delete;

  void march(const RayBundle<T>& rays, const BundleLight<T>& out) const override {
    thread_local std::vector<std::uint32_t> met;
    for (std::size_t i = 0; i < rays.count; ++i) {
      const T enu[3] = {rays.direction[0][i], rays.direction[1][i], rays.direction[2][i]};
      MarchSpanOf<T> spans[2];
      const int count = rays_.cut(enu, rays.end_km[i], spans);
      double light = 0.0, weighted = 0.0;
      for (int s = 0; s < count; ++s) {
        find_walls(spans[s], met);
        for (const std::uint32_t wall : met) add(walls_[wall], spans[s], i, rays.count, out, light, weighted);
      }
      if (light > 0.0) out.depth_km[i] = weighted / light;
    }
  }

 private:
  static ScalarFootprint<T, double> of_profile(const StepProfile& profile) {
    ScalarFootprint<T, double> foot;
    foot.profile = &profile;
    return foot;
  }

  struct Edge {
    Vec3<T> foot;
    T flux, ln_energy;
  };

  void build(const Scene& scene, const Footprint& f, const NumberAs<T>& number, const FootprintAt& now) {
    std::vector<Edge> edges;
    bool closed = false;
    StillCurve still;
    const auto cargo = [&](std::size_t i, auto& point) {
      point.flux = number(f.energy_flux_mw_m2);
      if (now.share != 1.0) point.flux = point.flux * now.share;
      if (!f.point_flux.empty()) point.flux = point.flux * number(f.point_flux[i]);
      point.ln_energy = f.point_energy.empty() ? T(0.0) : logarithm(number(f.point_energy[i]));
    };
    if (foot_.projection == FootProjection::shell) {
      std::vector<CurveNode<T, 3>> points(f.latitude_deg.size());
      for (std::size_t i = 0; i < points.size(); ++i) {
        const double lat = f.latitude_deg[i] * kRadiansPerDegree,
                     lon = f.longitude_deg[i] * kRadiansPerDegree;
        points[i].at = {T(foot_radius_ * std::cos(lat) * std::cos(lon)),
                        T(foot_radius_ * std::cos(lat) * std::sin(lon)), T(foot_radius_ * std::sin(lat))};
        cargo(i, points[i]);
      }
      const double longest_km = longest_piece_km(f, rule_.sphere_km);
      std::vector<double> places;
      const auto moved = with_bulge(f, scene.substorm, now.instant_s, points, longest_km, &places);
      const auto curve = curve_pieces<T, 3>(moved, f.closed, longest_km, true);
      closed = curve.is_closed;
      if (has_rays(f) && !places.empty())
        still =
            StillCurve(curve_pieces<T, 3>(points, f.closed, longest_km, true), points.size(), curve, places);
      for (const auto& piece : curve.pieces)
        edges.push_back({piece.middle.at, piece.middle.flux, piece.middle.ln_energy});
    } else {
      std::vector<CurveNode<T, 2>> points(f.east_km.size());
      for (std::size_t i = 0; i < points.size(); ++i) {
        points[i].at = {number(f.center_km.east) + number(f.east_km[i]) + now.drifted_km.east,
                        number(f.center_km.north) + number(f.north_km[i]) + now.drifted_km.north};
        cargo(i, points[i]);
      }
      const auto curve = curve_pieces<T, 2>(points, f.closed, longest_piece_km(f, rule_.sphere_km), false);
      closed = curve.is_closed;
      for (const auto& piece : curve.pieces) {
        const T &e = piece.middle.at[0], &n = piece.middle.at[1];
        const T height2 = T(foot_radius_ * foot_radius_) - e * e - n * n;
        if (value_of(height2) > 1.0)
          edges.push_back({{e, n, square_root(height2)}, piece.middle.flux, piece.middle.ln_energy});
      }
    }
    const std::size_t count = edges.size();
    std::vector<SegmentBox> boxes;
    T along_km(0.0);
    for (std::size_t i = 0; count > 1 && i < (closed ? count : count - 1); ++i)
      stand(edges[i], edges[(i + 1) % count], number(f.width_km), along_km, boxes, still.ends(i));
    if (still.is_there()) along_km = T(still.length_km());
    rays_of_light_ = CurtainRays(f, scene.seed, now.instant_s, value_of(along_km), closed);
    length_km_ = along_km;
    tree_ = SegmentTree(boxes);
  }

  /// Gives the walls that a span may meet, in the order in which they stand: light is added up in this order.
  void find_walls(const MarchSpanOf<T>& span, std::vector<std::uint32_t>& met) const {
    met.clear();
    if (tries_all_) {
      met.resize(walls_.size());
      std::iota(met.begin(), met.end(), 0u);
      return;
    }
    Vec3<double> place, direction;
    for (int a = 0; a < 3; ++a)
      place[a] = value_of(span.place_km[a]), direction[a] = value_of(span.direction[a]);
    tree_.visit(place, direction, value_of(span.first_km), -value_of(span.first_km), 0.0,
                [&](std::uint32_t wall) { met.push_back(wall); });
    std::sort(met.begin(), met.end());
  }

  /// `along_km`: from the curve's beginning, which goes on by this piece. `still_km` instead, if given, are
  /// those of its two edges.
  void stand(const Edge& a, const Edge& b, const T& width_km, T& along_km, std::vector<SegmentBox>& boxes,
             const std::optional<std::array<double, 2>>& still_km) {
    Wall<T> wall;
    wall.from = a.foot;
    wall.way = minus3(b.foot, a.foot);
    wall.along_km[0] = along_km;
    if (const T length2 = dot3(wall.way, wall.way); value_of(length2) > 0.0)
      along_km = along_km + square_root(length2);
    wall.along_km[1] = along_km;
    if (still_km)
      for (int end = 0; end < 2; ++end) wall.along_km[end] = T((*still_km)[end]);
    Vec3<T> along = times3(a.foot, T(-1.0 / foot_radius_));
    const Vec3<T> up = times3(along, T(-1.0));
    if (foot_.projection == FootProjection::field) along = {foot_.axis[0], foot_.axis[1], foot_.axis[2]};
    if (foot_.projection == FootProjection::dipole) {
      T direction[3];
      dipole_fall(foot_.axis, PlaneFoot<T>{a.foot[0], a.foot[1], true}, rule_.sphere_km, direction);
      along = {direction[0], direction[1], direction[2]};
    }
    if (foot_.projection == FootProjection::reference) {
      T direction[3];
      patch_fall(foot_.patches[0].template numbers<double>(), T(foot_.patches[0].per_place),
                 PlaneFoot<T>{a.foot[0], a.foot[1], true}, direction);
      along = {direction[0], direction[1], direction[2]};
    }
    const Vec3<T> normal = cross3(wall.way, along), level = cross3(wall.way, up);
    const T size2 = dot3(normal, normal), level2 = dot3(level, level);
    if (value_of(size2) < 1e-12 || value_of(level2) < 1e-12) return;
    wall.normal = times3(normal, 1.0 / square_root(size2));
    wall.beyond = dot3(wall.normal, wall.from);
    const T tilt = dot3(wall.normal, level) / square_root(level2);
    wall.thickness_km = width_km * kSqrtTwoPi * (value_of(tilt) < 0.0 ? -tilt : tilt);
    wall.flux[0] = a.flux, wall.flux[1] = b.flux;
    wall.ln_energy[0] = a.ln_energy, wall.ln_energy[1] = b.ln_energy;
    walls_.push_back(wall);
    boxes.push_back(box_of(wall, values3(along)));
  }

  /// The box of the part of a wall's plane whose feet lie between the wall's edges, in the shell of the
  /// light. `along` is the direction of fall at its first edge.
  SegmentBox box_of(const Wall<T>& moving, const Vec3<double>& along) const {
    const SegmentBox everywhere = {{-kEverywhere_km, -kEverywhere_km, -kEverywhere_km},
                                   {kEverywhere_km, kEverywhere_km, kEverywhere_km},
                                   0.0,
                                   0.0};
    Wall<double> wall;
    wall.from = values3(moving.from), wall.way = values3(moving.way);
    const double beyond = value_of(moving.beyond);
    Vec3<double> end[2][kBoxAltitudes];
    double margin = kBoxMargin_km;
    for (int k = 0; k < kBoxAltitudes; ++k) {
      const double radius = foot_.sphere_km + rays_.bottom_km() +
                            (rays_.top_km() - rays_.bottom_km()) * k / (kBoxAltitudes - 1.0);
      for (int side = 0; side < 2; ++side)
        if (!find_end(wall, along, radius, side, end[side][k])) return everywhere;
      // Between both ends the wall bulges as a circle does, in which its plane cuts the sphere.
      const Vec3<double> chord = minus3(end[1][k], end[0][k]);
      const double circle2 = radius * radius - beyond * beyond, rest2 = circle2 - 0.25 * dot3(chord, chord);
      if (!(rest2 > 0.0)) return everywhere;
      margin = std::max(margin, kBoxMargin_km + std::sqrt(circle2) - std::sqrt(rest2));
    }
    // Between the altitudes the ends are on smooth curves.
    for (const auto& curve : end)
      for (int k = 1; k + 1 < kBoxAltitudes; ++k) {
        const Vec3<double> bend = along3(along3(curve[k - 1], -2.0, curve[k]), 1.0, curve[k + 1]);
        margin = std::max(margin, kBoxMargin_km + length3(bend));
      }
    SegmentBox box = {end[0][0], end[0][0], 0.0, 0.0};
    for (const auto& curve : end)
      for (const Vec3<double>& point : curve)
        for (int a = 0; a < 3; ++a) {
          box.low[a] = std::min(box.low[a], point[a] - margin);
          box.high[a] = std::max(box.high[a], point[a] + margin);
        }
    return box;
  }

  /// Finds the point of a wall's plane at a radius, whose foot is at the wall's first (side 0) or second
  /// edge; returns false if there is none near it.
  bool find_end(const Wall<double>& wall, const Vec3<double>& along, double radius_km, int side,
                Vec3<double>& end) const {
    const auto share_at = [&](double part, double& share) {
      const Vec3<double> level = along3(wall.from, part, wall.way);
      const double fall = dot3(level, along),
                   root2 = fall * fall + radius_km * radius_km - dot3(level, level);
      if (!(root2 > 0.0)) return false;
      end = along3(level, -(fall + std::sqrt(root2)), along);
      AirPoint<double> p;
      std::copy_n(end.begin(), 3, p.x);
      p.square = (radius_km - foot_.sphere_km) * (radius_km + foot_.sphere_km);
      return share_of(wall, p, share);
    };
    constexpr int kSecants = 8;
    constexpr double kNear = 1e-9;  // in shares of the wall
    double part = side, last = side + 0.25, share = 0.0, last_share = 0.0;
    if (!share_at(last, last_share)) return false;
    for (int step = 0; step < kSecants; ++step) {
      if (!share_at(part, share)) return false;
      if (std::fabs(share - side) < kNear) return true;
      const double next = part + (side - share) * (part - last) / (share - last_share);
      if (!(std::fabs(next - side) < 1e3)) return false;
      last = part, last_share = share, part = next;
    }
    return false;
  }

  /// Finds how far from a wall's first edge, of 0, to its second, of 1, the foot of a point is; returns false
  /// if the point has no foot.
  template <class V>
  bool share_of(const Wall<V>& wall, const AirPoint<V>& p, V& share) const {
    if (foot_.projection == FootProjection::shell) {
      const V scale = V(foot_radius_) / radius_km(p, foot_.sphere_km);
      const Vec3<V> foot = {p.x[0] * scale, p.x[1] * scale, p.x[2] * scale};
      // The wall's plane goes on beyond the body's centre.
      if (!(value_of(dot3(foot, wall.from)) > 0.0)) return false;
      share = dot3(minus3(foot, wall.from), wall.way) / dot3(wall.way, wall.way);
      return true;
    }
    V axis[3];
    for (int a = 0; a < 3; ++a) {
      if constexpr (std::is_same_v<V, T>)
        axis[a] = foot_.axis[a];
      else
        axis[a] = value_of(foot_.axis[a]);
    }
    const auto foot = marcher_.place_of(p, axis, 0);
    if (!foot.is_there) return false;
    const V &e = wall.way[0], &n = wall.way[1];
    share = ((foot.x - wall.from[0]) * e + (foot.y - wall.from[1]) * n) / (e * e + n * n);
    return true;
  }

  void add(const Wall<T>& wall, const MarchSpanOf<T>& span, std::size_t ray, std::size_t rays,
           const BundleLight<T>& out, double& light, double& weighted) const {
    const Vec3<T> place = {span.place_km[0], span.place_km[1], span.place_km[2]};
    const Vec3<T> direction = {span.direction[0], span.direction[1], span.direction[2]};
    const T cosine = dot3(wall.normal, direction);
    if (std::fabs(value_of(cosine)) < 1e-9) return;
    const T u = (wall.beyond - dot3(wall.normal, place)) / cosine;
    if (std::fabs(value_of(u)) > -value_of(span.first_km)) return;
    const AirPoint<T> p = point_of_ray(span.place_km, span.direction, span.square_km2, span.along_km, u);
    T share(0.0), stretch(1.0);
    if (!share_of(wall, p, share)) return;
    if (!(value_of(share) >= 0.0 && value_of(share) < 1.0)) return;
    // Straight down, what is a kilometre wide at the foot is wider higher up.
    if (foot_.projection == FootProjection::shell || foot_.projection == FootProjection::vertical)
      stretch = radius_km(p, foot_.sphere_km) * (1.0 / foot_radius_);
    const T size = value_of(cosine) < 0.0 ? -cosine : cosine;
    const T incidence = value_of(size) < kCurtainMinCosine ? T(kCurtainMinCosine) : size;
    T flux = wall.flux[0] + share * (wall.flux[1] - wall.flux[0]);
    if (rays_of_light_.any())
      flux = flux * rays_of_light_.factor(wall.along_km[0] + share * (wall.along_km[1] - wall.along_km[0]),
                                          length_km_);
    T rate[kMaxLines];
    marcher_.rates(altitude_km(p, foot_.sphere_km),
                   wall.ln_energy[0] + share * (wall.ln_energy[1] - wall.ln_energy[0]), 0, rate);
    const T path = flux * wall.thickness_km * stretch / incidence * kRayleighsPerKm;
    const double at_km = value_of(span.at_km) + value_of(u);
    out.entry_km[ray] = std::min(out.entry_km[ray], at_km);
    for (int l = 0; l < out.lines; ++l) {
      T& sum = out.rayleigh[l * rays + ray];
      const T seen = path * rate[l];
      sum = sum + seen;
      light += value_of(seen);
      weighted += value_of(seen) * at_km;
    }
  }

  StepProfile profile_;
  std::unique_ptr<StepProfile> by_flux_, by_oxygen_;
  MarchRays rays_;
  FootRule<T> rule_;
  const double foot_radius_;
  ScalarFootprint<T, double> foot_;
  ScalarMarch<T, double> marcher_;
  const bool tries_all_;
  std::vector<Wall<T>> walls_;
  CurtainRays rays_of_light_;
  T length_km_{};  ///< of the curve
  SegmentTree tree_;
};

}  // namespace

template <class T>
std::unique_ptr<Emitter<T>> curtain_emitter(const Scene& scene, const Footprint& footprint,
                                            const ProfileTable& profiles, const ProfileChanges& changes,
                                            const NumberAs<T>& number, const FootprintAt& at, MarchBy by) {
  return std::make_unique<CurtainEmitter<T>>(scene, footprint, profiles, changes, number, at, by);
}

template std::unique_ptr<Emitter<double>> curtain_emitter(const Scene&, const Footprint&, const ProfileTable&,
                                                          const ProfileChanges&, const NumberAs<double>&,
                                                          const FootprintAt&, MarchBy);
template std::unique_ptr<Emitter<FreeDual>> curtain_emitter(const Scene&, const Footprint&,
                                                            const ProfileTable&, const ProfileChanges&,
                                                            const NumberAs<FreeDual>&, const FootprintAt&,
                                                            MarchBy);

}  // namespace vegard::sim
