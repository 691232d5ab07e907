#include "fit/photo/pointing/joint/same_lens.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "fit/photo/pointing/star_check.h"
#include "sim/base/error.h"
#include "sim/base/number/dense_solvers.h"

namespace vegard::fit {
namespace {

constexpr int kJointSteps = 40, kJointHalvings = 12, kJointRounds = 6;
constexpr double kJointSmall = 1e-13;  // relative change of the sum of squares

/// A lens in all pictures: the camera of each, which differ in their rotation alone.
using Cameras = std::vector<SkyCamera>;

class SameLensFit {
 public:
  SameLensFit(const std::vector<LensPicture>& pictures, const std::vector<StarSet>& used,
              const std::vector<LensNumber>& free)
      : pictures_(pictures), used_(used) {
    for (const LensNumber number : free) (number <= turn_about_forward ? turns_ : lens_).push_back(number);
  }

  int numbers() const { return static_cast<int>(turns_.size() * pictures_.size() + lens_.size()); }

  /// Of the stars in use, a picture after the other; infinite where the lens has no image.
  Eigen::VectorXd left(const Cameras& cameras) const {
    std::vector<double> all;
    for (std::size_t f = 0; f < pictures_.size(); ++f) {
      const std::vector<Eigen::Vector2d> one = residuals(cameras[f], pictures_[f].stars);
      for (std::size_t i = 0; i < one.size(); ++i)
        if (used_[f][i] != 0) all.insert(all.end(), {one[i][0], one[i][1]});
    }
    return Eigen::Map<const Eigen::VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
  }

  /// d place / d number: the turns of each picture, then the lens's numbers.
  Eigen::MatrixXd jacobian(const Cameras& cameras) const {
    int rows = 0;
    for (const StarSet& set : used_) rows += 2 * count(set);
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(rows, numbers());
    const auto turns = static_cast<Eigen::Index>(turns_.size());
    const auto lens = static_cast<Eigen::Index>(lens_.size());
    Eigen::Index row = 0;
    for (std::size_t f = 0; f < pictures_.size(); ++f) {
      const Eigen::Index n = 2 * count(used_[f]);
      if (n == 0) continue;
      all.block(row, turns * static_cast<Eigen::Index>(f), n, turns) =
          place_jacobian(cameras[f], turns_, pictures_[f].stars, used_[f]);
      all.block(row, all.cols() - lens, n, lens) =
          place_jacobian(cameras[f], lens_, pictures_[f].stars, used_[f]);
      row += n;
    }
    return all;
  }

  /// By Gauss and Newton, with steps halved until they descend. False if a star has no image.
  bool run(Cameras& cameras, double& sum) const {
    sum = left(cameras).squaredNorm();
    if (!std::isfinite(sum)) return false;
    for (int step = 0; step < kJointSteps; ++step) {
      const Eigen::VectorXd move = sim::least_squares(jacobian(cameras), left(cameras));
      if (!move.allFinite()) return false;
      double part = 1.0, next = 0.0;
      Cameras moved;
      for (int half = 0; half < kJointHalvings; ++half, part *= 0.5) {
        moved = with_move(cameras, part * move);
        next = left(moved).squaredNorm();
        if (next < sum) break;
      }
      if (!(next < sum)) return true;
      const double gain = sum - next;
      cameras = moved;
      sum = next;
      if (gain < kJointSmall * sum + 1e-18) return true;
    }
    return true;
  }

 private:
  Cameras with_move(const Cameras& cameras, const Eigen::VectorXd& move) const {
    Cameras moved = cameras;
    const auto turns = static_cast<Eigen::Index>(turns_.size());
    const auto lens = static_cast<Eigen::Index>(lens_.size());
    for (std::size_t f = 0; f < moved.size(); ++f) {
      for (Eigen::Index j = 0; j < turns; ++j)
        moved[f].numbers[turns_[static_cast<std::size_t>(j)]] +=
            move[turns * static_cast<Eigen::Index>(f) + j];
      for (Eigen::Index j = 0; j < lens; ++j)
        moved[f].numbers[lens_[static_cast<std::size_t>(j)]] += move[move.size() - lens + j];
      moved[f] = with_rotation_applied(moved[f]);
    }
    return moved;
  }

  const std::vector<LensPicture>& pictures_;
  const std::vector<StarSet>& used_;
  std::vector<LensNumber> turns_, lens_;
};

/// The residuals of a set of rows by a fit without them; NaN if nothing else determines a number.
Eigen::VectorXd left_without(const Eigen::MatrixXd& basis, const Eigen::VectorXd& left,
                             const std::vector<Eigen::Index>& rows) {
  constexpr double kHeldAlone = 1e-9;
  const auto n = static_cast<Eigen::Index>(rows.size());
  Eigen::MatrixXd own(n, basis.cols());
  Eigen::VectorXd r(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    own.row(i) = basis.row(rows[static_cast<std::size_t>(i)]);
    r[i] = left[rows[static_cast<std::size_t>(i)]];
  }
  const Eigen::MatrixXd rest = Eigen::MatrixXd::Identity(n, n) - own * own.transpose();
  const std::optional<Eigen::MatrixXd> inverse = sim::inverse_of_definite(rest, kHeldAlone);
  if (!inverse) return Eigen::VectorXd::Constant(n, std::numeric_limits<double>::quiet_NaN());
  return *inverse * r;
}

Eigen::MatrixXd basis_of(Eigen::MatrixXd jacobian) {
  for (Eigen::Index j = 0; j < jacobian.cols(); ++j) jacobian.col(j).normalize();
  return sim::orthonormal_columns(jacobian);
}

class SameLens {
 public:
  SameLens(const LensSettings& settings, const std::vector<LensPicture>& pictures, const Frame& frame)
      : pictures_(pictures), frame_(frame), keeps_all_(settings.keeps_all) {
    // All stars in the axes of their own cameras, as one picture: a start for every lens.
    std::vector<StarSighting> joined;
    std::size_t most = 0;
    for (std::size_t f = 0; f < pictures.size(); ++f) {
      if (pictures[f].stars.size() > pictures[most].stars.size()) most = f;
      used_.push_back(pictures[f].used);
      for (std::size_t i = 0; i < pictures[f].stars.size(); ++i) {
        if (pictures[f].used[i] == 0) continue;
        StarSighting star = pictures[f].stars[i];
        const Eigen::Vector3d v =
            pictures[f].camera.camera_from_enu * Eigen::Vector3d(star.enu[0], star.enu[1], star.enu[2]);
        star.enu = {v[0], v[1], v[2]};
        joined.push_back(star);
      }
    }
    LensSettings start = settings;
    start.only.clear();
    start.start = pictures[most].camera;
    start.start->camera_from_enu.setIdentity();
    candidates_ = choose_lens(start, joined, frame).candidates;
    for (const LensCandidate& candidate : candidates_) {
      Cameras cameras;
      for (const LensPicture& picture : pictures) {
        cameras.push_back(candidate.fit.camera);
        cameras.back().camera_from_enu =
            candidate.fit.camera.camera_from_enu * picture.camera.camera_from_enu;
      }
      cameras_.push_back(cameras);
    }
  }

  /// True if a lens was chosen.
  bool run() {
    for (int round = 0; round < kJointRounds; ++round) {
      fit_all();
      if (chosen_ < 0) return false;
      if (keeps_all_) return true;
      const LensCandidate& best = candidates_[static_cast<std::size_t>(chosen_)];
      std::vector<Eigen::Vector2d> left;
      StarSet joined;
      for (std::size_t f = 0; f < pictures_.size(); ++f) {
        const std::vector<Eigen::Vector2d> one = residuals(best_cameras()[f], pictures_[f].stars);
        left.insert(left.end(), one.begin(), one.end());
        joined.insert(joined.end(), used_[f].begin(), used_[f].end());
      }
      const int numbers = SameLensFit(pictures_, used_, best.free).numbers();
      const StarSet next = stars_kept(left, robust_sigma_px(left, joined, numbers));
      if (next == joined) return true;
      std::size_t first = 0;
      for (StarSet& set : used_)
        for (char& one : set) one = next[first++];
    }
    fit_all();
    return chosen_ >= 0;
  }

  std::vector<Calibration> calibrations() const {
    const LensCandidate& best = candidates_[static_cast<std::size_t>(chosen_)];
    const SameLensFit fit(pictures_, used_, best.free);
    const Eigen::MatrixXd jacobian = fit.jacobian(best_cameras());
    const Eigen::MatrixXd basis = basis_of(jacobian), root = root_of_inverse(jacobian);
    const Eigen::VectorXd left = fit.left(best_cameras());
    const double degrees = static_cast<double>(left.size() - jacobian.cols());
    std::vector<Calibration> all;
    Eigen::Index row = 0;
    for (std::size_t f = 0; f < pictures_.size(); ++f) {
      Calibration one;
      one.camera = best_cameras()[f];
      one.frame = frame_;
      one.form = best.form;
      one.candidates = candidates_;
      for (std::size_t c = 0; c < candidates_.size(); ++c) one.candidates[c].fit.camera = cameras_[c][f];
      one.chosen = chosen_;
      one.stars = pictures_[f].stars;
      set_residuals(one, used_[f]);
      one.sigma_px = degrees > 0.0 ? std::sqrt(left.squaredNorm() / degrees) : 0.0;
      hold_out(one, basis, left, row);
      Eigen::MatrixXd roots = Eigen::MatrixXd::Zero(lens_numbers, root.cols());
      Eigen::Index turn = 3 * static_cast<Eigen::Index>(f);
      Eigen::Index number = 3 * static_cast<Eigen::Index>(pictures_.size());
      for (const LensNumber which : best.free)
        roots.row(which) = root.row(which <= turn_about_forward ? turn++ : number++);
      set_errors(one, roots, best.free);
      set_warnings(one);
      all.push_back(one);
    }
    return all;
  }

 private:
  const Cameras& best_cameras() const { return cameras_[static_cast<std::size_t>(chosen_)]; }

  void fit_all() {
    int stars = 0;
    for (const StarSet& set : used_) stars += count(set);
    for (std::size_t c = 0; c < candidates_.size(); ++c) {
      LensCandidate& candidate = candidates_[c];
      if (!candidate.fit.good) continue;
      const SameLensFit fit(pictures_, used_, candidate.free);
      const int k = fit.numbers();
      candidate.objection = count_objection(2 * stars, k);
      if (!candidate.objection.empty()) continue;
      double sum = 0.0;
      if (!fit.run(cameras_[c], sum)) {
        candidate.objection = "it has no image of every star";
        continue;
      }
      const Eigen::MatrixXd jacobian = fit.jacobian(cameras_[c]);
      if (!are_determined(jacobian)) {
        candidate.objection = "the stars do not tell its numbers apart";
        continue;
      }
      candidate.fit.camera = cameras_[c].front();
      candidate.fit.sum_of_squares = sum;
      candidate.rms_px = std::sqrt(sum / stars);
      candidate.without_rms_px = without_rms(basis_of(jacobian), fit.left(cameras_[c]));
      candidate.bic = lens_criterion(sum, 2 * stars, k);
      candidate.is_held = is_held_by_stars(stars, k, candidate.rms_px, candidate.without_rms_px);
      if (!candidate.is_held) candidate.objection = "single stars hold its numbers";
    }
    chosen_ = preferred_lens(candidates_);
  }

  static double without_rms(const Eigen::MatrixXd& basis, const Eigen::VectorXd& left) {
    double sum = 0.0;
    for (Eigen::Index row = 0; row < left.size(); row += 2) {
      const Eigen::VectorXd one = left_without(basis, left, {row, row + 1});
      if (!one.allFinite()) return std::numeric_limits<double>::infinity();
      sum += one.squaredNorm();
    }
    return std::sqrt(sum / (0.5 * static_cast<double>(left.size())));
  }

  /// The residuals of one picture's stars by fits without them; `row`: of its first star, then of the next
  /// picture's.
  static void hold_out(Calibration& calibration, const Eigen::MatrixXd& basis, const Eigen::VectorXd& left,
                       Eigen::Index& row) {
    std::map<std::string, std::vector<std::pair<std::size_t, Eigen::Index>>> regions;
    double sum = 0.0;
    for (std::size_t i = 0; i < calibration.stars.size(); ++i) {
      StarResidual& one = calibration.residuals[i];
      if (!one.used) continue;
      const Eigen::VectorXd without = left_without(basis, left, {row, row + 1});
      one.without_dx_px = without[0];
      one.without_dy_px = without[1];
      sum += without.squaredNorm();
      const StarSighting& star = calibration.stars[i];
      regions[region_name(calibration.frame, star.x_px, star.y_px)].emplace_back(i, row);
      row += 2;
    }
    calibration.without_rms_px = std::sqrt(sum / std::max(1, calibration.used()));
    for (const auto& [name, members] : regions) {
      std::vector<Eigen::Index> rows;
      for (const auto& [star, at] : members) rows.insert(rows.end(), {at, at + 1});
      const Eigen::VectorXd without = left_without(basis, left, rows);
      for (std::size_t m = 0; m < members.size(); ++m) {
        StarResidual& one = calibration.residuals[members[m].first];
        one.without_region_dx_px = without[static_cast<Eigen::Index>(2 * m)];
        one.without_region_dy_px = without[static_cast<Eigen::Index>(2 * m + 1)];
      }
    }
  }

  const std::vector<LensPicture>& pictures_;
  const Frame& frame_;
  bool keeps_all_;
  std::vector<StarSet> used_;
  std::vector<LensCandidate> candidates_;
  std::vector<Cameras> cameras_;  ///< of each candidate
  int chosen_ = -1;
};

}  // namespace

std::vector<Calibration> calibrate_same_lens(const LensSettings& settings,
                                             const std::vector<LensPicture>& pictures, const Frame& frame,
                                             const std::string& name) {
  for (const LensPicture& picture : pictures)
    if (picture.camera.mirrored != pictures.front().camera.mirrored)
      throw sim::unreadable(picture.name, "this picture is the mirror image of the first one's")
          .expected("pictures of one camera");
  SameLens together(settings, pictures, frame);
  if (!together.run())
    throw sim::unreadable(name, "no lens brings the stars of all pictures to where they were seen")
        .expected("pictures of one camera with the same zoom, size and crop")
        .hint("calibrate each alone, and compare their focal lengths");
  return together.calibrations();
}

}  // namespace vegard::fit
