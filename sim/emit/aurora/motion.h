// Changes with time: the instants of a picture, the brightness during a substorm, and how fast sheets change.
//
// Source: Baranoski et al. 2000, sections 2.4, 4.3 and 5; rows B27-B29 and B32 of docs/physics.md. All
// functions depend on the instant alone, so that a frame of an animation equals the picture taken at that
// time.
#pragma once

#include <vector>

#include "sim/scene/structs/sheet.h"
#include "sim/scene/structs/site.h"

namespace vegard::sim {

/// Returns the instants over which a picture is the mean: start_s + k exposure_s / instants.
std::vector<double> instants_s(const Time& time);

/// Returns the factor on the brightness of all aurora at an instant. Before the growth phase and after the
/// recovery it is `quiet`; it grows to `grown` at the onset and to 1 at the end of the expansion, and returns
/// in the recovery, each time along a smooth step. The smooth step is ours: the source gives only the phases
/// and their lengths.
double substorm_level(const Substorm& substorm, double instant_s);

// How fast a sheet's precipitation changes, and the sheet's mean over a stretch of time.
//
// Excited atoms emit up to some minutes after the electrons have excited them (sim/light/excited_atom.h). The
// times here determine how finely this past is sampled, and which structures enter only as a mean: atoms that
// live two minutes are excited by hundreds of rays that live half a second.

/// Times of change in seconds, as seen from the ground: the lifetime of a structure, or the time in which it
/// moves by its own width, if shorter. Infinite for steady structures and for those that a sheet does not
/// have.
struct ChangeTimes {
  double rays, patches, border, folds, curls, spirals;
  double course;  ///< of the layers themselves, which drift and whose sine travels
};

ChangeTimes change_times(const Sheet& sheet);

/// Returns the shortest of these times and of the lengths of a substorm's phases. Infinite for a steady
/// sheet.
double soonest_change_s(const Sheet& sheet, const Substorm& substorm);

/// The mean of a sheet over a stretch of time: without the structures that come and go several times in it.
/// The mean of rays and patches is even light, that of an undulating border an even border, that of folds and
/// curls the plain course. (Folds and curls also spread the light a little, which is neglected.)
struct SheetOverTime {
  Sheet sheet;
  bool draws_ray_length = false;  ///< many long and short rays are averaged: each beam draws its own length
};
SheetOverTime sheet_over(const Sheet& sheet, double stretch_s);

}  // namespace vegard::sim
