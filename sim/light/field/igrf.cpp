#include "sim/light/field/igrf.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "sim/base/file/csv_table.h"
#include "sim/base/number/constants.h"
#include "sim/base/number/wgs84.h"

namespace vegard::sim {
namespace {

constexpr double kYearsBetween = 5.0;
constexpr double kReferenceRadiusKm = 6371.2;

const CsvTable& igrf_table() {
  static const CsvTable table = embedded_csv_table("igrf14.csv");
  return table;
}

}  // namespace

Igrf::Igrf(double year) {
  const double years = std::clamp(year, kFirstIgrfYear, kLastIgrfYear) - kFirstIgrfYear;
  const int last = static_cast<int>((kLastIgrfYear - kFirstIgrfYear) / kYearsBetween);
  const int before = std::min(last - 1, static_cast<int>(years / kYearsBetween));
  const double part = years / kYearsBetween - before;
  const CsvTable& table = igrf_table();
  const auto column = [&](int epoch) -> const std::vector<double>& {
    return table.column("y" + std::to_string(static_cast<int>(kFirstIgrfYear + kYearsBetween * epoch)));
  };
  const std::vector<double>&degree = table.column("degree"), &order = table.column("order");
  const std::vector<double>&first = column(before), &next = column(before + 1);
  for (std::size_t r = 0; r < table.rows(); ++r) {
    const double value = first[r] + part * (next[r] - first[r]);
    Coefficient& coefficient =
        by_degree_[static_cast<std::size_t>(degree[r])][static_cast<std::size_t>(std::abs(order[r]))];
    (order[r] < 0.0 ? coefficient.h : coefficient.g) = value;
  }
}

FieldVector Igrf::on_sphere(double sin_latitude, double cos_latitude, double longitude_rad,
                            double radius_km) const {
  constexpr int kCount = kIgrfDegree + 1;
  // Of the colatitude. At the poles themselves the limit is taken from beside them.
  const double cosine = sin_latitude, sine = std::max(cos_latitude, 1e-9);
  double p[kCount][kCount] = {}, slope[kCount][kCount] = {};
  p[0][0] = 1.0;
  double cos_order[kCount], sin_order[kCount];
  for (int m = 0; m < kCount; ++m) {
    cos_order[m] = std::cos(m * longitude_rad);
    sin_order[m] = std::sin(m * longitude_rad);
  }
  const double ratio = kReferenceRadiusKm / radius_km;
  double power = ratio * ratio;
  FieldVector field;
  for (int n = 1; n < kCount; ++n) {
    power *= ratio;
    for (int m = 0; m < n; ++m) {
      const double size = std::sqrt(static_cast<double>(n * n - m * m));
      const double older =
          n > 1 ? std::sqrt(std::max(0.0, static_cast<double>((n - 1) * (n - 1) - m * m))) : 0.0;
      const double two = n > 1 ? p[n - 2][m] : 0.0, slope_two = n > 1 ? slope[n - 2][m] : 0.0;
      p[n][m] = ((2 * n - 1) * cosine * p[n - 1][m] - older * two) / size;
      slope[n][m] =
          ((2 * n - 1) * (cosine * slope[n - 1][m] - sine * p[n - 1][m]) - older * slope_two) / size;
    }
    const double factor = n > 1 ? std::sqrt((2.0 * n - 1.0) / (2.0 * n)) : 1.0;
    p[n][n] = factor * sine * p[n - 1][n - 1];
    slope[n][n] = factor * (cosine * p[n - 1][n - 1] + sine * slope[n - 1][n - 1]);
    for (int m = 0; m <= n; ++m) {
      const Coefficient& c = by_degree_[static_cast<std::size_t>(n)][static_cast<std::size_t>(m)];
      const double along = c.g * cos_order[m] + c.h * sin_order[m];
      field.down_nt -= (n + 1) * power * along * p[n][m];
      field.north_nt += power * along * slope[n][m];
      field.east_nt += power * m * (c.g * sin_order[m] - c.h * cos_order[m]) * p[n][m] / sine;
    }
  }
  return field;
}

FieldVector Igrf::at(double latitude_deg, double longitude_deg, double altitude_km) const {
  const double latitude = latitude_deg * kRadiansPerDegree;
  const double s = std::sin(latitude), c = std::cos(latitude);
  const double normal_km = wgs84_normal_km(s);
  const double out_km = (normal_km + altitude_km) * c,
               up_km = (normal_km * (1.0 - kWgs84SquareEccentricity) + altitude_km) * s;
  const double radius = std::hypot(out_km, up_km);
  const double sin_centric = up_km / radius, cos_centric = std::max(0.0, out_km / radius);
  const FieldVector on = on_sphere(sin_centric, cos_centric, longitude_deg * kRadiansPerDegree, radius);
  // By how much the ellipsoid's vertical is turned towards the pole.
  const double turn_sine = s * cos_centric - c * sin_centric, turn_cosine = c * cos_centric + s * sin_centric;
  return {on.north_nt * turn_cosine + on.down_nt * turn_sine, on.east_nt,
          on.down_nt * turn_cosine - on.north_nt * turn_sine};
}

}  // namespace vegard::sim
