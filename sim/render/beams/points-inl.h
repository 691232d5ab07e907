// Lists deflection points as points in space with the light that they emit, without a camera. The code is in
// double precision, so that the points are the same on every instruction set.
#if defined(VEGARD_SIM_RENDER_POINTS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VEGARD_SIM_RENDER_POINTS_INL_H_
#undef VEGARD_SIM_RENDER_POINTS_INL_H_
#else
#define VEGARD_SIM_RENDER_POINTS_INL_H_
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

#include "sim/render/beams/kernel_types.h"
#include "sim/render/beams/samples-inl.h"

HWY_BEFORE_NAMESPACE();
namespace vegard::sim {
namespace HWY_NAMESPACE {

/// Appends the point to the list if it emits any light.
inline void list_point(const double position_in_enu_km[3], double volume_cm3_mw_m2, const BeamGroup& group,
                       int beam, const HeightProfile& profile, double observer_altitude_km, double sphere_km,
                       EmissionPoints& out) {
  const double up = position_in_enu_km[2] + observer_altitude_km;
  const double excess_km2 = up * (up + 2.0 * sphere_km) + position_in_enu_km[0] * position_in_enu_km[0] +
                            position_in_enu_km[1] * position_in_enu_km[1];
  const double altitude = altitude_read_km(group, beam, altitude_km(excess_km2, SphereScale(sphere_km)));
  const double h = (altitude - HeightProfile::kBottomKm) * (1.0 / HeightProfile::kStepKm);
  if (!(h >= 0.0 && h < HeightProfile::kAltitudes - 1)) return;
  const int below = static_cast<int>(h);
  const float* here = profile.rate.data() + static_cast<std::ptrdiff_t>(below) * profile.stride;
  bool shines = false;
  for (int l = 0; l < profile.lines; ++l) {
    const double rate = here[l] + (here[profile.stride + l] - here[l]) * (h - below);
    out.photons_per_s.push_back(static_cast<float>(rate * volume_cm3_mw_m2));
    shines = shines || out.photons_per_s.back() > 0.0f;
  }
  if (shines) {
    for (int i = 0; i < 3; ++i) out.position_in_enu_km.push_back(static_cast<float>(position_in_enu_km[i]));
  } else {
    out.photons_per_s.resize(out.photons_per_s.size() - profile.lines);
  }
}

/// Returns a beam's axes, as SampleMaker uses them.
inline FallFrame<double> frame_of(const KernelScene& scene, const BeamGroup& group, int beam) {
  FallFrame<double> frame;
  for (int i = 0; i < 3; ++i) {
    if (scene.beams_own_field) {
      fetch(group.axes->axis[0][i], beam, frame.along[i]);
      fetch(group.axes->axis[1][i], beam, frame.across1[i]);
      fetch(group.axes->axis[2][i], beam, frame.across2[i]);
    } else {
      spread(scene.fall.along[i], frame.along[i]);
      spread(scene.fall.across1[i], frame.across1[i]);
      spread(scene.fall.across2[i], frame.across2[i]);
    }
  }
  return frame;
}

/// Appends all points of the groups. A point represents the volume stretch * vertical * area, which emits at
/// the rate of the height profile.
inline void list_every_point(const KernelScene& scene, const BeamGroup* groups, std::size_t count,
                             EmissionPoints& out) {
  constexpr double kCm3PerKm3 = 1e15;
  Deflection<double> deflection;
  spread(scene.deflection.loss_cone_rad, deflection.loss_cone_rad);
  spread(scene.deflection.pitch_step_rad, deflection.pitch_step_rad);
  deflection.law = scene.deflection.law;
  deflection.path_step = scene.deflection.path_step;
  deflection.rule = scene.deflection.rule;
  PhiloxKeys keys;
  philox_keys(scene.seed, keys);
  for (std::size_t g = 0; g < count; ++g) {
    const BeamGroup& group = groups[g];
    const HeightProfile& profile = scene.profiles[group.profile];
    for (int beam = 0; beam < kGroup; ++beam) {
      const double end = group.end_of_path[beam];
      if (!(end > 0.0)) continue;
      double start[3], length, vertical;
      for (int i = 0; i < 3; ++i) fetch(group.start_in_enu_km[i], beam, start[i]);
      fetch(group.length_km, beam, length);
      fetch(group.vertical, beam, vertical);
      const FallFrame<double> frame = frame_of(scene, group, beam);
      const double area = vertical * group.flux_km2_mw_m2[beam] * kCm3PerKm3;
      FallingBeams<double, double, double> falling;
      falling.start(length, group.index[beam], group.layer_address, keys);
      bool on_path = true;
      while (on_path) {
        falling.next_four(deflection, keys, [&](int, const FallenPoint<double, double>& point) {
          on_path = point.t <= end;
          if (!on_path) return;
          double place[3];
          for (int i = 0; i < 3; ++i)
            place[i] = start[i] + point.along_km * frame.along[i] + point.across1_km * frame.across1[i] +
                       point.across2_km * frame.across2[i];
          list_point(place, point.stretch * length * area, group, beam, profile, scene.observer_altitude_km,
                     scene.sphere_km, out);
        });
      }
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace vegard::sim
HWY_AFTER_NAMESPACE();

#endif
