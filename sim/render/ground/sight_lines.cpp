#include "sim/render/ground/sight_lines.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "sim/base/number/constants.h"
#include "sim/base/parallel.h"
#include "sim/emit/aurora/beam.h"
#include "sim/emit/aurora/foot_field.h"
#include "sim/emit/footprint/foot.h"
#include "sim/light/height_profile.h"
#include "sim/scene/structs/scene.h"
#include "sim/scene/structs/site_axes.h"
#include "sim/view/camera/camera.h"

namespace vegard::sim {
namespace {

constexpr double kShareOfCell = 0.34;    // of a cell's shorter side that a foot moves by in one step at most
constexpr int kMaxAltitudeSteps = 4096;  // from one altitude to the next, of a ray that hardly rises
constexpr double kBend = 0.03;           // change of a ray's path to one of altitude within a stretch

/// The field over a frame's places.
class FieldOver {
 public:
  FieldOver(const Scene& scene, const Site& site) : model_(scene.field.model) {
    const Field& field = scene.field;
    switch (model_) {
      case FieldModel::dipole:
        std::copy_n(dipole_axis(field, site).in_enu, 3, axis_);
        break;
      case FieldModel::igrf:
        patch_ = reference_field(scene, site);
        break;
      case FieldModel::uniform: {
        const FallFrame<double> frame = fall_frame<double>(field.inclination_deg * kRadiansPerDegree,
                                                           field.declination_deg * kRadiansPerDegree);
        std::copy_n(frame.along, 3, axis_);
        break;
      }
    }
  }

  PlaneFoot<double> foot(const AirPoint<double>& p) const {
    if (model_ == FieldModel::uniform) return foot_along(p, axis_, kEarthRadiusKm);
    return model_ == FieldModel::dipole ? foot_of_dipole(p, axis_, kEarthRadiusKm)
                                        : foot_of_patch(p, patch_->numbers<double>(), patch_->per_place);
  }

  /// The direction of fall at a foot.
  void fall_at(EastNorth foot_km, double along[3]) const {
    const PlaneFoot<double> foot{foot_km.east, foot_km.north, true};
    switch (model_) {
      case FieldModel::dipole:
        dipole_fall(axis_, foot, kEarthRadiusKm, along);
        break;
      case FieldModel::igrf:
        patch_fall(patch_->numbers<double>(), patch_->per_place, foot, along);
        break;
      case FieldModel::uniform:
        std::copy_n(axis_, 3, along);
        break;
    }
  }

 private:
  FieldModel model_;
  double axis_[3] = {0.0, 0.0, -1.0};
  std::shared_ptr<const FieldPatch> patch_;
};

/// A ray from a place, both in home's axes with the Earth's centre as origin.
struct HomeRay {
  double place[3], direction[3];
  double square = 0.0;  ///< as AirPoint
  double along = 0.0;

  AirPoint<double> at(double u_km) const { return point_of_ray(place, direction, square, along, u_km); }

  /// Returns the distance at which the rising line reaches an altitude; negative if it begins above it.
  double to_altitude(double altitude_km) const {
    const double above = square - altitude_km * (altitude_km + 2.0 * kEarthRadiusKm);
    const double root2 = along * along - above;
    return root2 < 0.0 ? -1.0 : -along + std::sqrt(root2);
  }
};

HomeRay ray_at_home(const Scene& scene, const SiteTurn& to_home, const Site& home, const double enu[3]) {
  HomeRay ray;
  for (int i = 0; i < 3; ++i) {
    ray.place[i] = to_home.shift_km[i] + (i == 2 ? kEarthRadiusKm + home.altitude_m * 1e-3 : 0.0);
    ray.direction[i] = 0.0;
    for (int j = 0; j < 3; ++j) ray.direction[i] += to_home.turn[i][j] * enu[j];
    ray.along += ray.place[i] * ray.direction[i];
  }
  const double altitude = scene.site.altitude_m * 1e-3;
  ray.square = altitude * (altitude + 2.0 * kEarthRadiusKm);
  return ray;
}

/// Puts a ray's stretches one after another, those over the same cell together.
class StretchList {
 public:
  StretchList(const AltitudeBins& bins, std::vector<SightStretch>& list) : bins_(bins), list_(list) {}

  /// A piece of the ray in a bin of altitude, from one share of its height to another.
  void add(int cell, int bin, double from_share, double to_share, double length_km) {
    const double from = (bin + from_share) * AltitudeBins::kLevelsInBin;
    const double slope = length_km / ((to_share - from_share) * bins_.height_km(bin));
    if (cell != cell_ || from != to_ || std::abs(slope - slope_) > kBend * slope_) {
      close();
      cell_ = cell;
      slope_ = slope;
      from_ = static_cast<int>(std::lround(from));
    }
    to_ = (bin + to_share) * AltitudeBins::kLevelsInBin;
    length_km_ += length_km;
  }

  void close() {
    const int to = static_cast<int>(std::lround(to_));
    if (cell_ >= 0 && to > from_) {
      const double height = bins_.level_km(to) - bins_.level_km(from_);
      list_.push_back({static_cast<std::uint32_t>(cell_), static_cast<std::uint16_t>(from_),
                       static_cast<std::uint16_t>(to), static_cast<float>(length_km_ / height)});
    }
    if (cell_ < 0 || to > from_) length_km_ = 0.0;
  }

 private:
  const AltitudeBins& bins_;
  std::vector<SightStretch>& list_;
  int cell_ = -1, from_ = 0;
  double to_ = -1.0, slope_ = 0.0, length_km_ = 0.0;
};

void march(const HomeRay& ray, double end_km, const FieldOver& field, const GroundGrid& grid,
           const AltitudeBins& bins, std::vector<SightStretch>& list) {
  StretchList stretches(bins, list);
  double from = std::max(0.0, ray.to_altitude(bins.edge_km(0)));
  PlaneFoot<double> foot = field.foot(ray.at(from));
  for (int bin = 0; bin < bins.bins(); ++bin) {
    const double to = std::min(ray.to_altitude(bins.edge_km(bin + 1)), end_km);
    if (to <= from) continue;
    const PlaneFoot<double> next = field.foot(ray.at(to));
    if (foot.is_there && next.is_there) {
      const double east = next.east_km - foot.east_km, north = next.north_km - foot.north_km;
      const double finest =
          std::min(grid.finest_km(foot.east_km, foot.north_km), grid.finest_km(next.east_km, next.north_km));
      const int steps =
          std::clamp(static_cast<int>(std::sqrt(east * east + north * north) / (kShareOfCell * finest)) + 1,
                     1, kMaxAltitudeSteps);
      for (int i = 0; i < steps; ++i) {
        const double t = (i + 0.5) / steps;
        stretches.add(grid.cell_at(foot.east_km + t * east, foot.north_km + t * north), bin,
                      static_cast<double>(i) / steps, (i + 1.0) / steps, (to - from) / steps);
      }
    }
    from = to;
    foot = next;
  }
  stretches.close();
}

}  // namespace

AltitudeBins::AltitudeBins() {
  double edge = HeightProfile::kBottomKm;
  while (edge < HeightProfile::kTopKm) {
    edge_km_.push_back(edge);
    edge += edge < 130.0 ? 0.5 : edge < 160.0 ? 1.0 : edge < 240.0 ? 2.0 : edge < 320.0 ? 4.0 : 8.0;
  }
  edge_km_.push_back(HeightProfile::kTopKm);
}

SightLines sight_lines(const Scene& scene, const Site& home, const GroundGrid& grid, const FilmGeometry& film,
                       const std::vector<std::uint8_t>& wanted, int threads, const std::atomic<bool>* stop) {
  const AltitudeBins bins;
  const FieldOver field(scene, home);
  const SiteTurn to_home = turn_between(scene.site, home);
  const CameraView<double> view = camera_view(scene.camera);
  const auto rows = static_cast<std::size_t>(film.rows);
  std::vector<std::vector<SightStretch>> of_row(rows);
  std::vector<std::vector<std::size_t>> count(rows);
  parallel_for(rows, threads, [&](std::size_t row, int) {
    if (stop != nullptr && *stop) {
      count[row].assign(static_cast<std::size_t>(film.columns), 0);
      return;
    }
    for (int column = 0; column < film.columns; ++column) {
      const std::size_t before = of_row[row].size();
      double enu[3];
      if (wanted[row * static_cast<std::size_t>(film.columns) + static_cast<std::size_t>(column)] != 0 &&
          enu_of_cell(view, film, static_cast<int>(row), column, enu))
        march(ray_at_home(scene, to_home, home, enu), ground_km(scene.site.altitude_m * 1e-3, enu[2]), field,
              grid, bins, of_row[row]);
      count[row].push_back(of_row[row].size() - before);
    }
  });
  SightLines lines;
  lines.first.push_back(0);
  std::size_t all = 0;
  for (const auto& list : of_row) all += list.size();
  lines.stretch.reserve(all);
  for (std::size_t row = 0; row < rows; ++row) {
    lines.stretch.insert(lines.stretch.end(), of_row[row].begin(), of_row[row].end());
    for (const std::size_t n : count[row]) lines.first.push_back(lines.first.back() + n);
    std::vector<SightStretch>().swap(of_row[row]);
  }
  return lines;
}

bool pixel_over_foot(const Scene& scene, const Site& home, EastNorth foot_km, double altitude_km,
                     double& x_px, double& y_px) {
  const FieldOver field(scene, home);
  double fall[3];
  field.fall_at(foot_km, fall);
  constexpr double kRadius = kEarthRadiusKm + kFootAltitudeKm;
  const double height2 = kRadius * kRadius - foot_km.east * foot_km.east - foot_km.north * foot_km.north;
  if (!(height2 > 0.0)) return false;
  const double foot[3] = {foot_km.east, foot_km.north, std::sqrt(height2)};
  // Up the straight field line from the foot q, |q - t fall| = R + altitude.
  double rise = 0.0;
  for (int i = 0; i < 3; ++i) rise -= foot[i] * fall[i];
  const double wanted = kEarthRadiusKm + altitude_km;
  const double root2 = rise * rise + wanted * wanted - kRadius * kRadius;
  if (root2 < 0.0) return false;
  const double up = -rise + std::sqrt(root2);
  const SiteTurn there = turn_between(home, scene.site);
  double point[3], enu[3];
  for (int i = 0; i < 3; ++i)
    point[i] = foot[i] - up * fall[i] - (i == 2 ? kEarthRadiusKm + home.altitude_m * 1e-3 : 0.0);
  double length2 = 0.0;
  for (int i = 0; i < 3; ++i) {
    enu[i] = there.shift_km[i];
    for (int j = 0; j < 3; ++j) enu[i] += there.turn[i][j] * point[j];
    length2 += enu[i] * enu[i];
  }
  const double length = std::sqrt(length2);
  const double direction[3] = {enu[0] / length, enu[1] / length, enu[2] / length};
  if (ground_km(scene.site.altitude_m * 1e-3, direction[2]) < length) return false;
  const CameraView<double> view = camera_view(scene.camera);
  return pixel_of_enu(view, direction, x_px, y_px) && x_px >= 0.0 && y_px >= 0.0 &&
         x_px < scene.camera.width && y_px < scene.camera.height;
}

}  // namespace vegard::sim
