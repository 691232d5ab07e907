// Which lens the stars justify, and which stars are none of it.
//
// Every lens form is fitted by least squares to the same stars, and compared by Schwarz's criterion (Annals
// of Statistics 6, 1978, 461) for noise that is normal and of unknown variance: BIC = n ln(RSS / n) + k ln n,
// with n = 2 N residuals of N stars and k free numbers. Chosen is, of the lenses within 2 of the least BIC (a
// difference "not worth more than a bare mention": Kass and Raftery, Journal of the American Statistical
// Association 90, 1995, 773), that with the fewest numbers, then that with the lowest BIC. A lens takes part
// if it leaves at least 4 residuals more than it has numbers, and at least half as many more.
//
// Mistaken stars: first every lens is fitted with Cauchy's loss, which a mistaken star can hardly pull. What
// lies farther off than 5 robust standard deviations (of one coordinate; the median distance over 1.1774,
// corrected for the numbers fitted) is left out; then the lens is chosen with plain least squares on the
// others, and all stars, those left out too, are judged again under it until the set stays.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fit/photo/pointing/camera_fit.h"
#include "fit/photo/pointing/lens_form.h"

namespace vegard::fit {

inline constexpr double kRejectionSigmas = 5.0;
/// No star is left out for being off by less.
inline constexpr double kLeastRejection_px = 0.02;

struct LensCandidate {
  LensForm form;
  std::vector<LensNumber> free;
  CameraFit fit;
  double rms_px = 0.0;  ///< sqrt(sum (dx^2 + dy^2) / N) over the stars in use
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

/// The standard deviation of one coordinate that the median distance speaks of.
double robust_sigma_px(const std::vector<Eigen::Vector2d>& left, const StarSet& used, int free_numbers);

}  // namespace vegard::fit
