// The light of the auroral lines by its source: impact, cascades, chemistry.
//
//     427.8        N2+(B) of ionisation, with the ratio of 391.4 nm to the shell at 100 eV
//     337.1        N2(C) by impact
//     670.5        first positive bands: N2(B) by impact, from C, B' and a part of W
//     557.7        O(1S): impact on O, O2+ + e, N2(A) + O, impact on O2
//     630.0        O(1D): impact on O, O2+ + e, N(2D) + O2, O(1S) by way of 557.7, N+ + O2, impact on O2
//     520.0        N(2D): N2+ + O, N2+ + e, NO+ + e, impact on N2
//     777.4, 844.6 impact on O and O2
//
// Ions, thermal electrons and metastable atoms are as they are some time after the electrons have begun to
// fall, each atom made at the rate of its moment and lost to light and collisions since; or all are in a
// steady state. The light of the night's ions without aurora is taken off. Left out: transport of atoms,
// O(1D) by thermal electrons, the nightglow, scattered sunlight. Sources: data/electrons; docs/electrons.md.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "sim/light/chemistry/ion_balance.h"
#include "sim/light/transport/electron_transport.h"

namespace vegard::sim {

struct LineSource {
  std::string name;                   ///< "O2+ + e"
  std::vector<double> photons_cm3_s;  ///< [place]
};

struct SourcedLine {
  std::string column;  ///< of the emission tables: "ver_5577"
  double wavelength_nm = 0.0;
  std::vector<LineSource> sources;
  /// Of the metastable atoms, [place]: light, collisions with the air and with the electrons of the last
  /// moment. Empty of a prompt line.
  std::vector<double> lifetime_s;

  std::vector<double> photons_cm3_s() const;
};

struct AuroralLight {
  std::vector<SourcedLine> lines;  ///< by wavelength
  std::vector<IonDensities> ions;  ///< [place]
};

/// Returns the rayleighs seen from straight below, 1e-6 times the integral over the altitude.
double column_rayleigh(const FieldAir& column, const std::vector<double>& photons_cm3_s);

/// The way from electrons at the top to light: transport, chemistry, and thermal electrons, which both depend
/// on.
struct AuroralRun {
  FieldAir column;  ///< with the thermal electrons of the first run, which the second one met
  ElectronRates rates;
  AuroralLight light;
};

/// Computes the light of electrons, `seconds` after they have begun to fall, or in a steady state; `flux` as
/// in electron_transport(). The column's thermal electrons, if it has any, are replaced: a first run without
/// them gives their density, a second one loses energy to them. Deterministic.
AuroralRun auroral_run(const Degradation& degradation, FieldAir column, const std::vector<double>& flux,
                       PitchAngles angles, const Reactions& reactions,
                       double seconds = std::numeric_limits<double>::infinity());

}  // namespace vegard::sim
