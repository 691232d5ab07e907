// Whether the picture shows the brightest light above a border: where it is clipped or hidden, the peak is
// brighter than what is seen, and the border, at half of it, higher.
#pragma once

#include "fit/border/border_trace.h"
#include "fit/photo/photo.h"
#include "sim/view/camera/camera.h"

namespace vegard::fit {

/// Returns the share of a trace's measured points above which the picture is clipped or masked over as many
/// degrees as the light falls from three quarters to a quarter; 0 without points. Where less is clipped, the
/// peak can be brighter by no more than about a third, since the light rises no faster above the border than
/// at it.
double cut_peak_share(const BorderTrace& trace, const Photo& photo, const sim::Camera& camera, int channel);

}  // namespace vegard::fit
