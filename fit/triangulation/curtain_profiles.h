// The height of a curtain by its light along the field lines: at the right height of its lower border, both
// cameras see the same light at the same places.
//
// For each height the border of one picture is laid at that height, and field lines (IGRF-14) are drawn
// through it. Along them the light of both pictures is compared piece by piece of the border: the light's
// ranks within a piece, so that gains, tone curves and slow differences between the pieces do not matter. A
// piece with the correlation r adds -log(1 - r^2) / 2 to the logarithm of the likelihood for each independent
// place (the likelihood of normal variables whose correlation is known only by the sample: R. A. Fisher,
// Biometrika 10, 1915). Heights and a movement of the light between the pictures, across the line between the
// cameras, are found together. A movement along that line looks as another height would: it cannot be seen,
// and border_km_per_km says what it does.
//
// Errors: by leaving out each piece in turn (delete-a-group jackknife: B. Efron, "The jackknife, the
// bootstrap and other resampling plans", 1982), and by doing it again with each camera turned, the border at
// another level, the field tilted, and less of the field lines.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "fit/photo/photo.h"
#include "fit/triangulation/matched_curves.h"
#include "fit/triangulation/mean_profiles.h"

namespace vegard::fit {

struct ProfileSettings {
  HeightRange range{75.0, 220.0};  ///< of the border
  int channel = 1;                 ///< of Photo::linear
  double year = 2020.0;            ///< of the field, decimal
  double lowest_elevation_deg = 5.0;
  double moved_km = 1.0;  ///< standard deviation of the light's movement in each direction
  int threads = 0;
};

struct ProfileMatch {
  double border_km, across_km;     ///< the light has moved by the latter, to the left of the base, in between
  Eigen::Matrix2d covariance_km2;  ///< of both, without the clocks
  double level_error_km;           ///< of that, by the level at which the border is taken
  double border_km_per_km;         ///< border_km is too high by this for a movement of 1 km along the base
  /// What the border of the other picture says, if that is as clear and differs beyond the errors; else NaN.
  double contradicting_km, contradicting_error_km;
  double correlation = 0.0;       ///< of ranks: the median of the pieces
  double alike = 0.0;             ///< share of the pieces with a correlation above a half
  double weight = 0.0;            ///< of this height among all, and no match at all
  Eigen::Vector3d along, across;  ///< level unit vectors in the Earth's axes: of the base, and to its left
  std::vector<double> height_km, likelihood;  ///< mean of the pieces' -log(1 - r^2) / 2
  MeanProfiles profiles;                      ///< at this height

  ProfileMatch();
  bool is_given() const;
  /// Whether this height is clearly the most probable, and the light alike in half of the pieces.
  bool is_clear() const;
};

/// The border as one camera sees it, and at the level of the light at which it may be as well
/// (level_error()).
struct BorderCurve {
  PictureCurve border, higher;
};

/// Finds the height of the border of camera `curve.border.camera`; the other of the two cameras needs no
/// border. Photos have their cameras' sizes. The movement counts from the first camera's picture to the
/// second's. The same pictures give the same answer for every number of threads.
ProfileMatch profile_match(const std::vector<ViewPoint>& cameras, const std::vector<const Photo*>& photos,
                           const BorderCurve& curve, const ProfileSettings& settings);

/// Joins the answers by the borders of both pictures: their weighted mean, with half of their difference as
/// an error. If only one is given it is that; if they differ beyond three errors, the one that is clear, or
/// the better one with what contradicts it.
ProfileMatch joined_profiles(const ProfileMatch& a, const ProfileMatch& b);

}  // namespace vegard::fit
