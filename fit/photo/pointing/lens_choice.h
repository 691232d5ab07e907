// Chooses the lens that the stars justify, and rejects outliers among the stars.
//
// Every lens form is fitted by least squares to the same stars, and compared by Schwarz's criterion (Annals
// of Statistics 6, 1978, 461) for noise that is normal and of unknown variance: BIC = n ln(RSS / n) + k ln n,
// with n = 2 N residuals of N stars and k free numbers. Chosen is, of the lenses within 2 of the least BIC (a
// difference "not worth more than a bare mention": Kass and Raftery, Journal of the American Statistical
// Association 90, 1995, 773), that with the fewest numbers, then that with the lowest BIC. A lens takes part
// if it leaves at least 4 residuals more than it has numbers, and at least half as many more; and if it
// foretells each star by a fit without it better (by the mean square) than every lens with fewer numbers that
// takes part: with few stars BIC alone believes residuals that the many numbers of a lens have drawn to
// nothing.
//
// A fit without star i leaves (I - H_ii)^-1 r_i (Cook and Weisberg, Residuals and Influence in Regression,
// 1982, 2.2), with its residual r_i and its block of the hat matrix H = J (J' J)^-1 J'.
//
// Mistaken stars: first every lens is fitted with Cauchy's loss, which a mistaken star can hardly pull. What
// lies farther off than 5 robust standard deviations (of one coordinate; the median distance over 1.1774,
// corrected for the numbers fitted) is left out; then the lens is chosen with plain least squares on the
// others, and all stars, those left out too, are tested again under it until the set stays. Of fewer than
// twenty stars the scatter is known too little for that: none is left out for less than a pixel, and not more
// than a fifth of them, the farthest.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fit/photo/pointing/camera_fit.h"
#include "fit/photo/pointing/lens_form.h"

namespace vegard::fit {

inline constexpr double kRejectionSigmas = 5.0;
/// No star is left out for being off by less; of fewer stars than kManyStars, for less than kFewMin_px.
inline constexpr double kMinRejection_px = 0.02, kFewMin_px = 1.0;
inline constexpr int kManyStars = 20;
/// The share of few stars that may be left out.
inline constexpr double kFewLeftOut = 0.2;

struct LensCandidate {
  LensForm form;
  std::vector<LensNumber> free;
  CameraFit fit;
  double rms_px = 0.0;          ///< sqrt(sum (dx^2 + dy^2) / N) over the stars in use
  double without_rms_px = 0.0;  ///< the same of the residuals of fits without each star, by the leverages
  double bic = 0.0;
  std::string objection;  ///< why it takes no part; empty if it does
};

struct LensChoice {
  std::vector<LensCandidate> candidates;
  int chosen = -1;  ///< -1: none could be fitted
  StarSet used;
};

/// What may be chosen from.
struct LensSettings {
  std::optional<sim::LensModel> model;  ///< only this one's
  std::optional<LensForm> form;         ///< only this
  bool centre_free = true;              ///< else it stays in the frame's middle, or that of `start`
  std::optional<SkyCamera> start;       ///< of its own model; others start by themselves
  std::vector<LensNumber> only;         ///< free numbers of `start`, whose lens stays; empty: choose a lens
};

LensChoice choose_lens(const LensSettings& settings, const std::vector<StarSighting>& stars,
                       const Frame& frame);

/// sqrt of the mean over the stars in use of |(I - H_ii)^-1 r_i|^2; infinite where a star alone holds a
/// number.
double left_one_out_rms_px(const SkyCamera& camera, const std::vector<LensNumber>& free,
                           const std::vector<StarSighting>& stars, const StarSet& used);

/// Which stars stay in use, by their residuals: see above.
StarSet stars_kept(const std::vector<Eigen::Vector2d>& left, double sigma_px);

/// The standard deviation of one coordinate that the median distance speaks of.
double robust_sigma_px(const std::vector<Eigen::Vector2d>& left, const StarSet& used, int free_numbers);

}  // namespace vegard::fit
