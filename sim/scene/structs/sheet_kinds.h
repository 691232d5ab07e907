// What the words of a sheet choose. They stand apart from the sheet for those who need no scene: the kernel,
// and footprints, which share its profiles.
#pragma once

namespace vegard::sim {

/// Light against altitude.
enum class ProfileKind {
  maxwellian,  ///< of electrons whose spectrum is a Maxwellian,
  mono,        ///< of a single energy,
  gaussian,    ///< or a Gaussian one
  form,        ///< a form's measured curve, with the Maxwellian's ratios of lines
  file,        ///< of a CSV
  spline,      ///< free, a coefficient per knot and line
  layer        ///< of the layers that the scene's own lines have
};

/// Whether it is that of electrons in the Earth's air, by the emission tables.
constexpr bool is_of_electrons(ProfileKind profile) {
  return profile != ProfileKind::file && profile != ProfileKind::spline && profile != ProfileKind::layer;
}

/// The line that the layers of a sheet follow.
enum class SheetCourse {
  sine,  ///< about a straight line
  curve  ///< through given points
};

/// How a beam is deflected: readings of equation (4) of the source paper (docs/physics.md row B14).
enum class PitchLaw { reduced, product, increment, constant };

/// Where the beams of a layer stand.
enum class SpacingRule {
  stratified,  ///< each in a stretch of its own
  tied,        ///< by a jittered walk
  literal      ///< by the paper's walk, whose phase does not follow it
};

/// How long the steps of a beam's path are.
enum class PathRule {
  even,   ///< all alike, and beams next to each other begin at other places
  random  ///< between nothing and the largest one, as in the paper
};

/// What the undulation of the lower border moves.
enum class BorderRule {
  light,  ///< where a beam's light is read from the height profile
  start   ///< where a beam starts, and so ends: literally the paper's
};

/// The largest step of a beam's path.
enum class PathStepRule {
  given,  ///< path_step
  energy  ///< by the electrons' mean energy
};

}  // namespace vegard::sim
