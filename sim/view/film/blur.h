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

/// A Gaussian of standard deviation `sigma` cells, to 4 sigma, or cut at `radius` cells if that is not
/// negative. The weights sum to 1. sigma 0 gives no blur.
BlurKernel gaussian_kernel(double sigma, int radius = -1);

/// In cells squared.
double kernel_variance(const BlurKernel& kernel);

/// The derivative of gaussian_kernel(sigma, radius)'s weights with respect to sigma; they sum to 0. For sigma
/// above 0.
BlurKernel gaussian_kernel_derivative(double sigma, int radius = -1);

/// Convolves planes of [rows][columns][channels] with a kernel along the columns' direction (down) or the
/// rows' (across). Outside the plane there is no light. in and out may not overlap. Sums are in a fixed
/// order.
void blur_down(const float* in, float* out, int rows, int columns, int channels, const BlurKernel& kernel,
               int threads);
void blur_across(const float* in, float* out, int rows, int columns, int channels, const BlurKernel& kernel,
                 int threads);

/// One row of what blur_down() gives, [columns][channels].
void blur_down_row(const float* in, float* out, int rows, int columns, int channels, const BlurKernel& kernel,
                   int row);

/// The part of a plane that is wanted.
struct Window {
  int first_row = 0, first_column = 0, rows = 0, columns = 0;
};

/// What a plane is blurred by, in its own cells: down its columns and across its rows.
struct PlaneBlur {
  BlurKernel down, across;
};

/// blur_down() and then blur_across() of planes of [rows][columns], as many as there are blurs, with the same
/// sums; of the result only the window is worked out, [row][column][plane].
void blur_window(const float* in, int rows, int columns, const std::vector<PlaneBlur>& blurs,
                 const Window& window, float* out, int threads);

}  // namespace vegard::sim
