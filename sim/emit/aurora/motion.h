// Changes with time: the instants of a picture, and the brightness during a substorm.
//
// Source: Baranoski et al. 2000, sections 2.4, 4.3 and 5; rows B27-B29 and B32 of docs/physics.md. All
// functions depend on the instant alone, so that a frame of an animation equals the picture taken at that
// time.
#pragma once

#include <vector>

#include "sim/scene/structs/site.h"

namespace vegard::sim {

/// Returns the instants over which a picture is the mean: start_s + k exposure_s / instants.
std::vector<double> instants_s(const Time& time);

/// Returns the factor on the brightness of all aurora at an instant. Before the growth phase and after the
/// recovery it is `quiet`; it grows to `grown` at the onset and to 1 at the end of the expansion, and returns
/// in the recovery, each time along a smooth step. The smooth step is ours: the source gives only the phases
/// and their lengths.
double substorm_level(const Substorm& substorm, double instant_s);

}  // namespace vegard::sim
