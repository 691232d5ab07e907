#include "fit/photo/pointing/joint/still_camera.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "fit/photo/pointing/chance_agreement.h"
#include "sim/base/error.h"
#include "sim/base/file/number_text.h"
#include "sim/base/number/constants.h"

namespace vegard::fit {
namespace {

constexpr double kStillPx = 1.2;  // radius of agreement: stars are placed to some 0.3 px
constexpr double kSky_deg_s = 360.9856 / 86400.0;
constexpr std::size_t kBrightest = 30;                          // points of a frame whose pairs are compared
constexpr double kLeastApart_deg = 3.0, kMostApart_deg = 90.0;  // of a pair
constexpr double kLog10Still = -3.0;                            // that it stood still is what one expects
constexpr double kLog10Moved = -8.0;                            // as is_no_chance() asks of cameras
constexpr int kFewest = 6;                                      // stars that agree with a move
constexpr double kWrongSky = 2.0;   // turns of the sky by which it may be wrong: it would turn backwards
constexpr double kWatch_s = 600.0;  // errors of the lens hardly matter while the sky turns by 2.5 degrees

using Directions = std::vector<Eigen::Vector3d>;

/// The points' directions east, north and up; zero outside of the lens's picture.
Directions directions_of(const sim::CameraView<double>& view, const std::vector<FoundStar>& points) {
  Directions directions;
  for (const FoundStar& point : points) {
    double enu[3] = {0.0, 0.0, 0.0};
    const bool seen = sim::enu_of_pixel(view, point.x_px, point.y_px, enu);
    directions.emplace_back(seen ? Eigen::Vector3d(enu[0], enu[1], enu[2]).normalized()
                                 : Eigen::Vector3d(0, 0, 0));
  }
  return directions;
}

/// The turn of the sky in this time, clockwise about the northern celestial pole.
Eigen::Matrix3d turn_of_sky(double latitude_deg, double seconds) {
  const double latitude = latitude_deg * sim::kRadiansPerDegree;
  return Eigen::AngleAxisd(-kSky_deg_s * seconds * sim::kRadiansPerDegree,
                           Eigen::Vector3d(0.0, std::cos(latitude), std::sin(latitude)))
      .toRotationMatrix();
}

/// A pair's right-handed axes: along the first, and across the plane of both.
Eigen::Matrix3d triad(const Eigen::Vector3d& first, const Eigen::Vector3d& second) {
  Eigen::Matrix3d axes;
  axes.col(0) = first;
  axes.col(1) = first.cross(second).normalized();
  axes.col(2) = first.cross(axes.col(1));
  return axes;
}

/// The turn that brings the first directions to the second ones by least squares.
Eigen::Matrix3d best_turn(const Directions& from, const Directions& to,
                          const std::vector<StarMatch>& matches) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const StarMatch& m : matches) sum += to[m.point] * from[m.star].transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(sum, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double sign = (svd.matrixU() * svd.matrixV().transpose()).determinant();
  return svd.matrixU() * Eigen::Vector3d(1.0, 1.0, sign).asDiagonal() * svd.matrixV().transpose();
}

double angle_of(const Eigen::Matrix3d& turn) { return Eigen::AngleAxisd(turn).angle(); }

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

struct SkyPair {
  int first, second;
  double apart;  // radians
};

std::vector<SkyPair> pairs_of(const Directions& directions) {
  std::vector<SkyPair> pairs;
  const int count = static_cast<int>(std::min(kBrightest, directions.size()));
  for (int i = 0; i < count; ++i)
    for (int j = i + 1; j < count; ++j) {
      const double cosine = directions[i].dot(directions[j]);
      if (directions[i].isZero() || directions[j].isZero()) continue;
      const double apart = std::acos(std::clamp(cosine, -1.0, 1.0));
      if (apart > kLeastApart_deg * sim::kRadiansPerDegree && apart < kMostApart_deg * sim::kRadiansPerDegree)
        pairs.push_back({i, j, apart});
    }
  std::sort(pairs.begin(), pairs.end(), [](const SkyPair& a, const SkyPair& b) { return a.apart < b.apart; });
  return pairs;
}

/// Two frames' points.
class TwoFrames {
 public:
  TwoFrames(const sim::Camera& camera, double latitude_deg, const FramePoints& before,
            const FramePoints& after);

  StarsOfTwoFrames compared() const;

 private:
  bool place(const Eigen::Vector3d& direction, double& x, double& y) const {
    const double enu[3] = {direction.x(), direction.y(), direction.z()};
    return !direction.isZero() && sim::pixel_of_enu(view_, enu, x, y) && x >= 0.0 && y >= 0.0 &&
           x < camera_.width && y < camera_.height;
  }
  /// The points of the earlier frame that meet one of the later after the turn, in a picture shifted by dx,
  /// dy.
  std::vector<StarMatch> matches(const Eigen::Matrix3d& turn, double dx = 0.0, double dy = 0.0,
                                 std::size_t of = std::numeric_limits<std::size_t>::max(),
                                 int* expected = nullptr) const;
  /// How many meet one by chance: the mean over shifted pictures.
  double by_chance(const Eigen::Matrix3d& turn) const;
  std::optional<CameraMove> move(int still) const;

  const sim::Camera& camera_;
  sim::CameraView<double> view_;
  double tolerance_;                       // of agreement, radians
  std::vector<FoundStar> before_, after_;  // without lamps and hot pixels that are known as such
  int fixed_ = 0;                          // points at the same pixel of both frames, among all
  std::optional<PointCells> cells_;        // of after_
  Directions from_, to_;                   // of before_, turned with the sky, and of after_
};

TwoFrames::TwoFrames(const sim::Camera& camera, double latitude_deg, const FramePoints& before,
                     const FramePoints& after)
    : camera_(camera),
      view_(sim::camera_view(camera)),
      tolerance_(2.0 * kStillPx / sim::pixels_per_degree(camera) * sim::kRadiansPerDegree) {
  const Frame frame{camera.width, camera.height, true};
  const Eigen::Matrix3d sky = turn_of_sky(latitude_deg, after.time_s - before.time_s);
  const PointCells all(after.points, frame, after.points.size());
  const Directions from = directions_of(view_, before.points);
  std::vector<char> is_lamp(after.points.size());
  for (std::size_t i = 0; i < before.points.size(); ++i) {
    const FoundStar& point = before.points[i];
    double distance = 0.0, x = 0.0, y = 0.0;
    const int fixed = all.nearest(point.x_px, point.y_px, kStillPx, distance);
    fixed_ += fixed >= 0 ? 1 : 0;
    // Where the sky has moved on by more than both radii, what stayed is no star.
    if (fixed >= 0 && place(sky * from[i], x, y) &&
        std::hypot(x - point.x_px, y - point.y_px) > 2.0 * kStillPx) {
      is_lamp[static_cast<std::size_t>(fixed)] = 1;
      continue;
    }
    before_.push_back(point);
    from_.push_back(sky * from[i]);
  }
  for (std::size_t i = 0; i < after.points.size(); ++i)
    if (is_lamp[i] == 0) after_.push_back(after.points[i]);
  cells_.emplace(after_, frame, after_.size());
  to_ = directions_of(view_, after_);
}

std::vector<StarMatch> TwoFrames::matches(const Eigen::Matrix3d& turn, double dx, double dy, std::size_t of,
                                          int* expected) const {
  std::vector<ExpectedStar> stars;
  for (std::size_t i = 0; i < std::min(of, from_.size()); ++i) {
    double x = 0.0, y = 0.0;
    if (place(turn * from_[i], x, y)) stars.push_back({static_cast<int>(i), x + dx, y + dy});
  }
  if (expected != nullptr) *expected = static_cast<int>(stars.size());
  return each_others_nearest(stars, after_, *cells_, [](const ExpectedStar&) { return kStillPx; });
}

double TwoFrames::by_chance(const Eigen::Matrix3d& turn) const {
  constexpr std::array<double, 2> kShifts_px{9.0, 17.0};
  constexpr int kWays = 8;
  double sum = 0.0;
  for (const double shift : kShifts_px)
    for (int way = 0; way < kWays; ++way) {
      const double angle = 2.0 * sim::kPi * (way + 0.25) / kWays;
      sum += static_cast<double>(matches(turn, shift * std::cos(angle), shift * std::sin(angle)).size());
    }
  // One more than was seen, over one more than the trials: the mean is not known to be 0.
  return (sum + 1.0) / (static_cast<double>(kShifts_px.size()) * kWays + 1.0);
}

std::optional<CameraMove> TwoFrames::move(int still) const {
  const std::vector<SkyPair> first = pairs_of(from_), second = pairs_of(to_);
  double trials = 0.0;
  std::size_t most = 0;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  std::size_t begin = 0;
  for (const SkyPair& a : first) {
    while (begin < second.size() && second[begin].apart < a.apart - tolerance_) ++begin;
    for (std::size_t k = begin; k < second.size() && second[k].apart <= a.apart + tolerance_; ++k)
      for (const bool swapped : {false, true}) {
        const SkyPair& b = second[k];
        const Eigen::Matrix3d trial =
            triad(to_[swapped ? b.second : b.first], to_[swapped ? b.first : b.second]) *
            triad(from_[a.first], from_[a.second]).transpose();
        ++trials;
        if (angle_of(trial) < tolerance_) continue;  // stood still, as lamps would have it
        const std::size_t agree = matches(trial, 0.0, 0.0, kBrightest).size();
        if (agree <= most) continue;
        most = agree;
        turn = trial;
      }
  }
  if (most < 3) return std::nullopt;
  for (int i = 0; i < 3; ++i) turn = best_turn(from_, to_, matches(turn));
  const auto agree = static_cast<int>(matches(turn).size());
  constexpr double kFitted = 1.5;  // stars used up by the three numbers of a turn
  if (angle_of(turn) < tolerance_ || agree < std::max(kFewest, 2 * std::max(still, fixed_)) ||
      log10_poisson_tail(agree - kFitted, by_chance(turn)) + std::log10(std::max(1.0, trials)) > kLog10Moved)
    return std::nullopt;
  return CameraMove{angle_of(turn) / sim::kRadiansPerDegree, agree};
}

StarsOfTwoFrames TwoFrames::compared() const {
  StarsOfTwoFrames said;
  const Eigen::Matrix3d none = Eigen::Matrix3d::Identity();
  const std::vector<StarMatch> found = matches(none, 0.0, 0.0, from_.size(), &said.expected);
  said.still = static_cast<int>(found.size());
  said.by_chance = by_chance(none);
  said.brightness = said.brightness_error = std::numeric_limits<double>::quiet_NaN();
  if (2 * said.still < said.expected) said.move = move(said.still);
  said.stood_still =
      !said.move && said.still >= kFewest && log10_poisson_tail(said.still, said.by_chance) < kLog10Still;
  if (!said.stood_still) return said;
  std::vector<double> ratio;
  for (const StarMatch& m : found)
    if (before_[m.star].flux > 0.0 && after_[m.point].flux > 0.0)
      ratio.push_back(std::log(after_[m.point].flux / before_[m.star].flux));
  if (ratio.size() < kFewest) return said;
  const double middle = median(ratio);
  std::vector<double> apart;
  for (const double r : ratio) apart.push_back(std::abs(r - middle));
  constexpr double kOfMedian = 1.4826 * 1.2533;  // from the median deviation to the error of a median
  said.brightness = std::exp(middle);
  said.brightness_error =
      said.brightness * kOfMedian * median(apart) / std::sqrt(static_cast<double>(ratio.size()));
  return said;
}

}  // namespace

StarsOfTwoFrames stars_of_two_frames(const sim::Camera& camera, double latitude_deg,
                                     const FramePoints& before, const FramePoints& after) {
  return TwoFrames(camera, latitude_deg, before, after).compared();
}

void CameraWatch::note_brightness(const FramePoints& earlier, const FramePoints& frame,
                                  const StarsOfTwoFrames& said) {
  const auto differs = [](double ratio) { return ratio > 1.25 || ratio < 0.8; };
  if (!differs(said.brightness) || std::abs(said.brightness - 1.0) < 5.0 * said.brightness_error) return;
  // One line for a change, not one for each frame after it.
  if (!other_.empty() && other_.back().as_in == earlier.name &&
      !differs(other_.back().brightness / said.brightness))
    return;
  other_.push_back({frame.name, earlier.name, said.brightness});
}

void CameraWatch::note_drift(const FramePoints& earlier, const FramePoints& frame, const CameraMove& move) {
  if (!drift_ || move.angle_deg > drift_->angle_deg) drift_ = Drift{earlier.name, frame.name, move.angle_deg};
}

void CameraWatch::confirm(const FramePoints& frame) {
  if (!suspect_) return;
  const StarsOfTwoFrames said = stars_of_two_frames(camera_, latitude_deg_, suspect_->before, frame);
  const double seconds = frame.time_s - suspect_->time_s;
  const double apart_deg =
      0.5 * kStillPx / sim::pixels_per_degree(camera_) + kWrongSky * kSky_deg_s * seconds;
  if (said.move && std::abs(said.move->angle_deg - suspect_->move.angle_deg) < apart_deg)
    throw sim::unreadable(suspect_->name,
                          "the camera was turned by " + sim::short_number(suspect_->move.angle_deg, 3) +
                              " degrees after " + suspect_->before.name + ": " +
                              std::to_string(suspect_->move.stars) + " stars agree with that, " +
                              std::to_string(suspect_->still) + " with a camera that stood still")
        .expected("frames of one camera that stood still")
        .hint("take the frames before and after that by themselves, each with its camera (vegard calibrate)");
  suspect_.reset();  // what moves on and on is no camera
}

void CameraWatch::add(FramePoints frame) {
  ++frames_;
  if (frame.points.size() < kFewest) return;
  confirm(frame);
  const auto is_old = [&](const FramePoints& f) { return frame.time_s - f.time_s > kWatch_s; };
  if (last_ && is_old(*last_)) last_.reset();
  if (first_ && is_old(*first_)) first_.reset();
  bool still = false;
  if (last_) {
    const StarsOfTwoFrames said = stars_of_two_frames(camera_, latitude_deg_, *last_, frame);
    still = said.stood_still;
    if (still && !first_) first_ = last_;
    // A wrong site, direction or time turns the sky about another axis, or by another angle.
    const double explained_deg = kWrongSky * kSky_deg_s * (frame.time_s - last_->time_s) +
                                 4.0 * kStillPx / sim::pixels_per_degree(camera_);
    if (said.move && said.move->angle_deg > explained_deg)
      suspect_ = Suspect{*last_, frame.name, frame.time_s, said.still, *said.move};
    else if (said.move)
      note_drift(*last_, frame, *said.move);
  }
  // Small moves and changes add up.
  if (first_ && !suspect_) {
    const StarsOfTwoFrames said = stars_of_two_frames(camera_, latitude_deg_, *first_, frame);
    still = still || said.stood_still;
    if (said.move) note_drift(*first_, frame, *said.move);
    note_brightness(*first_, frame, said);
  }
  told_ += still ? 1 : 0;
  last_ = std::move(frame);
}

std::vector<std::string> CameraWatch::words() const {
  if (frames_ < 2) return {};
  if (told_ == 0)
    return {
        "Whether the camera stood still is not known: the frames show too few stars, or are more than ten "
        "minutes apart."};
  const bool all = told_ == frames_ - 1;
  std::vector<std::string> words{
      "By the stars the camera stood still in " +
      (all ? "all" : std::to_string(told_ + 1) + " of the " + std::to_string(frames_)) + " frames" +
      (all ? "." : "; of the others it is not known.")};
  if (suspect_) words.push_back("In the last frame it may have been turned.");
  if (drift_)
    words.push_back("From " + drift_->from + " to " + drift_->to + " the points of light turned by " +
                    sim::short_number(drift_->angle_deg, 2) +
                    " degrees more or less than the sky: the camera drifts, the times, the site or its "
                    "direction are not right, or clouds drift.");
  for (const OtherBrightness& other : other_)
    words.push_back("The stars of " + other.name + " are " + sim::short_number(other.brightness, 2) +
                    " times as bright as in " + other.as_in +
                    ": another exposure, by which its map is brighter or fainter too, or cloud.");
  return words;
}

}  // namespace vegard::fit
