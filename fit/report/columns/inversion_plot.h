// A plot of chi2 of line brightnesses over energy and energy flux, with the solutions.
#pragma once

#include "fit/columns/column_inversion.h"
#include "fit/report/plot/plot.h"

namespace vegard::fit {

/// Returns a plot with contours of chi2 at 2.30, 6.18 and 11.83 above the minimum (68.3, 95.4 and 99.7 % for
/// two parameters jointly; a free oxygen factor is at its best value), the curves on which each single line
/// has its measured brightness, and the solutions with their 68 % intervals. Energy and flux must both be
/// free.
Plot inversion_plot(const ColumnChi2& chi2, const ColumnInversion& inversion, const std::string& note);

}  // namespace vegard::fit
