#include "sim/view/colour/illuminants.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include "sim/base/file/csv_table.h"

namespace vegard::sim {

double black_body_power(double wavelength_nm, double temperature_k) {
  constexpr double kSecondRadiationConstantNmK = 1.438776877e7;
  return std::pow(wavelength_nm / 560.0, -5.0) /
         std::expm1(kSecondRadiationConstantNmK / (wavelength_nm * temperature_k));
}

double daylight_power(double wavelength_nm, double correlated_temperature_k) {
  static const CsvTable table = embedded_csv_table("daylight_components_10nm.csv");
  const std::vector<double>& nm = table.numbers.at(0);
  if (wavelength_nm < nm.front() || wavelength_nm > nm.back()) return 0.0;
  assert(correlated_temperature_k >= 4000.0 && correlated_temperature_k <= 25000.0);
  const double k = 1e3 / correlated_temperature_k;
  const double x = correlated_temperature_k <= 7000.0 ? 0.244063 + k * (0.09911 + k * (2.9678 - k * 4.6070))
                                                      : 0.237040 + k * (0.24748 + k * (1.9018 - k * 2.0064));
  const double y = -0.275 + x * (2.870 - x * 3.000);
  // The CIE rounds the shares to three digits.
  const auto rounded = [](double share) { return std::round(share * 1e3) * 1e-3; };
  const double m = 0.0241 + 0.2562 * x - 0.7341 * y;
  const double m1 = rounded((-1.3515 - 1.7703 * x + 5.9114 * y) / m);
  const double m2 = rounded((0.0300 - 31.4424 * x + 30.0717 * y) / m);
  const std::size_t i = std::min<std::size_t>(
      std::upper_bound(nm.begin(), nm.end(), wavelength_nm) - nm.begin(), nm.size() - 1);
  const double t = (wavelength_nm - nm[i - 1]) / (nm[i] - nm[i - 1]);
  const auto component = [&](int c) {
    const std::vector<double>& s = table.numbers.at(c);
    return s[i - 1] + t * (s[i] - s[i - 1]);
  };
  return component(1) + m1 * component(2) + m2 * component(3);
}

}  // namespace vegard::sim
