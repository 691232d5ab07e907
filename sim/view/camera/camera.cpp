#include "sim/view/camera/camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "sim/base/number/constants.h"
#include "sim/base/number/vec3.h"
#include "sim/view/camera/cube_map.h"
#include "sim/view/camera/lens.h"

namespace vegard::sim {
namespace {

/// A number of a camera and its role in the parameter table.
struct CameraNumberRow {
  double Camera::*number;
  ParameterRole role;
};
constexpr std::array<CameraNumberRow, camera_numbers> kCameraNumbers = {
    {{&Camera::azimuth_deg, ParameterRole::camera_azimuth},
     {&Camera::elevation_deg, ParameterRole::camera_elevation},
     {&Camera::roll_deg, ParameterRole::camera_roll},
     {&Camera::focal_px, ParameterRole::focal_length},
     {&Camera::principal_x_px, ParameterRole::principal_x},
     {&Camera::principal_y_px, ParameterRole::principal_y},
     {&Camera::aspect, ParameterRole::lens_aspect},
     {&Camera::k1, ParameterRole::lens_k1},
     {&Camera::k2, ParameterRole::lens_k2},
     {&Camera::k3, ParameterRole::lens_k3},
     {&Camera::p1, ParameterRole::lens_p1},
     {&Camera::p2, ParameterRole::lens_p2}}};
constexpr CameraNumberRow kPinholeScale = {&Camera::hfov_deg, ParameterRole::field_of_view};

const CameraNumberRow& row_of(const Camera& camera, CameraNumber which) {
  return which == scale_number && camera.model == LensModel::pinhole ? kPinholeScale : kCameraNumbers[which];
}

Vec3<double> unit(Vec3<double> a) {
  const double length = std::sqrt(dot3(a, a));
  for (double& x : a) x /= length;
  return a;
}

void put(FilmEdges& edges, const Vec3<double>& outward) {
  std::copy(outward.begin(), outward.end(), edges.outward[edges.count++]);
}

/// Returns directions along the rectangle's border; empty if some of it is outside of the lens's picture.
std::vector<Vec3<double>> border(const Lens<double>& lens, double left, double top, double right,
                                 double bottom) {
  constexpr int kPieces = 48;
  std::vector<Vec3<double>> all;
  for (int side = 0; side < 4; ++side)
    for (int i = 0; i < kPieces; ++i) {
      const double share = static_cast<double>(i) / kPieces;
      const double along = side < 2 ? share : 1.0 - share;
      const double x = side % 2 == 0 ? left + along * (right - left) : (side == 1 ? right : left);
      const double y = side % 2 == 1 ? top + along * (bottom - top) : (side == 0 ? top : bottom);
      Vec3<double> direction;
      if (!unproject(lens, x, y, direction.data())) return {};
      all.push_back(direction);
    }
  return all;
}

}  // namespace

const double& camera_number(const Camera& camera, CameraNumber which) {
  return camera.*row_of(camera, which).number;
}

ParameterRole role_of(const Camera& camera, CameraNumber which) { return row_of(camera, which).role; }

int camera_number_of(const Camera& camera, const ParameterId& id) {
  for (int which = 0; which < camera_numbers; ++which)
    if (role_of(camera, static_cast<CameraNumber>(which)) == id.role()) return which;
  return -1;
}

CameraView<double> camera_view(const Camera& camera) {
  return camera_view<double>(camera, [&](CameraNumber which) { return camera_number(camera, which); });
}

Direction direction_of_pixel(const Camera& camera, double x_px, double y_px) {
  double enu[3];
  if (!enu_of_pixel(camera_view(camera), x_px, y_px, enu)) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    return {kNone, kNone};
  }
  return direction_of_enu(enu);
}

Direction direction_of_enu(const double enu[3]) {
  Direction direction;
  direction.azimuth_deg = std::atan2(enu[0], enu[1]) / kRadiansPerDegree;
  if (direction.azimuth_deg < 0.0) direction.azimuth_deg += 360.0;
  direction.elevation_deg = std::atan2(enu[2], std::hypot(enu[0], enu[1])) / kRadiansPerDegree;
  return direction;
}

void enu_of_direction(const Direction& direction, double enu[3]) {
  const double azimuth = direction.azimuth_deg * kRadiansPerDegree;
  const double elevation = direction.elevation_deg * kRadiansPerDegree;
  enu[0] = std::cos(elevation) * std::sin(azimuth);
  enu[1] = std::cos(elevation) * std::cos(azimuth);
  enu[2] = std::sin(elevation);
}

double pixels_per_degree(const Camera& camera) {
  if (camera.model == LensModel::equirectangular) return camera.width / 360.0;
  if (camera.model == LensModel::cube) return face_px(camera) / 90.0;
  return camera.model == LensModel::pinhole ? camera.width / camera.hfov_deg
                                            : camera.focal_px / camera.pixel_width_px * kRadiansPerDegree;
}

double pixels_per_degree_growth(const Camera& camera) {
  return camera.model == LensModel::pinhole ? -1.0 / camera.hfov_deg : 1.0 / camera.focal_px;
}

double widest_angle_rad(const Lens<double>& lens, const FilmGeometry& film) {
  double least = 1.0;
  for (const double x_px :
       {film.x0_px - film.cell_width_px, film.x0_px + (film.columns + 1) * film.cell_width_px})
    for (const double y_px :
         {film.y0_px - film.cell_height_px, film.y0_px + (film.rows + 1) * film.cell_height_px}) {
      double direction[3] = {0.0, 0.0, lens.min_cosine};
      unproject(lens, x_px, y_px, direction);
      least = std::min(least, direction[2]);
    }
  return std::acos(std::clamp(least, lens.min_cosine, 1.0));
}

Camera camera_of_face(const Camera& camera, const CubeFace& face) {
  const CameraView<double> view = camera_view(camera);
  const auto in_enu = [&](const std::array<double, 3>& axis) {
    Vec3<double> enu{};
    for (int i = 0; i < 3; ++i)
      for (int a = 0; a < 3; ++a) enu[i] += axis[a] * view.camera_from_enu[a][i];
    return enu;
  };
  const Vec3<double> forward = in_enu(face.forward), right = in_enu(face.right);
  Camera one = camera;
  one.model = LensModel::pinhole;
  one.width = one.height = face_px(camera);
  one.hfov_deg = 90.0;
  one.pixel_width_px = one.pixel_height_px = 1.0;
  const double elevation = std::asin(std::clamp(forward[2], -1.0, 1.0));
  // Straight up and down any azimuth will do: the roll follows from it.
  const double azimuth = std::hypot(forward[0], forward[1]) > 1e-9 ? std::atan2(forward[0], forward[1]) : 0.0;
  const double sa = std::sin(azimuth), ca = std::cos(azimuth), se = std::sin(elevation),
               ce = std::cos(elevation);
  const Vec3<double> level_right = {ca, -sa, 0.0}, level_up = {-(sa * se), -(ca * se), ce};
  one.azimuth_deg = azimuth / kRadiansPerDegree;
  one.elevation_deg = elevation / kRadiansPerDegree;
  one.roll_deg = std::atan2(dot3(right, level_up), dot3(right, level_right)) / kRadiansPerDegree;
  return one;
}

PictureSize size_within(const Camera& camera, const PictureSize& most) {
  if (is_panorama(camera.model)) {
    // Their shape is exact: in whole faces, or halves.
    const CubeSize parts = camera.model == LensModel::cube ? cube_size(camera.cube_layout) : CubeSize{2, 1};
    const int edge =
        std::min({camera.height / parts.rows, most.height / parts.rows, most.width / parts.columns});
    return {parts.columns * std::max(1, edge), parts.rows * std::max(1, edge)};
  }
  const double scale = std::min({1.0, static_cast<double>(most.width) / camera.width,
                                 static_cast<double>(most.height) / camera.height});
  return {std::max(1, static_cast<int>(std::lround(camera.width * scale))),
          std::max(1, static_cast<int>(std::lround(camera.height * scale)))};
}

Camera scaled_camera(const Camera& camera, const PictureSize& size) {
  Camera scaled = camera;
  scaled.width = size.width;
  scaled.height = size.height;
  scaled.pixel_width_px *= static_cast<double>(camera.width) / size.width;
  scaled.pixel_height_px *= static_cast<double>(camera.height) / size.height;
  return scaled;
}

Camera in_own_pixels(const Camera& camera) {
  // A pinhole's field of view is across the whole picture and stays; so do the radial and decentring terms,
  // which are in units of the focal length.
  Camera own = camera;
  own.focal_px /= camera.pixel_width_px;
  own.principal_x_px /= camera.pixel_width_px;
  own.principal_y_px /= camera.pixel_height_px;
  own.aspect *= camera.pixel_width_px / camera.pixel_height_px;
  own.pixel_width_px = own.pixel_height_px = 1.0;
  return own;
}

namespace {}  // namespace

double tangent_altitude_km(double observer_km, double elevation_deg) {
  if (!(elevation_deg < 0.0)) return kNaN;
  // H - (R + H) (1 - cos e), without the difference of two large numbers.
  const double sine = std::sin(0.5 * elevation_deg * kRadiansPerDegree);
  return observer_km - 2.0 * (kEarthRadiusKm + observer_km) * sine * sine;
}

double elevation_of_tangent_deg(double observer_km, double tangent_km) {
  const double below_km = observer_km - tangent_km;
  if (!(below_km >= 0.0 && tangent_km >= -kEarthRadiusKm)) return kNaN;
  return -2.0 * std::asin(std::sqrt(0.5 * below_km / (kEarthRadiusKm + observer_km))) / kRadiansPerDegree;
}

double tangent_distance_km(double observer_km, double elevation_deg) {
  if (!(elevation_deg < 0.0)) return kNaN;
  return (kEarthRadiusKm + observer_km) * std::sin(-elevation_deg * kRadiansPerDegree);
}

FilmEdges film_edges(const Lens<double>& lens, const FilmGeometry& film) {
  FilmEdges edges;
  if (is_panorama(lens.model)) return edges;
  const double left = film.x0_px - film.cell_width_px, top = film.y0_px - film.cell_height_px;
  const double right = film.x0_px + (film.columns + 1) * film.cell_width_px;
  const double bottom = film.y0_px + (film.rows + 1) * film.cell_height_px;
  if (is_plain_pinhole(lens)) {
    const double fx = lens.focal_px * lens.side, fy = lens.focal_px * lens.aspect;
    const double a = (left - lens.principal_x_px) / fx, b = (right - lens.principal_x_px) / fx;
    put(edges, {-1.0, 0.0, std::min(a, b)});
    put(edges, {1.0, 0.0, -std::max(a, b)});
    put(edges, {0.0, -1.0, (top - lens.principal_y_px) / fy});
    put(edges, {0.0, 1.0, -(bottom - lens.principal_y_px) / fy});
    return edges;
  }
  const std::vector<Vec3<double>> seen = border(lens, left, top, right, bottom);
  if (seen.empty()) return edges;
  // About the middle of the border, the smallest box of tangents that holds all of it.
  Vec3<double> middle{};
  for (const Vec3<double>& direction : seen)
    for (int i = 0; i < 3; ++i) middle[i] += direction[i];
  if (!(dot3(middle, middle) > 1e-6)) return edges;
  middle = unit(middle);
  const Vec3<double> first = unit(
      cross3(middle, std::abs(middle[0]) < 0.7 ? Vec3<double>{1.0, 0.0, 0.0} : Vec3<double>{0.0, 1.0, 0.0}));
  const Vec3<double> second = cross3(middle, first);
  constexpr double kNarrowest = 0.17;  // cosine of 80 degrees
  double low[2] = {1e30, 1e30}, high[2] = {-1e30, -1e30};
  for (const Vec3<double>& direction : seen) {
    const double forward = dot3(direction, middle);
    if (forward < kNarrowest) return edges;
    const double tangent[2] = {dot3(direction, first) / forward, dot3(direction, second) / forward};
    for (int i = 0; i < 2; ++i) {
      low[i] = std::min(low[i], tangent[i]);
      high[i] = std::max(high[i], tangent[i]);
    }
  }
  // A border that runs around the back of the camera has its middle there, and all that the film sees is
  // beyond it.
  double inside[3];
  if (!unproject(lens, 0.5 * (left + right), 0.5 * (top + bottom), inside)) return edges;
  const Vec3<double> centre = {inside[0], inside[1], inside[2]};
  const double forward = dot3(centre, middle);
  if (forward < kNarrowest) return edges;
  const double at[2] = {dot3(centre, first) / forward, dot3(centre, second) / forward};
  for (int i = 0; i < 2; ++i)
    if (at[i] < low[i] || at[i] > high[i]) return edges;
  // The border bulges between the points that were looked at.
  constexpr double kBulge = 0.02;
  for (int i = 0; i < 2; ++i) {
    const Vec3<double>& axis = i == 0 ? first : second;
    const double room = kBulge * (high[i] - low[i]);
    Vec3<double> lower, upper;
    for (int k = 0; k < 3; ++k) {
      lower[k] = (low[i] - room) * middle[k] - axis[k];
      upper[k] = axis[k] - (high[i] + room) * middle[k];
    }
    put(edges, lower);
    put(edges, upper);
  }
  return edges;
}

}  // namespace vegard::sim
