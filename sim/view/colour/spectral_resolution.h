// The spectral resolution of three broad channels: the narrowest window around a wavelength that a weighted
// sum of the channels can make.
//
// Sources: Backus and Gilbert 1970, doi:10.1098/rsta.1970.0005: the weights that minimise the spread 12
// integral (l - l0)^2 K(l)^2 dl of a kernel K = sum of weights times responses with the integral 1 (a box of
// width w around l0 has the spread w). Jackel et al. 2014, doi:10.5194/gi-3-71-2014, did this for colour
// CCDs.
#pragma once

#include "sim/view/colour/matrix3.h"
#include "sim/view/colour/sensor_response.h"

namespace vegard::sim {

struct ResolvingKernel {
  Vector3 weights{};       ///< of the channels, each scaled to an integral of 1 nm over wavelength, nm^-1
  double spread_nm = 0.0;  ///< spread of Backus and Gilbert
  double peak_nm = 0.0;    ///< wavelength of the kernel's maximum
  double fwhm_nm = 0.0;    ///< full width at half maximum
};

/// Returns the kernel for channels that count photons: response per photon, on a grid of 1 nm.
ResolvingKernel resolving_kernel(const SensorResponse& response, double wavelength_nm);

}  // namespace vegard::sim
