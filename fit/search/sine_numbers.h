// The free numbers of a sheet's sine, and how a sine that was found becomes theirs.
#pragma once

#include <vector>

#include "fit/parameters/free_parameters.h"
#include "fit/search/lateral_offsets.h"

namespace vegard::fit {

/// Indices among the free numbers; -1 for what is not free.
struct SineNumbers {
  int wavelength = -1, phase = -1, thickness = -1;
};
SineNumbers sine_numbers(const std::vector<FreeNumber>& free, int sheet);

/// Puts a sine found from a sheet's lateral offsets into the values of its free numbers: wavelength,
/// amplitude and phase, and the line that it goes about into centre and bearing. `start` is the scene in
/// whose frame the numbers are.
void take_sine(const sim::Scene& start, const std::vector<FreeNumber>& free, const SineThroughOffsets& found,
               int sheet, std::vector<double>& values);

}  // namespace vegard::fit
