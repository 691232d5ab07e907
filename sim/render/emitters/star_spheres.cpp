#include "sim/render/emitters/star_spheres.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/base/number/constants.h"
#include "sim/emit/sun/sun_frame.h"
#include "sim/light/colours_profile.h"
#include "sim/view/camera/camera.h"
#include "sim/view/colour/line_colours.h"
#include "sim/view/sky/stars.h"

namespace vegard::sim {
namespace {

// Of (1 - q²)²: the mean of a coordinate's square over the radius' is 1/9.
constexpr double kRadiusPerSigma = 3.0;
constexpr double kVolume = 32.0 * kPi / 105.0;  // its integral, of the radius cubed
constexpr std::size_t kMostStars = 1000000;

bool in_picture(const CameraView<double>& view, const Camera& camera, const std::array<double, 3>& enu) {
  double x_px = 0.0, y_px = 0.0;
  return pixel_of_enu(view, enu.data(), x_px, y_px) && x_px >= 0.0 && y_px >= 0.0 && x_px < camera.width &&
         y_px < camera.height;
}

}  // namespace

StarField::StarField(std::vector<StarSphere> spheres, double radius, double unit_cm, int lines)
    : spheres_(std::move(spheres)), radius_(radius), unit_cm_(unit_cm), lines_(lines) {}

Box3 StarField::bounds() const {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  if (spheres_.empty()) return {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
  Box3 box{{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
  for (const StarSphere& star : spheres_)
    for (int a = 0; a < 3; ++a) {
      box.low[a] = std::min(box.low[a], star.middle[a] - radius_);
      box.high[a] = std::max(box.high[a], star.middle[a] + radius_);
    }
  return box;
}

bool StarField::is_dark(const Box3& box) const {
  return std::none_of(spheres_.begin(), spheres_.end(), [&](const StarSphere& star) {
    double square = 0.0;
    for (int a = 0; a < 3; ++a) {
      const double off = std::max({box.low[a] - star.middle[a], star.middle[a] - box.high[a], 0.0});
      square += off * off;
    }
    return square < radius_ * radius_;
  });
}

void StarField::sample(std::size_t count, const double* const point[3], float* const emission[],
                       float* density) const {
  std::fill_n(density, count, 0.0f);
  for (int l = 0; l < lines_; ++l) std::fill_n(emission[l], count, 0.0f);
  if (count == 0) return;
  Box3 around;
  for (int a = 0; a < 3; ++a) {
    const auto [low, high] = std::minmax_element(point[a], point[a] + count);
    around.low[a] = *low - radius_;
    around.high[a] = *high + radius_;
  }
  for (const StarSphere& star : spheres_) {
    bool near = true;
    for (int a = 0; a < 3; ++a)
      near = near && star.middle[a] > around.low[a] && star.middle[a] < around.high[a];
    if (!near) continue;
    for (std::size_t k = 0; k < count; ++k) {
      double square = 0.0;
      for (int a = 0; a < 3; ++a) square += (point[a][k] - star.middle[a]) * (point[a][k] - star.middle[a]);
      const double left = 1.0 - square / (radius_ * radius_);
      if (left <= 0.0) continue;
      for (int l = 0; l < lines_; ++l) emission[l][k] += static_cast<float>(star.emission[l] * left * left);
    }
  }
}

bool has_star_spheres(const Scene& scene) {
  return scene.sun.shown && scene.stars.shown && scene.stars.sphere_distance > 0.0;
}

double star_sphere_radius(const Scene& scene) {
  const double distance = scene.stars.sphere_distance * scene.sun.distance_km / scene.sun.unit_km;
  return kRadiusPerSigma * scene.stars.width_deg * kRadiansPerDegree * distance;
}

StarField star_field(const Scene& scene) {
  const SunFrame<double> frame(scene.sun, plain_number);
  const double distance = scene.stars.sphere_distance * scene.sun.distance_km / scene.sun.unit_km,
               radius = star_sphere_radius(scene), unit_cm = scene.sun.unit_km * kCmPerKm;
  const int lines = static_cast<int>(scene.emission.lines.size());
  std::vector<std::array<double, 3>> of_line;
  for (const Vector3& rgb : line_colours(scene)) of_line.push_back({rgb[0], rgb[1], rgb[2]});
  const CameraView<double> view = camera_view(scene.camera);
  // Rayleighs times steradian are the emission times the volume over the distance's square.
  const double per_rayleigh_steradian =
      photons_per_volume(1.0, unit_cm) * distance * distance / (kVolume * radius * radius * radius);
  std::vector<StarSphere> spheres;
  for (const PointOfLight& star : star_points(scene, scene.time.start_s, kMostStars)) {
    if (!in_picture(view, scene.camera, star.enu)) continue;
    const SkyRay<double> ray = frame.ray(star.enu.data());
    StarSphere sphere;
    for (int a = 0; a < 3; ++a)
      sphere.middle[a] = ray.nearest[a] + (ray.observer + distance) * ray.direction[a];
    sphere.emission = line_amounts(of_line, star.rgb_steradian);
    for (double& amount : sphere.emission) amount *= 1e3 * per_rayleigh_steradian;
    spheres.push_back(std::move(sphere));
  }
  return {std::move(spheres), radius, unit_cm, lines};
}

}  // namespace vegard::sim
