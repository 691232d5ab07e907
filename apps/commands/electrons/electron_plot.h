// A plot of ionisation and excitation by electrons against altitude.
#pragma once

#include <string>
#include <vector>

#include "fit/report/plot/plot.h"
#include "sim/light/transport/electron_transport.h"

namespace vegard::apps {

/// Two panels, altitude upwards: ion pairs of each gas, of all gases and, if not empty, `fang_cm3_s`; and for
/// each gas the two most frequent excitations of 1.5 eV or more.
fit::Plot electron_plot(const sim::FieldAir& column, const sim::ElectronRates& rates,
                        const std::vector<double>& fang_cm3_s, const std::string& note);

}  // namespace vegard::apps
