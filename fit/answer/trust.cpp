#include "fit/answer/trust.h"

#include <cmath>

namespace vegard::fit {

const char* trust_name(Trust trust) {
  switch (trust) {
    case Trust::good:
      return "good";
    case Trust::doubtful:
      return "doubtful";
    case Trust::unconstrained:
      return "unconstrained";
  }
  return "";
}

ErrorScale error_scale(Quantity kind) {
  switch (kind) {
    case Quantity::distance:
      return {true, 0.05, 0.2};
    case Quantity::energy:
      return {true, 0.15, 0.5};
    case Quantity::energy_flux:
      return {true, 0.35, 1.0};
    case Quantity::altitude:
      return {false, 3.0, 10.0};
    case Quantity::place:
      return {false, 0.3, 1.5};
    case Quantity::azimuth:
      return {false, 3.0, 15.0};
    case Quantity::phase:
      return {false, 0.5, 1.5};
    case Quantity::width:
    case Quantity::ratio:
    case Quantity::other:
      break;
  }
  return {true, 0.25, 0.7};
}

Trust trust_of(Quantity kind, double value, double error) {
  const ErrorScale scale = error_scale(kind);
  const double size = scale.relative ? error / std::abs(value) : error;
  if (!(size < scale.none)) return Trust::unconstrained;
  return size <= scale.good ? Trust::good : Trust::doubtful;
}

}  // namespace vegard::fit
