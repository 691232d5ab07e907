// A photograph's profile with the noise that the scene says it has.
#pragma once

#include <memory>

#include "fit/measure/bin_grid.h"
#include "fit/measure/profile.h"
#include "fit/photo/photo.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// extract_profile(); with fit.photo_noise = "sensor" the standard errors are those of photons, dark current,
/// reading and rounding by [sensor] (sim::light_variance()), pixels taken as independent, in place of what
/// neighbours differ by. Of a grey sensor (sensor.response = "grey") only the green channel is measured, the
/// others have no pixels: equal channels would count three times.
Profile measured_profile(const sim::Scene& scene, const Photo& photo,
                         const std::shared_ptr<const BinGrid>& grid);

}  // namespace vegard::fit
