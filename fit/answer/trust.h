// The trust in a quantity is good, doubtful or unconstrained, each with its reason.
//
// What counts is the standard error on the scale of the quantity's kind. A distance that is off by a
// twentieth still identifies the arc, by a fifth it does not; an energy is constrained to a sixth or, at
// most, to a factor of 1.6; a lower border that may be 10 km off adds nothing to what is known of aurora
// without a picture (95 to 120 km).
#pragma once

namespace vegard::fit {

enum class Trust { good, doubtful, unconstrained };

/// "good", "doubtful", "unconstrained".
const char* trust_name(Trust trust);

/// Kinds of quantities; each has its scale (error_scale()).
enum class Quantity { distance, energy, energy_flux, altitude, width, ratio, place, azimuth, phase, other };

/// Up to which standard error a quantity is good, and from which on it is unconstrained.
struct ErrorScale {
  bool relative = true;  ///< errors are shares of the value; else in its unit (km, degrees)
  double good = 0.0, none = 0.0;
};

/// Distance 5 and 20 %, energy 15 and 50 %, energy flux 35 and 100 %, width 25 and 70 %, ratio and whatever
/// else 25 and 70 %; altitude 3 and 10 km; latitudes and longitudes 0.3 and 1.5 degrees, azimuth 3 and 15,
/// phase 0.5 and 1.5 rad.
ErrorScale error_scale(Quantity kind);

/// By its standard error alone. An error that is no number is one that nothing bounds.
Trust trust_of(Quantity kind, double value, double error);

}  // namespace vegard::fit
