#include "sim/scene/lines/emission_lines.h"

#include <cmath>

namespace vegard::sim {
namespace {

constexpr double kNebularFirstNm = 400.0, kNebularLastNm = 700.0, kNebularStepNm = 10.0;  // of the continua

constexpr const char* kOxygenSource =
    "500.7 to 495.9 as 2.98 in energy (Storey and Zeippen 2000, MNRAS 312, 813; Osterbrock and Ferland "
    "2006), 3.01 in photons; both come from one level, so that no nebula changes it";
constexpr const char* kNitrogenSource =
    "658.4 to 654.8 as 3.05 in energy (Storey and Zeippen 2000), 3.07 in photons; both come from one level";
constexpr const char* kSulphurSource =
    "671.6 to 673.1 as 1.2, as in gas of some 200 electrons to the cm³ at 10⁴ K (Osterbrock and Ferland "
    "2006, figure 5.8): from 1.45 in thin gas to 0.44 in dense";
constexpr const char* kStarlightSource =
    "photons by Planck's law at 15 000 K, a B star's, times λ^-1.3, about as small grains scatter "
    "(ESTIMATED, the exponent to 0.5); every 10 nm";
constexpr const char* kSynchrotronSource =
    "a power law with energy per frequency as ν^-0.43, the Crab's (Véron-Cetty and Woltjer 1993, A&A 270, "
    "370, freed of reddening): photons per wavelength as λ^-0.57; every 10 nm";

/// Bands of a continuum, with photons per wavelength in these proportions.
template <class Photons>
std::vector<LineComponent> bands_of(const Photons& photons) {
  std::vector<LineComponent> bands;
  double sum = 0.0;
  for (double nm = kNebularFirstNm; nm <= kNebularLastNm; nm += kNebularStepNm) {
    bands.push_back({nm, photons(nm)});
    sum += bands.back().share;
  }
  for (LineComponent& band : bands) band.share /= sum;
  return bands;
}

/// Photons per wavelength of a black body go as λ^-4 / (exp(hc / λkT) - 1).
double starlight(double nm) {
  constexpr double kTemperatureK = 15000.0, kSecondRadiationConstantNmK = 1.438776877e7;
  constexpr double kScattering = 1.3;
  return std::pow(nm, -4.0 - kScattering) / std::expm1(kSecondRadiationConstantNmK / (nm * kTemperatureK));
}

double synchrotron(double nm) { return std::pow(nm, 0.43 + 1.0 - 2.0); }

}  // namespace

// Lifetimes: the sums of the Einstein coefficients of hydrogen's levels n = 3 and 4, 1.0e8 and 3.0e7 s^-1, of
// He+ those times 2^4; of the forbidden lines Osterbrock and Ferland 2006, "Astrophysics of Gaseous Nebulae
// and Active Galactic Nuclei", tables 3.12 and 3.13: O++ 2.0e-2 + 6.8e-3, N+ 3.0e-3 + 9.8e-4, S+ 8.8e-4 s^-1.
// PyNeb's files have 2.05e-2 + 6.8e-3 (Storey and Zeippen 2000), 2.91e-3 + 9.9e-4 (Froese Fischer and Tachiev
// 2004) and 8.9e-4 (Keenan et al. 1993): lifetimes are within 2 %.
std::vector<EmissionLine> nebular_lines() {
  return {
      {450.0, "*", "starlight scattered by dust, 400 to 700 nm", 0.0, "", 0.0, "", "", bands_of(starlight),
       kStarlightSource},
      {468.6, "He+", "n = 4 to 3", 2e-9, "", 0.0, "", "[Ar IV] 471.1, He 471.3", {}},
      {486.1, "H", "Balmer beta, n = 4 to 2", 3.3e-8, "", 0.0, "", "", {}},
      {500.7,
       "O++",
       "(1D2)-(3P2), with (1D2)-(3P1) 495.9",
       37.0,
       "",
       0.0,
       "",
       "",
       {{495.9, 0.249}, {500.7, 0.751}},
       kOxygenSource},
      {550.0, "e-", "synchrotron light, 400 to 700 nm", 0.0, "", 0.0, "", "", bands_of(synchrotron),
       kSynchrotronSource},
      {656.3, "H", "Balmer alpha, n = 3 to 2", 1e-8, "", 0.0, "", "N+ 654.8 and 658.4", {}},
      {658.4,
       "N+",
       "(1D2)-(3P2), with (1D2)-(3P1) 654.8",
       251.0,
       "",
       0.0,
       "",
       "H Balmer alpha 656.3",
       {{654.8, 0.246}, {658.4, 0.754}},
       kNitrogenSource},
      {673.1,
       "S+",
       "(2D3/2)-(4S3/2), with (2D5/2)-(4S3/2) 671.6",
       1136.0,
       "",
       0.0,
       "",
       "",
       {{671.6, 0.545}, {673.1, 0.455}},
       kSulphurSource},
  };
}

}  // namespace vegard::sim
