// The discrete Fourier transform of a periodic plane.
#pragma once

#include <complex>
#include <vector>

namespace vegard::sim {

/// Returns the smallest even number of at least `least` whose only prime factors are 2, 3 and 5.
int transform_size(int least);

/// Transforms values, [row][column], in place; `backwards` gives the inverse transform, with its factor 1 /
/// (rows columns). The result does not depend on the number of threads.
void transform_plane(std::vector<std::complex<double>>& values, int columns, int rows, bool backwards,
                     int threads);

/// Returns the wave number of a transform's element i of n, in waves over the whole length: from -n/2 to n/2.
inline int wave_number(int i, int n) { return i <= n / 2 ? i : i - n; }

}  // namespace vegard::sim
