// Tests whether chi2 is a parabola about the answer, as error bars from its curvature assume, and corrects
// the error bars where it is not.
#pragma once

#include <functional>
#include <vector>

#include "fit/uncertainty/uncertainty.h"

namespace vegard::fit {

/// Evaluates chi2 three standard deviations to either side of the answer along every principal axis of the
/// covariance. If on either side chi2 rises by less than a quarter of the parabola's rise, chi2 is not a
/// parabola. If chi2 rises enough twice, four or eight times as far out, the axis' standard deviation is
/// multiplied by this factor. If it does not, the data do not bound the parameters in this direction (for
/// example a sheet's end at the edge of the picture: moving it outwards raises chi2, moving it inwards does
/// not). Then the axis is removed from the covariance and added to the undetermined directions, and
/// coordinates whose error bar is due to it by more than half lose their error bar. `rise(step)` returns chi2
/// at the answer plus `step`, in coordinates, less chi2 at the answer, divided by the inflation squared.
///
/// `bounded` marks coordinates that are bounded by other knowledge than the data: an axis that consists
/// almost only of these is not tested.
void drop_flat_directions(const std::function<double(const std::vector<double>& step)>& rise,
                          const std::vector<bool>& bounded, Uncertainty& u);

}  // namespace vegard::fit
