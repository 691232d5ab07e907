// Error bars by how much the bands of a photograph differ.
//
// One factor for all error bars (the inflation) says how much worse than its noise a picture is explained, and
// not in what. Rays, for example, scatter from band to band as a wave does: a wave's numbers are then worse
// known than the factor says, and E0, which is the same in all bands, is not. The scores of the bands (what each
// band by itself would change) tell: their covariance between information matrices, the "sandwich", is the
// covariance of the answer whatever the residuals inside a band are: H. White, Econometrica 48 (1980) 817,
// doi:10.2307/1912934; for groups of rows K.-Y. Liang and S. L. Zeger, Biometrika 73 (1986) 13,
// doi:10.1093/biomet/73.1.13. It is what the bootstrap over bands (band_bootstrap.h) estimates by random draws.
#pragma once

#include <vector>

#include "fit/uncertainty/band_bootstrap.h"
#include "fit/uncertainty/uncertainty.h"

namespace vegard::fit {

/// Fewer bands than these tell too little: their scatter's own relative error, 1/√(2 (bands − 1)), is then above
/// a quarter.
inline constexpr int kFewestBands = 9;

/// Returns for every coordinate the factor, at least 1, by which the scatter of the bands asks for a wider error
/// bar than the covariance has; 1 where there are too few bands. `rows` are the photographs' at the answer
/// (photo_rows()), in the coordinates of the covariance; those that belong to no band have no part in it.
std::vector<double> factors_by_bands(const BandRows& rows, const std::vector<std::vector<double>>& covariance);

/// Widens the error bars of `u` by `u.by_bands`; their correlations stay. `usual` is the covariance that the
/// factors are of: what `u` has more, the error of the physics, does not scatter from band to band.
void widen_by_bands(const std::vector<std::vector<double>>& usual, Uncertainty& u);

}  // namespace vegard::fit
