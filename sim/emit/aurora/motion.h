// What time does to a sheet: when a picture's instants are, where a sheet has drifted to, how bright a
// substorm makes it.
//
// Source: Baranoski et al. 2000, sections 2.4, 4.3 and 5; rows B27-B29 and B32 of docs/physics.md. All of it
// is a function of the instant alone, so that a frame of an animation is the picture taken at that time.
#pragma once

#include <vector>

#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// The instants whose mean a picture is: start_s + k exposure_s / instants.
std::vector<double> instants_s(const Time& time);

/// The brightness of all aurora at an instant, as a fraction of what its emitters say. Before the growth
/// phase and after the recovery it is `quiet`; growth leads to `grown` at the onset, expansion to 1, recovery
/// back, each along a smooth step. The smooth step is ours: the source names the phases and their lengths
/// only.
double substorm_level(const Substorm& substorm, double instant_s);

}  // namespace vegard::sim
