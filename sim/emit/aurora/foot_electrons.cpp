#include "sim/emit/aurora/foot_electrons.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/base/number/constants.h"
#include "sim/emit/aurora/beam.h"
#include "sim/emit/aurora/foot_field.h"
#include "sim/emit/aurora/foot_line.h"
#include "sim/emit/aurora/motion.h"
#include "sim/emit/aurora/sheet.h"
#include "sim/emit/aurora/sheet_curve.h"
#include "sim/scene/structs/scene.h"
#include "sim/scene/structs/site_axes.h"

namespace vegard::sim {
namespace {

constexpr double kMostWidths = 9.0;  // of a Gaussian: 1e-18 of its peak
constexpr double kMetresPerKm = 1e3;

/// `scale` times a number: what sheet_shape() asks of a NumberAs.
template <class T>
struct Scaled {
  const NumberAs<T>& number;
  T operator()(const double& of, double scale = 1.0) const { return number(of) * scale; }
};

/// Sums of one sheet; the energy's logarithm is weighted with the flux.
template <class T>
struct FootSum {
  T flux{0.0}, flux_ln_energy{0.0};
  void add(const T& more, const T& ln_energy) {
    flux = flux + more;
    flux_ln_energy = flux_ln_energy + more * ln_energy;
  }
};

template <class T>
void add_sine(const Scene& scene, int sheet, double instant_s, const T& east_km, const T& north_km,
              const Scaled<T>& number, FootSum<T>& sum) {
  const Sheet& s = scene.sheets[sheet];
  const T ln_energy = logarithm(T(number(s.energy_kev)));
  for (int arc = 0; arc < s.arcs; ++arc) {
    const SheetShape<T> shape = sheet_shape<T>(scene, sheet, arc, instant_s, number);
    const T east = east_km - shape.center_east_km, north = north_km - shape.center_north_km;
    const T from_start = east * shape.along_east + north * shape.along_north + shape.length_km * 0.5;
    if (value_of(from_start) < 0.0 || value_of(from_start) > value_of(shape.length_km)) continue;
    const T left = north * shape.along_east - east * shape.along_north;
    const T aside = left * shape.side - shape.arc_offset_km;
    for (int layer = 0; layer < s.layers; ++layer) {
      const double part = s.layers > 1 ? static_cast<double>(layer) / (s.layers - 1) : 0.0;
      const T phase =
          from_start * kTwoPi / shape.wavelength_km + shape.phase_rad + shape.phase_shift_rad * part;
      const T across = (aside - shape.thickness_km * sine(phase)) / shape.width_km;
      if (std::abs(value_of(across)) > kMostWidths) continue;
      sum.add(shape.energy_flux_mw_m2 * exponential(across * across * -0.5), ln_energy);
    }
  }
}

/// The places of a piece of a curve whose perpendicular goes through a point, as fractions of the piece.
std::vector<double> nearest_places(const SheetCurve<double>& curve, int piece, double east_km,
                                   double north_km) {
  constexpr int kParts = 16, kHalvings = 50;
  const auto before = [&](double fraction) {  // the way from the place to the point, along the curve
    const CurvePlace<double> on = curve.place(piece, fraction);
    return (east_km - on.at[0]) * on.along[0] + (north_km - on.at[1]) * on.along[1];
  };
  std::vector<double> found;
  double low = before(0.0);
  for (int part = 0; part < kParts; ++part) {
    double from = static_cast<double>(part) / kParts, to = static_cast<double>(part + 1) / kParts;
    const double high = before(to), first = low;
    low = high;
    if (!(first > 0.0 && high <= 0.0)) continue;  // from the nearest place the curve leads away either way
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = 0.5 * (from + to);
      (before(middle) > 0.0 ? from : to) = middle;
    }
    found.push_back(0.5 * (from + to));
  }
  return found;
}

template <class T>
void add_curve(const Scene& scene, int sheet, double instant_s, const T& east_km, const T& north_km,
               const Scaled<T>& number, FootSum<T>& sum) {
  constexpr double kStep = 1e-5;  // of a piece
  const Sheet& s = scene.sheets[sheet];
  const SheetShape<T> shape = sheet_shape<T>(scene, sheet, 0, instant_s, number);
  const CurveNodes<double> plain_nodes =
      curve_nodes<double>(s, instant_s, [](const double& of) { return of; });
  const int last = static_cast<int>(plain_nodes.at.size()) - 2;
  const SheetCurve<double> plain(plain_nodes, 0, last);
  const SheetCurve<T> curve(curve_nodes<T>(s, instant_s, number), 0, last);
  for (int piece = 0; piece <= last; ++piece)
    for (const double fraction : nearest_places(plain, piece, value_of(east_km), value_of(north_km))) {
      const CurvePlace<T> on = curve.place(piece, fraction);
      const T east = east_km - on.at[0], north = north_km - on.at[1];
      const T aside = north * on.along[0] - east * on.along[1];
      // The nearest place goes along with the point and the curve: by so many km, of value 0.
      const double low = std::max(0.0, fraction - kStep), high = std::min(1.0, fraction + kStep);
      const CurvePlace<double> here = plain.place(piece, fraction), back = plain.place(piece, low),
                               ahead = plain.place(piece, high);
      const double step_km = (high - low) * plain.length_km(piece);
      const double bend = (here.along[0] * (ahead.along[1] - back.along[1]) -
                           here.along[1] * (ahead.along[0] - back.along[0])) /
                          step_km;
      const T moved = (east * on.along[0] + north * on.along[1]) / (1.0 - bend * value_of(aside));
      const auto along = [&](const std::vector<T>& list, const std::vector<double>& plain_list) {
        const double slope =
            (plain.along(plain_list, piece, high) - plain.along(plain_list, piece, low)) / step_km;
        return curve.along(list, piece, fraction) + moved * slope;
      };
      const auto& nodes = curve.nodes();
      const T width =
          nodes.ln_width.empty() ? shape.width_km : exponential(along(nodes.ln_width, plain_nodes.ln_width));
      const T across = aside / width;
      if (std::abs(value_of(across)) > kMostWidths) continue;
      T flux = shape.energy_flux_mw_m2 * exponential(across * across * -0.5) * static_cast<double>(s.layers);
      if (!nodes.ln_brightness.empty())
        flux = flux * exponential(along(nodes.ln_brightness, plain_nodes.ln_brightness));
      sum.add(flux, nodes.ln_energy.empty() ? logarithm(T(number(s.energy_kev)))
                                            : along(nodes.ln_energy, plain_nodes.ln_energy));
    }
}

}  // namespace

template <class T>
std::vector<FootElectrons<T>> foot_electrons(const Scene& scene, const T& east_km, const T& north_km,
                                             const NumberAs<T>& of_scene) {
  const Scaled<T> number{of_scene};
  const std::vector<double> instants = instants_s(scene.time);
  std::vector<FootElectrons<T>> electrons;
  for (int sheet = 0; sheet < static_cast<int>(scene.sheets.size()); ++sheet) {
    FootSum<T> sum;
    for (const double instant_s : instants)
      (is_curve(scene.sheets[sheet]) ? add_curve<T> : add_sine<T>)(scene, sheet, instant_s, east_km, north_km,
                                                                   number, sum);
    if (!(value_of(sum.flux) > 0.0)) continue;
    electrons.push_back(
        {sheet, sum.flux * (1.0 / static_cast<double>(instants.size())), sum.flux_ln_energy / sum.flux});
  }
  return electrons;
}

template std::vector<FootElectrons<double>> foot_electrons(const Scene&, const double&, const double&,
                                                           const NumberAs<double>&);
template std::vector<FootElectrons<FreeDual>> foot_electrons(const Scene&, const FreeDual&, const FreeDual&,
                                                             const NumberAs<FreeDual>&);

template <class T>
FootPlace<T> foot_below(const Scene& scene, const double point_km[3], const NumberAs<T>& number) {
  constexpr int kRounds = 8;  // the field turns by a degree in 100 km: each leaves a hundredth
  const FootField field(scene);
  const double centre_km = scene.body.radius_km + scene.site.altitude_m / kMetresPerKm,
               foot_radius_km = scene.body.radius_km + kFootAltitudeKm;
  const double from_centre[3] = {point_km[0], point_km[1], point_km[2] + centre_km};
  double square = 0.0;
  for (const double x : from_centre) square += x * x;
  FootPlace<T> foot{T(point_km[0]), T(point_km[1])};
  for (int round = 0; round < (field.varies() ? kRounds : 1); ++round) {
    const FallFrame<T> fall = field.varies()
                                  ? field.at(foot.east_km, foot.north_km)
                                  : fall_frame<T>(number(scene.field.inclination_deg) * kRadiansPerDegree,
                                                  number(scene.field.declination_deg) * kRadiansPerDegree);
    const T q =
        fall.along[0] * from_centre[0] + fall.along[1] * from_centre[1] + fall.along[2] * from_centre[2];
    const T way = q * -1.0 - square_root(q * q + (foot_radius_km * foot_radius_km - square));
    foot = {fall.along[0] * way + point_km[0], fall.along[1] * way + point_km[1]};
  }
  return foot;
}

template FootPlace<double> foot_below(const Scene&, const double[3], const NumberAs<double>&);
template FootPlace<FreeDual> foot_below(const Scene&, const double[3], const NumberAs<FreeDual>&);

PointInSpace point_above(const Scene& scene, double latitude_deg, double longitude_deg, double altitude_km) {
  Site there;
  there.latitude_deg = latitude_deg;
  there.longitude_deg = longitude_deg;
  there.altitude_m = altitude_km * kMetresPerKm;
  const SiteTurn turn = turn_between(there, scene.site, scene.body.radius_km);
  return {{turn.shift_km[0], turn.shift_km[1], turn.shift_km[2]}};
}

double distance_to_sheets_km(const Scene& scene, double east_km, double north_km) {
  constexpr int kPoints = 4001;
  double least = std::numeric_limits<double>::infinity();
  for (const Sheet& sheet : scene.sheets)
    for (int arc = 0; arc < sheet.arcs; ++arc)
      for (const EastNorth& foot : sine_feet(scene, sheet, scene.time.start_s, arc, kPoints))
        least = std::min(least, std::hypot(foot.east - east_km, foot.north - north_km));
  return least;
}

}  // namespace vegard::sim
