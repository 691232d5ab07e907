// A plot of the air of a place and time.
#pragma once

#include "apps/commands/atmosphere/atmosphere_texts.h"
#include "fit/report/plot/plot.h"

namespace vegard::apps {

/// Two panels, altitude upwards: the densities of all gases, and the temperature.
fit::Plot air_plot(const AirColumn& column);

}  // namespace vegard::apps
