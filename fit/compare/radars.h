// Densities of electrons that radars measured, compared with those of the scene's electrons beside the light.
//
// At each altitude the field line through the radar's place has its foot, at which the sheets' electrons fall
// (sim/emit/aurora/foot_electrons.h); what all of them ionise there makes a density N (fit/radar/
// radar_density.h). With measured densities d of error s the residuals are
//
//     (d - N (1 + M c)) / s   and   c,
//
// with the coefficients c that make their squares least, found at each evaluation. The columns of M are what
// one standard deviation of each mode of physics (reactions, ionisation, air) changes of N, and that of a
// free scale. So the sum of squares is that of the densities with the covariance of noise, physics and scale
// together, and its degrees of freedom are the densities. Residuals are linear, not of logarithms: a radar's
// noise is of the density itself, which may come out below 0.
//
// Densities do not depend on the photographs' gains, nor on how their residuals go together. So these rows
// stand beside the priors' in a cost (fit/compare/profile_cost.h), where errors count as they are.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "fit/parameters/parameter_map.h"
#include "fit/radar/fitted_radar.h"
#include "fit/radar/radar_density.h"
#include "sim/emit/aurora/foot_electrons.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

class Radars {
 public:
  /// Reads the files of scene.fit.radars, whose names are relative to the scene's file. `scene` is the shared
  /// one, in its site's frame, at the fit's start: modes of physics and the factor of oxygen are taken there.
  /// Throws what read_density_table() throws, and Error(scene) if a sheet has no known electrons or is
  /// folded, where there are footprints, or if hardly any electrons fall at a radar's field line.
  explicit Radars(const sim::Scene& scene);

  int rows() const { return rows_; }
  int values() const;  ///< densities that are compared

  /// Computes the rows for a scene and, if `motion` is not null, d row / d what moves, row-major
  /// [row][moved].
  void evaluate(const sim::Scene& scene, const ParameterMap::Motion* motion, std::vector<double>& residuals,
                std::vector<double>* jacobian) const;

  /// What the radars measured beside what a scene has.
  std::vector<FittedRadar> fitted(const sim::Scene& scene) const;

 private:
  struct Radar {
    FittedRadar measured;
    std::shared_ptr<const RadarDensity> density;
    std::vector<sim::PointInSpace> points;  ///< by altitude, in the site's frame; a single foot at 110 km
    Eigen::VectorXd density_cm3, one_over_sigma;
    Eigen::MatrixXd modes;       ///< M: [altitude, mode], the scale first
    double scale_sigma = 0.0;    ///< 0: the scale is held
    Eigen::Index strongest = 0;  ///< altitude of the largest density
  };
  struct Solution;

  static Radar prepared(const sim::Scene& scene, const sim::RadarEntry& entry);
  static Solution solved(const Radar& radar, const Eigen::VectorXd& electrons_cm3);

  std::vector<Radar> radars_;
  int rows_ = 0;
};

/// The radars of one cost: the scene that they see, and how free numbers move it.
struct RadarTerm {
  const Radars* radars;  ///< must outlive the cost
  sim::Scene scene;
  ParameterMap map;
};

}  // namespace vegard::fit
