#include "sim/view/sky/sky_numbers.h"

#include <cassert>

namespace vegard::sim {

const double* sky_number_address(const Scene& scene, SkyNumber which) {
  if (which >= first_sky_camera && which < sky_numbers)
    return camera_number_address(scene.camera, static_cast<CameraNumber>(which - first_sky_camera));
  switch (which) {
    case sky_aerosol_depth:
      return &scene.air.aerosol_optical_depth;
    case sky_angstrom:
      return &scene.air.angstrom_exponent;
    case sky_green:
      return &scene.airglow.green_rayleigh;
    case sky_red:
      return &scene.airglow.red_rayleigh;
    case sky_sodium:
      return &scene.airglow.sodium_rayleigh;
    case sky_pollution:
      return &scene.light_pollution.luminance_mcd_m2;
    default:
      break;
  }
  assert(false);
  return nullptr;
}

std::vector<int> sky_numbers_of(const Scene& scene, const std::vector<const double*>& free) {
  std::vector<int> which(free.size(), -1);
  for (std::size_t j = 0; j < free.size(); ++j)
    for (int k = 0; k < sky_numbers; ++k)
      if (free[j] == sky_number_address(scene, static_cast<SkyNumber>(k))) which[j] = k;
  return which;
}

template <>
double sky_number<double>(const Scene& scene, SkyNumber which) {
  return *sky_number_address(scene, which);
}

template <>
SkyDual sky_number<SkyDual>(const Scene& scene, SkyNumber which) {
  SkyDual number(*sky_number_address(scene, which));
  number.d.t[which] = 1.0;
  return number;
}

template <class T>
SkyView<T>::SkyView(const Scene& scene)
    : view_(camera_view<T>(scene.camera,
                           [&](CameraNumber which) {
                             return sky_number<T>(scene, static_cast<SkyNumber>(first_sky_camera + which));
                           })),
      plain_(values_of(view_.lens)) {}

template class SkyView<double>;
template class SkyView<SkyDual>;

}  // namespace vegard::sim
