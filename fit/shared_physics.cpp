#include "fit/shared_physics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "fit/answer/tables_correction.h"
#include "fit/columns/column_inversion.h"
#include "fit/columns/common_physics.h"
#include "sim/base/number/dense_solvers.h"

namespace vegard::fit {
namespace {

constexpr double kTellsNothing = 1e-2;         // information of a direction, of that of the prior
constexpr double kChanceToBeLeftOut = 0.0027;  // three standard deviations
constexpr double kLeastShareUsed = 2.0 / 3.0;

using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// What a picture says of the coefficients c that are in common: y = B c + noise of variance 1.
struct Told {
  Eigen::MatrixXd response;
  Eigen::VectorXd value;
};

Told told_of(const ModeInformation& picture) {
  const auto count = static_cast<Eigen::Index>(picture.modes.size());
  const sim::SymmetricEigen eigen =
      sim::symmetric_eigen(Eigen::Map<const RowMajorMatrix>(picture.information.data(), count, count));
  const Eigen::VectorXd along =
      eigen.vectors.transpose() * Eigen::Map<const Eigen::VectorXd>(picture.towards.data(), count);
  const Eigen::Index told = (eigen.values.array() > kTellsNothing).count();  // the last ones: ascending
  Told one{Eigen::MatrixXd(told, count), Eigen::VectorXd(told)};
  for (Eigen::Index i = 0; i < told; ++i) {
    const Eigen::Index k = count - told + i;
    const double information = eigen.values(k), scale = 1.0 + kOwnShare * information;
    one.response.row(i) =
        std::sqrt((1.0 - kOwnShare) * information / scale) * eigen.vectors.col(k).transpose();
    one.value(i) = along(k) / std::sqrt(information * scale);
  }
  return one;
}

/// The distribution of c.
struct Common {
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
};

/// The sums of what pictures say, and of the prior.
struct Sums {
  Eigen::MatrixXd information;
  Eigen::VectorXd towards;

  explicit Sums(Eigen::Index count)
      : information(Eigen::MatrixXd::Identity(count, count)), towards(Eigen::VectorXd::Zero(count)) {}
  void add(const Told& one, double times) {
    information += times * one.response.transpose() * one.response;
    towards += times * one.response.transpose() * one.value;
  }
  Common common() const {
    const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(information.rows(), information.cols());
    Common found{{}, sim::solve_symmetric(information, unit)};
    found.mean = found.covariance * towards;
    return found;
  }
};

/// Tests what a picture asks for against what others say.
void test_against(const Told& one, const Common& others, SharedFrame& frame) {
  const Eigen::VectorXd off = one.value - one.response * others.mean;
  const Eigen::MatrixXd covariance = Eigen::MatrixXd::Identity(off.size(), off.size()) +
                                     one.response * others.covariance * one.response.transpose();
  frame.degrees_of_freedom = static_cast<int>(off.size());
  frame.chi2 = off.size() > 0 ? off.dot(sim::solve_symmetric(covariance, off)) : 0.0;
  frame.chance = off.size() > 0 ? chi2_tail(frame.chi2, frame.degrees_of_freedom) : 1.0;
}

/// The combination, picture by picture.
class Combination {
 public:
  Combination(const std::vector<FrameOfNight>& given, SharedPhysics& r) : given_(given), r_(r) {
    r_.frames.resize(given.size());
    choose_tables();
    told_.resize(given.size());
    for (std::size_t i = 0; i < given.size(); ++i)
      if (r_.frames[i].use == PhysicsUse::used) told_[i] = told_of(given[i].told);
  }

  void run() {
    if (count_ == 0) {
      r_.why_not = "no fit says anything of the emission tables";
      return;
    }
    const std::size_t taken = used();
    leave_out();
    r_.used = used();
    judge(taken);
    for (std::size_t i = 0; i < given_.size(); ++i) put_numbers(i);
    if (r_.is_consistent) put_tables();
    put_means();
  }

 private:
  std::size_t used() const {
    return static_cast<std::size_t>(std::count_if(
        r_.frames.begin(), r_.frames.end(), [](const SharedFrame& f) { return f.use == PhysicsUse::used; }));
  }

  /// Those of the tables and modes that most pictures have; the first of several.
  void choose_tables() {
    const auto key = [](const ModeInformation& told) { return std::pair(told.tables, told.modes); };
    std::map<std::pair<std::string, std::vector<int>>, int> counts;
    for (const FrameOfNight& frame : given_)
      if (frame.converged && !frame.told.modes.empty()) ++counts[key(frame.told)];
    if (counts.empty()) return;
    const auto most = std::max_element(counts.begin(), counts.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    modes_ = most->first.second;
    count_ = static_cast<Eigen::Index>(modes_.size());
    for (std::size_t i = 0; i < given_.size(); ++i)
      if (given_[i].converged && key(given_[i].told) == most->first) r_.frames[i].use = PhysicsUse::used;
  }

  Sums sums() const {
    Sums all(count_);
    for (std::size_t i = 0; i < told_.size(); ++i)
      if (r_.frames[i].use == PhysicsUse::used) all.add(told_[i], 1.0);
    return all;
  }

  /// What is known in the end: of a combination that is not consistent, what the tables themselves say.
  Common known() const { return r_.is_consistent ? all_.common() : Sums(count_).common(); }
  double factor() const { return r_.is_consistent ? r_.factor : 1.0; }

  Common others_of(std::size_t i, const Sums& all) const {
    Sums rest = all;
    if (r_.frames[i].use == PhysicsUse::used) rest.add(told_[i], -1.0);
    return rest.common();
  }

  /// Leaves out pictures that contradict the others, the worst first.
  void leave_out() {
    const double limit = kChanceToBeLeftOut / static_cast<double>(std::max<std::size_t>(1, used()));
    for (;;) {
      const Sums all = sums();
      std::size_t worst = given_.size();
      for (std::size_t i = 0; i < given_.size(); ++i) {
        if (r_.frames[i].use == PhysicsUse::unknown) continue;
        test_against(told_[i], others_of(i, all), r_.frames[i]);
        if (r_.frames[i].use == PhysicsUse::used && r_.frames[i].chance < limit &&
            (worst == given_.size() || r_.frames[i].chance < r_.frames[worst].chance))
          worst = i;
      }
      if (worst == given_.size() || used() <= 2) return;
      r_.frames[worst].use = PhysicsUse::contradicts;
    }
  }

  void judge(std::size_t taken) {
    all_ = sums();
    const Common common = all_.common();
    r_.chi2 = common.mean.squaredNorm();
    for (std::size_t i = 0; i < told_.size(); ++i) {
      if (r_.frames[i].use != PhysicsUse::used) continue;
      r_.chi2 += (told_[i].value - told_[i].response * common.mean).squaredNorm();
      r_.degrees_of_freedom += static_cast<int>(told_[i].value.size());
    }
    if (r_.degrees_of_freedom > 0) {
      r_.chance = chi2_tail(r_.chi2, r_.degrees_of_freedom);
      r_.factor = std::sqrt(std::max(1.0, r_.chi2 / r_.degrees_of_freedom));
    }
    if (r_.used < 2)
      r_.why_not = "fewer than two fits say something of the emission tables";
    else if (static_cast<double>(r_.used) < kLeastShareUsed * static_cast<double>(taken))
      r_.why_not = "more than a third of the fits contradict the others";
    else if (r_.degrees_of_freedom > 0 && contradicts_tables(r_.chi2, r_.degrees_of_freedom))
      r_.why_not = "what the fits ask for together is not within the tables' uncertainty";
    r_.is_consistent = r_.why_not.empty();
  }

  void put_numbers(std::size_t i) {
    if (r_.frames[i].use == PhysicsUse::unknown) return;
    const Common others = r_.is_consistent ? others_of(i, all_) : known();
    for (const SequenceNumber& n : given_[i].numbers) {
      if (static_cast<Eigen::Index>(n.by_mode.size()) != count_ || !n.sigma || !std::isfinite(n.value))
        continue;
      const Eigen::Map<const Eigen::VectorXd> by_mode(n.by_mode.data(), count_);
      const double physics = by_mode.squaredNorm();
      if (!(physics > 0.0)) continue;
      const Eigen::VectorXd by_common = std::sqrt(1.0 - kOwnShare) * by_mode;
      const double change = by_common.dot(others.mean);
      const double times = n.relative ? std::exp(change / n.value) : 1.0;
      SharedNumber s{n.name, n.unit, n.value, *n.sigma, n.relative ? n.value * times : n.value + change,
                     0.0,    0.0,    {}};
      // The error bar has all that the modes do; what is left is the picture's.
      const double own = std::max(0.0, *n.sigma * *n.sigma - physics) + kOwnShare * physics;
      s.sigma_own = times * std::sqrt(own);
      s.sigma_common =
          times * factor() * std::sqrt(std::max(0.0, by_common.dot(others.covariance * by_common)));
      for (Eigen::Index k = 0; k < count_; ++k) s.by_common.push_back(times * by_common(k));
      r_.frames[i].numbers.push_back(std::move(s));
    }
  }

  /// Of the ratios of lines the mean over the pictures' electrons.
  void put_tables() {
    std::map<std::pair<double, double>, std::pair<int, Eigen::VectorXd>> lines;
    for (std::size_t i = 0; i < given_.size(); ++i) {
      if (r_.frames[i].use != PhysicsUse::used) continue;
      for (const LineByModes& line : given_[i].told.lines) {
        auto& [number, sum] = lines[{line.wavelength_nm, line.over_nm}];
        const Eigen::Map<const Eigen::VectorXd> ratio(line.ln_ratio.data(), count_);
        sum = number++ == 0 ? Eigen::VectorXd(ratio) : Eigen::VectorXd(sum + ratio);
      }
    }
    // Of a picture like these: the part of its own is not known.
    LearntModes learnt;
    const Common common = all_.common();
    r_.common = {modes_, common.mean, r_.factor * r_.factor * common.covariance};
    learnt.modes = modes_;
    learnt.value = std::sqrt(1.0 - kOwnShare) * common.mean;
    learnt.covariance = (1.0 - kOwnShare) * r_.common.covariance;
    learnt.covariance.diagonal().array() += kOwnShare;
    std::vector<LineByModes> mean;
    for (const auto& [nm, of] : lines) {
      mean.push_back({nm.first, nm.second, {}});
      for (Eigen::Index k = 0; k < count_; ++k) mean.back().ln_ratio.push_back(of.second(k) / of.first);
    }
    r_.tables = tables_corrections(mean, learnt);
  }

  void put_means() {
    const Common common = known();
    std::vector<std::string> names;
    std::map<std::string, std::vector<const SharedNumber*>> by_name;
    for (const SharedFrame& frame : r_.frames) {
      if (frame.use != PhysicsUse::used) continue;
      for (const SharedNumber& n : frame.numbers) {
        std::vector<const SharedNumber*>& same = by_name[n.name];
        if (same.empty()) names.push_back(n.name);
        same.push_back(&n);
      }
    }
    for (const std::string& name : names) {
      const std::vector<const SharedNumber*>& all = by_name[name];
      if (all.size() < 2) continue;
      r_.means.push_back(mean_of(all, common));
    }
  }

  /// The scatter by moments (DerSimonian and Laird 1986, Controlled Clinical Trials 7, 177).
  SharedMean mean_of(const std::vector<const SharedNumber*>& all, const Common& common) const {
    SharedMean mean;
    mean.name = all.front()->name;
    mean.unit = all.front()->unit;
    mean.frames = all.size();
    const auto weighted = [&](double scatter2) {
      double weights = 0.0, squares = 0.0, sum = 0.0;
      Eigen::VectorXd by_common = Eigen::VectorXd::Zero(count_);
      for (const SharedNumber* n : all) {
        const double weight = 1.0 / (n->sigma_own * n->sigma_own + scatter2);
        weights += weight;
        squares += weight * weight;
        sum += weight * n->value;
        by_common += weight * Eigen::Map<const Eigen::VectorXd>(n->by_common.data(), count_);
      }
      mean.value = sum / weights;
      mean.sigma_own = 1.0 / std::sqrt(weights);
      by_common /= weights;
      mean.sigma_common = factor() * std::sqrt(std::max(0.0, by_common.dot(common.covariance * by_common)));
      return std::pair(weights, squares);
    };
    const auto [weights, squares] = weighted(0.0);
    double chi2 = 0.0;
    for (const SharedNumber* n : all) chi2 += std::pow((n->value - mean.value) / n->sigma_own, 2);
    const double excess = chi2 - static_cast<double>(all.size() - 1);
    const double scatter2 = std::max(0.0, excess / (weights - squares / weights));
    mean.scatter = std::sqrt(scatter2);
    weighted(scatter2);
    return mean;
  }

  const std::vector<FrameOfNight>& given_;
  SharedPhysics& r_;
  std::vector<int> modes_;
  Eigen::Index count_ = 0;
  std::vector<Told> told_;
  Sums all_{0};
};

}  // namespace

double SharedNumber::sigma() const { return std::hypot(sigma_own, sigma_common); }
double SharedMean::sigma() const { return std::hypot(sigma_own, sigma_common); }

SharedPhysics share_physics(const std::vector<FrameOfNight>& frames) {
  SharedPhysics shared;
  Combination(frames, shared).run();
  return shared;
}

std::string shared_physics_words(const SharedPhysics& shared) {
  if (!shared.is_consistent)
    return "The frames do not calibrate their physics: " + shared.why_not + ". Each keeps its own answer.";
  const auto out = std::count_if(shared.frames.begin(), shared.frames.end(),
                                 [](const SharedFrame& f) { return f.use == PhysicsUse::contradicts; });
  std::string text =
      fmt::format("{} frames calibrate their physics together (chi2 {:.0f} for {} degrees of freedom)",
                  shared.used, shared.chi2, shared.degrees_of_freedom);
  if (out > 0) text += fmt::format("; {} that contradict them {} left out", out, out == 1 ? "is" : "are");
  if (shared.factor > 1.0)
    text += fmt::format("; errors in common are {:.2f} times as large for it", shared.factor);
  return text + ".";
}

}  // namespace vegard::fit
