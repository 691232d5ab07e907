// What electrons do to the air, against altitude.
#pragma once

#include <string>
#include <vector>

#include "fit/report/plot/plot.h"
#include "sim/light/transport/electron_transport.h"

namespace vegard::apps {

/// Two panels, altitude upwards: ion pairs of each gas, all of them and, where it is not empty, `fang_cm3_s`;
/// and the two excitations of each gas, by 1.5 eV or more, that are most frequent.
fit::Plot electron_plot(const sim::FieldAir& column, const sim::ElectronRates& rates,
                        const std::vector<double>& fang_cm3_s, const std::string& note);

}  // namespace vegard::apps
