// The posterior probability of a spectrum of electrons, given a density profile, and samples of it.
//
// The energy flux in a bin of ln(E) is exp(x), so it is never negative, with
//
//     x = ln Q + [b ln(E/E0) - E/E0, normalised] + s1 g1(ln E) + s2 g2(ln E):
//
// a power law with an exponential end (b = 3: a Maxwellian) and two Gaussian processes over ln E, of lengths
// 0.8 and 0.25. Their amplitudes s1 and s2 say how far from smooth the spectrum is; they are found with the
// rest, so no number for smoothness is set by hand. All unknowns have broad normal priors:
//
//     ln Q about what the density itself needs, 2.5;  ln E0 about ln 3 keV, 1.2;  b about 2.5, 1.5;
//     ln s1 about ln 0.3 and ln s2 about ln 0.1, 1.2.
//
// Density follows by steady balance, or from that before by sim::grown_density(), as by Virtanen et al. 2018
// (ELSPEC, J. Geophys. Res. 123, doi:10.1029/2018JA025636), where the densities before are unknowns too. The
// coefficients of physics' uncertainty are unknowns with the prior of their draws. The largest posterior is
// found by Levenberg's and Marquardt's steps; samples are by Hamiltonian Monte Carlo (Duane et al. 1987,
// Phys. Lett. B 195, 216) in coordinates in which its Gaussian approximation is the unit one.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "fit/radar/density_physics.h"

namespace vegard::fit {

/// The modes of physics' uncertainty: each column is what one unit of a coefficient changes by altitude.
struct PhysicsModes {
  Eigen::MatrixXd ln_pairs, ln_recombination;  ///< [altitude, mode]
};

/// Returns how many numbers describe a spectrum: without other knowledge they are independent and standard
/// normal.
Eigen::Index spectrum_numbers(const DensityPhysics& physics);

/// What is known before of all unknowns, mean + root times independent standard normal numbers: the numbers
/// of the spectrum, the coefficients of the modes and, not in a steady balance, ln(density in cm^-3) before.
struct RadarState {
  Eigen::VectorXd mean;
  Eigen::MatrixXd root;
};

struct SpectrumProblem {
  Eigen::VectorXd density_cm3;     ///< 0 where not measured
  Eigen::VectorXd one_over_sigma;  ///< 0 where not measured
  PhysicsModes modes;
  RadarState state;
  double seconds = 0.0;  ///< since the density before; infinite: a steady balance
  /// By altitude, at the density `about_cm3`.
  Eigen::VectorXd ln_recombination, recombination_slope, about_cm3;
  double usual_flux_mw_m2 = 1.0;  ///< the middle of the prior of Q
};

class SpectrumPosterior {
 public:
  /// `physics` and `problem` must outlive this object.
  SpectrumPosterior(const DensityPhysics& physics, const SpectrumProblem& problem);

  Eigen::Index unknowns() const { return unknowns_; }

  /// What a point stands for.
  struct Meaning {
    Eigen::VectorXd flux_mw_m2;            ///< by bin
    Eigen::VectorXd density_cm3, end_cm3;  ///< by altitude: what a radar sees; at the end of the time
    Eigen::VectorXd state;                 ///< all unknowns
    double chi2 = 0.0;                     ///< of the densities
  };
  Meaning meaning(const Eigen::VectorXd& at) const;

  /// Returns by how many standard deviations the densities change, root of the sum of squares, per relative
  /// change of a bin's flux, from 0 up.
  Eigen::VectorXd signal(const Eigen::VectorXd& at) const;

  /// Minus the logarithm of the posterior, but for a constant, and its gradient.
  double energy(const Eigen::VectorXd& at, Eigen::VectorXd& gradient) const;

  struct Peak {
    Eigen::VectorXd at;
    Eigen::MatrixXd root;       ///< of the covariance in the Gaussian approximation; empty where it has none
    double used_freedom = 0.0;  ///< how many numbers the densities determine
    double ln_evidence =
        0.0;  ///< probability of the densities by Laplace's approximation, but for a constant
    bool is_found() const { return root.size() > 0; }
  };
  /// The largest posterior from several starts, or from the peak of a problem that differs in recombination
  /// and modes alone.
  Peak peak(const Eigen::VectorXd& start = {}) const;

  struct Samples {
    Eigen::MatrixXd at;       ///< a column each
    double acceptance = 0.0;  ///< of the steps
  };
  /// A pure function of the peak, which must be found, `seed` and `stride`, of which many steps one is kept.
  Samples samples(const Peak& peak, int count, std::uint64_t seed, int stride = 1) const;

  /// Returns how much energy flux of a spectrum `shares` (by bin, sum 1) may be added to a point's until chi2
  /// has risen by `rise`, mW m^-2.
  double addable_flux_mw_m2(const Eigen::VectorXd& at, const Eigen::VectorXd& shares, double rise) const;

 private:
  struct Forward;
  /// `added_mw_m2`: to the flux of the bins, or empty.
  Forward forward(const Eigen::VectorXd& at, const Eigen::VectorXd& added_mw_m2 = {}) const;
  double chi2(const Forward& of) const;
  /// The gradient of sum_i weight_i N_i by the unknowns of the state.
  Eigen::VectorXd backward(const Forward& from, const Eigen::VectorXd& weight) const;
  /// Ends at a point; returns its energy.
  double descend(Eigen::VectorXd& at) const;
  Eigen::MatrixXd jacobian(const Forward& from) const;

  const DensityPhysics& physics_;
  const SpectrumProblem& problem_;
  Eigen::VectorXd ln_energy_;
  Eigen::MatrixXd long_, short_;  ///< [bin, coefficient] of the Gaussian processes
  Eigen::Index unknowns_ = 0;
};

}  // namespace vegard::fit
