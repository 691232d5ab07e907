// Error bars from a curvature are right only where chi2 is a parabola. This probes whether it is.
#pragma once

#include <functional>
#include <vector>

#include "fit/uncertainty/uncertainty.h"

namespace vegard::fit {

/// Walks three standard deviations to either side of the answer along every principal axis of the covariance.
/// Where chi2 rises by less than a quarter of what the parabola says, on either side, chi2 is none. If it
/// does so twice, four or eight times as far out, the axis' standard deviation is so many times as long. If
/// it does not, the data do not bound the parameters that way (a sheet's end at the very edge of the picture,
/// for one: moved outwards it costs, inwards nothing): the axis is taken out of the covariance and joins the
/// undetermined directions; coordinates that owe more than half of their error bar to it lose it. `rise(step)` is chi2 at the answer
/// plus `step`, in coordinates, less chi2 at the answer, divided by the inflation squared.
///
/// `bounded` marks coordinates that something other than the data bounds: an axis that is all but theirs is
/// not probed.
void drop_flat_directions(const std::function<double(const std::vector<double>& step)>& rise,
                          const std::vector<bool>& bounded, Uncertainty& u);

}  // namespace vegard::fit
