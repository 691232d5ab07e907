// The trust in a quantity is good, doubtful or unconstrained, each with its reason.
//
// It depends on the standard error, with limits for each kind of quantity. A distance that is off by a
// twentieth still identifies the arc; by a fifth, it does not. An energy is good to a sixth, and constrained
// at most to a factor of 1.6. A lower border with an error of 10 km adds nothing to what is known of aurora
// without a picture (95 to 120 km).
#pragma once

namespace vegard::fit {

enum class Trust { good, doubtful, unconstrained };

/// "good", "doubtful", "unconstrained".
const char* trust_name(Trust trust);

/// Kinds of quantities; each has its scale (error_scale()).
enum class Quantity { distance, energy, energy_flux, altitude, width, ratio, place, azimuth, phase, other };

/// Up to the standard error `good` a quantity is good, and from `none` on it is unconstrained.
struct ErrorScale {
  bool relative = true;  ///< `good` and `none` are relative to the value; else in its unit (km, degrees)
  double good = 0.0, none = 0.0;
};

/// Distance 5 and 20 %, energy 15 and 50 %, energy flux 35 and 100 %, width 25 and 70 %, ratio and whatever
/// else 25 and 70 %; altitude 3 and 10 km; latitudes and longitudes 0.3 and 1.5 degrees, azimuth 3 and 15,
/// phase 0.5 and 1.5 rad.
ErrorScale error_scale(Quantity kind);

/// Returns the trust by the standard error alone. An error that is not a number stands for an unbounded one.
Trust trust_of(Quantity kind, double value, double error);

}  // namespace vegard::fit
