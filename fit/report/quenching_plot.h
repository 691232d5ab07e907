// A plot of the quenching of the slow lines against altitude.
#pragma once

#include "fit/report/plot/plot.h"

namespace vegard::fit {

/// Two panels, altitude upwards: the share of the excited atoms that shine before a collision takes their
/// energy, tau/T, and their mean life tau in seconds (its decimal logarithm). One curve per line whose atoms
/// are not prompt; lines from the same state share one.
Plot quenching_plot();

}  // namespace vegard::fit
