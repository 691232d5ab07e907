#include "sim/scene/lines/emission_lines.h"

#include <cmath>

namespace vegard::sim {
namespace {

constexpr double kSolarFirstNm = 400.0, kSolarLastNm = 700.0, kSolarStepNm = 10.0;  // of white light
constexpr double kWhiteNm = 560.0;

constexpr const char* kWhiteSource =
    "photons by Planck's law at 5772 K, the Sun's effective temperature (IAU 2015, resolution B3), which "
    "free electrons scatter alike at all wavelengths; every 10 nm";

std::vector<LineComponent> white_light() {
  constexpr double kTemperatureK = 5772.0, kSecondRadiationConstantNmK = 1.438776877e7;
  std::vector<LineComponent> bands;
  double sum = 0.0;
  for (double nm = kSolarFirstNm; nm <= kSolarLastNm; nm += kSolarStepNm) {
    bands.push_back(
        {nm, std::pow(nm, -4.0) / std::expm1(kSecondRadiationConstantNmK / (nm * kTemperatureK))});
    sum += bands.back().share;
  }
  for (LineComponent& band : bands) band.share /= sum;
  return bands;
}

struct Band {
  double wavelength_nm;
  const char *species, *transition;
  TemperatureResponse response;
};

constexpr const char* kEquilibrium =
    "where the ion is most abundant in CHIANTI's ionisation equilibrium (chianti.ioneq of the database: Fe "
    "IX 5.88, X 6.02, XII 6.18, XIV 6.29, XV 6.35), to 0.05";
constexpr const char* kTransitionRegion =
    "8 10^4 K, the upper end of the 6 to 8 10^4 K that the Extreme ultraviolet Imaging Telescope's team "
    "gives for its band (SOHO, 13 May 2004); ESTIMATED to 0.2, since He+ is most abundant at 4.69 in "
    "CHIANTI's equilibrium, in which helium is not";
constexpr const char* kAiaBand =
    "as table 1 of the Atmospheric Imaging Assembly has its band (Lemen et al. 2012, Sol. Phys. 275, 17), to "
    "0.1; CHIANTI's equilibrium has Fe XIV 6.29, XVI 6.44, XVIII 6.85, XXI 7.06";

// The widths are ours, ESTIMATED to 0.03: a Gaussian of some 0.35 of log10 T over half its height (Schmelz
// and Martens 2005, astro-ph/0511487, find 0.2 to 0.3 for single lines; an imager's band adds the
// neighbouring ions).
constexpr Band kBands[] = {
    {9.4, "Fe17+", "Fe XVIII 93.93 Å", {6.80, 0.16, kAiaBand}},
    {13.1, "Fe20+", "Fe XXI 128.75 Å", {7.00, 0.15, kAiaBand}},
    {17.1, "Fe8+", "Fe IX 171.07 Å", {5.85, 0.16, kEquilibrium}},
    {19.5, "Fe11+", "Fe XII 195.12 Å", {6.20, 0.14, kEquilibrium}},
    {21.1, "Fe13+", "Fe XIV 211.32 Å", {6.30, 0.14, kAiaBand}},
    {28.4, "Fe14+", "Fe XV 284.16 Å", {6.35, 0.15, kEquilibrium}},
    {30.4, "He+", "He II 303.78 Å", {4.90, 0.20, kTransitionRegion}},
    {33.5, "Fe15+", "Fe XVI 335.41 Å", {6.40, 0.15, kAiaBand}},
    {530.3, "Fe13+", "Fe XIV, the green line", {6.30, 0.14, kEquilibrium}},
    {637.4, "Fe9+", "Fe X, the red line", {6.05, 0.14, kEquilibrium}},
};

}  // namespace

std::vector<EmissionLine> solar_lines() {
  std::vector<EmissionLine> lines;
  for (const Band& band : kBands)
    lines.push_back({band.wavelength_nm, band.species, band.transition, 0.0, "", 0.0, "", "", {}});
  lines.push_back({kWhiteNm, "e-", "white light scattered by free electrons, 400 to 700 nm", 0.0, "", 0.0, "",
                   "", white_light(), kWhiteSource});
  return lines;
}

std::optional<TemperatureResponse> temperature_response(double wavelength_nm) {
  for (const Band& band : kBands)
    if (std::abs(band.wavelength_nm - wavelength_nm) < 0.05) return band.response;
  return std::nullopt;
}

bool is_solar(const EmissionLine& line) {
  return line.wavelength_nm == kWhiteNm || temperature_response(line.wavelength_nm).has_value();
}

}  // namespace vegard::sim
