// The enumerations of a sheet's keys. They are apart from struct Sheet for code that needs no scene: the
// beam kernel, and footprints, which use the same height profiles.
#pragma once

namespace vegard::sim {

/// Height profile: light as a function of altitude.
enum class ProfileKind {
  maxwellian,  ///< of electrons with a Maxwellian spectrum
  mono,        ///< of electrons of a single energy
  gaussian,    ///< of electrons with a Gaussian spectrum
  form,        ///< measured curve of an auroral form, with the line ratios of a Maxwellian
  file,        ///< from a CSV file
  spline,      ///< free-form: a coefficient per knot and line
  layer,       ///< the layers of the scene's own lines ([[line]])
  line,        ///< of one line, as bright as given, at the heights of a form: light without electrons
  proton       ///< of protons with a Maxwellian spectrum, as bright as given in one of their lines
};

/// True if the profile comes from the emission tables: electrons in the Earth's air.
constexpr bool is_of_electrons(ProfileKind profile) {
  return profile != ProfileKind::file && profile != ProfileKind::spline && profile != ProfileKind::layer &&
         profile != ProfileKind::line && profile != ProfileKind::proton;
}

/// True if line_kilorayleigh is the brightness of line_nm, so that no energy flux follows.
constexpr bool is_as_bright_as_given(ProfileKind profile) {
  return profile == ProfileKind::line || profile == ProfileKind::proton;
}

/// True if peak_km, lower_km and upper_km are the heights of the light.
constexpr bool has_heights_of_form(ProfileKind profile) {
  return profile == ProfileKind::form || profile == ProfileKind::line;
}

/// The course of a sheet's layers on the ground.
enum class SheetCourse {
  sine,  ///< sine about a straight line
  curve  ///< curve through given points
};

/// How a beam is deflected: interpretations of equation (4) of the source paper (docs/physics.md row B14).
enum class PitchLaw { reduced, product, increment, constant };

/// The positions of the beams along a layer.
enum class SpacingRule {
  stratified,  ///< jittered about the middles of equal intervals
  tied,        ///< a walk with jittered steps
  literal      ///< the paper's walk: the sine's phase ignores the jitter
};

/// The lengths of the steps of a beam's path.
enum class PathRule {
  even,   ///< all equal; neighbouring beams have different first steps
  random  ///< uniform between 0 and the largest, as in the paper
};

/// What the undulation of the lower border moves.
enum class BorderRule {
  light,  ///< the altitude at which the height profile is evaluated
  start   ///< the start of a beam, and so its end: literally as in the paper
};

/// The largest step of a beam's path.
enum class PathStepRule {
  given,  ///< Sheet::path_step
  energy  ///< from the electrons' mean energy
};

}  // namespace vegard::sim
