#include "tests/recovery/scorecard/line_of_sight_picture.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/base/parallel.h"
#include "sim/emit/aurora/beam_light.h"
#include "sim/emit/aurora/sheet.h"
#include "sim/light/sheet_profile.h"
#include "sim/render/film.h"
#include "sim/render/render.h"
#include "sim/view/camera/camera.h"

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

namespace {

constexpr double kStepAlongKm = 0.05;
constexpr double kStepsPerSigma = 10.0, kReachSigmas = 4.5;
constexpr double kTwoPi = 6.283185307179586;

}  // namespace

Footprint::Footprint(const sim::Scene& scene, int index) {
  const sim::Sheet& sheet = scene.sheets[index];
  assert(sheet.arcs == 1 && sheet.curl_spacing_km == 0.0 && sheet.patch_size_km == 0.0 &&
         sheet.border_amplitude_km == 0.0);
  half_length_km_ = 0.5 * sheet.length_km;
  const double folds_reach = sheet.fold_spacing_km > 0.0 ? 2.0 * sheet.fold_length_km : 0.0;
  half_width_km_ = sheet.thickness_km + kReachSigmas * sheet.width_km + folds_reach + 1.0;
  columns_ = static_cast<int>(2.0 * half_length_km_ / kCellKm) + 2;
  rows_ = static_cast<int>(2.0 * half_width_km_ / kCellKm) + 2;
  flux_.assign(static_cast<std::size_t>(columns_) * rows_, 0.0f);

  const sim::StretchOfSheet stretch = sim::stretch_of(sheet, scene.time.start_s);
  const std::uint32_t arc = sim::layer_address(index, 0, 0);
  const sim::LayerStructure structure{
      sim::Folds(sheet, arc, scene.seed, scene.time.start_s, stretch.drifted_km),
      sim::Curls(sheet, arc, scene.seed, scene.time.start_s, stretch.drifted_km)};
  sim::ArcLight light(sheet, arc, scene.seed, scene.time.start_s, stretch.drifted_km);
  light.remember(stretch.center_km - half_length_km_, stretch.center_km + half_length_km_);

  // Sharing out among four corners, and reading between them, each widen a cross-section by a sixth of a
  // cell squared.
  const double width = std::sqrt(sheet.width_km * sheet.width_km - kCellKm * kCellKm / 3.0);
  const int steps = static_cast<int>(std::lround(sheet.length_km / kStepAlongKm));
  const double step = sheet.length_km / steps;
  const int half = static_cast<int>(kReachSigmas * kStepsPerSigma);
  for (int layer = 0; layer < sheet.layers; ++layer) {
    const double share = sheet.layers > 1 ? static_cast<double>(layer) / (sheet.layers - 1) : 0.0;
    for (int k = 0; k < steps; ++k) {
      const double from_start = (k + 0.5) * step, along = stretch.along_km(from_start / sheet.length_km);
      const sim::LayerSine<double> sine{
          sheet.thickness_km, kTwoPi / sheet.wavelength_km,
          kTwoPi * from_start / sheet.wavelength_km + sheet.phase_rad + sheet.phase_shift_rad * share};
      const double flux = sheet.energy_flux_mw_m2 * light.at(along, sine.aside(0.0)).factor;
      for (int c = -half; c <= half; ++c) {
        const double sigmas = c / kStepsPerSigma;
        // A Gaussian of height 1 at width_km, whatever the width it is drawn with.
        const double weight =
            flux * std::exp(-0.5 * sigmas * sigmas) * sheet.width_km / kStepsPerSigma * step;
        const sim::PlanePoint<double> point =
            sim::structured_point(sine, structure, sheet.fold_stage, along, width * sigmas);
        const double x = (from_start + point.x_km) / kCellKm, y = (point.aside_km + half_width_km_) / kCellKm;
        const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
        if (i < 0 || j < 0 || i + 1 >= columns_ || j + 1 >= rows_) continue;
        const double fx = x - i, fy = y - j, density = weight / (kCellKm * kCellKm);
        float* const near = &flux_[static_cast<std::size_t>(i) * rows_ + j];
        near[0] += static_cast<float>(density * (1.0 - fx) * (1.0 - fy));
        near[1] += static_cast<float>(density * (1.0 - fx) * fy);
        near[rows_] += static_cast<float>(density * fx * (1.0 - fy));
        near[rows_ + 1] += static_cast<float>(density * fx * fy);
      }
    }
  }
}

}  // namespace vegard::scorecard
