// Chooses the lens that the stars justify, and rejects outliers among the stars.
//
// Every lens form is fitted by least squares to the same stars, and compared by Schwarz's criterion (Annals
// of Statistics 6, 1978, 461) for noise that is normal and of unknown variance: BIC = n ln(RSS / n) + k ln n,
// with n = 2 N residuals of N stars and k free numbers. Of the lenses within 2 of the least BIC (a difference
// "not worth more than a bare mention": Kass and Raftery, Journal of the American Statistical Association 90,
// 1995, 773), the one with the fewest numbers is chosen, then the one with the lowest BIC. A lens takes part
// if there are at least 4 residuals more than it has numbers, and at least half as many more; and if its
// leave-one-out predictions of the stars are better (by the mean square) than those of every lens with fewer
// numbers that takes part. With few stars BIC alone would prefer lenses whose many numbers fit the noise.
//
// The residual of a fit without star i is (I - H_ii)^-1 r_i (Cook and Weisberg, Residuals and Influence in
// Regression, 1982, 2.2), with its residual r_i and its block of the hat matrix H = J (J' J)^-1 J'.
//
// Of k numbers fitted to n residuals, a residual is (1 - k / n) of that of a fit without its star, if all
// stars weigh alike. Where few stars are kHeldTimes as far off, and by more than a pixel, some number hangs
// on a single star, and a lens with wrong names could pass as well: such a lens takes no part.
//
// Outliers: first every lens is fitted with Cauchy's loss, which limits the influence of a mistaken star.
// Stars with residuals above 5 robust standard deviations (of one coordinate: the median distance
// over 1.1774, corrected for the numbers fitted) are rejected. Then the lens is chosen by plain least squares
// with the others, and all stars, also the rejected ones, are tested again under it until the set does not
// change. No more are rejected than leave enough for the simplest lens. For fewer than twenty stars, whose
// scatter is not known well, none is rejected for less than a pixel, and at most a fifth of them, the
// farthest.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fit/photo/pointing/camera_fit.h"
#include "fit/photo/pointing/lens_form.h"

namespace vegard::fit {

inline constexpr double kRejectionSigmas = 5.0;
/// The least residual for which a star is rejected, and the same for fewer stars than kManyStars.
inline constexpr double kMinRejection_px = 0.02, kFewMin_px = 1.0;
inline constexpr int kManyStars = 20;
/// From the first number of stars to the second, lenses without terms are also tried with their centre in the
/// middle of the picture.
inline constexpr int kFewestStars = 5, kVeryFewStars = 7;
/// Of fewer stars than kManyStars: how many times farther off than by the count of its numbers a star may be
/// by a fit without it, and from how many pixels on that counts.
inline constexpr double kHeldTimes = 3.0, kHeld_px = 1.0;
/// The largest share of few stars that may be rejected.
inline constexpr double kFewLeftOut = 0.2;

struct LensCandidate {
  LensForm form;
  std::vector<LensNumber> free;
  CameraFit fit;
  double rms_px = 0.0;          ///< sqrt(sum (dx^2 + dy^2) / N) over the stars in use
  double without_rms_px = 0.0;  ///< the same of the leave-one-out residuals
  double bic = 0.0;
  std::string objection;  ///< why it takes no part; empty if it takes part
  bool is_held = true;    ///< whether it would be much the same without any one of the stars
};

/// True unless few stars are much farther off by fits without them (see above).
bool is_held_by_stars(int stars, int numbers, double rms_px, double without_rms_px);

/// Objects to every lens than which one of fewer numbers foretells stars better, and returns the index of the
/// one that BIC prefers among those without objection; -1: there is none.
int preferred_lens(std::vector<LensCandidate>& candidates);

/// Returns the objection to a lens whose numbers are too many for the residuals; empty if they are not.
std::string count_objection(int residuals, int numbers);

/// Returns Schwarz's criterion, BIC.
double lens_criterion(double sum_of_squares, int residuals, int numbers);

/// True if the columns of a Jacobian determine the numbers, by its singular values once they have length 1.
bool are_determined(Eigen::MatrixXd jacobian);

struct LensChoice {
  std::vector<LensCandidate> candidates;
  int chosen = -1;  ///< -1: none could be fitted
  StarSet used;
};

/// The lenses to choose from.
struct LensSettings {
  std::optional<sim::LensModel> model;  ///< only lenses of this model
  std::optional<LensForm> form;         ///< only this lens
  bool centre_free = true;              ///< false: the centre is the frame's middle, or that of `start`
  std::optional<SkyCamera> start;  ///< where lenses of its model start, and others that see the stars alike
  std::function<void(double share)> progress;  ///< told the share of the work that is done, from any thread
  bool keeps_all = false;                      ///< true: no star is left out
  std::vector<LensNumber> only;  ///< the free numbers of `start`, whose lens is kept; empty: choose a lens
};

LensChoice choose_lens(const LensSettings& settings, const std::vector<StarSighting>& stars,
                       const Frame& frame);

/// Returns (I - H_ii)^-1 r_i of the stars in use, in their order; empty if a single star determines a number.
std::vector<Eigen::Vector2d> left_one_out(const SkyCamera& camera, const std::vector<LensNumber>& free,
                                          const std::vector<StarSighting>& stars, const StarSet& used);

/// Returns the square root of the mean of |(I - H_ii)^-1 r_i|^2 over the stars in use; infinite if a single
/// star determines a number.
double left_one_out_rms_px(const SkyCamera& camera, const std::vector<LensNumber>& free,
                           const std::vector<StarSighting>& stars, const StarSet& used);

/// Returns the stars that are not outliers by their residuals, as described above.
StarSet stars_kept(const std::vector<Eigen::Vector2d>& left, double sigma_px);

/// Returns the standard deviation of one coordinate by the median distance.
double robust_sigma_px(const std::vector<Eigen::Vector2d>& left, const StarSet& used, int free_numbers);

/// Returns the best camera with this lens model without any terms, mirrored or not; CameraFit::good is false
/// if no star is near its place.
CameraFit starting_camera(sim::LensModel model, bool mirrored, const std::vector<StarSighting>& stars,
                          const Frame& frame);

/// Fits a start without terms by Cauchy's loss, coarsely and then finely.
CameraFit refined_start(const SkyCamera& start, const std::vector<StarSighting>& stars);

/// Returns the sum over stars of min(r^2, (a twentieth of the stars' extent)^2) in px^2, by which starts are
/// compared.
double truncated_sum(const SkyCamera& camera, const std::vector<StarSighting>& stars);
/// The same of a camera that has no star near its place.
double lost_sum(const std::vector<StarSighting>& stars);

}  // namespace vegard::fit
