#include "fit/triangulation/curtain_light.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "fit/triangulation/shared_view.h"
#include "sim/base/number/constants.h"
#include "sim/view/camera/camera.h"

namespace vegard::fit {
namespace curtain_light {

constexpr std::size_t kPlacesAlong = 240;
constexpr double kUsualDistance_km = 150.0;

/// Upwards along the field, of such a length that it rises by 1 km.
Eigen::Vector3d field_line(const sim::Igrf& igrf, EarthShape shape, const Eigen::Vector3d& place_km,
                           const CurtainSupposition& supposed) {
  const GeodeticPlace place = geodetic_place(shape, place_km);
  const sim::FieldVector field = igrf.at(place.latitude_deg, place.longitude_deg, place.height_km);
  const Eigen::Vector3d enu(
      -field.east_nt / field.down_nt + std::tan(supposed.field_east_deg * sim::kRadiansPerDegree),
      -field.north_nt / field.down_nt + std::tan(supposed.field_north_deg * sim::kRadiansPerDegree), 1.0);
  return east_north_up(place).transpose() * enu;
}

}  // namespace curtain_light

CurtainLight::CurtainLight(const std::vector<ViewPoint>& cameras, const std::vector<const Photo*>& photos,
                           int channel, double year, double lowest_elevation_deg)
    : igrf_(year), least_sine_(std::sin(lowest_elevation_deg * sim::kRadiansPerDegree)) {
  for (std::size_t i = 0; i < 2; ++i) {
    // A box as wide as a step, at the usual distance.
    const double px = sim::pixels_per_degree(cameras[i].camera().camera) / sim::kRadiansPerDegree *
                      kStepAbove_km / curtain_light::kUsualDistance_km;
    light_.emplace_back(*photos[i], channel, static_cast<int>(0.5 * px));
  }
}

void CurtainLight::set_base(const Eigen::Vector3d& along, const Eigen::Vector3d& across) {
  along_ = along;
  across_ = across;
}

std::vector<BorderFieldLine> CurtainLight::lines_at(const CurtainSupposition& supposed,
                                                    double height_km) const {
  const PictureCurve& border = *supposed.border;
  const ViewPoint& view = (*supposed.cameras)[border.camera];
  std::vector<BorderFieldLine> lines;
  const std::size_t points = border.points.size();
  if (points < 2) return lines;
  const std::size_t parts = std::max<std::size_t>(1, curtain_light::kPlacesAlong / (points - 1));
  const std::size_t count = (points - 1) * parts + 1;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t from = std::min(i / parts, points - 2);
    const double part = static_cast<double>(i - from * parts) / static_cast<double>(parts);
    const PixelPoint &a = border.points[from], &b = border.points[from + 1];
    const auto direction =
        view.direction({a.x_px + part * (b.x_px - a.x_px), a.y_px + part * (b.y_px - a.y_px)});
    const auto place = direction ? place_at_height(view, *direction, height_km) : std::nullopt;
    if (!place) continue;
    lines.push_back({*place, curtain_light::field_line(igrf_, view.shape(), *place, supposed),
                     i * kBorderPieces / count});
  }
  return lines;
}

std::size_t CurtainLight::levels(double highest_km, double step_km) {
  return static_cast<std::size_t>((highest_km - kLowestAbove_km) / step_km + 1e-9) + 1;
}

double CurtainLight::at(const ViewPoint& view, std::size_t camera, const Eigen::Vector3d& place_km) const {
  const Eigen::Vector3d sight = place_km - view.place_km();
  if (!(sight.dot(view.place_km()) > least_sine_ * sight.norm() * view.place_km().norm())) return sim::kNaN;
  const std::optional<PixelPoint> pixel = view.pixel(place_km);
  return pixel ? light_[camera].between(*pixel).value_or(sim::kNaN) : sim::kNaN;
}

std::vector<double> CurtainLight::along(const CurtainSupposition& supposed,
                                        const std::vector<BorderFieldLine>& lines, std::size_t camera,
                                        double step_km) const {
  Eigen::Vector3d moved = Eigen::Vector3d::Zero();
  // The picture that has the border shows it where it is.
  if (camera != supposed.border->camera)
    moved = (camera == 1 ? 1.0 : -1.0) * (supposed.along_km * along_ + supposed.across_km * across_);
  const std::size_t count = levels(supposed.highest_km, step_km);
  std::vector<double> light;
  light.reserve(lines.size() * count);
  for (const BorderFieldLine& line : lines)
    for (std::size_t k = 0; k < count; ++k) {
      const double above_km = kLowestAbove_km + step_km * static_cast<double>(k);
      light.push_back(at((*supposed.cameras)[camera], camera, line.foot_km + above_km * line.rise + moved));
    }
  return light;
}

}  // namespace vegard::fit
