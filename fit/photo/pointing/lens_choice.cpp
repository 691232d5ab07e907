#include "fit/photo/pointing/lens_choice.h"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>

#include "sim/base/number/dense_solvers.h"
#include "sim/base/number/quantile.h"
#include "sim/base/parallel.h"

namespace vegard::fit {
namespace {

constexpr double kWorthAMention = 2.0;  // of BIC
constexpr int kLensMaxRounds = 6;
constexpr double kMedianOfRayleigh = 1.1774100225154747;  // sqrt(2 ln 2)
constexpr double kExact_px2 = 1e-18;  // of RSS / n: noise-free stars must not make an infinite criterion
constexpr double kWorstCondition = 1e-7;
constexpr const char* kBeaten = "a lens with fewer numbers foretells each star from the others better";

class Chooser {
 public:
  Chooser(const LensSettings& settings, const std::vector<StarSighting>& stars, const Frame& frame)
      : settings_(settings), stars_(stars), frame_(frame) {}

  LensChoice run() {
    prepare();
    const int reference = fit_robustly();
    if (reference < 0) return choice_;
    const LensCandidate& best = choice_.candidates[reference];
    const std::vector<Eigen::Vector2d> left = residuals(best.fit.camera, stars_);
    choice_.used = kept(left, robust_sigma_px(left, {}, static_cast<int>(best.free.size())));
    for (int round = 0; round < kLensMaxRounds; ++round) {
      fit_plainly();
      if (choice_.chosen < 0) return choice_;
      const LensCandidate& chosen = choice_.candidates[choice_.chosen];
      const std::vector<Eigen::Vector2d> now = residuals(chosen.fit.camera, stars_);
      const StarSet next =
          kept(now, robust_sigma_px(now, choice_.used, static_cast<int>(chosen.free.size())));
      if (next == choice_.used) return choice_;
      choice_.used = next;
    }
    // They go back and forth: the last set it is, with the fit that belongs to it.
    fit_plainly();
    return choice_;
  }

 private:
  /// All stars where none is to be left out, or where the others would be too few for every lens.
  StarSet kept(const std::vector<Eigen::Vector2d>& left, double sigma_px) const {
    const StarSet all(stars_.size(), 1);
    if (settings_.keeps_all) return all;
    StarSet set = stars_kept(left, sigma_px);
    const int n = 2 * count(set);
    const bool enough = std::any_of(
        choice_.candidates.begin(), choice_.candidates.end(),
        [&](const auto& one) { return count_objection(n, static_cast<int>(one.free.size())).empty(); });
    return enough ? set : all;
  }

  SkyCamera centred() const {
    SkyCamera camera;
    camera.numbers[centre_x_number] = 0.5 * frame_.width_px;
    camera.numbers[centre_y_number] = 0.5 * frame_.height_px;
    return camera;
  }

  /// A start for every model, in every candidate of it.
  void prepare() {
    if (!settings_.only.empty()) {
      LensCandidate candidate;
      candidate.form = form_of(*settings_.start);
      candidate.free = settings_.only;
      candidate.fit.camera = *settings_.start;
      choice_.candidates.push_back(candidate);
      return;
    }
    std::vector<LensForm> forms;
    std::vector<sim::LensModel> models;
    for (const LensForm& form : lens_forms()) {
      if (settings_.model && form.model != *settings_.model) continue;
      if (settings_.form && words_of(form) != words_of(*settings_.form)) continue;
      forms.push_back(form);
      if (std::find(models.begin(), models.end(), form.model) == models.end()) models.push_back(form.model);
    }
    std::vector<CameraFit> fits(models.size());
    sim::parallel_for(models.size(), 0, [&](std::size_t m, int) {
      fits[m] = start_of(models[m]);
      tell_progress(static_cast<double>(forms.size()) / static_cast<double>(models.size()));
    });
    std::map<sim::LensModel, CameraFit> starts;
    for (std::size_t m = 0; m < models.size(); ++m) starts[models[m]] = fits[m];
    for (const LensForm& form : forms) {
      LensCandidate candidate;
      candidate.form = form;
      candidate.free = free_numbers(form, settings_.centre_free);
      candidate.fit = starts[form.model];
      drop_other_terms(candidate);
      if (!candidate.fit.good) candidate.objection = "no star comes out near its place";
      choice_.candidates.push_back(candidate);
      if (settings_.centre_free && static_cast<int>(stars_.size()) <= kVeryFewStars && is_plain(form))
        choice_.candidates.push_back(with_centre_held(candidate));
    }
  }

  static bool is_plain(const LensForm& form) { return form.radial == 0 && !form.decentring && !form.aspect; }

  LensCandidate with_centre_held(LensCandidate candidate) const {
    const SkyCamera middle = centred();
    candidate.free = free_numbers(candidate.form, false);
    candidate.fit.camera.numbers[centre_x_number] = middle.numbers[centre_x_number];
    candidate.fit.camera.numbers[centre_y_number] = middle.numbers[centre_y_number];
    return candidate;
  }

  /// The start may have terms that this form has not.
  static void drop_other_terms(LensCandidate& candidate) {
    const SkyCamera plain;
    for (int i = aspect_ratio_number; i < lens_numbers; ++i)
      if (std::find(candidate.free.begin(), candidate.free.end(), i) == candidate.free.end())
        candidate.fit.camera.numbers[i] = plain.numbers[i];
  }

  CameraFit start_of(sim::LensModel model) const {
    CameraFit best;
    double least = std::numeric_limits<double>::infinity();
    const auto offer = [&](const CameraFit& fit) {
      if (!fit.good) return;
      const double sum = truncated_sum(fit.camera, stars_);
      if (sum < least) {
        least = sum;
        best = fit;
      }
    };
    if (settings_.start && settings_.start->model == model) {
      CameraFit given;
      given.camera = *settings_.start;
      given.good = true;
      return given;
    }
    if (settings_.start)
      if (const std::optional<CameraFit> fit = start_by_other_lens(model, *settings_.start)) return *fit;
    offer(starting_camera(model, false, stars_, frame_));
    offer(starting_camera(model, true, stars_, frame_));
    if (!settings_.centre_free) {
      const SkyCamera middle = centred();
      best.camera.numbers[centre_x_number] = middle.numbers[centre_x_number];
      best.camera.numbers[centre_y_number] = middle.numbers[centre_y_number];
    }
    return best;
  }

  /// From where a camera with another lens looks: with the scale by which its pictures of the stars are as
  /// large. None if it does not have nearly all stars near their places, and has to be sought.
  std::optional<CameraFit> start_by_other_lens(sim::LensModel model, const SkyCamera& known) const {
    constexpr double kNearTheirPlaces = 0.1;  // of the sum of stars that are nowhere near
    SkyCamera camera = known;
    camera.model = model;
    for (int i = aspect_ratio_number; i < lens_numbers; ++i) camera.numbers[i] = SkyCamera().numbers[i];
    double both = 0.0, own = 0.0;
    for (const StarSighting& star : stars_) {
      double x = 0.0, y = 0.0, u = 0.0, v = 0.0;
      if (!place_of_star(known, star.enu, x, y) || !place_of_star(camera, star.enu, u, v)) continue;
      const double from_x = known.numbers[centre_x_number], from_y = known.numbers[centre_y_number];
      both += std::hypot(x - from_x, y - from_y) * std::hypot(u - from_x, v - from_y);
      own += (u - from_x) * (u - from_x) + (v - from_y) * (v - from_y);
    }
    if (!(both > 0.0) || !(own > 0.0)) return std::nullopt;
    camera.numbers[focal_px_number] *= both / own;
    CameraFit fit = refined_start(camera, stars_);
    if (!fit.good || !(truncated_sum(fit.camera, stars_) <= kNearTheirPlaces * lost_sum(stars_)))
      return std::nullopt;
    if (!settings_.centre_free) {
      fit.camera.numbers[centre_x_number] = centred().numbers[centre_x_number];
      fit.camera.numbers[centre_y_number] = centred().numbers[centre_y_number];
    }
    return fit;
  }

  /// Fits all lenses with Cauchy's loss at a scale that shrinks to the noise. Returns the best simple lens,
  /// -1 for none.
  int fit_robustly() {
    const int n = 2 * static_cast<int>(stars_.size());
    int best = -1;
    std::size_t fewest = 99;
    for (const LensCandidate& candidate : choice_.candidates)
      fewest = std::min(fewest, candidate.free.size());
    double least = std::numeric_limits<double>::infinity();
    std::vector<double> sigmas(choice_.candidates.size(), std::numeric_limits<double>::infinity());
    sim::parallel_for(choice_.candidates.size(), 0, [&](std::size_t c, int) {
      LensCandidate& candidate = choice_.candidates[c];
      const int k = static_cast<int>(candidate.free.size());
      if (candidate.objection.empty()) candidate.objection = count_objection(n, k);
      if (!candidate.objection.empty()) return;
      double sigma = 0.0;
      for (int step = 0; step < 3; ++step) {
        sigma = robust_sigma_px(residuals(candidate.fit.camera, stars_), {}, k);
        // A camera that is far off still: all stars count alike.
        if (!std::isfinite(sigma)) sigma = 0.05 * std::max(frame_.width_px, frame_.height_px);
        candidate.fit =
            fit_camera(candidate.fit.camera, candidate.free, stars_, {}, std::max(2.0 * sigma, 1e-3));
      }
      sigmas[c] = robust_sigma_px(residuals(candidate.fit.camera, stars_), {}, k);
      tell_progress();
    });
    for (std::size_t c = 0; c < choice_.candidates.size(); ++c) {
      const double sigma = sigmas[c];
      const int k = static_cast<int>(choice_.candidates[c].free.size());
      if (!std::isfinite(sigma)) continue;
      // Robust scales of lenses with many numbers are too small: half of the stars can be drawn to nothing.
      if (k > static_cast<int>(fewest) + 2) continue;
      const double value = lens_criterion(sigma * sigma * (n - k), n, k);
      if (value < least) {
        least = value;
        best = static_cast<int>(c);
      }
    }
    return best;
  }

  void fit_plainly() {
    const int stars = count(choice_.used), n = 2 * stars;
    // Each lens by itself, so that threads share them.
    sim::parallel_for(choice_.candidates.size(), 0, [&](std::size_t c, int) {
      LensCandidate& candidate = choice_.candidates[c];
      if (candidate.objection == "no star comes out near its place") return;
      const int k = static_cast<int>(candidate.free.size());
      candidate.objection = count_objection(n, k);
      if (!candidate.objection.empty()) return;
      const CameraFit fit = fit_camera(candidate.fit.camera, candidate.free, stars_, choice_.used);
      if (!fit.good) {
        candidate.objection = "it has no image of every star";
        return;
      }
      candidate.fit = fit;
      if (!are_determined(place_jacobian(candidate.fit.camera, candidate.free, stars_, choice_.used))) {
        candidate.objection = "the stars do not tell its numbers apart";
        return;
      }
      candidate.rms_px = std::sqrt(candidate.fit.sum_of_squares / stars);
      candidate.without_rms_px =
          left_one_out_rms_px(candidate.fit.camera, candidate.free, stars_, choice_.used);
      candidate.bic = lens_criterion(candidate.fit.sum_of_squares, n, k);
      candidate.is_held = is_held_by_stars(stars, k, candidate.rms_px, candidate.without_rms_px);
      if (!candidate.is_held) candidate.objection = "single stars hold its numbers";
      tell_progress();
    });
    choice_.chosen = preferred_lens(choice_.candidates);
  }

  /// Starts, robust fits and plain fits of a lens take about as long; the last are mostly made twice.
  void tell_progress(double lenses = 1.0) {
    if (!settings_.progress) return;
    const std::lock_guard<std::mutex> lock(of_progress_);
    constexpr double kTimes = 4.0, kMost = 0.95;
    done_ += lenses;
    settings_.progress(std::min(kMost, done_ / (kTimes * static_cast<double>(lens_forms().size()))));
  }

  const LensSettings& settings_;
  const std::vector<StarSighting>& stars_;
  const Frame& frame_;
  LensChoice choice_;
  std::mutex of_progress_;
  double done_ = 0.0;
};

/// To every lens than which one of fewer numbers foretells stars better.
void object_to_foretelling(std::vector<LensCandidate>& candidates) {
  constexpr double kExactly_px = 1e-9;  // below it all lenses are right, and rounding would decide
  std::vector<std::string> objections;
  for (const LensCandidate& one : candidates) {
    const bool beaten = one.objection.empty() &&
                        std::any_of(candidates.begin(), candidates.end(), [&](const LensCandidate& other) {
                          return other.objection.empty() && other.free.size() < one.free.size() &&
                                 one.without_rms_px > std::max(other.without_rms_px, kExactly_px);
                        });
    objections.push_back(beaten ? kBeaten : one.objection);
  }
  for (std::size_t c = 0; c < objections.size(); ++c) candidates[c].objection = objections[c];
}

}  // namespace

double lens_criterion(double sum_of_squares, int residuals, int numbers) {
  return residuals * std::log(std::max(sum_of_squares / residuals, kExact_px2)) +
         numbers * std::log(residuals);
}

bool are_determined(Eigen::MatrixXd jacobian) {
  for (Eigen::Index j = 0; j < jacobian.cols(); ++j) {
    const double length = jacobian.col(j).norm();
    if (!(length > 0.0) || !std::isfinite(length)) return false;
    jacobian.col(j) /= length;
  }
  const Eigen::VectorXd values = sim::singular_values(jacobian);
  return values[values.size() - 1] > kWorstCondition * values[0];
}

std::string count_objection(int residuals, int numbers) {
  if (residuals >= numbers + 4 && 2 * residuals >= 3 * numbers) return {};
  return "too few stars for " + std::to_string(numbers) + " numbers";
}

int preferred_lens(std::vector<LensCandidate>& candidates) {
  object_to_foretelling(candidates);
  double least = std::numeric_limits<double>::infinity();
  for (const LensCandidate& candidate : candidates)
    if (candidate.objection.empty()) least = std::min(least, candidate.bic);
  int chosen = -1;
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    const LensCandidate& candidate = candidates[c];
    if (!candidate.objection.empty() || candidate.bic > least + kWorthAMention) continue;
    if (chosen >= 0) {
      const LensCandidate& before = candidates[static_cast<std::size_t>(chosen)];
      if (candidate.free.size() > before.free.size()) continue;
      if (candidate.free.size() == before.free.size() && candidate.bic >= before.bic) continue;
    }
    chosen = static_cast<int>(c);
  }
  return chosen;
}

bool is_held_by_stars(int stars, int numbers, double rms_px, double without_rms_px) {
  if (stars >= kManyStars || without_rms_px <= kHeld_px) return true;
  const double share_left = 1.0 - static_cast<double>(numbers) / (2.0 * stars);
  return without_rms_px * share_left <= kHeldTimes * rms_px;
}

double robust_sigma_px(const std::vector<Eigen::Vector2d>& left, const StarSet& used, int free_numbers) {
  std::vector<double> distances;
  for (std::size_t i = 0; i < left.size(); ++i)
    if (used.empty() || used[i] != 0) distances.push_back(left[i].norm());
  const int n = 2 * static_cast<int>(distances.size());
  if (n <= free_numbers) return std::numeric_limits<double>::infinity();
  return sim::median(distances) / kMedianOfRayleigh * std::sqrt(static_cast<double>(n) / (n - free_numbers));
}

std::vector<Eigen::Vector2d> left_one_out(const SkyCamera& camera, const std::vector<LensNumber>& free,
                                          const std::vector<StarSighting>& stars, const StarSet& used) {
  constexpr double kHeldAlone = 1e-6;  // of 1 - leverage: nothing else determines what this star determines
  Eigen::MatrixXd jacobian = place_jacobian(camera, free, stars, used);
  // An orthonormal basis of its columns has the same hat matrix, to all digits.
  for (Eigen::Index j = 0; j < jacobian.cols(); ++j) jacobian.col(j).normalize();
  const Eigen::MatrixXd basis = sim::orthonormal_columns(jacobian);
  const std::vector<Eigen::Vector2d> left = residuals(camera, stars);
  std::vector<Eigen::Vector2d> without;
  Eigen::Index row = 0;
  for (std::size_t i = 0; i < stars.size(); ++i) {
    if (!used.empty() && used[i] == 0) continue;
    const Eigen::MatrixXd own = basis.middleRows(row, 2);
    row += 2;
    const Eigen::Matrix2d rest = Eigen::Matrix2d::Identity() - own * own.transpose();
    if (!(rest.determinant() > kHeldAlone)) return {};
    without.emplace_back(rest.inverse() * left[i]);
  }
  return without;
}

double left_one_out_rms_px(const SkyCamera& camera, const std::vector<LensNumber>& free,
                           const std::vector<StarSighting>& stars, const StarSet& used) {
  const std::vector<Eigen::Vector2d> without = left_one_out(camera, free, stars, used);
  if (without.empty()) return std::numeric_limits<double>::infinity();
  double sum = 0.0;
  for (const Eigen::Vector2d& one : without) sum += one.squaredNorm();
  return std::sqrt(sum / static_cast<double>(without.size()));
}

StarSet stars_kept(const std::vector<Eigen::Vector2d>& left, double sigma_px) {
  const bool few = static_cast<int>(left.size()) < kManyStars;
  const double limit = std::max(kRejectionSigmas * sigma_px, few ? kFewMin_px : kMinRejection_px);
  std::vector<std::size_t> farthest;
  for (std::size_t i = 0; i < left.size(); ++i)
    if (!(left[i].norm() <= limit)) farthest.push_back(i);
  std::stable_sort(farthest.begin(), farthest.end(),
                   [&](std::size_t a, std::size_t b) { return left[a].norm() > left[b].norm(); });
  // A star of which the lens has no image has no residual and is always rejected.
  const auto none = static_cast<std::size_t>(
      std::count_if(left.begin(), left.end(), [](const Eigen::Vector2d& one) { return !one.allFinite(); }));
  const auto most = std::max(none, static_cast<std::size_t>(kFewLeftOut * static_cast<double>(left.size())));
  if (few && farthest.size() > most) farthest.resize(most);
  StarSet used(left.size(), 1);
  for (const std::size_t i : farthest) used[i] = 0;
  return used;
}

LensChoice choose_lens(const LensSettings& settings, const std::vector<StarSighting>& stars,
                       const Frame& frame) {
  return Chooser(settings, stars, frame).run();
}

}  // namespace vegard::fit
