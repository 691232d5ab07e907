// chi2 of line brightnesses over energy and energy flux, with the solutions.
#pragma once

#include "fit/columns/column_inversion.h"
#include "fit/report/plot/plot.h"

namespace vegard::fit {

/// Contours of chi2 where it is 2.30, 6.18 and 11.83 above the least (68.3, 95.4 and 99.7 % of two numbers
/// together; an oxygen factor that is free is at its best), where each line by itself has its brightness, and
/// the solutions with their 68 % intervals. To be called where energy and flux are both free.
Plot inversion_plot(const ColumnChi2& chi2, const ColumnInversion& inversion, const std::string& note);

}  // namespace vegard::fit
