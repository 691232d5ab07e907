#include "fit/photo/rayleigh/filter_band.h"

#include <algorithm>
#include <cmath>

#include "sim/view/sky/star_photometry.h"

namespace vegard::fit {
namespace {

/// The integrals over the band of what `of` gives: one times the transmission, and of the transmission alone.
template <class Of>
double integral_over_band(const FilterBand& band, const Of& of) {
  const double first = band.table_nm.empty() ? band.centre_nm - 0.5 * band.width_nm : band.table_nm.front();
  const double last = band.table_nm.empty() ? band.centre_nm + 0.5 * band.width_nm : band.table_nm.back();
  constexpr double kStep_nm = 0.1;
  constexpr int kMaxSteps = 5000;
  const int steps = std::clamp(static_cast<int>(std::ceil((last - first) / kStep_nm)), 20, kMaxSteps);
  const double step = (last - first) / steps;
  double sum = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double nm = first + (i + 0.5) * step;
    sum += of(nm) * transmission_at(band, nm) * step;
  }
  return sum;
}

}  // namespace

double transmission_at(const FilterBand& band, double wavelength_nm) {
  if (band.table_nm.empty())
    return std::abs(wavelength_nm - band.centre_nm) <= 0.5 * band.width_nm ? 1.0 : 0.0;
  const auto after = std::upper_bound(band.table_nm.begin(), band.table_nm.end(), wavelength_nm);
  if (after == band.table_nm.begin()) return 0.0;
  if (after == band.table_nm.end())
    return wavelength_nm == band.table_nm.back() ? band.transmission.back() : 0.0;
  const auto i = static_cast<std::size_t>(after - band.table_nm.begin());
  const double share = (wavelength_nm - band.table_nm[i - 1]) / (band.table_nm[i] - band.table_nm[i - 1]);
  return (1.0 - share) * band.transmission[i - 1] + share * band.transmission[i];
}

double star_photons_in_band(const FilterBand& band, double magnitude, double colour_index) {
  const double through = integral_over_band(
      band, [&](double nm) { return sim::star_photons_cm2_s_nm(magnitude, colour_index, nm); });
  return through / transmission_at(band, band.line_nm);
}

double middle_of_band_nm(const FilterBand& band) {
  return integral_over_band(band, [](double nm) { return nm; }) /
         integral_over_band(band, [](double) { return 1.0; });
}

}  // namespace vegard::fit
