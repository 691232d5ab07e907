// How soon what falls along a sheet becomes something else, and what a stretch of time sees of it.
//
// Excited atoms shine by the electrons of up to some minutes ago (sim/light/excited_atom.h). How finely that
// past is to be looked at follows from here, and so does what of it is no more than a mean: of rays that live
// half a second, atoms that live two minutes have seen hundreds.
#pragma once

#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// In seconds, as seen from the ground: lifetimes, or how long a structure takes to go on by its own width.
/// Infinite for what lasts and stays, and for what a sheet does not have.
struct ChangeTimes {
  double rays, patches, border, folds, curls, spirals;
  double course;  ///< of the layers themselves, which drift and whose sine travels
};

ChangeTimes change_times(const Sheet& sheet);

/// The shortest of them, and of the phases of a substorm. Infinite for a steady sheet.
double soonest_change_s(const Sheet& sheet, const Substorm& substorm);

/// A sheet over a stretch of time: without the structures that come and go several times in it. Their mean is
/// that: of rays and patches even light, of an undulating border an even one, of folds and curls the plain
/// course. (Of these, light is spread a little wider than that; it is left out.)
struct SheetOverTime {
  Sheet sheet;
  bool draws_ray_length =
      false;  ///< rays are long and short without number: each beam draws a length of its own
};
SheetOverTime sheet_over(const Sheet& sheet, double stretch_s);

}  // namespace vegard::sim
