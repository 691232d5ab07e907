#include "sim/light/air/msis_expansion.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "sim/base/file/csv_table.h"

namespace vegard::sim {
namespace {

constexpr double kMsisDegree = 1.74533e-2;  // radians
constexpr double kMsisDay = 1.72142e-2;     // of the year, radians
constexpr double kMsisHour = 0.2618;        // of the local time, radians
constexpr double kMsisSecond = 7.2722e-5;   // of the universal time, radians

/// The places of the parameters of magnetic activity, for its daily index and for its history.
struct ActivityParameters {
  int mean, second, fourth;                         // with P0, P2, P4
  int season;                                       // the first of three with P1, P3, P5 and the season
  int local_time, local_phase;                      // the first of three with P11, P31, P51
  int tilt, longitude_2, longitude_4, longitude_6;  // with P1; P21, P41, P61
  int longitude_phase;
  int season_longitude, season_longitude_phase;  // the first of three with P11, P31, P51
  int universal, universal_phase;                // the first of three with P1, P3, P5
};

constexpr ActivityParameters kDailyIndex = {32, 45, 34, 100, 121, 124, 120, 60, 61, 62, 63, 115, 118, 83, 75};
constexpr ActivityParameters kIndexHistory = {50, 96, 54, 125, 128, 131, 132, 52,
                                              98, 67, 97, 133, 136, 55,  58};
constexpr int kDailyDecay = 43, kDailyShare = 44, kHistoryDecay = 24, kHistoryShare = 25;
constexpr int kMemory = 51, kMemoryLatitude = 138;

constexpr std::array<int, 3> kOdd = {1, 3, 5}, kEven = {2, 4, 6};

double at(const MsisParameters& p, int number) { return p[static_cast<std::size_t>(number)]; }

/// Returns the index above quiet conditions, which grows more slowly where it is large (Hedin 1987, equation
/// A24d).
double tempered_index(double ap, double decay, double share) {
  const double above = ap - 4.0;
  return above + (share - 1.0) * (above + std::expm1(-decay * above) / decay);
}

/// Returns the associated Legendre functions P_l^m without the sign (-1)^m, from those of the order by
/// recurrence.
std::array<std::array<double, 8>, 4> legendre_functions(double sine, double cosine) {
  std::array<std::array<double, 8>, 4> p{};
  double sectoral = 1.0;
  for (std::size_t m = 0; m < 4; ++m) {
    p[m][m] = sectoral;
    const auto order = static_cast<double>(m);
    for (std::size_t l = m + 1; l < 8; ++l) {
      const auto degree = static_cast<double>(l);
      const double before = l >= 2 && l - 2 >= m ? p[m][l - 2] : 0.0;
      p[m][l] =
          ((2.0 * degree - 1.0) * sine * p[m][l - 1] - (degree + order - 1.0) * before) / (degree - order);
    }
    sectoral *= (2.0 * order + 1.0) * cosine;
  }
  return p;
}

constexpr std::array<const char*, kMsisGases> kDensityColumns = {"N2", "O2", "O", "He", "Ar", "H", "N"};
constexpr std::array<const char*, 4> kNodeColumns = {"T_110", "T_100", "T_90", "T_72"};

MsisParameters parameters_of(const CsvTable& table, const char* column) {
  MsisParameters all{};
  const std::vector<double>&number = table.column("parameter"), &value = table.column(column);
  for (std::size_t r = 0; r < table.rows(); ++r) all[static_cast<std::size_t>(number[r])] = value[r];
  return all;
}

MsisCoefficients read_coefficients() {
  const CsvTable constants = embedded_csv_table("msis_constants.csv"),
                 gases = embedded_csv_table("msis_gases.csv"),
                 thermosphere = embedded_csv_table("msis_thermosphere.csv"),
                 nodes = embedded_csv_table("msis_nodes.csv");
  const auto constant = [&](const char* name) { return constants.column(name).front(); };
  MsisCoefficients all;
  all.t_inf_k = constant("T_inf_K");
  all.t_lb_k = constant("T_lb_K");
  all.gradient_k_km = constant("gradient_K_km");
  all.node_k = {constant("T_110_K"), constant("T_100_K"), constant("T_90_K"), constant("T_72_K")};
  all.node_slope_k_km = constant("gradient_72_K_km");
  all.boundary_km = constant("boundary_km");
  all.join_km = constant("join_km");
  all.mean_mass = constant("mean_mass");
  all.turbopause_season = constant("turbopause_season");
  all.transition = constant("transition");
  all.hot_o_cm3 = constant("hot_O_cm3");
  all.hot_o_k = constant("hot_O_temperature_K");
  all.hot_o_km = constant("hot_O_km");
  all.hot_o_length_km = constant("hot_O_length_km");
  all.t_inf = parameters_of(thermosphere, "T_inf");
  all.t_lb = parameters_of(thermosphere, "T_lb");
  all.gradient = parameters_of(thermosphere, "gradient");
  all.hot_o = parameters_of(thermosphere, "hot_O");
  for (std::size_t n = 0; n < all.node.size(); ++n) all.node[n] = parameters_of(nodes, kNodeColumns[n]);
  all.node_slope = parameters_of(nodes, "gradient_72");
  for (std::size_t g = 0; g < kMsisGases; ++g) {
    const auto number = [&](const char* name) { return gases.column(name)[g]; };
    MsisGasNumbers& gas = all.gas[g];
    gas.mass_number = number("mass_number");
    gas.thermal_diffusion = number("thermal_diffusion");
    gas.boundary_cm3 = number("boundary_cm3");
    gas.turbopause_km = number("turbopause_km");
    gas.mixed_below_km = number("mixed_below_km");
    gas.mixing_ratio = number("mixing_ratio");
    gas.bottom = {number("bottom_log"), number("bottom_solar"), number("bottom_km"),
                  number("bottom_length_km"), number("bottom_length_2_km")};
    gas.departure = {number("departure_log"), number("departure_solar"), number("departure_km"),
                     number("departure_length_km"), number("departure_length_2_km")};
    gas.departure_below_km = number("departure_below_km");
    gas.density = parameters_of(thermosphere, kDensityColumns[g]);
  }
  return all;
}

}  // namespace

MsisExpansion::MsisExpansion(const MsisDrivers& drivers)
    : drivers_(drivers), flux_(drivers.f107a - 150.0), flux_today_(drivers.f107 - drivers.f107a) {
  const double latitude = kMsisDegree * drivers.latitude_deg;
  legendre_ = legendre_functions(std::sin(latitude), std::cos(latitude));
  for (std::size_t k = 1; k < 4; ++k) {
    const double angle = static_cast<double>(k) * kMsisHour * drivers.local_time_h;
    cosine_[k] = std::cos(angle);
    sine_[k] = std::sin(angle);
  }
}

double MsisExpansion::annual_cosine(double phase_day) const {
  return std::cos(kMsisDay * (drivers_.day_of_year - phase_day));
}

double MsisExpansion::semiannual_cosine(double phase_day) const {
  return std::cos(2.0 * kMsisDay * (drivers_.day_of_year - phase_day));
}

/// Returns the sum of three parameters that stand side by side, each times its Legendre function.
double MsisExpansion::series(const MsisParameters& p, int first, int order,
                             std::array<int, 3> degrees) const {
  double sum = 0.0;
  for (const int degree : degrees)
    sum += at(p, first++) * legendre_[static_cast<std::size_t>(order)][static_cast<std::size_t>(degree)];
  return sum;
}

/// Returns a wave with one maximum around the Earth, at rest on its surface.
double MsisExpansion::longitudinal(const MsisParameters& p, int cosine, int sine,
                                   std::array<int, 3> degrees) const {
  const double longitude = kMsisDegree * drivers_.longitude_deg;
  return series(p, cosine, 1, degrees) * std::cos(longitude) +
         series(p, sine, 1, degrees) * std::sin(longitude);
}

/// Returns the waves that go round with the Sun: one, two and three a day. The nodes have the shorter series.
double MsisExpansion::daily_part(const MsisParameters& p, double season, bool long_series) const {
  const auto& [p0, p1, p2, p3] = legendre_;
  double once_cos = p[3] * p1[1] + p[4] * p1[3] + p[11] * p1[2] * season;
  double once_sin = p[6] * p1[1] + p[7] * p1[3] + p[12] * p1[2] * season;
  const double twice_cos = p[5] * p2[2] + p[41] * p2[4] + (p[23] * p2[3] + p[35] * p2[5]) * season;
  const double twice_sin = p[8] * p2[2] + p[42] * p2[4] + (p[33] * p2[3] + p[36] * p2[5]) * season;
  double thrice_sin = p[39] * p3[3], thrice_cos = p[40] * p3[3];
  if (long_series) {
    once_cos += p[27] * p1[5];
    once_sin += p[28] * p1[5];
    thrice_sin += (p[93] * p3[4] + p[46] * p3[6]) * season;
    thrice_cos += (p[94] * p3[4] + p[48] * p3[6]) * season;
  }
  return once_cos * cosine_[1] + once_sin * sine_[1] + twice_cos * cosine_[2] + twice_sin * sine_[2] +
         thrice_cos * cosine_[3] + thrice_sin * sine_[3];
}

double MsisExpansion::activity(const MsisParameters& p) const {
  if (!drivers_.ap_history) return tempered_index(drivers_.ap, p[kDailyDecay], p[kDailyShare]);
  if (p[kMemory] == 0.0) return 0.0;
  // The air forgets by e^(-3 h * rate) from one three-hourly index to the next: Hedin 1987, equation A24.
  constexpr double kThreeHours = 10800.0, kMaxMemory = 0.99999;
  const double keeps =
      std::min(kMaxMemory, std::exp(-kThreeHours * std::abs(p[kMemory]) /
                                    (1.0 + p[kMemoryLatitude] * (45.0 - std::abs(drivers_.latitude_deg)))));
  std::array<double, 7> index{};
  for (std::size_t k = 1; k < index.size(); ++k)
    index[k] = tempered_index((*drivers_.ap_history)[k], std::abs(p[kHistoryDecay]), p[kHistoryShare]);
  const auto sum_of_powers = [&](double count) { return (1.0 - std::pow(keeps, count)) / (1.0 - keeps); };
  const double recent = index[1] + keeps * (index[2] + keeps * (index[3] + keeps * index[4]));
  const double old =
      (index[5] * std::pow(keeps, 4.0) + index[6] * std::pow(keeps, 12.0)) * sum_of_powers(8.0);
  return (recent + old) / (1.0 + sum_of_powers(19.0) * std::sqrt(keeps));
}

double MsisExpansion::active_part(const MsisParameters& p, double season) const {
  const ActivityParameters& a = drivers_.ap_history ? kIndexHistory : kDailyIndex;
  const auto& p0 = legendre_[0];
  const auto& p1 = legendre_[1];
  const double longitude = drivers_.longitude_deg;
  const double fixed = at(p, a.mean) + at(p, a.second) * p0[2] + at(p, a.fourth) * p0[4] +
                       series(p, a.season, 0, kOdd) * season;
  const double with_the_sun =
      series(p, a.local_time, 1, kOdd) * std::cos(kMsisHour * (drivers_.local_time_h - at(p, a.local_phase)));
  const double with_the_pole =
      (1.0 + at(p, a.tilt) * p0[1]) *
          (at(p, a.longitude_2) * p1[2] + at(p, a.longitude_4) * p1[4] + at(p, a.longitude_6) * p1[6]) *
          std::cos(kMsisDegree * (longitude - at(p, a.longitude_phase))) +
      series(p, a.season_longitude, 1, kOdd) * season *
          std::cos(kMsisDegree * (longitude - at(p, a.season_longitude_phase)));
  const double with_the_clock =
      series(p, a.universal, 0, kOdd) * std::cos(kMsisSecond * (drivers_.ut_s - at(p, a.universal_phase)));
  return activity(p) * (fixed + with_the_sun + with_the_pole + with_the_clock);
}

double MsisExpansion::thermosphere(const MsisParameters& p) const {
  const auto& p0 = legendre_[0];
  const auto& p2 = legendre_[2];
  const double season = annual_cosine(p[13]);
  const double today = flux_today_ * (p[19] + p[20] * flux_today_);
  double sum = p[19] * flux_today_ * (1.0 + p[59] * flux_) + p[20] * flux_today_ * flux_today_ +
               flux_ * (p[21] + p[29] * flux_);
  sum += p[30] + p[1] * p0[2] + p[2] * p0[4] + p[22] * p0[6] + p[14] * p0[2] * flux_ + p[26] * p0[1];
  sum += p[18] * annual_cosine(p[31]) + (p[15] + p[16] * p0[2]) * semiannual_cosine(p[17]) +
         p[37] * p0[1] * semiannual_cosine(p[38]);
  sum += (1.0 + p[47] * flux_ + today) * (p[9] * p0[1] + p[10] * p0[3]) * season;
  sum += (1.0 + p[49] * flux_ + today) * daily_part(p, season, true);
  sum += active_part(p, season);
  sum += (1.0 + p[80] * flux_) * (longitudinal(p, 64, 90, kEven) + longitudinal(p, 103, 106, kOdd) +
                                  season * longitudinal(p, 109, 112, kOdd));
  sum += (1.0 + p[95] * p0[1]) * (1.0 + p[81] * flux_) * (1.0 + p[119] * p0[1] * season) *
         series(p, 68, 0, kOdd) * std::cos(kMsisSecond * (drivers_.ut_s - p[71]));
  sum += (1.0 + p[137] * flux_) * (p[76] * p2[3] + p[77] * p2[5] + p[78] * p2[7]) *
         std::cos(kMsisSecond * (drivers_.ut_s - p[79]) + 2.0 * kMsisDegree * drivers_.longitude_deg);
  return sum;
}

double MsisExpansion::node(const MsisParameters& p, double activity) const {
  const auto& p0 = legendre_[0];
  double sum = p[21] * flux_ + p[1] * p0[2] + p[2] * p0[4] + p[22] * p0[6] + p[26] * p0[1] + p[14] * p0[3] +
               p[59] * p0[5];
  sum += (p[18] + p[47] * p0[2] + p[29] * p0[4]) * annual_cosine(p[31]) +
         (p[15] + p[16] * p0[2] + p[30] * p0[4]) * semiannual_cosine(p[17]) +
         (p[9] * p0[1] + p[10] * p0[3] + p[20] * p0[5]) * annual_cosine(p[13]) +
         p[37] * p0[1] * semiannual_cosine(p[38]);
  sum += daily_part(p, annual_cosine(p[13]), false);
  sum += drivers_.ap_history ? activity * (p[50] + p[96] * p0[2]) : activity * (p[32] + p[45] * p0[2]);
  sum += (1.0 + p0[1] * (p[80] * annual_cosine(p[81]) + p[85] * semiannual_cosine(p[86])) +
          p[83] * annual_cosine(p[84]) + p[87] * semiannual_cosine(p[88])) *
         (longitudinal(p, 64, 90, kEven) + longitudinal(p, 74, 77, kOdd));
  return sum;
}

const MsisCoefficients& msis_coefficients() {
  static const MsisCoefficients all = read_coefficients();
  return all;
}

}  // namespace vegard::sim
