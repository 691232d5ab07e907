// A photograph's profile with standard errors by the scene's setting fit.photo_noise.
#pragma once

#include <memory>

#include "fit/measure/bin_grid.h"
#include "fit/measure/profile.h"
#include "fit/photo/photo.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// Returns extract_profile(). With fit.photo_noise = "sensor" the standard errors are not those of the
/// differences of neighbours, but those of photon noise, dark current, readout and rounding by [sensor]
/// (sim::light_variance()), pixels assumed independent. For a grey sensor (sensor.response = "grey") only the
/// green channel is measured and the others have no pixels: three equal channels would count three times.
Profile measured_profile(const sim::Scene& scene, const Photo& photo,
                         const std::shared_ptr<const BinGrid>& grid);

}  // namespace vegard::fit
