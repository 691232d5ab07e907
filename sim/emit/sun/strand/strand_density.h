// The density of a strand at a place, as strand.h defines it.
#pragma once

#include <array>

#include "sim/emit/sun/strand/strand.h"

namespace vegard::sim {

/// Returns the density at the distance q, in radii, from an axis with density 1.
double falloff_across(RadialFalloff falloff, double q);

/// Returns the density on the axis, at t from 0 to 1 of the whole chain.
double density_in_middle(const Strand<double>& strand, double t);

/// True if the place is beyond the flat end at the chain's first or last point, given that this is the
/// nearest point.
bool beyond_end(const Strand<double>& strand, bool last, const std::array<double, 3>& place);

/// Returns the density from the nearest point of the chain, found with certainty (closest_point.h); slow.
double density_at(const Strand<double>& strand, RadialFalloff falloff, const std::array<double, 3>& place);

}  // namespace vegard::sim
