#include "sim/emit/aurora/foot_line.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/base/number/constants.h"
#include "sim/emit/aurora/beam.h"
#include "sim/emit/aurora/foot_field.h"
#include "sim/emit/aurora/sheet_curve.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {
namespace {

constexpr int kBandPlaces = 25, kCurvePlaces = 4001;

/// Unit vectors along and to the left, and the middle.
struct Line {
  double east, north, u_east, u_north;
  EastNorth at(double along_km, double left_km) const {
    return {east + along_km * u_east - left_km * u_north, north + along_km * u_north + left_km * u_east};
  }
};

Line line_of_sheet(const Sheet& sheet, double instant_s) {
  const double bearing = sheet.bearing_deg * kRadiansPerDegree;
  return {sheet.center_km.east + sheet.drift_km_s.east * instant_s,
          sheet.center_km.north + sheet.drift_km_s.north * instant_s, std::sin(bearing), std::cos(bearing)};
}

double arc_offset_km(const Sheet& sheet, int arc) {
  return (arc - 0.5 * (sheet.arcs - 1)) * sheet.arc_spacing_km;
}

double part(int i, int count) { return count > 1 ? static_cast<double>(i) / (count - 1) : 0.5; }

}  // namespace

FootPoints foot_points(const Sheet& sheet, double instant_s) {
  if (is_curve(sheet)) {
    const std::vector<EastNorth> feet = curve_feet(sheet, instant_s, kCurvePlaces);
    const auto distance = [](const EastNorth& foot) { return std::hypot(foot.east, foot.north); };
    return {feet.front(), feet[kCurvePlaces / 2], feet.back(),
            *std::min_element(feet.begin(), feet.end(), [&](const EastNorth& a, const EastNorth& b) {
              return distance(a) < distance(b);
            })};
  }
  const Line line = line_of_sheet(sheet, instant_s);
  const double half = 0.5 * sheet.length_km;
  FootPoints points{line.at(-half, 0.0), line.at(0.0, 0.0), line.at(half, 0.0), {}};
  const double along = std::clamp(-(line.east * line.u_east + line.north * line.u_north), -half, half);
  double least = std::numeric_limits<double>::infinity();
  for (int arc = 0; arc < sheet.arcs; ++arc) {
    const EastNorth foot = line.at(along, arc_offset_km(sheet, arc));
    const double distance = std::hypot(foot.east, foot.north);
    if (distance >= least) continue;
    least = distance;
    points.nearest = foot;
  }
  return points;
}

std::vector<EastNorth> straight_feet(const Sheet& sheet, double instant_s, int arc, int count) {
  if (is_curve(sheet)) return curve_feet(sheet, instant_s, count);
  const Line line = line_of_sheet(sheet, instant_s);
  std::vector<EastNorth> feet;
  for (int i = 0; i < count; ++i)
    feet.push_back(line.at((part(i, count) - 0.5) * sheet.length_km, arc_offset_km(sheet, arc)));
  return feet;
}

std::vector<EastNorth> sine_feet(const Scene& scene, const Sheet& sheet, double instant_s, int arc,
                                 int count) {
  if (is_curve(sheet)) return curve_feet(sheet, instant_s, count);
  const Line line = line_of_sheet(sheet, instant_s);
  // The sine's positive values lie towards u x B: to the left in the north (sim/emit/aurora/sheet.h).
  const double side = falls_along_field(scene) ? 1.0 : -1.0;
  const double middle_phase = sheet.layers > 1 ? 0.5 * sheet.phase_shift_rad : 0.0;
  std::vector<EastNorth> feet;
  for (int i = 0; i < count; ++i) {
    const double from_start = part(i, count) * sheet.length_km;
    const double phase = kTwoPi / sheet.wavelength_km * (from_start - sheet.sine_speed_km_s * instant_s) +
                         sheet.phase_rad + middle_phase;
    feet.push_back(line.at(from_start - 0.5 * sheet.length_km,
                           side * (arc_offset_km(sheet, arc) + sheet.thickness_km * std::sin(phase))));
  }
  return feet;
}

double wrapped_longitude_deg(double longitude_deg) {
  return longitude_deg - 360.0 * std::ceil((longitude_deg - 180.0) / 360.0);
}

PlaceOnEarth place_of_foot(const Scene& scene, EastNorth foot_km) {
  const double radius = scene.body.radius_km + kFootAltitudeKm;
  const double east = foot_km.east / radius, north = foot_km.north / radius;
  const double up = std::sqrt(1.0 - east * east - north * north);  // NaN beyond the edge
  const double latitude = scene.site.latitude_deg * kRadiansPerDegree;
  const double from_equator = std::cos(latitude) * north + std::sin(latitude) * up;
  const double out = std::cos(latitude) * up - std::sin(latitude) * north;
  const DipoleAxis axis = dipole_axis(scene.field, scene.site);
  PlaceOnEarth place;
  const auto degrees = [](double radians) { return radians / kRadiansPerDegree; };
  place.latitude_deg = degrees(std::atan2(from_equator, std::hypot(east, out)));
  place.longitude_from_site_deg = degrees(std::atan2(east, out));
  place.longitude_deg = wrapped_longitude_deg(scene.site.longitude_deg + place.longitude_from_site_deg);
  place.magnetic_latitude_deg = degrees(
      std::asin(std::clamp(axis.in_enu[0] * east + axis.in_enu[1] * north + axis.in_enu[2] * up, -1.0, 1.0)));
  return place;
}

std::vector<double> band_places_km(const Sheet& sheet) {
  std::vector<double> places;
  for (int i = 0; i < kBandPlaces; ++i) places.push_back((part(i, kBandPlaces) - 0.5) * sheet.length_km);
  return places;
}

std::vector<double> aside_km(const Sheet& best, const Sheet& moved, double instant_s,
                             const std::vector<double>& along_km) {
  const Line from = line_of_sheet(best, instant_s), to = line_of_sheet(moved, instant_s);
  // In from's axes, to begins at (x, y) and runs along (cosine, sine).
  const double east = to.east - from.east, north = to.north - from.north;
  const double x = east * from.u_east + north * from.u_north, y = north * from.u_east - east * from.u_north;
  const double cosine = to.u_east * from.u_east + to.u_north * from.u_north;
  const double sine = to.u_north * from.u_east - to.u_east * from.u_north;
  std::vector<double> aside;
  for (const double along : along_km) aside.push_back(y + (along - x) * sine / cosine);
  return aside;
}

}  // namespace vegard::sim
