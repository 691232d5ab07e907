// Angles come round again.
#pragma once

#include "fit/parameters/free_parameters.h"

namespace vegard::fit {

/// 360 or 2 pi for an angle, 0 for anything else, and for an angle that expressions use.
double full_turn(const FreeNumber& number);

/// An angle without needless turns, unless the user's own limits say which turn is meant.
double without_turns(const FreeNumber& number, double value);

/// How far apart two values are, turns of an angle left out.
double apart(const FreeNumber& number, double a, double b);

}  // namespace vegard::fit
