// Power spectrum of how uneven the light of a small picture is, in bands of wavenumber.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace vegard::fit {

/// The picture's light L in cells [row][column] is divided by its trend T, the parabola in both places
/// (1, u, v, u², uv, v²) that fits it best under the window w, and
///   P_b = mean over the band's wavenumbers of |sum of w (L / T - 1) exp(-2 pi i (k u + l v))|².
/// Bands are rings of |wavenumber|, of equal ratio, from two waves over the picture's longer side to a wave
/// of three cells. For Gaussian light of a spectrum that is smooth within a band, P_b has the relative
/// variance
///   2 / n² sum over pairs of wavenumbers in the band of |W(k - k')|²,   W the transform of w² / sum of w²,
/// which the class works out: how many independent waves a window leaves.
class PowerSpectrum {
 public:
  /// `window` >= 0, [row][column]; at least 16 cells each way. Bands with fewer than six wavenumbers, or
  /// without any, are joined to the next.
  PowerSpectrum(int columns, int rows, std::vector<double> window);

  std::size_t bands() const { return bands_.size(); }
  /// Geometric mean of the band's ends, in waves to a cell.
  double wavenumber(std::size_t band) const { return bands_[band].middle; }
  double relative_variance(std::size_t band) const { return bands_[band].relative_variance; }

  /// The light as it is compared, with what its derivatives need.
  struct Light {
    Eigen::VectorXd light, trend;
    Eigen::MatrixXcd waves;     ///< [wavenumber down][across]
    std::vector<double> power;  ///< [band]
  };
  Light of(const std::vector<double>& light) const;

  /// d power / d number, where the light has this derivative.
  std::vector<double> slope(const Light& at, const std::vector<double>& by_number) const;

  /// What noise of these variances of the light, independent from cell to cell, adds to the power of all
  /// bands.
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
