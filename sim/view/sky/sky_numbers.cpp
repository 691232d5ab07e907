#include "sim/view/sky/sky_numbers.h"

#include "sim/scene/structs/scene.h"
#include <array>
#include <cassert>

namespace vegard::sim {

ParameterId sky_number_id(const Scene& scene, SkyNumber which) {
  if (which >= first_sky_camera && which < sky_numbers)
    return parameter_with(role_of(scene.camera, static_cast<CameraNumber>(which - first_sky_camera)));
  static constexpr std::array<ParameterRole, first_sky_camera> roles = {
      ParameterRole::aerosol_depth, ParameterRole::angstrom_exponent, ParameterRole::green_airglow,
      ParameterRole::red_airglow,   ParameterRole::sodium_airglow,    ParameterRole::town_light};
  assert(which >= 0 && which < first_sky_camera);
  return parameter_with(roles[which]);
}

std::vector<int> sky_numbers_of(const Scene& scene, const std::vector<ParameterId>& free) {
  std::vector<int> which(free.size(), -1);
  for (int k = 0; k < sky_numbers; ++k) {
    const ParameterId number = sky_number_id(scene, static_cast<SkyNumber>(k));
    for (std::size_t j = 0; j < free.size(); ++j)
      if (free[j] == number) which[j] = k;
  }
  return which;
}

template <>
double sky_number<double>(const Scene& scene, SkyNumber which) {
  return *number_at(scene, sky_number_id(scene, which));
}

template <>
SkyDual sky_number<SkyDual>(const Scene& scene, SkyNumber which) {
  SkyDual number(sky_number<double>(scene, which));
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
