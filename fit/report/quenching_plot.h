// A plot of the quenching of the slow lines against altitude.
#pragma once

#include "fit/report/plot/plot.h"

namespace vegard::fit {

/// Two panels, altitude upwards: tau/T, the fraction of the excited atoms that radiate before a collision
/// de-excites them, and the decimal logarithm of their mean life tau in seconds. There is one curve per line
/// that is not prompt; lines from the same upper state share one.
Plot quenching_plot();

}  // namespace vegard::fit
