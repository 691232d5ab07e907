#include "sim/emit/aurora/beam_light.h"

#include <cmath>

#include "sim/base/number/noise.h"

namespace vegard::sim {
namespace {

/// Log-normal of mean 1; `contrast` is the standard deviation of the logarithm.
double log_normal(double contrast, double gaussian) {
  return std::exp(contrast * gaussian - 0.5 * contrast * contrast);
}

}  // namespace

BeamLight mean_light(const Sheet& sheet, double ray) {
  BeamLight light;
  if (sheet.ray_length_contrast > 0.0) light.stretch_above = log_normal(sheet.ray_length_contrast, ray);
  return light;
}

ArcLight::ArcLight(const Sheet& sheet, std::uint32_t arc_address, std::uint64_t seed, double instant_s,
                   double drifted_km)
    : sheet_(sheet),
      address_(arc_address),
      seed_(seed),
      drifted_km_(drifted_km),
      rays_moved_km_(drifted_km + sheet.ray_speed_km_s * instant_s),
      border_lives_(sheet.border_lifetime_s > 0.0 ? instant_s / sheet.border_lifetime_s : 0.0) {
  if (sheet.ray_contrast > 0.0)
    rays_.emplace(seed, Stream::ray_light, arc_address, sheet.ray_width_km, instant_s, sheet.ray_lifetime_s);
  if (sheet.ray_length_contrast > 0.0)
    lengths_.emplace(seed, Stream::ray_length, arc_address, sheet.ray_width_km, instant_s,
                     sheet.ray_lifetime_s);
  if (sheet.patch_size_km > 0.0 && sheet.patch_contrast > 0.0)
    patches_.emplace(seed, Stream::patch, arc_address, sheet.patch_size_km, instant_s,
                     sheet.patch_lifetime_s);
}

void ArcLight::remember(double first_km, double last_km) {
  if (rays_) rays_->remember(first_km - rays_moved_km_, last_km - rays_moved_km_);
  if (lengths_) lengths_->remember(first_km - rays_moved_km_, last_km - rays_moved_km_);
}

BeamLight ArcLight::at(double along_km, double aside_km) {
  BeamLight light;
  const double on_rays = along_km - rays_moved_km_, on_sheet = along_km - drifted_km_;
  if (rays_) light.factor *= log_normal(sheet_.ray_contrast, rays_->at(on_rays));
  if (patches_) light.factor *= log_normal(sheet_.patch_contrast, patches_->at(on_sheet, aside_km));
  if (lengths_) light.stretch_above = log_normal(sheet_.ray_length_contrast, lengths_->at(on_rays));
  if (sheet_.border_amplitude_km > 0.0)
    (sheet_.border_rule == BorderRule::light ? light.altitude_shift_km : light.start_shift_km) =
        sheet_.border_amplitude_km * octave_noise(seed_, Stream::border, address_, sheet_.border_octaves,
                                                  on_sheet / sheet_.border_scale_km,
                                                  aside_km / sheet_.border_scale_km, border_lives_);
  return light;
}

}  // namespace vegard::sim
