// The smoother: velocities as far off as it says, jumps found, no more false alarms than it says.
#include "fit/survey/track_smoother.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/number/random.h"

namespace vegard::fit::track_smoother_test {
namespace {

constexpr std::uint64_t kSeed = 22;
constexpr double kFalseAlarms = 1e-4;

/// Standard normal numbers: those of track `track`, one after the other (Box and Muller 1958).
class Normals {
 public:
  explicit Normals(std::uint32_t track) : track_(track) {}
  double next() {
    const sim::Words words =
        sim::philox4x32({track_, count_++, 7, 0}, {static_cast<std::uint32_t>(kSeed), 1});
    const double u = (words[0] + 0.5) / 4294967296.0, v = (words[1] + 0.5) / 4294967296.0;
    return std::sqrt(-2.0 * std::log(u)) * std::cos(6.283185307179586 * v);
  }
  double uniform() {
    return (sim::philox4x32({track_, count_++, 8, 0}, {static_cast<std::uint32_t>(kSeed), 1})[0] + 0.5) /
           4294967296.0;
  }

 private:
  std::uint32_t track_, count_ = 0;
};

struct MadeTrack {
  std::vector<TrackPoint> points;
  std::vector<double> position, velocity;
};

/// A track of the smoother's own model: q in km^2 / s^3, steps of about 3 s.
MadeTrack made_track(std::uint32_t number, int frames, double q, double sigma, bool irregular = false) {
  Normals normals(number);
  MadeTrack made;
  double x = 200.0, v = 0.3 * normals.next(), time_s = 1000.0;
  for (int i = 0; i < frames; ++i) {
    if (i > 0) {
      const double t = irregular ? 0.5 + 9.0 * normals.uniform() : 3.0;
      const double a = normals.next(), b = normals.next();
      // Cholesky's factor of q (t^3/3, t^2/2; t^2/2, t).
      const double wx = std::sqrt(q * t * t * t / 3.0) * a;
      const double wv = std::sqrt(q * t) * (std::sqrt(3.0) / 2.0 * a + 0.5 * b);
      x += v * t + wx;
      v += wv;
      time_s += t;
    }
    made.points.push_back({time_s, x + sigma * normals.next(), sigma});
    made.position.push_back(x);
    made.velocity.push_back(v);
  }
  return made;
}

/// Of many tracks: mean square of errors over standard deviations, at the middle and at both ends.
struct Errors {
  double velocity = 0.0, position = 0.0, within_one = 0.0, innovation = 0.0;
};

Errors errors_of(int tracks, bool irregular, bool gaps) {
  Errors sum;
  int count = 0;
  for (int n = 0; n < tracks; ++n) {
    MadeTrack made = made_track(static_cast<std::uint32_t>(n), 80, 2e-3, 1.5, irregular);
    if (gaps)
      for (std::size_t i = 0; i < made.points.size(); ++i)
        if (i % 5 == 1 || (i > 30 && i < 39)) made.points[i].value = std::nan("");
    const SmoothedTrack track = smooth_track(made.points, kFalseAlarms);
    sum.innovation += track.innovation_chi2 / tracks;
    for (const std::size_t i : {std::size_t{0}, std::size_t{35}, std::size_t{79}}) {
      const SmoothedPoint& point = track.points[i];
      const double dv = (point.velocity - made.velocity[i]) / point.velocity_sigma;
      const double dx = (point.position - made.position[i]) / point.position_sigma;
      sum.velocity += dv * dv;
      sum.position += dx * dx;
      sum.within_one += std::abs(dv) < 1.0 ? 1.0 : 0.0;
      ++count;
    }
  }
  sum.velocity /= count;
  sum.position /= count;
  sum.within_one /= count;
  return sum;
}

/// 900 errors that are independent but for the three of a track: the mean of their squares scatters by 5 %,
/// the share within one standard deviation by 1.6 %. That q is estimated of 78 innovations each, not known,
/// widens the errors by some per cent. So 15 % and 5 % are three standard deviations.
void expect_nominal(const Errors& errors) {
  EXPECT_NEAR(errors.velocity, 1.0, 0.15);
  EXPECT_NEAR(errors.position, 1.0, 0.15);
  EXPECT_NEAR(errors.within_one, 0.683, 0.05);
  EXPECT_NEAR(errors.innovation, 1.0, 0.05);
}

TEST(TrackSmoother, VelocitiesAreAsFarOffAsItSays) { expect_nominal(errors_of(300, false, false)); }

TEST(TrackSmoother, AlsoWithIrregularTimes) { expect_nominal(errors_of(300, true, false)); }

TEST(TrackSmoother, AlsoWhereNumbersAreMissing) { expect_nominal(errors_of(300, false, true)); }

TEST(TrackSmoother, GivesTheVelocityOfAStraightTrack) {
  std::vector<TrackPoint> points;
  for (int i = 0; i < 40; ++i) points.push_back({3.0 * i, 100.0 - 0.25 * 3.0 * i, 2.0});
  const SmoothedTrack track = smooth_track(points, kFalseAlarms);
  // A line by least squares has an error of sigma / sqrt(sum of (t - mean)^2); that the track may bend adds
  // to it, the more the nearer the ends.
  double sum = 0.0;
  for (const TrackPoint& point : points) sum += std::pow(point.time_s - 58.5, 2);
  const double of_line = 2.0 / std::sqrt(sum);
  for (const SmoothedPoint& point : track.points) {
    EXPECT_NEAR(point.velocity, -0.25, 1e-5);
    EXPECT_GE(point.velocity_sigma, of_line);
    EXPECT_LE(point.velocity_sigma, track.points.front().velocity_sigma * (1.0 + 1e-6));
  }
}

TEST(TrackSmoother, FindsTheProcessNoise) {
  // 2000 frames tell ln q to about 0.1: each is worth about a tenth of an independent look at it.
  const SmoothedTrack track = smooth_track(made_track(5, 2000, 2e-3, 1.5).points, kFalseAlarms);
  EXPECT_NEAR(std::log(track.process_noise / 2e-3), 0.0, 0.35);
}

TEST(TrackSmoother, LeavesOutOneThatJumps) {
  for (std::uint32_t n = 0; n < 40; ++n) {
    MadeTrack made = made_track(100 + n, 60, 2e-3, 1.5);
    const std::size_t at = n % 4 == 0 ? n / 4 % 3 : 3 + n;  // also among the first three
    const std::vector<TrackPoint> sound = made.points;
    made.points[at].value += n % 2 == 0 ? 25.0 : -25.0;
    const SmoothedTrack track = smooth_track(made.points, kFalseAlarms);
    EXPECT_EQ(track.points[at].flag, TrackFlag::outlier) << n;
    EXPECT_GT(track.points[at].chi2, jump_limit(kFalseAlarms));
    EXPECT_EQ(track.outliers, 1) << n;
    EXPECT_EQ(track.breaks, 0) << n;
    EXPECT_EQ(track.used, 59);
    // As if it had not been there.
    std::vector<TrackPoint> without = sound;
    without[at].value = std::nan("");
    const SmoothedTrack expected = smooth_track(without, kFalseAlarms);
    for (std::size_t i = 0; i < sound.size(); ++i)
      EXPECT_NEAR(track.points[i].velocity, expected.points[i].velocity, 1e-9);
  }
}

TEST(TrackSmoother, BeginsAnewWhereTheNumberStaysElsewhere) {
  for (std::uint32_t n = 0; n < 40; ++n) {
    MadeTrack made = made_track(200 + n, 60, 2e-3, 1.5);
    const std::size_t at = 10 + n;
    for (std::size_t i = at; i < made.points.size(); ++i) {
      made.points[i].value += 60.0;
      made.position[i] += 60.0;
    }
    const SmoothedTrack track = smooth_track(made.points, kFalseAlarms);
    EXPECT_EQ(track.breaks, 1) << n;
    EXPECT_EQ(track.outliers, 0) << n;
    EXPECT_EQ(track.points[at].flag, TrackFlag::broken) << n;
    for (std::size_t i = 0; i < made.points.size(); ++i)
      EXPECT_LT(std::abs(track.points[i].position - made.position[i]), 5.0 * track.points[i].position_sigma)
          << n << " " << i;
  }
}

TEST(TrackSmoother, FlagsNoMoreSoundFramesThanItSays) {
  // 20 000 sound frames at 1e-2: 200 by one question, at most 400 by both; five standard deviations beyond.
  int flagged = 0;
  for (std::uint32_t n = 0; n < 40; ++n) {
    const SmoothedTrack track = smooth_track(made_track(300 + n, 500, 2e-3, 1.5, true).points, 1e-2);
    flagged += track.outliers + track.breaks;
  }
  EXPECT_GT(flagged, 200 - 5 * std::sqrt(200.0));
  EXPECT_LT(flagged, 400 + 5 * std::sqrt(400.0));
}

TEST(TrackSmoother, TellsNothingOfNothing) {
  EXPECT_TRUE(smooth_track({}, kFalseAlarms).points.empty());
  const SmoothedTrack none = smooth_track({{0.0, std::nan(""), 1.0}, {1.0, 3.0, 0.0}}, kFalseAlarms);
  EXPECT_EQ(none.used, 0);
  EXPECT_TRUE(std::isnan(none.points[1].velocity));
  const SmoothedTrack one = smooth_track({{0.0, 3.0, 1.0}, {1.0, std::nan(""), 1.0}}, kFalseAlarms);
  EXPECT_EQ(one.used, 1);
  EXPECT_TRUE(std::isnan(one.points[0].velocity));
  // Of two nothing says how the track bends; of three one innovation does.
  const SmoothedTrack two = smooth_track({{0.0, 3.0, 1.0}, {2.0, 7.0, 1.0}}, kFalseAlarms);
  EXPECT_TRUE(std::isnan(two.points[1].velocity));
  const SmoothedTrack three =
      smooth_track({{0.0, 3.0, 1.0}, {2.0, 7.0, 1.0}, {4.0, 11.0, 1.0}}, kFalseAlarms);
  for (const SmoothedPoint& point : three.points) {
    EXPECT_NEAR(point.velocity, 2.0, 1e-9);
    EXPECT_GT(point.velocity_sigma, std::sqrt(1.0 / 8.0));  // that of a straight line
  }
}

TEST(TrackSmoother, GivesTheSameNumbersAgain) {
  const MadeTrack made = made_track(7, 300, 2e-3, 1.5, true);
  const SmoothedTrack a = smooth_track(made.points, kFalseAlarms),
                      b = smooth_track(made.points, kFalseAlarms);
  for (std::size_t i = 0; i < a.points.size(); ++i) EXPECT_EQ(a.points[i].velocity, b.points[i].velocity);
  EXPECT_EQ(a.process_noise, b.process_noise);
}

}  // namespace
}  // namespace vegard::fit::track_smoother_test
