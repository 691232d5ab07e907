// How fast a sheet's precipitation changes, and the sheet's mean over a stretch of time.
//
// Excited atoms emit up to some minutes after the electrons have excited them (sim/light/excited_atom.h). The
// times here determine how finely this past is sampled, and which structures enter only as a mean: atoms that
// live two minutes are excited by hundreds of rays that live half a second.
#pragma once

#include "sim/scene/structs/sheet.h"
#include "sim/scene/structs/site.h"

namespace vegard::sim {

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
