// The density of a strand at a place, as strand.h defines it.
#pragma once

#include <array>

#include "sim/emit/sun/strand/strand.h"

namespace vegard::sim {

/// Of 1 in the middle, at the distance q from it in radii.
double falloff_across(RadialFalloff falloff, double q);

/// In the middle, at t from 0 to 1 of the whole chain.
double density_in_middle(const Strand<double>& strand, double t);

/// Whether the place is beyond the chain's first or last point, at which the nearest point is.
bool beyond_end(const Strand<double>& strand, bool last, const std::array<double, 3>& place);

/// By the nearest point of the chain, found for certain (closest_point.h): slow.
double density_at(const Strand<double>& strand, RadialFalloff falloff, const std::array<double, 3>& place);

}  // namespace vegard::sim
