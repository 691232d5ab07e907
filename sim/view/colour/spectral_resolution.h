// How finely three broad channels can distinguish wavelengths: the narrowest window that a sum of them can
// make around a wavelength.
//
// Sources: Backus and Gilbert 1970, doi:10.1098/rsta.1970.0005: the weights that minimise the spread 12
// integral (l - l0)^2 K(l)^2 dl of a kernel K = sum of weights times responses whose integral is 1 (a box of
// width w about l0 has the spread w). Jackel et al. 2014, doi:10.5194/gi-3-71-2014, did this for colour CCDs.
#pragma once

#include "sim/view/colour/matrix3.h"
#include "sim/view/colour/sensor_response.h"

namespace vegard::sim {

struct ResolvingKernel {
  Vector3 weights{};       ///< of the channels, each scaled to an integral of 1 nm over wavelength, nm^-1
  double spread_nm = 0.0;  ///< Backus and Gilbert's, above
  double peak_nm = 0.0;    ///< where the kernel is highest
  double fwhm_nm = 0.0;    ///< full width at half of that height
};

/// For channels that count photons: response per photon, on a grid of 1 nm.
ResolvingKernel resolving_kernel(const SensorResponse& response, double wavelength_nm);

}  // namespace vegard::sim
