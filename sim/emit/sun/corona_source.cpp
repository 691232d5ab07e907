#include "sim/emit/sun/corona_source.h"

#include <cstddef>

namespace vegard::sim {

template <class T>
CoronaSource<T>::CoronaSource(const Scene& scene, const Corona& corona, const NumberAs<T>& number)
    : kind_(corona.light),
      square_radius_(scene.sun.radius * scene.sun.radius),
      density_(number(corona.density)),
      polar_(number(corona.polar)),
      darkening_(number(scene.sun.limb_darkening)),
      darkening_square_(number(scene.sun.limb_darkening_square)),
      scattered_below_(scattered_light(T(1.0), T(1.0), darkening_, darkening_square_)) {
  for (std::size_t k = 0; k < corona.share.size(); ++k) {
    share_.push_back(number(corona.share[k]));
    power_.push_back(number(corona.power[k]));
  }
}

template <class T>
T CoronaSource<T>::density(const T& square, const T& square_sine_latitude) const {
  const T height = logarithm(square * (1.0 / square_radius_)) * -0.5;
  T sum(0.0);
  for (std::size_t k = 0; k < share_.size(); ++k) sum = sum + share_[k] * exponential(height * power_[k]);
  return density_ * sum * ((polar_ - 1.0) * square_sine_latitude + 1.0);
}

template <class T>
T CoronaSource<T>::light(const T& square, const T& square_sine_latitude, const T& square_sine_chi) const {
  const T here = density(square, square_sine_latitude);
  if (kind_ == CoronaLight::density) return here;
  if (kind_ == CoronaLight::square) return here * here;
  return here * scattered_light(square_radius_ / square, square_sine_chi, darkening_, darkening_square_) /
         scattered_below_;
}

template class CoronaSource<double>;
template class CoronaSource<FreeDual>;

}  // namespace vegard::sim
