#include "sim/light/transport/field_air.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "sim/base/error.h"
#include "sim/base/file/csv_table.h"
#include "sim/base/number/constants.h"
#include "sim/light/atmosphere.h"

namespace vegard::sim {
namespace {

constexpr std::array<double, kGases> kMassNumber = {28.0, 32.0, 16.0};
constexpr std::array<const char*, kGases> kColumns = {"nN2", "nO2", "nO"};
constexpr double kMinDensity = 1e-30;  // cm^-3, for logarithms of what is not there

struct AirPlace {
  double temperature_k = 0.0;
  std::array<double, kGases> density_cm3{};
  double no_cm3 = 0.0, n_cm3 = 0.0, electron_temperature_k = 0.0;
};

AirPlace air_place_at(const AirTable& table, double altitude_km) {
  const auto after = std::upper_bound(table.altitude_km.begin(), table.altitude_km.end() - 1, altitude_km);
  const auto high = static_cast<std::size_t>(std::max(after - table.altitude_km.begin(), std::ptrdiff_t{1}));
  const std::size_t low = high - 1;
  const double way =
      (altitude_km - table.altitude_km[low]) / (table.altitude_km[high] - table.altitude_km[low]);
  const auto straight = [&](const std::vector<double>& values) {
    return values[low] + way * (values[high] - values[low]);
  };
  const auto falling = [&](const std::vector<double>& values) {
    const double a = std::log(std::max(kMinDensity, values[low]));
    return std::exp(a + way * (std::log(std::max(kMinDensity, values[high])) - a));
  };
  AirPlace place;
  place.temperature_k = straight(table.temperature_k);
  for (std::size_t g = 0; g < kGases; ++g) place.density_cm3[g] = falling(table.density_cm3[g]);
  place.no_cm3 = table.no_cm3.empty() ? nitric_oxide_cm3(altitude_km) : falling(table.no_cm3);
  place.n_cm3 = table.n_cm3.empty() ? 0.0 : falling(table.n_cm3);
  place.electron_temperature_k = table.electron_temperature_k.empty()
                                     ? electron_temperature_k(altitude_km, place.temperature_k)
                                     : straight(table.electron_temperature_k);
  return place;
}

double mass_density(const AirPlace& place) {
  double sum = 0.0;
  for (std::size_t g = 0; g < kGases; ++g) sum += kMassNumber[g] * place.density_cm3[g];
  return sum;
}

/// Returns the distance over which the density falls by e, from 1 km of it.
double scale_height_km(const AirTable& table, double altitude_km) {
  const double end = table.altitude_km.back(), low = std::min(altitude_km, end - 1.0);
  const double fall =
      std::log(mass_density(air_place_at(table, low)) / mass_density(air_place_at(table, low + 1.0)));
  return fall > 0.0 ? 1.0 / fall : 1e9;
}

}  // namespace

double nitric_oxide_cm3(double altitude_km) {
  // A layer with the scale heights of what makes it below its peak and of diffusion above.
  constexpr double kMaxCm3 = 1.5e8, kPeakKm = 107.0, kBelowKm = 8.0, kAboveKm = 18.0;
  const double z = (altitude_km - kPeakKm) / (altitude_km < kPeakKm ? kBelowKm : kAboveKm);
  return kMaxCm3 * (1.0 + std::abs(z)) * std::exp(-std::abs(z));
}

double electron_temperature_k(double altitude_km, double temperature_k) {
  constexpr double kFromKm = 115.0, kMaxK = 1500.0, kScaleKm = 123.0;
  if (altitude_km <= kFromKm) return temperature_k;
  return temperature_k - kMaxK * std::expm1(-(altitude_km - kFromKm) / kScaleKm);
}

AirTable with_oxygen_factor(AirTable table, double factor) {
  for (double& density : table.density_cm3[static_cast<std::size_t>(Gas::o)]) density *= factor;
  return table;
}

AirTable standard_air_table() {
  AirTable table;
  for (double altitude = 80.0; altitude <= 640.0; altitude += altitude < 130.0 ? 1.0 : 5.0) {
    const Air air = standard_air(altitude);
    table.altitude_km.push_back(altitude);
    table.temperature_k.push_back(air.temperature_k);
    table.density_cm3[0].push_back(air.n2_cm3);
    table.density_cm3[1].push_back(air.o2_cm3);
    table.density_cm3[2].push_back(air.o_cm3);
  }
  return table;
}

AirTable read_air_table(const std::string& text, const std::string& name) {
  constexpr double kMaxBottomKm = 100.0, kMinTopKm = 300.0, kLargest = 1e20, kHighestKm = 2000.0;
  const CsvTable csv = read_csv_table(text, name);
  AirTable table;
  table.altitude_km = csv.column("altitude_km");
  csv.require_increasing("altitude_km");
  csv.require_within("altitude_km", 0.0, kHighestKm);
  table.temperature_k = csv.column("T_K");
  csv.require_within("T_K", 1.0, 1e4);
  for (std::size_t g = 0; g < kGases; ++g) {
    table.density_cm3[g] = csv.column(kColumns[g]);
    csv.require_within(kColumns[g], 0.0, kLargest);
  }
  const auto optional_column = [&](const char* name, double least, double most) {
    if (!csv.has(name)) return std::vector<double>();
    csv.require_within(name, least, most);
    return csv.column(name);
  };
  table.no_cm3 = optional_column("nNO", 0.0, kLargest);
  table.n_cm3 = optional_column("nN4S", 0.0, kLargest);
  table.electron_temperature_k = optional_column("Te_K", 1.0, 1e5);
  if (table.altitude_km.front() > kMaxBottomKm || table.altitude_km.back() < kMinTopKm)
    throw unreadable(name, "the air reaches from " +
                               std::to_string(static_cast<int>(table.altitude_km.front())) + " to " +
                               std::to_string(static_cast<int>(table.altitude_km.back())) + " km")
        .expected("a table that begins at 100 km or below and ends at 300 km or above")
        .hint("electrons of some keV stop near 100 km and begin to above 300 km");
  for (std::size_t r = 0; r < csv.rows(); ++r)
    if (!(table.density_cm3[0][r] + table.density_cm3[1][r] + table.density_cm3[2][r] > 0.0))
      throw csv.bad_row(r, "there is no air").expected("a density above 0 of N2, O2 or O");
  return table;
}

AirTable air_at(const AirTable& table, const std::vector<double>& altitudes_km) {
  AirTable result;
  result.altitude_km = altitudes_km;
  for (const double altitude : altitudes_km) {
    const AirPlace place = air_place_at(table, altitude);
    result.temperature_k.push_back(place.temperature_k);
    for (std::size_t g = 0; g < kGases; ++g) result.density_cm3[g].push_back(place.density_cm3[g]);
    result.no_cm3.push_back(place.no_cm3);
    result.n_cm3.push_back(place.n_cm3);
    result.electron_temperature_k.push_back(place.electron_temperature_k);
  }
  return result;
}

FieldAir field_air(const AirTable& table, double dip_deg, double refinement) {
  constexpr double kMinStepKm = 0.2, kStepsPerHeight = 30.0, kMaxStepKm = 20.0;
  FieldAir column;
  const double bottom = table.altitude_km.front(), top = table.altitude_km.back();
  const double path_per_km = 1e5 / std::sin(dip_deg * kRadiansPerDegree);
  for (double altitude = bottom;;) {
    const AirPlace place = air_place_at(table, altitude);
    column.altitude_km.push_back(altitude);
    column.path_cm.push_back((altitude - bottom) * path_per_km);
    column.temperature_k.push_back(place.temperature_k);
    for (std::size_t g = 0; g < kGases; ++g) column.density_cm3[g].push_back(place.density_cm3[g]);
    column.no_cm3.push_back(place.no_cm3);
    column.n_cm3.push_back(place.n_cm3);
    column.electron_temperature_k.push_back(place.electron_temperature_k);
    if (altitude >= top) break;
    const double step =
        std::clamp(scale_height_km(table, altitude) / kStepsPerHeight, kMinStepKm, kMaxStepKm) / refinement;
    altitude = altitude + 1.5 * step >= top ? top : altitude + step;
  }
  return column;
}

StoppingAir stopping_air(const FieldAir& column, std::size_t place) {
  return stopping_air(column.altitude_km[place], column.temperature_k[place], column.density_cm3[0][place],
                      column.density_cm3[1][place], column.density_cm3[2][place]);
}

}  // namespace vegard::sim
