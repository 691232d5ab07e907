// The free parameters of a sheet's sine, and their values for a sine that was found from lateral offsets.
#pragma once

#include <vector>

#include "fit/parameters/free_parameters.h"
#include "fit/search/lateral_offsets.h"

namespace vegard::fit {

/// Indices among the free numbers; -1 for a number that is not free.
struct SineNumbers {
  int wavelength = -1, phase = -1, thickness = -1;
};
SineNumbers sine_numbers(const std::vector<FreeNumber>& free, int sheet);

/// Sets `values` of the free numbers to a sine found from a sheet's lateral offsets: its wavelength,
/// amplitude and phase, and its straight line as centre and bearing. `start` is the scene that the free
/// numbers change.
void take_sine(const sim::Scene& start, const std::vector<FreeNumber>& free, const SineThroughOffsets& found,
               int sheet, std::vector<double>& values);

}  // namespace vegard::fit
