#include "sim/light/chemistry/auroral_run.h"

#include <utility>

namespace vegard::sim {

AuroralRun auroral_run(const Degradation& degradation, FieldAir column, const std::vector<double>& flux,
                       PitchAngles angles, const Reactions& reactions) {
  AuroralRun run;
  run.column = std::move(column);
  run.column.electrons_cm3.clear();
  run.rates = electron_transport(degradation, run.column, flux, angles);
  run.light = auroral_light(degradation, run.column, run.rates, reactions);
  for (const IonDensities& ions : run.light.ions) run.column.electrons_cm3.push_back(ions.electrons);
  run.rates = electron_transport(degradation, run.column, flux, angles);
  run.light = auroral_light(degradation, run.column, run.rates, reactions);
  return run;
}

}  // namespace vegard::sim
