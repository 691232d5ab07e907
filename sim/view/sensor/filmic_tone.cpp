#include "sim/view/sensor/filmic_tone.h"

#include <algorithm>
#include <cmath>

#include "sim/view/colour/colour.h"

namespace vegard::sim {
namespace filmic_tone {

// Ottosson 2020: the cones of CIE XYZ, which are 1 each for D65.
constexpr Matrix3 kConesOfXyz = {{{0.8189330101, 0.3618667424, -0.1288597137},
                                  {0.0329845436, 0.9293118715, 0.0361456387},
                                  {0.0482003018, 0.2643662691, 0.6338517070}}};
constexpr double kWhitest = 1.0 - 5e-6;  // what is shown of light of 1e5

/// t / (1 + t) of the light that is shown as f: 0 at the knee, 1 at white.
double share_of_way(double f) { return (f - kFilmicKnee) / (1.0 - kFilmicKnee); }

double pale_share(double f) {
  const double way = share_of_way(f);
  return kFilmicPalest * way * way;
}

double largest(const Vector3& v) { return std::max({v[0], v[1], v[2]}); }

Vector3 scaled(const Vector3& v, double factor) { return {v[0] * factor, v[1] * factor, v[2] * factor}; }

Vector3 without_negative(const Vector3& v) {
  return {std::max(v[0], 0.0), std::max(v[1], 0.0), std::max(v[2], 0.0)};
}

}  // namespace filmic_tone

double filmic_roll_off(double light) {
  if (!(light > kFilmicKnee)) return light;
  const double t = (light - kFilmicKnee) / (1.0 - kFilmicKnee);
  return kFilmicKnee + (1.0 - kFilmicKnee) * (t / (1.0 + t));
}

double filmic_light(double shown) {
  if (!(shown > kFilmicKnee)) return shown;
  const double way = filmic_tone::share_of_way(std::min(shown, filmic_tone::kWhitest));
  return kFilmicKnee + (1.0 - kFilmicKnee) * way / (1.0 - way);
}

FilmicTone::FilmicTone(Primaries primaries) {
  const Matrix3 cones = product(filmic_tone::kConesOfXyz, inverse(rgb_from_xyz(primaries)));
  const Vector3 white = product(cones, Vector3{1.0, 1.0, 1.0});
  cones_of_rgb_ = product(diagonal({1.0 / white[0], 1.0 / white[1], 1.0 / white[2]}), cones);
  rgb_of_cones_ = inverse(cones_of_rgb_);
}

Vector3 FilmicTone::roots(const Vector3& rgb) const {
  const Vector3 cones = product(cones_of_rgb_, rgb);
  return {std::cbrt(cones[0]), std::cbrt(cones[1]), std::cbrt(cones[2])};
}

Vector3 FilmicTone::rgb_of_roots(const Vector3& lms) const {
  const Vector3 cones = {lms[0] * lms[0] * lms[0], lms[1] * lms[1] * lms[1], lms[2] * lms[2] * lms[2]};
  return product(rgb_of_cones_, cones);
}

Vector3 FilmicTone::shown(const Vector3& light) const {
  using namespace filmic_tone;
  const Vector3 seen = without_negative(light);
  const double most = largest(seen);
  if (!(most > kFilmicKnee)) return seen;
  const double f = std::min(filmic_roll_off(most), kWhitest), pale = pale_share(f), grey = std::cbrt(f);
  Vector3 mixed = roots(scaled(seen, f / most));
  for (double& root : mixed) root = (1.0 - pale) * root + pale * grey;
  const Vector3 paler = without_negative(rgb_of_roots(mixed));
  return scaled(paler, f / largest(paler));
}

Vector3 FilmicTone::light(const Vector3& shown) const {
  using namespace filmic_tone;
  const Vector3 seen = without_negative(shown);
  const double f = std::min(largest(seen), kWhitest);
  if (!(f > kFilmicKnee)) return seen;
  const double pale = pale_share(f), grey = std::cbrt(f), most = filmic_light(f);
  const Vector3 mixed = roots(seen);
  // The factor by which shown() has scaled the mixture is such that the colour before it has the largest
  // channel f.
  const auto before = [&](double scale) {
    Vector3 root = mixed;
    for (double& r : root) r = (scale * r - pale * grey) / (1.0 - pale);
    return rgb_of_roots(root);
  };
  double low = 0.7, high = 1.4;
  constexpr int kHalvings = 48;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (largest(before(middle)) < f ? low : high) = middle;
  }
  const Vector3 colour = without_negative(before(0.5 * (low + high)));
  return scaled(colour, most / f);
}

}  // namespace vegard::sim
