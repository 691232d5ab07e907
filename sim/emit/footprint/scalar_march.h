// The march through a footprint one step after the other: in double, as a reference for the packs of floats,
// and in dual numbers, for derivatives.
//
// T is the number type of the rays, G that of the footprint.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "sim/emit/footprint/foot.h"
#include "sim/emit/footprint/footprint_kernel_types.h"
#include "sim/emit/footprint/map/footprint_map.h"
#include "sim/emit/footprint/march_span.h"

namespace vegard::sim {

template <class T, class G>
struct ScalarFootprint {
  FootProjection projection = FootProjection::vertical;
  T axis[3];  ///< as in FootprintKernel
  const FieldPatch* patches = nullptr;
  double texels = 1.0, first_x = 0.0, first_y = 0.0;
  std::array<const FootprintGrid<G>*, 6> grid{};
  std::array<const LitMap*, 6> lit{};  ///< null: nothing is skipped
  const StepProfile* profile = nullptr;
  double sphere_km = kEarthRadiusKm;             ///< radius of the body
  T ln_energy_shift;                             ///< 0, with the tangents of ln(energy)
  const StepProfile* profile_by_flux = nullptr;  ///< slopes with respect to energy flux; null: none
  T flux_shift;                                  ///< 0, with the tangents of the energy flux
  const StepProfile* profile_by_oxygen =
      nullptr;     ///< slopes with respect to the tables' oxygen factor; null: none
  T oxygen_shift;  ///< 0, with the tangents of that factor
};

template <class T>
struct ScalarLight {
  T rayleigh[kMaxLines];
  double weighted_km = 0.0;
  double entry_km = std::numeric_limits<double>::infinity();
};

template <class T, class G>
class ScalarMarch {
 public:
  explicit ScalarMarch(const ScalarFootprint<T, G>& footprint)
      : f_(footprint), profile_(*footprint.profile) {}

  void march(const MarchSpanOf<T>& span, ScalarLight<T>& out) const {
    for (T& light : out.rayleigh) light = T(0.0);
    const MarchSpan plain = plain_span(span);
    const WidthOfBlock width_of_block(profile_, plain, f_.sphere_km);
    for (int first = 0; first < span.steps; first += kBlockSteps) {
      if (may_pass_over(plain, first)) continue;
      const int width = width_of_block(first);
      bool any = false;
      for (int i = first; i < std::min(first + kBlockSteps, span.steps); ++i)
        any = add(span, i, width, out) || any;
      if (any) out.entry_km = std::min(out.entry_km, plain.at_km + plain.first_km + first * plain.step_km);
    }
    for (T& light : out.rayleigh) light = light * span.step_km * kRayleighsPerKm;
    out.weighted_km *= kRayleighsPerKm * plain.step_km;
  }

  /// A foot in texels.
  template <class V>
  struct Place {
    V x, y;
    bool is_there;
  };

  template <class V>
  Place<V> place_of(const AirPoint<V>& p, const V axis[3], int face) const {
    if (is_shell_projection(f_.projection)) {
      const FacePlace<V> at = place_on_face(foot_of_shell(p, axis, face), face);
      return {at.u * f_.texels + f_.first_x, at.v * f_.texels + f_.first_y, value_of(at.ahead) > 1.0};
    }
    const PlaneFoot<V> foot = foot_on_plane(p, axis);
    return {foot.east_km * f_.texels + f_.first_x, foot.north_km * f_.texels + f_.first_y, foot.is_there};
  }

  /// Computes the rates of each line, photons cm^-3 s^-1 per mW m^-2. Between the energies of the profiles'
  /// ladder both the rates and their stored slopes with respect to ln E are interpolated linearly. The
  /// tangents use the stored slopes: the difference between two rungs is only a mean of them, and at the
  /// ladder's ends, where a map of constant energy lies, one neighbour is missing.
  void rates(const T& altitude, const T& ln_energy, int width, T rate[]) const {
    const T place = (altitude - profile_.bottom_km()) * (1.0 / HeightProfile::kStepKm);
    const double most = profile_.rows() - 1;
    const int row = static_cast<int>(std::clamp(std::floor(value_of(place)), 0.0, most - 1.0));
    const T part = place - static_cast<double>(row);
    const double ln = value_of(ln_energy), last = profile_.energies() - 1;
    const double at = last > 0.0 ? (ln - profile_.ln_first()) / profile_.ln_step() : 0.0;
    const double kept = profile_.ln_first() + std::clamp(at, 0.0, last) * profile_.ln_step();
    // Beyond the ladder, which covers the common range of map and emission tables, the energy is limited.
    const T shift = std::fabs(ln - kept) > kBeyondLadder ? T(0.0) : f_.ln_energy_shift + (ln_energy - ln);
    const int energy = static_cast<int>(std::clamp(at, 0.0, last));
    of_energy(energy, width, row, part, shift, rate);
    if (at <= 0.0 || at >= last) return;
    T next[kMaxLines];
    of_energy(energy + 1, width, row, part, shift, next);
    const double share = at - energy;
    for (int l = 0; l < profile_.lines(); ++l) rate[l] = rate[l] + (next[l] - rate[l]) * share;
  }

  /// Computes the volume emission rates at a point, photons cm^-3 s^-1, with the profile's table of this
  /// width; returns false if the point is dark.
  bool light_at(const AirPoint<T>& p, int width, T light[]) const {
    const int face = face_of(p);
    if (f_.grid[face] == nullptr || f_.grid[face]->flux_mw_m2.empty()) return false;
    const FootprintGrid<G>& grid = *f_.grid[face];
    const Place<T> place = place_of(p, f_.axis, face);
    if (!place.is_there) return false;
    // Dark outside: the texels beyond the edge are taken as 0.
    const double x = std::floor(value_of(place.x)), y = std::floor(value_of(place.y));
    if (!(x >= -1.0 && y >= -1.0 && x < grid.columns && y < grid.rows)) return false;
    const int column = static_cast<int>(x), row = static_cast<int>(y);
    const T right = place.x - x, upper = place.y - y;
    const T weight[4] = {(T(1.0) - right) * (T(1.0) - upper), right * (T(1.0) - upper),
                         (T(1.0) - right) * upper, right * upper};
    T flux(0.0), ln_energy(0.0);
    for (int corner = 0; corner < 4; ++corner) {
      const int c = column + corner % 2, r = row + corner / 2;
      if (c < 0 || r < 0 || c >= grid.columns || r >= grid.rows) continue;
      const std::size_t at = static_cast<std::size_t>(r) * grid.columns + c;
      flux = flux + weight[corner] * grid.flux_mw_m2[at];
      if (!grid.ln_energy.empty()) ln_energy = ln_energy + weight[corner] * grid.ln_energy[at];
    }
    if (value_of(flux) == 0.0) return false;
    rates(altitude_km(p, f_.sphere_km), ln_energy, width, light);
    for (int l = 0; l < profile_.lines(); ++l) light[l] = flux * light[l];
    return true;
  }

  /// True if the feet of all points are in the dark, judged by the foot of `middle` and the largest distance
  /// of the others from it.
  bool are_dark(const AirPoint<double>& middle, const AirPoint<double>* others, int count) const {
    if (f_.lit[0] == nullptr) return false;
    const double axis[3] = {value_of(f_.axis[0]), value_of(f_.axis[1]), value_of(f_.axis[2])};
    const int face = face_of(middle);
    const auto place = place_of(middle, axis, face);
    if (!place.is_there) return false;
    double reach = 0.0;
    for (int i = 0; i < count; ++i) {
      const auto there = place_of(others[i], axis, face);
      if (!there.is_there) return false;
      reach = std::max(reach, std::hypot(there.x - place.x, there.y - place.y));
    }
    return reach * 1.05 + 1.0 < f_.lit[face]->dark_texels(place.x, place.y);
  }

 private:
  static constexpr double kBeyondLadder = 1e-6;  // in ln E; less is rounding

  template <class V>
  PlaneFoot<V> foot_on_plane(const AirPoint<V>& p, const V axis[3]) const {
    switch (f_.projection) {
      case FootProjection::field:
        return foot_along(p, axis, f_.sphere_km);
      case FootProjection::dipole:
        return foot_of_dipole(p, axis, f_.sphere_km);
      case FootProjection::reference:
        return foot_of_patch(p, f_.patches[0].template numbers<double>(), V(f_.patches[0].per_place));
      default:
        return foot_below(p, f_.sphere_km);
    }
  }

  template <class V>
  AirPoint<V> foot_of_shell(const AirPoint<V>& p, const V axis[3], int face) const {
    if (f_.projection == FootProjection::shell_dipole)
      return foot_in_dipole_around_body(p, axis, f_.sphere_km);
    if (f_.projection == FootProjection::shell_reference)
      return foot_in_patch_around_earth(p, face, f_.patches[face].template numbers<double>(),
                                        V(f_.patches[face].per_place));
    return p;
  }

  /// Returns the face on which the foot of a point lies.
  template <class V>
  int face_of(const AirPoint<V>& p) const {
    if (!is_shell_projection(f_.projection)) return 0;
    const int above = static_cast<int>(value_of(face_number(p)));
    if (f_.projection == FootProjection::shell) return above;
    AirPoint<double> plain;
    for (int i = 0; i < 3; ++i) plain.x[i] = value_of(p.x[i]);
    plain.square = value_of(p.square);
    const double axis[3] = {value_of(f_.axis[0]), value_of(f_.axis[1]), value_of(f_.axis[2])};
    return static_cast<int>(face_number(foot_of_shell(plain, axis, above)));
  }

  static MarchSpan plain_span(const MarchSpanOf<T>& span) {
    MarchSpan plain;
    for (int i = 0; i < 3; ++i) {
      plain.place_km[i] = value_of(span.place_km[i]);
      plain.direction[i] = value_of(span.direction[i]);
    }
    plain.square_km2 = value_of(span.square_km2);
    plain.along_km = value_of(span.along_km);
    plain.at_km = value_of(span.at_km);
    plain.first_km = value_of(span.first_km);
    plain.step_km = value_of(span.step_km);
    plain.steps = span.steps;
    return plain;
  }

  bool may_pass_over(const MarchSpan& span, int first_step) const {
    const double half = 0.5 * kBlockSteps * span.step_km;
    const double middle = span.first_km + first_step * span.step_km + half;
    const auto at = [&](double u) {
      return point_of_ray(span.place_km, span.direction, span.square_km2, span.along_km, u);
    };
    const AirPoint<double> ends[2] = {at(middle - half), at(middle + half)};
    return are_dark(at(middle), ends, 2);
  }

  /// Adds the light of a step; returns true if there is any.
  bool add(const MarchSpanOf<T>& span, int step, int width, ScalarLight<T>& out) const {
    const T u = span.first_km + span.step_km * (step + 0.5);
    T light[kMaxLines];
    if (!light_at(point_of_ray(span.place_km, span.direction, span.square_km2, span.along_km, u), width,
                  light))
      return false;
    double all = 0.0;
    for (int l = 0; l < profile_.lines(); ++l) {
      out.rayleigh[l] = out.rayleigh[l] + light[l];
      all += value_of(light[l]);
    }
    out.weighted_km += all * (value_of(span.at_km) + value_of(u));
    return all > 0.0;
  }

  /// `shift` is 0, with tangents.
  void of_energy(int energy, int width, int row, const T& part, const T& shift, T rate[]) const {
    const std::size_t at = static_cast<std::size_t>(row) * profile_.stride();
    const auto between = [&](const float* table, int line) {
      const double low = table[at + line], high = table[at + profile_.stride() + line];
      return part * (high - low) + low;
    };
    for (int l = 0; l < profile_.lines(); ++l) {
      rate[l] = between(profile_.rate(energy, width), l) + between(profile_.slope(energy, width), l) * shift;
      if (f_.profile_by_flux != nullptr)
        rate[l] = rate[l] + between(f_.profile_by_flux->slope(energy, width), l) * f_.flux_shift;
      if (f_.profile_by_oxygen != nullptr)
        rate[l] = rate[l] + between(f_.profile_by_oxygen->slope(energy, width), l) * f_.oxygen_shift;
    }
  }

  const ScalarFootprint<T, G>& f_;
  const StepProfile& profile_;
};

}  // namespace vegard::sim
