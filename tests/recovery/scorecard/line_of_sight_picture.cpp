#include "tests/recovery/scorecard/line_of_sight_picture.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/base/parallel.h"
#include "sim/light/sheet_profile.h"
#include "sim/render/film.h"
#include "sim/render/render.h"
#include "sim/view/camera/camera.h"
#include "tests/recovery/scorecard/footprint.h"

namespace vegard::scorecard {
namespace {

constexpr double kFootKm = 110.0;
// Feet and altitudes are worked out every kNodesKm along a line of sight and taken as linear between: over
// that distance the Earth's curvature is 0.7 m.
constexpr double kNodesKm = 6.0, kStepKm = 0.1;
constexpr int kMaxLines = 4;

struct SheetLight {
  Footprint footprint;
  sim::HeightProfile profile;
  double along_east, along_north, center_along, center_left, side;
};

/// A point of a line of sight: its altitude, and where the field line through it has its foot.
struct Node {
  double altitude_km = 0.0, foot_east_km = 0.0, foot_north_km = 0.0;
};

class Sight {
 public:
  explicit Sight(const sim::Scene& scene) : earth_km_(sim::kEarthRadiusKm), top_km_(scene.sheets[0].top_km) {
    observer_km_ = earth_km_ + 1e-3 * scene.site.altitude_m;
    const double inclination = scene.field.inclination_deg * sim::kRadiansPerDegree;
    const double declination = scene.field.declination_deg * sim::kRadiansPerDegree;
    const double sign = inclination < 0.0 ? -1.0 : 1.0;
    along_ = {sign * std::cos(inclination) * std::sin(declination),
              sign * std::cos(inclination) * std::cos(declination), -sign * std::sin(inclination)};
    for (std::size_t s = 0; s < scene.sheets.size(); ++s) {
      const sim::Sheet& sheet = scene.sheets[s];
      const double bearing = sheet.bearing_deg * sim::kRadiansPerDegree;
      const double e = std::sin(bearing), n = std::cos(bearing);
      sheets_.push_back({Footprint(scene, static_cast<int>(s)),
                         sim::sheet_profile(scene.emission.lines, scene, static_cast<int>(s)), e, n,
                         sheet.center_km.east * e + sheet.center_km.north * n,
                         sheet.center_km.north * e - sheet.center_km.east * n, sign});
    }
  }

  /// Adds the rayleighs of every line in the direction of a unit vector.
  void add_light(const std::array<double, 3>& direction, double weight, double* rayleigh) const {
    if (direction[2] <= 0.0) return;
    const double first = range_at(direction[2], sim::HeightProfile::kBottomKm),
                 last = range_at(direction[2], top_km_);
    const int nodes = static_cast<int>(std::ceil((last - first) / kNodesKm));
    const double length = (last - first) / nodes;
    Node before = node(direction, first);
    for (int k = 1; k <= nodes; ++k) {
      const Node after = node(direction, first + k * length);
      for (const SheetLight& sheet : sheets_) add_stretch(sheet, before, after, length, weight, rayleigh);
      before = after;
    }
  }

 private:
  double range_at(double up, double altitude_km) const {
    const double target = earth_km_ + altitude_km;
    return -observer_km_ * up +
           std::sqrt(observer_km_ * observer_km_ * up * up + target * target - observer_km_ * observer_km_);
  }

  Node node(const std::array<double, 3>& direction, double range) const {
    const double q[3] = {range * direction[0], range * direction[1], range * direction[2] + observer_km_};
    const double square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2];
    const double b = q[0] * along_[0] + q[1] * along_[1] + q[2] * along_[2];
    const double foot = earth_km_ + kFootKm;
    const double to_foot = -b - std::sqrt(b * b - square + foot * foot);
    return {std::sqrt(square) - earth_km_, q[0] + to_foot * along_[0], q[1] + to_foot * along_[1]};
  }

  static void add_stretch(const SheetLight& sheet, const Node& before, const Node& after, double length,
                          double weight, double* rayleigh) {
    const auto along = [&](const Node& n) {
      return n.foot_east_km * sheet.along_east + n.foot_north_km * sheet.along_north - sheet.center_along;
    };
    const auto aside = [&](const Node& n) {
      return sheet.side *
             (n.foot_north_km * sheet.along_east - n.foot_east_km * sheet.along_north - sheet.center_left);
    };
    const double half = sheet.footprint.half_width_km();
    const double x0 = along(before), y0 = aside(before), z0 = before.altitude_km;
    const double dx = along(after) - x0, dy = aside(after) - y0, dz = after.altitude_km - z0;
    if (std::min(y0, y0 + dy) > half || std::max(y0, y0 + dy) < -half) return;
    const int steps = static_cast<int>(std::ceil(length / kStepKm));
    const sim::HeightProfile& profile = sheet.profile;
    for (int k = 0; k < steps; ++k) {
      const double t = (k + 0.5) / steps;
      const double flux = sheet.footprint.flux_mw_m2(x0 + t * dx, y0 + t * dy);
      if (flux <= 0.0) continue;
      const double place = (z0 + t * dz - sim::HeightProfile::kBottomKm) / sim::HeightProfile::kStepKm;
      const int below = static_cast<int>(place);
      if (place < 0.0 || below + 1 >= sim::HeightProfile::kAltitudes) continue;
      const float* const here = &profile.rate[static_cast<std::size_t>(below) * profile.stride];
      // A photon per cubic centimetre and second over a kilometre is a tenth of a rayleigh.
      const double light = 0.1 * weight * flux * length / steps;
      for (int l = 0; l < profile.lines; ++l)
        rayleigh[l] += light * (here[l] + (here[profile.stride + l] - here[l]) * (place - below));
    }
  }

  double earth_km_, top_km_, observer_km_ = 0.0;
  std::array<double, 3> along_{};
  std::vector<SheetLight> sheets_;
};

}  // namespace

sim::Image line_of_sight_rayleighs(const sim::Scene& scene, int threads) {
  assert(scene.field.model == sim::FieldModel::uniform && scene.emission.lines.size() <= kMaxLines);
  const Sight sight(scene);
  const sim::CameraView<double> view = sim::camera_view(scene.camera);
  sim::Exposure film;
  film.geometry = sim::film_for(scene, 0, 0, scene.camera.width, scene.camera.height, 1.0, 1.0);
  film.lines = static_cast<int>(scene.emission.lines.size());
  film.rayleigh.resize(film.cells() * film.lines);
  sim::parallel_for(film.geometry.rows, threads, [&](std::size_t row, int) {
    for (int column = 0; column < film.geometry.columns; ++column) {
      double rayleigh[kMaxLines] = {};
      for (const double part : {0.25, 0.75}) {
        const double x = film.geometry.x0_px + column + 0.5 - 0.5 * scene.camera.width;
        const double y = film.geometry.y0_px + static_cast<double>(row) + part - 0.5 * scene.camera.height;
        std::array<double, 3> direction;
        for (int i = 0; i < 3; ++i)
          direction[i] = view.camera_from_enu[0][i] * x + view.camera_from_enu[1][i] * y +
                         view.camera_from_enu[2][i] * view.lens.focal_px;
        const double size = std::hypot(direction[0], direction[1], direction[2]);
        for (double& d : direction) d /= size;
        sight.add_light(direction, 0.5, rayleigh);
      }
      for (int l = 0; l < film.lines; ++l)
        film.rayleigh[l * film.cells() + row * film.geometry.columns + column] =
            static_cast<float>(rayleigh[l]);
    }
  });
  return sim::rayleigh_image(scene, film, threads);
}

}  // namespace vegard::scorecard
