#include "fit/measure/profile_bins.h"

#include <cmath>
#include <string>

#include "fit/measure/bin_grid.h"
#include "sim/base/error.h"
#include "sim/base/file/number_text.h"
#include "sim/base/number/constants.h"
#include "sim/emit/sun/sun_frame.h"
#include "sim/scene/structs/scene.h"
#include "sim/view/camera/camera.h"

namespace vegard::fit {
namespace {

constexpr int kLimbMinPositions = 3;
constexpr int kLimbPositionsEachSide = 1;  ///< whose noise is pooled

}  // namespace

BinGrid limb_bins(const sim::Scene& scene, const Region& region) {
  const sim::Fit& fit = scene.fit;
  if (!scene.sun.shown)
    throw sim::Error(sim::ErrorKind::scene, "there is no Sun that profiles could lead away from")
        .file(scene.file)
        .key("sun.shown")
        .expected("true")
        .hint("or another fit.profile_along");
  if (!(fit.limb_lowest < fit.limb_highest))
    throw sim::Error(sim::ErrorKind::scene, "limb_lowest is not below limb_highest")
        .file(scene.file)
        .key("fit.limb_lowest")
        .expected("limb_lowest below limb_highest");
  const double steps = std::ceil((fit.limb_highest - fit.limb_lowest) / fit.limb_step - 1e-9);
  constexpr double kMaxPositions = 10000.0;
  if (steps < kLimbMinPositions || steps > kMaxPositions)
    throw sim::Error(sim::ErrorKind::scene,
                     sim::short_number(steps) + " steps lie between limb_lowest and limb_highest")
        .file(scene.file)
        .key("fit.limb_step")
        .expected(std::to_string(kLimbMinPositions) + " to " + sim::short_number(kMaxPositions, 5));
  BinGrid grid;
  grid.region = region;
  grid.groups = fit.bands;
  grid.positions = static_cast<int>(steps);
  grid.along = {"distance from the Sun's middle", "radii", fit.limb_lowest, fit.limb_step};
  grid.across = {"position angle", "\u00b0", 0.0, 360.0 / fit.bands};
  grid.pooled = kLimbPositionsEachSide;
  for (int b = 0; b < grid.groups; ++b) grid.band.insert(grid.band.end(), grid.positions, b);

  const sim::CameraView<double> view = sim::camera_view(scene.camera);
  const sim::SunFrame<double> frame(scene.sun, [](const double& number) { return number; });
  gather(
      [&](int x, int y) {
        double enu[3];
        if (!sim::enu_of_pixel(view, x + 0.5, y + 0.5, enu)) return kNoBin;
        const sim::SkyRay<double> ray = frame.sky().ray(enu);
        if (ray.direction[2] >= 0.0) return kNoBin;  // away from the Sun
        const double radii = std::sqrt(ray.aside) / scene.sun.radius;
        const double position = (radii - fit.limb_lowest) / fit.limb_step;
        if (!(position >= 0.0 && position < grid.positions)) return kNoBin;
        // The frame's axes are right and up, the Sun's east is to the left.
        double angle = std::atan2(-ray.nearest[0], ray.nearest[1]) / (2.0 * sim::kPi);
        if (angle < 0.0) angle += 1.0;
        const int group = static_cast<int>(angle * grid.groups) % grid.groups;
        return group * grid.positions + static_cast<int>(position);
      },
      grid);
  if (grid.runs.empty())
    throw sim::Error(sim::ErrorKind::scene,
                     "no pixel of the region is " + sim::short_number(fit.limb_lowest) + " to " +
                         sim::short_number(fit.limb_highest) + " radii from the Sun's middle")
        .file(scene.file)
        .key("sun.azimuth_deg")
        .expected("the Sun in view")
        .hint("check sun.azimuth_deg, sun.elevation_deg and where the camera points");
  const double radius_rad = std::asin(scene.sun.radius * scene.sun.unit_km / scene.sun.distance_km);
  grid.position_px =
      fit.limb_step * radius_rad / sim::kRadiansPerDegree * sim::pixels_per_degree(scene.camera);
  return grid;
}

}  // namespace vegard::fit
