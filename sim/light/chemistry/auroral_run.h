// From electrons at the top to light: transport, chemistry, and the thermal electrons that both make and
// meet.
#pragma once

#include <vector>

#include "sim/light/chemistry/line_sources.h"

namespace vegard::sim {

struct AuroralRun {
  FieldAir column;  ///< with the thermal electrons of the first run, which the second one met
  ElectronRates rates;
  AuroralLight light;
};

/// `flux` as electron_transport() takes it. The column's thermal electrons, if it has any, are replaced: a
/// first run without them gives their density, a second one loses energy to them. Deterministic.
AuroralRun auroral_run(const Degradation& degradation, FieldAir column, const std::vector<double>& flux,
                       PitchAngles angles, const Reactions& reactions);

}  // namespace vegard::sim
