#include "fit/survey/track_smoother.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "sim/base/number/constants.h"
#include "sim/base/number/distributions.h"

namespace vegard::fit {
namespace {

using TrackState = Eigen::Vector2d;
using TrackCovariance = Eigen::Matrix2d;

TrackCovariance transition_over(double time_s) {
  return (TrackCovariance() << 1.0, time_s, 0.0, 1.0).finished();
}

/// Returns the covariance that the noise of acceleration adds over a time.
TrackCovariance process_noise_over(double time_s, double q) {
  const double t2 = time_s * time_s;
  return q * (TrackCovariance() << t2 * time_s / 3.0, t2 / 2.0, t2 / 2.0, time_s).finished();
}

struct TrackEstimate {
  TrackState state = TrackState::Zero();
  TrackCovariance covariance = TrackCovariance::Zero();
};

TrackEstimate predicted(const TrackEstimate& from, double time_s, double q) {
  const TrackCovariance transition = transition_over(time_s);
  return {transition * from.state,
          transition * from.covariance * transition.transpose() + process_noise_over(time_s, q)};
}

/// Returns the estimate of the state at the second of two numbers, without a prior.
TrackEstimate first_estimate(const TrackPoint& first, const TrackPoint& second, double q) {
  const double t = second.time_s - first.time_s, r0 = first.sigma * first.sigma,
               r1 = second.sigma * second.sigma;
  TrackEstimate estimate;
  estimate.state << second.value, (second.value - first.value) / t;
  estimate.covariance << r1, r1 / t, r1 / t, (r0 + r1) / (t * t) + q * t / 3.0;
  return estimate;
}

struct Innovation {
  double difference = 0.0, variance = 1.0;
  double chi2() const { return difference * difference / variance; }
};

Innovation innovation_of(const TrackEstimate& estimate, const TrackPoint& point) {
  return {point.value - estimate.state[0], estimate.covariance(0, 0) + point.sigma * point.sigma};
}

/// Returns the estimate updated with a number.
TrackEstimate updated(const TrackEstimate& estimate, const Innovation& innovation) {
  const TrackState gain = estimate.covariance.col(0) / innovation.variance;
  TrackEstimate filtered;
  filtered.state = estimate.state + gain * innovation.difference;
  filtered.covariance = estimate.covariance - gain * estimate.covariance.row(0);
  filtered.covariance = 0.5 * (filtered.covariance + filtered.covariance.transpose()).eval();
  return filtered;
}

bool measures_position(const TrackPoint& point) {
  // Numbers whose squares no double can hold are no measurements either.
  constexpr double kMax = 1e100;
  return std::abs(point.value) < kMax && point.sigma < kMax && point.sigma > 1.0 / kMax;
}

using Indices = std::vector<std::size_t>;

/// The numbers that are used for the track, piece by piece in the order of time.
using Pieces = std::vector<Indices>;

/// The misfit of the third and later numbers: the sum over the squares of their normalised innovations, whose
/// mean is 1 if errors are as stated, and -2 log likelihood.
struct Misfit {
  double chi2 = 0.0, deviance = 0.0;
  int count = 0;
};
Misfit misfit_of(const std::vector<TrackPoint>& points, const Pieces& pieces, double q) {
  Misfit sum;
  for (const Indices& piece : pieces) {
    if (piece.size() < 3) continue;
    TrackEstimate estimate = first_estimate(points[piece[0]], points[piece[1]], q);
    for (std::size_t i = 2; i < piece.size(); ++i) {
      const TrackPoint& point = points[piece[i]];
      estimate = predicted(estimate, point.time_s - points[piece[i - 1]].time_s, q);
      const Innovation innovation = innovation_of(estimate, point);
      sum.chi2 += innovation.chi2();
      sum.deviance += innovation.chi2() + std::log(innovation.variance);
      ++sum.count;
      estimate = updated(estimate, innovation);
    }
  }
  return sum;
}

/// Limits of q: below `least` the noise moves nothing over all of the time, above `most` a number predicts
/// nothing of the next.
struct NoiseLimits {
  double least = 1.0, most = 1.0;
  bool any = false;
};

NoiseLimits noise_limits(const std::vector<TrackPoint>& points, const Pieces& pieces) {
  double shortest = std::numeric_limits<double>::infinity(), longest = 0.0, min_sigma = shortest,
         max_sigma = 0.0, low = shortest, high = -shortest;
  NoiseLimits limits;
  for (const Indices& piece : pieces) {
    if (piece.size() < 3) continue;
    limits.any = true;
    longest = std::max(longest, points[piece.back()].time_s - points[piece.front()].time_s);
    for (std::size_t i = 0; i < piece.size(); ++i) {
      const TrackPoint& point = points[piece[i]];
      if (i > 0) shortest = std::min(shortest, point.time_s - points[piece[i - 1]].time_s);
      min_sigma = std::min(min_sigma, point.sigma);
      max_sigma = std::max(max_sigma, point.sigma);
      low = std::min(low, point.value);
      high = std::max(high, point.value);
    }
  }
  if (!limits.any) return limits;
  constexpr double kFar = 1e4;
  limits.least = min_sigma * min_sigma / (kFar * longest * longest * longest);
  const double width = high - low + max_sigma;
  limits.most = kFar * width * width / (shortest * shortest * shortest);
  return limits;
}

/// Returns values of ln q in even steps, kNodesOfTen to a power of ten.
std::vector<double> noise_nodes(const NoiseLimits& limits) {
  constexpr double kNodesOfTen = 4.0;
  const double begin = std::log(limits.least), length = std::log(limits.most) - begin;
  const int steps = std::max(4, static_cast<int>(std::ceil(kNodesOfTen / std::log(10.0) * length)));
  std::vector<double> nodes;
  for (int i = 0; i <= steps; ++i) nodes.push_back(begin + length * i / steps);
  return nodes;
}

/// Returns the q of the largest likelihood: the best node, then by golden sections between its neighbours.
double best_noise(const std::vector<TrackPoint>& points, const Pieces& pieces) {
  const NoiseLimits limits = noise_limits(points, pieces);
  if (!limits.any) return 0.0;
  const auto deviance = [&](double log_q) { return misfit_of(points, pieces, std::exp(log_q)).deviance; };
  const std::vector<double> nodes = noise_nodes(limits);
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (const double d = deviance(nodes[i]); d < least) {
      least = d;
      best = i;
    }
  double low = nodes[best == 0 ? 0 : best - 1], high = nodes[std::min(nodes.size() - 1, best + 1)];
  const double kGolden = 0.5 * (std::sqrt(5.0) - 1.0);
  double a = high - kGolden * (high - low), b = low + kGolden * (high - low), at_a = deviance(a),
         at_b = deviance(b);
  constexpr double kClose = 1e-3;
  while (high - low > kClose) {
    if (at_a < at_b) {
      high = b;
      b = a;
      at_b = at_a;
      at_a = deviance(a = high - kGolden * (high - low));
    } else {
      low = a;
      a = b;
      at_a = at_b;
      at_b = deviance(b = low + kGolden * (high - low));
    }
  }
  return std::exp(0.5 * (low + high));
}

/// A value of q with its posterior weight.
struct WeighedNoise {
  double q = 0.0, weight = 1.0;
};

/// Returns values of q with their posterior weights. The prior is uniform in the square root of q (Gelman
/// 2006, Bayesian Analysis 1, 515): one uniform in the logarithm would put all short tracks on straight
/// lines.
std::vector<WeighedNoise> weighed_noise(const std::vector<TrackPoint>& points, const Pieces& pieces) {
  const NoiseLimits limits = noise_limits(points, pieces);
  if (!limits.any) return {{0.0, 1.0}};
  std::vector<double> nodes = noise_nodes(limits), logs;
  for (const double node : nodes)
    logs.push_back(0.5 * node - 0.5 * misfit_of(points, pieces, std::exp(node)).deviance);
  const double most = *std::max_element(logs.begin(), logs.end());
  // A long track's peak is narrower than the distance of the nodes: it is looked at more closely.
  constexpr double kBelow = 8.0, kFine = 12.0;
  double low = nodes.back(), high = nodes.front();
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (logs[i] > most - kBelow) {
      low = std::min(low, nodes[i == 0 ? 0 : i - 1]);
      high = std::max(high, nodes[std::min(nodes.size() - 1, i + 1)]);
    }
  std::vector<WeighedNoise> weighed;
  double sum = 0.0, top = -std::numeric_limits<double>::infinity();
  std::vector<double> fine;
  for (int i = 0; i <= kFine; ++i) {
    const double node = low + (high - low) * i / kFine;
    fine.push_back(0.5 * node - 0.5 * misfit_of(points, pieces, std::exp(node)).deviance);
    weighed.push_back({std::exp(node), 0.0});
    top = std::max(top, fine.back());
  }
  for (std::size_t i = 0; i < weighed.size(); ++i) weighed[i].weight = std::exp(fine[i] - top);
  constexpr double kNoPart = 1e-3;
  weighed.erase(std::remove_if(weighed.begin(), weighed.end(),
                               [](const WeighedNoise& one) { return one.weight < kNoPart; }),
                weighed.end());
  for (const WeighedNoise& one : weighed) sum += one.weight;
  for (WeighedNoise& one : weighed) one.weight /= sum;
  return weighed;
}

struct Segmentation {
  Pieces pieces;
  /// -2 log likelihood, where an outlier counts as a number that lies at the limit: so what is left out is
  /// paid for, and q is not made small by leaving out much, nor large by taking jumps for movement.
  double deviance = 0.0;
  std::vector<std::pair<std::size_t, double>> outliers, breaks;  ///< with their chi2
};

/// Returns chi2 of the third number against the prediction from the two before it.
double disagreement(const std::vector<TrackPoint>& points, std::size_t a, std::size_t b, std::size_t c,
                    double q) {
  const TrackEstimate estimate =
      predicted(first_estimate(points[a], points[b], q), points[c].time_s - points[b].time_s, q);
  return innovation_of(estimate, points[c]).chi2();
}

/// Divides the numbers into pieces: each is tested against the prediction from those before it.
class TrackSegmenter {
 public:
  TrackSegmenter(const std::vector<TrackPoint>& points, const Indices& measured, double q, double limit)
      : points_(points), measured_(measured), q_(q), limit_(limit) {}

  Segmentation segment() {
    std::size_t next = begin_piece(0);
    while (next < measured_.size()) next = take(next);
    leave_out_held();
    return std::move(segmentation_);
  }

 private:
  /// A number that jumps, by its place in measured_; those in a row are held until it is clear what they are.
  struct Held {
    std::size_t number = 0;
    double chi2 = 0.0, variance = 1.0;
  };

  /// Begins a piece with the first two numbers from here on that a third agrees with; of four one may be left
  /// out. Returns the place of the next number to test.
  std::size_t begin_piece(std::size_t from) {
    segmentation_.pieces.emplace_back();
    held_.clear();
    std::size_t a = from, b = from + 1;
    if (from + 3 < measured_.size() && disagrees(from, from + 1, from + 2)) {
      std::optional<std::size_t> left_out;
      double best = limit_;
      for (const std::size_t skipped : {from, from + 1, from + 2}) {
        Indices kept;
        for (std::size_t i = from; i < from + 4; ++i)
          if (i != skipped) kept.push_back(i);
        const double chi2 =
            disagreement(points_, measured_[kept[0]], measured_[kept[1]], measured_[kept[2]], q_);
        if (chi2 > best) continue;
        best = chi2;
        left_out = skipped;
      }
      if (left_out && *left_out < from + 2) {
        segmentation_.outliers.emplace_back(measured_[*left_out], sim::kNaN);
        const double sigma = points_[measured_[*left_out]].sigma;
        segmentation_.deviance += limit_ + std::log(sigma * sigma);
        a = *left_out == from ? from + 1 : from;
        b = from + 2;
      }
    }
    piece().push_back(measured_[a]);
    if (b >= measured_.size()) return b;
    piece().push_back(measured_[b]);
    estimate_ = first_estimate(points_[measured_[a]], points_[measured_[b]], q_);
    at_s_ = points_[measured_[b]].time_s;
    return b + 1;
  }

  std::size_t take(std::size_t i) {
    const TrackPoint& point = points_[measured_[i]];
    const TrackEstimate estimate = predicted(estimate_, point.time_s - at_s_, q_);
    const Innovation innovation = innovation_of(estimate, point);
    if (innovation.chi2() > limit_) {
      held_.push_back({i, innovation.chi2(), innovation.variance});
      constexpr std::size_t kInARow = 3;
      if (held_.size() < kInARow) return i + 1;
      const auto* last = &held_[held_.size() - kInARow];
      if (disagrees(last[0].number, last[1].number, last[2].number)) return i + 1;
      const Held first = last[0];
      // Two begin the new track.
      for (const Held* one : {last, last + 1}) segmentation_.deviance += limit_ + std::log(one->variance);
      held_.erase(held_.end() - static_cast<std::ptrdiff_t>(kInARow), held_.end());
      leave_out_held();
      segmentation_.breaks.emplace_back(measured_[first.number], first.chi2);
      return begin_piece(first.number);
    }
    leave_out_held();
    segmentation_.deviance += innovation.chi2() + std::log(innovation.variance);
    estimate_ = updated(estimate, innovation);
    at_s_ = point.time_s;
    piece().push_back(measured_[i]);
    return i + 1;
  }

  void leave_out_held() {
    for (const Held& one : held_) {
      segmentation_.outliers.emplace_back(measured_[one.number], one.chi2);
      segmentation_.deviance += limit_ + std::log(one.variance);
    }
    held_.clear();
  }
  bool disagrees(std::size_t a, std::size_t b, std::size_t c) const {
    return disagreement(points_, measured_[a], measured_[b], measured_[c], q_) > limit_;
  }
  Indices& piece() { return segmentation_.pieces.back(); }

  const std::vector<TrackPoint>& points_;
  const Indices& measured_;
  double q_, limit_;
  Segmentation segmentation_;
  std::vector<Held> held_;
  TrackEstimate estimate_;
  double at_s_ = 0.0;
};

/// The transition from a known state to the one before it, backwards in time: without any other knowledge,
/// its process noise is that of the transition forwards.
struct BackwardStep {
  TrackCovariance transition = TrackCovariance::Identity(), noise = TrackCovariance::Zero();
  TrackState offset = TrackState::Zero();

  BackwardStep(double time_s, double q) {
    transition = transition_over(-time_s);
    noise = transition * process_noise_over(time_s, q) * transition.transpose();
  }
  /// Updates the step with a number that measures `row` times the state.
  void update(const Eigen::RowVector2d& row, double value, double variance) {
    const TrackState gain = noise * row.transpose() / (row * noise * row.transpose() + variance);
    const TrackCovariance left = TrackCovariance::Identity() - gain * row;
    offset = left * offset + gain * value;
    transition = left * transition;
    noise = left * noise;
  }
  TrackEstimate estimate_before(const TrackEstimate& later) const {
    return {transition * later.state + offset,
            transition * later.covariance * transition.transpose() + noise};
  }
};

/// Writes the smoothed states of a piece at the points first to last, which reach around its own numbers,
/// into `smoothed` and marks them in `is_known`; both have an element for every point.
void smooth_piece(const std::vector<TrackPoint>& points, const Indices& piece, std::size_t first,
                  std::size_t last, double q, std::vector<TrackEstimate>& smoothed,
                  std::vector<char>& is_known) {
  if (piece.size() < 2) return;
  const std::size_t second = piece[1];
  // The estimates of the forward pass at each point from the second on: without its own number, and with it.
  std::vector<TrackEstimate> prediction(last - second + 1), filtered(last - second + 1);
  filtered[0] = first_estimate(points[piece[0]], points[second], q);
  std::size_t next = 2;
  for (std::size_t i = second + 1; i <= last; ++i) {
    const std::size_t k = i - second;
    prediction[k] = predicted(filtered[k - 1], points[i].time_s - points[i - 1].time_s, q);
    filtered[k] = prediction[k];
    if (next < piece.size() && piece[next] == i) {
      filtered[k] = updated(prediction[k], innovation_of(prediction[k], points[i]));
      ++next;
    }
  }
  // The backward pass.
  smoothed[last] = filtered[last - second];
  is_known[last] = 1;
  for (std::size_t i = last; i-- > second;) {
    const std::size_t k = i - second;
    const TrackCovariance transition = transition_over(points[i + 1].time_s - points[i].time_s);
    const TrackCovariance gain =
        prediction[k + 1].covariance.ldlt().solve(transition * filtered[k].covariance).transpose();
    smoothed[i].state = filtered[k].state + gain * (smoothed[i + 1].state - prediction[k + 1].state);
    smoothed[i].covariance =
        filtered[k].covariance +
        gain * (smoothed[i + 1].covariance - prediction[k + 1].covariance) * gain.transpose();
    is_known[i] = 1;
  }
  // Before the second number the filter has no state: the steps go backwards from there.
  const TrackPoint& begin = points[piece[0]];
  for (std::size_t i = second; i-- > first;) {
    BackwardStep back(points[i + 1].time_s - points[i].time_s, q);
    if (i >= piece[0]) {
      const double since = points[i].time_s - begin.time_s;
      back.update({1.0, -since}, begin.value, begin.sigma * begin.sigma + q * since * since * since / 3.0);
    }
    smoothed[i] = back.estimate_before(smoothed[i + 1]);
    is_known[i] = 1;
  }
}

/// Returns the numbers that do not lie between all others, the worst of each neighbourhood, by their places
/// in the piece and with their chi2.
std::vector<std::pair<std::size_t, double>> jumps_between(const std::vector<TrackPoint>& points,
                                                          const Indices& piece,
                                                          const std::vector<TrackEstimate>& smoothed,
                                                          double limit) {
  constexpr std::size_t kNeighbours = 3;
  std::vector<double> chi2(piece.size(), 0.0);
  for (std::size_t i = 0; i < piece.size(); ++i) {
    const TrackPoint& point = points[piece[i]];
    const double difference = point.value - smoothed[piece[i]].state[0];
    // The variance of what the others predict: the smoothed number's own part is taken out again.
    const double variance = point.sigma * point.sigma - smoothed[piece[i]].covariance(0, 0);
    if (variance > 1e-9 * point.sigma * point.sigma) chi2[i] = difference * difference / variance;
  }
  std::vector<std::pair<std::size_t, double>> found;
  for (std::size_t i = 0; i < piece.size(); ++i) {
    const std::size_t begin = i < kNeighbours ? 0 : i - kNeighbours,
                      end = std::min(piece.size(), i + kNeighbours + 1);
    const auto worst = std::max_element(chi2.begin() + static_cast<std::ptrdiff_t>(begin),
                                        chi2.begin() + static_cast<std::ptrdiff_t>(end));
    if (chi2[i] > limit && worst == chi2.begin() + static_cast<std::ptrdiff_t>(i))
      found.emplace_back(i, chi2[i]);
  }
  return found;
}

/// The points that a piece gives states for: from its first number (of the first piece, from the first point)
/// to the point before the next piece.
struct PieceReach {
  std::size_t first = 0, last = 0;
};
std::vector<PieceReach> reaches_of(const Pieces& pieces, std::size_t points) {
  std::vector<PieceReach> reaches;
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    const std::size_t first = p == 0 ? 0 : pieces[p].front();
    const std::size_t last = p + 1 == pieces.size() ? points - 1 : pieces[p + 1].front() - 1;
    reaches.push_back({first, last});
  }
  return reaches;
}

/// Returns the segmentation with the largest likelihood, over all q.
Segmentation best_segmentation(const std::vector<TrackPoint>& points, const Indices& measured, double limit) {
  const NoiseLimits limits = noise_limits(points, {measured});
  if (!limits.any) return TrackSegmenter(points, measured, 0.0, limit).segment();
  Segmentation best;
  best.deviance = std::numeric_limits<double>::infinity();
  for (const double node : noise_nodes(limits)) {
    Segmentation segmentation = TrackSegmenter(points, measured, std::exp(node), limit).segment();
    if (segmentation.deviance < best.deviance) best = std::move(segmentation);
  }
  return best;
}

/// The states of all points that have any, over all pieces.
struct SmoothedStates {
  std::vector<TrackEstimate> states;
  std::vector<char> is_known;
};
SmoothedStates smoothed_states(const std::vector<TrackPoint>& points, const Pieces& pieces, double q) {
  SmoothedStates all{std::vector<TrackEstimate>(points.size()), std::vector<char>(points.size(), 0)};
  const std::vector<PieceReach> reaches = reaches_of(pieces, points.size());
  for (std::size_t p = 0; p < pieces.size(); ++p)
    smooth_piece(points, pieces[p], reaches[p].first, reaches[p].last, q, all.states, all.is_known);
  return all;
}

/// Returns the states over the posterior distribution of q: their means, and the covariances about them.
SmoothedStates states_of_all_noise(const std::vector<TrackPoint>& points, const Pieces& pieces) {
  const std::vector<WeighedNoise> weighed = weighed_noise(points, pieces);
  SmoothedStates sum = smoothed_states(points, pieces, weighed.front().q);
  // States are counted from the first, so that nothing is lost in differences of large numbers.
  const std::vector<TrackEstimate> origin = sum.states;
  std::vector<TrackCovariance> squares(points.size(), TrackCovariance::Zero());
  for (TrackEstimate& estimate : sum.states) estimate = TrackEstimate();
  for (const WeighedNoise& one : weighed) {
    const SmoothedStates states = smoothed_states(points, pieces, one.q);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const TrackState from_origin = states.states[i].state - origin[i].state;
      sum.states[i].state += one.weight * from_origin;
      sum.states[i].covariance += one.weight * states.states[i].covariance;
      squares[i] += one.weight * from_origin * from_origin.transpose();
    }
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    TrackEstimate& estimate = sum.states[i];
    estimate.covariance += squares[i] - estimate.state * estimate.state.transpose();
    estimate.state += origin[i].state;
  }
  return sum;
}

/// Takes numbers out of the pieces that do not lie between all others, until there are none.
void leave_out_jumps(const std::vector<TrackPoint>& points, double q, double limit,
                     Segmentation& segmentation) {
  constexpr int kMaxRounds = 50;
  for (int round = 0; round < kMaxRounds; ++round) {
    const SmoothedStates now = smoothed_states(points, segmentation.pieces, q);
    bool any = false;
    for (Indices& piece : segmentation.pieces) {
      if (piece.size() < 4) continue;
      const auto jumps = jumps_between(points, piece, now.states, limit);
      // The last is erased first, so that the places before it stay; three at least are left to agree.
      for (auto jump = jumps.rbegin(); jump != jumps.rend() && piece.size() > 3; ++jump) {
        segmentation.outliers.emplace_back(piece[jump->first], jump->second);
        piece.erase(piece.begin() + static_cast<std::ptrdiff_t>(jump->first));
        any = true;
      }
    }
    if (!any) break;
  }
}

void put_states(const SmoothedStates& all, SmoothedTrack& track) {
  for (std::size_t i = 0; i < track.points.size(); ++i) {
    if (all.is_known[i] == 0) continue;
    SmoothedPoint& to = track.points[i];
    const TrackEstimate& estimate = all.states[i];
    to.position = estimate.state[0];
    to.velocity = estimate.state[1];
    to.position_sigma = std::sqrt(std::max(0.0, estimate.covariance(0, 0)));
    to.velocity_sigma = std::sqrt(std::max(0.0, estimate.covariance(1, 1)));
  }
}

/// Flags outliers and breaks. An outlier's chi2 is by the track as it is in the end, which has no part of it.
void put_flags(const std::vector<TrackPoint>& points, const Segmentation& segmentation,
               const SmoothedStates& all, SmoothedTrack& track) {
  for (const auto& [i, chi2] : segmentation.breaks) {
    track.points[i].flag = TrackFlag::broken;
    track.points[i].chi2 = chi2;
  }
  for (const auto& [i, chi2] : segmentation.outliers) {
    SmoothedPoint& to = track.points[i];
    to.flag = TrackFlag::outlier;
    const double difference = points[i].value - to.position;
    const double variance = points[i].sigma * points[i].sigma + to.position_sigma * to.position_sigma;
    to.chi2 = all.is_known[i] != 0 ? difference * difference / variance : chi2;
  }
}

}  // namespace

const char* track_flag_name(TrackFlag flag) {
  static constexpr std::array names = {"", "outlier", "break"};
  return names[static_cast<std::size_t>(flag)];
}

double jump_limit(double false_alarms) {
  const double z = sim::normal_quantile(1.0 - 0.5 * false_alarms);
  return z * z;
}

SmoothedTrack smooth_track(const std::vector<TrackPoint>& points, double false_alarms) {
  const double limit = jump_limit(false_alarms);
  SmoothedTrack track;
  track.points.assign(points.size(),
                      {sim::kNaN, sim::kNaN, sim::kNaN, sim::kNaN, TrackFlag::none, sim::kNaN});
  Indices measured;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (measures_position(points[i])) measured.push_back(i);
  if (measured.empty()) {
    track.innovation_chi2 = sim::kNaN;
    return track;
  }
  Segmentation segmentation = best_segmentation(points, measured, limit);
  leave_out_jumps(points, best_noise(points, segmentation.pieces), limit, segmentation);
  const double q = best_noise(points, segmentation.pieces);
  SmoothedStates all = states_of_all_noise(points, segmentation.pieces);
  // Nothing says how a track of two bends, nor whether one of them jumps.
  if (!noise_limits(points, segmentation.pieces).any) std::fill(all.is_known.begin(), all.is_known.end(), 0);
  put_states(all, track);
  put_flags(points, segmentation, all, track);
  track.process_noise = q;
  track.outliers = static_cast<int>(segmentation.outliers.size());
  track.breaks = static_cast<int>(segmentation.breaks.size());
  for (const Indices& piece : segmentation.pieces) track.used += static_cast<int>(piece.size());
  const Misfit misfit = misfit_of(points, segmentation.pieces, q);
  track.innovation_chi2 = misfit.count > 0 ? misfit.chi2 / misfit.count : sim::kNaN;
  return track;
}

}  // namespace vegard::fit
