// Power spectrum of the relative brightness fluctuations of a small picture, in bands of wavenumber.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace vegard::fit {

/// The picture's light L in cells [row][column] is divided by its trend T, the quadratic polynomial in both
/// coordinates (1, u, v, u², uv, v²) that fits it best under the window w, and
///   P_b = mean over the band's wavenumbers of |sum of w (L / T - 1) exp(-2 pi i (k u + l v))|².
/// Bands are rings of |wavenumber| with a constant ratio of outer to inner radius, from two waves over the
/// picture's longer side to a wavelength of three cells. For Gaussian light whose spectrum is smooth within a
/// band, P_b has the relative variance
///   2 / n² sum over pairs of wavenumbers in the band of |W(k - k')|²,   W the transform of w² / sum of w²,
/// which the class computes; it accounts for the number of independent waves under the window.
class PowerSpectrum {
 public:
  /// `window` >= 0, [row][column]; at least 16 cells in each direction. Bands with fewer than six wavenumbers
  /// are merged with the next.
  PowerSpectrum(int columns, int rows, std::vector<double> window);

  std::size_t bands() const { return bands_.size(); }
  /// Geometric mean of the band's ends, in waves per cell.
  double wavenumber(std::size_t band) const { return bands_[band].middle; }
  double relative_variance(std::size_t band) const { return bands_[band].relative_variance; }

  /// The band powers of a picture, with intermediate results for their derivatives.
  struct Light {
    Eigen::VectorXd light, trend;
    Eigen::MatrixXcd waves;     ///< [wavenumber down][across]
    std::vector<double> power;  ///< [band]
  };
  /// Computes the band powers of the light [row][column].
  Light of(const std::vector<double>& light) const;

  /// Returns d power / d number, for `by_number` = d light / d number.
  std::vector<double> slope(const Light& at, const std::vector<double>& by_number) const;

  /// Returns the power that noise adds to every band, if the light has these variances, independent from cell
  /// to cell.
  double noise_power(const Light& at, const std::vector<double>& variance) const;

 private:
  struct Band {
    std::vector<std::pair<int, int>> waves;  ///< down, across
    double middle = 0.0, relative_variance = 0.0;
  };
  Eigen::VectorXd trend_of(const Eigen::VectorXd& light) const;
  Eigen::MatrixXcd waves_of(const Eigen::VectorXd& uneven) const;

  int columns_, rows_;
  Eigen::VectorXd window_;
  Eigen::MatrixXd terms_, fit_;  ///< trend = terms * (fit * light)
  Eigen::MatrixXcd down_, across_;
  std::vector<Band> bands_;
};

}  // namespace vegard::fit
