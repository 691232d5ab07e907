// The posterior of one density profile, and what it tells of the next of a sequence.
//
// Recombination and the modes of physics depend on the density and the spectrum that are looked for, so they
// follow them in a few rounds. From one profile to the next ln(density) is what it was at the end. The
// numbers of the spectrum forget with time, an Ornstein-Uhlenbeck process whose stationary distribution is
// their prior; physics stays as it is, and is not taken to be better known by many profiles.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "fit/radar/density_table.h"
#include "fit/radar/spectrum_posterior.h"

namespace vegard::fit {

/// What is known before a profile; without a state nothing.
struct ProfileBefore {
  RadarState state;
  Eigen::VectorXd flux_mw_m2;      ///< by bin
  Eigen::MatrixXd draws_in_modes;  ///< [draw, mode]: the same modes in all profiles
};

struct ProfileSettings {
  double seconds = 0.0;           ///< as SpectrumProblem has them
  double usual_flux_mw_m2 = 1.0;  ///< as SpectrumProblem has it
  bool has_uncertainty = true;    ///< of physics
};

struct SolvedProfile {
  SpectrumProblem problem;
  SpectrumPosterior::Peak peak;
  Eigen::VectorXd flux_mw_m2;
  Eigen::MatrixXd draws_in_modes;
};

/// The energy flux that makes up for what recombines of a profile, mW m^-2.
double needed_flux_mw_m2(const DensityPhysics& physics, const DensityProfile& profile);

/// Finds the largest posterior, if it has one (peak.is_found()). A `before` without a state: the density
/// before is the profile's own, within a factor of 1.6, or not in a steady balance.
SolvedProfile solve_profile(const DensityPhysics& physics, const DensityProfile& profile,
                            const ProfileSettings& settings, const ProfileBefore& before);

/// Returns what samples (a column each) of a profile that is not steady tell before the next. `kept`: the
/// correlation of the spectrum's numbers between the two. Without a state if their covariance has no root.
ProfileBefore before_next(const DensityPhysics& physics, const SolvedProfile& solved,
                          const Eigen::MatrixXd& samples, double kept);

/// Returns samples of the Gaussian approximation at a peak, a column each.
Eigen::MatrixXd normal_samples(const SpectrumPosterior::Peak& peak, int count, std::uint64_t seed);

}  // namespace vegard::fit
