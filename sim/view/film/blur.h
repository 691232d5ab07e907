// Blur: the spread of each emission line's light over the picture.
//
// Source: Baranoski et al. 2000, section 4.3; docs/physics.md row B25. Gaussians integrated over the cells,
// normalised to 1.
#pragma once

#include <vector>

namespace vegard::sim {

/// A symmetric kernel: weights[0] at the centre, weights[k] at k cells to either side. One weight means no
/// blur.
struct BlurKernel {
  std::vector<float> weights;
  int radius() const { return static_cast<int>(weights.size()) - 1; }
};

/// Returns a Gaussian of standard deviation `sigma` cells, truncated at 4 sigma, or at `radius` cells if that
/// is not negative. The weights sum to 1. sigma 0 gives no blur.
BlurKernel gaussian_kernel(double sigma, int radius = -1);

/// Returns the variance in cells squared.
double kernel_variance(const BlurKernel& kernel);

/// Returns the derivatives of the weights of gaussian_kernel(sigma, radius) by sigma, which sum to 0. For
/// sigma above 0.
BlurKernel gaussian_kernel_derivative(double sigma, int radius = -1);

/// Convolve planes of [rows][columns][channels] with a kernel, vertically (down) or horizontally (across).
/// Outside of the plane there is no light. `in` and `out` must not overlap. Sums are in a fixed order.
void blur_down(const float* in, float* out, int rows, int columns, int channels, const BlurKernel& kernel,
               int threads);
void blur_across(const float* in, float* out, int rows, int columns, int channels, const BlurKernel& kernel,
                 int threads);

/// Computes one row of the result of blur_down(), [columns][channels].
void blur_down_row(const float* in, float* out, int rows, int columns, int channels, const BlurKernel& kernel,
                   int row);

/// A rectangular part of a plane.
struct Window {
  int first_row = 0, first_column = 0, rows = 0, columns = 0;
};

/// The kernels of a plane in its own cells: vertical (down) and horizontal (across).
struct PlaneBlur {
  BlurKernel down, across;
};

/// Applies blur_down() and then blur_across(), with the same sums, to planes of [rows][columns], one per
/// element of `blurs`; computes only the window of the result, [row][column][plane].
void blur_window(const float* in, int rows, int columns, const std::vector<PlaneBlur>& blurs,
                 const Window& window, float* out, int threads);

// Blurs of light on a film: a blur against grain, and glow.

/// `count` planes of [rows][columns][channels], one after the other.
struct Planes {
  float* data = nullptr;
  int count = 0, rows = 0, columns = 0, channels = 1;
};

/// Blurs each plane by a Gaussian with these standard deviations in cells. Outside of
/// the plane there is no light; light that is blurred beyond the edges is lost.
void soften(const Planes& planes, double sigma_down, double sigma_across, int threads);

/// light = (1 - share) light + share x blurred light. The total is conserved, except beyond the edges.
void spread_glow(const Planes& planes, double share, double sigma_down, double sigma_across, int threads);

}  // namespace vegard::sim
