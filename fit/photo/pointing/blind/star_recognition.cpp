#include "fit/photo/pointing/blind/star_recognition.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

#include "fit/photo/pointing/blind/asterisms.h"
#include "fit/photo/pointing/catalogue_sky.h"
#include "sim/base/file/number_text.h"
#include "sim/base/number/constants.h"

namespace vegard::fit {
namespace {

constexpr double kCodeTolerance = 0.03;
constexpr double kSizeFactor = 1.35;
constexpr int kPictureNeighbours = 7;
constexpr int kGrownPerLevel = 16, kGrownOffCentre = 6;
constexpr std::size_t kOffCentrePoints = 40;
constexpr double kMinScore = 3.0;  // natural log of the odds, four stars of the figure not counted

struct AssumedLens {
  sim::LensModel model;
  double half_width_deg;  // off the axis at half of the longer side
};

std::vector<AssumedLens> assumed_lenses() {
  using sim::LensModel;
  std::vector<AssumedLens> lenses;
  for (const double a : {10.0, 14.0, 19.0, 25.0, 32.0, 38.0, 44.0, 50.0, 56.0, 62.0})
    lenses.push_back({LensModel::pinhole, a});
  for (const double a : {25.0, 36.0, 48.0, 60.0, 73.0, 86.0, 100.0, 115.0})
    lenses.push_back({LensModel::stereographic, a});
  for (const double a : {36.0, 48.0, 60.0, 73.0, 86.0, 100.0, 115.0}) {
    lenses.push_back({LensModel::equidistant, a});
    lenses.push_back({LensModel::equisolid, a});
  }
  return lenses;
}

double radius_of(sim::LensModel model, double angle) {
  switch (model) {
    case sim::LensModel::pinhole:
      return std::tan(angle);
    case sim::LensModel::stereographic:
      return 2.0 * std::tan(0.5 * angle);
    case sim::LensModel::equisolid:
      return 2.0 * std::sin(0.5 * angle);
    default:
      return angle;
  }
}

/// Points that stand in a crowd of brighter ones are put behind the others: trees, houses and the aurora's
/// folds give many, the sky few.
std::vector<FoundStar> spread_out(const std::vector<FoundStar>& points, const Frame& frame, int most) {
  const double reach = 0.05 * std::max(frame.width_px, frame.height_px);
  constexpr int kCrowd = 4;
  std::vector<std::pair<int, int>> order;
  for (std::size_t i = 0; i < points.size(); ++i) {
    int brighter = 0;
    for (std::size_t j = 0; j < i; ++j)
      brighter += std::hypot(points[i].x_px - points[j].x_px, points[i].y_px - points[j].y_px) < reach;
    order.emplace_back(brighter / kCrowd, static_cast<int>(i));
  }
  std::stable_sort(order.begin(), order.end());
  std::vector<FoundStar> spread;
  for (const auto& one : order)
    if (static_cast<int>(spread.size()) < most) spread.push_back(points[one.second]);
  return spread;
}

/// Three axes of two directions: the middle, across towards the second, and the third.
Eigen::Matrix3d axes_of(const Eigen::Vector3d& middle, const Eigen::Vector3d& from,
                        const Eigen::Vector3d& to) {
  Eigen::Matrix3d axes;
  axes.col(0) = middle;
  axes.col(1) = ((to - from) - middle * middle.dot(to - from)).normalized();
  axes.col(2) = middle.cross(axes.col(1));
  return axes;
}

struct Hit {
  double score;
  SkyCamera camera;
  std::vector<StarMatch> seed;
  double reach_px;
};

namespace star_recognition {

class Search {
 public:
  Search(const std::vector<FoundStar>& points, const Frame& frame)
      : points_(points), frame_(frame), cells_(points, frame, points.size()) {
    for (const StarSighting& star : equatorial_sky())
      stars_.emplace_back(star.enu[0], star.enu[1], star.enu[2]);
    for (const FoundStar& point : points) places_.emplace_back(point.x_px, point.y_px, 0.0);
  }

  /// True if a camera was found that cannot be chance.
  bool run(double centre_x, double centre_y, std::size_t max_points, int most_grown,
           StarRecognition& answer) {
    std::vector<AsterismMembers> before;
    std::size_t last = 0;
    for (const std::size_t first : {8u, 12u, 18u, 27u, 40u, 60u, 90u, 135u}) {
      const std::size_t n = std::min({first, points_.size(), max_points});
      if (n == last) break;
      last = n;
      std::vector<AsterismMembers> sets =
          neighbour_sets(places_, static_cast<int>(n), n <= 20 ? kPictureNeighbours + 1 : kPictureNeighbours);
      std::vector<AsterismMembers> fresh;
      std::set_difference(sets.begin(), sets.end(), before.begin(), before.end(), std::back_inserter(fresh));
      before.insert(before.end(), fresh.begin(), fresh.end());
      std::sort(before.begin(), before.end());
      answer.figures += static_cast<int>(fresh.size());
      std::vector<Hit> hits;
      // The counts of stars around a hit: of the points to about the figures' own faintness.
      const PointCells near(points_, frame_, n + n / 2 + 4);
      near_count_ = static_cast<double>(std::min(n + n / 2 + 4, points_.size()));
      for (const AssumedLens& lens : assumed_lenses())
        for (const bool mirrored : {false, true})
          look_up(lens, mirrored, centre_x, centre_y, n, fresh, near, hits);
      answer.cameras += static_cast<double>(tried_);
      tried_ = 0;
      std::stable_sort(hits.begin(), hits.end(),
                       [](const Hit& a, const Hit& b) { return a.score > b.score; });
      if (hits.size() > static_cast<std::size_t>(most_grown)) hits.resize(most_grown);
      for (const Hit& hit : hits) {
        const GrownCamera grown = grow_camera(hit.camera, frame_, equatorial_sky(), points_, cells_, hit.seed,
                                              hit.reach_px, std::max(1.0, answer.cameras));
        if (grown_ == 0 || grown.log10_false < answer.best.log10_false) answer.best = grown;
        ++grown_;
        if (is_certain(answer.best)) return true;
      }
    }
    return false;
  }

 private:
  void look_up(const AssumedLens& assumed, bool mirrored, double centre_x, double centre_y, std::size_t n,
               const std::vector<AsterismMembers>& sets, const PointCells& near, std::vector<Hit>& hits) {
    SkyCamera camera;
    camera.model = assumed.model;
    camera.mirrored = mirrored;
    camera.numbers[centre_x_number] = centre_x;
    camera.numbers[centre_y_number] = centre_y;
    camera.numbers[focal_px_number] =
        0.5 * std::max(frame_.width_px, frame_.height_px) /
        radius_of(assumed.model, assumed.half_width_deg * sim::kRadiansPerDegree);
    const sim::Lens<double> lens = true_lens(camera);
    std::vector<Eigen::Vector3d> directions(n);
    std::vector<char> has(n);
    for (std::size_t i = 0; i < n; ++i) {
      double v[3];
      has[i] = sim::unproject(lens, points_[i].x_px, points_[i].y_px, v);
      if (has[i]) directions[i] = {v[0], v[1], v[2]};
    }
    std::vector<const Asterism*> found;
    for (const AsterismMembers& set : sets) {
      if (!has[set[0]] || !has[set[1]] || !has[set[2]] || !has[set[3]]) continue;
      Asterism one;
      if (!make_asterism(directions, set, one)) continue;
      for (const Asterism& order : orders_of(one, kCodeTolerance)) {
        found.clear();
        bright_star_asterisms().find(order, kCodeTolerance, kSizeFactor, found);
        for (const Asterism* sky : found) score(camera, order, *sky, near, hits);
      }
    }
  }

  /// Rotation and scale by the figure, then the stars around it.
  void score(const SkyCamera& assumed, const Asterism& picture, const Asterism& sky, const PointCells& near,
             std::vector<Hit>& hits) {
    ++tried_;
    SkyCamera camera = assumed;
    camera.numbers[focal_px_number] *= picture.size_rad / sky.size_rad;
    const sim::Lens<double> lens = lens_of(camera, camera.numbers.data());
    Eigen::Vector3d seen[4], middle = Eigen::Vector3d::Zero(), sky_middle = Eigen::Vector3d::Zero();
    double middle_x = 0.0, middle_y = 0.0, size_px = 0.0;
    for (int i = 0; i < 4; ++i) {
      const FoundStar& point = points_[picture.members[i]];
      double v[3];
      if (!sim::unproject(lens, point.x_px, point.y_px, v)) return;
      seen[i] = {v[0], v[1], v[2]};
      middle += seen[i];
      sky_middle += stars_[sky.members[i]];
      middle_x += 0.25 * point.x_px;
      middle_y += 0.25 * point.y_px;
    }
    middle.normalize();
    sky_middle.normalize();
    camera.camera_from_enu = axes_of(middle, seen[0], seen[1]) *
                             axes_of(sky_middle, stars_[sky.members[0]], stars_[sky.members[1]]).transpose();
    for (int i = 0; i < 4; ++i) {
      const FoundStar& point = points_[picture.members[i]];
      size_px = std::max(size_px, std::hypot(point.x_px - middle_x, point.y_px - middle_y));
    }
    double reach_angle = 0.0;
    int faintest = 0;
    for (const int m : sky.members) {
      reach_angle = std::max(reach_angle, std::acos(std::clamp(sky_middle.dot(stars_[m]), -1.0, 1.0)));
      faintest = std::max(faintest, m);
    }
    const double least = std::cos(std::min(2.2 * reach_angle, 1.7));
    const double density = 1.5 * near_count_ / (static_cast<double>(frame_.width_px) * frame_.height_px);
    const double unit = std::max(1.0, std::max(frame_.width_px, frame_.height_px) / 1500.0);
    Hit hit{0.0, camera, {}, 1.1 * size_px};
    const int last = std::min(static_cast<int>(stars_.size()), faintest + faintest / 2 + 6);
    std::vector<int> taken;
    for (int i = 0; i < last; ++i) {
      if (stars_[i].dot(sky_middle) < least) continue;
      const auto member = std::find(sky.members.begin(), sky.members.end(), i);
      if (member != sky.members.end()) {
        hit.seed.push_back({i, picture.members[member - sky.members.begin()]});
        continue;
      }
      const Eigen::Vector3d v = camera.camera_from_enu * stars_[i];
      const double in_camera[3] = {v[0], v[1], v[2]};
      double x = 0.0, y = 0.0, distance = 0.0;
      if (!sim::project(lens, in_camera, x, y) || x < 0.0 || y < 0.0 || x > frame_.width_px ||
          y > frame_.height_px)
        continue;
      const double from = std::hypot(x - middle_x, y - middle_y);
      const double tolerance = 2.0 * unit + 0.035 * std::max(from, size_px);
      const int p = near.nearest(x, y, tolerance, distance);
      const double by_chance = std::min(0.9, 1.0 - std::exp(-density * M_PI * tolerance * tolerance));
      // Stars fainter than the figure's need not be seen.
      const double expected = i <= faintest ? 0.6 : 0.3;
      if (p < 0 || std::find(taken.begin(), taken.end(), p) != taken.end() ||
          std::find(picture.members.begin(), picture.members.end(), p) != picture.members.end()) {
        hit.score += std::log(1.0 - expected);
      } else {
        hit.score += std::log(std::max(0.3, (1.0 - expected) + expected / by_chance));
        taken.push_back(p);
      }
    }
    if (taken.empty() && points_.size() > 6) return;
    if (hit.score > kMinScore) hits.push_back(std::move(hit));
  }

  const std::vector<FoundStar>& points_;
  const Frame& frame_;
  PointCells cells_;
  std::vector<Eigen::Vector3d> stars_, places_;
  double near_count_ = 0.0;
  long tried_ = 0;
  int grown_ = 0;
};

}  // namespace star_recognition

constexpr int kMinSearched_px = 300, kWidestFirst_px = 1600;

sim::Image made_smaller(const sim::Image& picture, int by) {
  if (by == 1) return picture;
  sim::Image small;
  small.width = picture.width / by;
  small.height = picture.height / by;
  const int channels = picture.channels();
  small.channel_names = picture.channel_names;
  small.data.assign(static_cast<std::size_t>(small.width) * small.height * channels, 0.0f);
  const float share = 1.0f / static_cast<float>(by * by);
  for (int y = 0; y < small.height * by; ++y)
    for (int x = 0; x < small.width * by; ++x) {
      const float* from = &picture.data[(static_cast<std::size_t>(y) * picture.width + x) * channels];
      float* to = &small.data[(static_cast<std::size_t>(y / by) * small.width + x / by) * channels];
      for (int c = 0; c < channels; ++c) to[c] += share * from[c];
    }
  return small;
}

/// Usable where all of its pixels are.
std::vector<char> made_smaller(const std::vector<char>& usable, int width, int height, int by) {
  if (usable.empty() || by == 1) return usable;
  const int w = width / by, h = height / by;
  std::vector<char> small(static_cast<std::size_t>(w) * h, 1);
  for (int y = 0; y < h * by; ++y)
    for (int x = 0; x < w * by; ++x)
      if (usable[static_cast<std::size_t>(y) * width + x] == 0)
        small[static_cast<std::size_t>(y / by) * w + x / by] = 0;
  return small;
}

}  // namespace

std::vector<StarSighting> StarRecognition::stars() const {
  std::vector<StarSighting> all;
  for (const StarMatch& one : best.matches) {
    all.push_back(equatorial_sky()[one.star]);
    all.back().x_px = points[one.point].x_px;
    all.back().y_px = points[one.point].y_px;
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const StarSighting& a, const StarSighting& b) { return a.magnitude < b.magnitude; });
  return all;
}

StarRecognition recognise_stars(const std::vector<FoundStar>& points, const Frame& frame,
                                const RecognitionSettings& settings) {
  StarRecognition answer;
  answer.points = spread_out(points, frame, settings.max_points);
  if (answer.points.size() < 5) return answer;
  star_recognition::Search search(answer.points, frame);
  const double w = frame.width_px, h = frame.height_px;
  answer.found = search.run(0.5 * w, 0.5 * h, answer.points.size(), kGrownPerLevel, answer);
  if (answer.found || !settings.off_centre) return answer;
  for (const double right : {-0.35, 0.0, 0.35})
    for (const double down : {-0.35, 0.0, 0.35}) {
      if (answer.found || (right == 0.0 && down == 0.0)) continue;
      answer.found =
          search.run((0.5 + right) * w, (0.5 + down) * h, kOffCentrePoints, kGrownOffCentre, answer);
    }
  return answer;
}

std::string words_of(const StarRecognition& recognition) {
  const GrownCamera& best = recognition.best;
  std::string words = std::to_string(recognition.points.size()) + " points of light were looked at";
  if (recognition.points.size() < 5)
    return words +
           ", and five at least are needed: a longer exposure, --signal lower, or no --mask over the sky.";
  const std::string counts =
      std::to_string(best.matches.size()) + " of the " + std::to_string(best.in_frame) +
      " stars to magnitude " + sim::short_number(best.faintest, 2) +
      " that it should show have a point within " + sim::short_number(best.radius_px, 2) +
      " px, where chance gives " + sim::short_number(best.by_chance, 2);
  if (recognition.found)
    return words + ". Recognised: " + counts + "; searches like this one are wrong once in 10^" +
           sim::short_number(std::floor(-best.log10_false), 3) + ".";
  words += " and no camera explains them. ";
  if (!best.matches.empty())
    words += "The best of " + sim::short_number(recognition.cameras, 2) + " that were tried: " + counts +
             "; " +
             (best.log10_false > 0.0
                  ? "that many are to be expected of so long a search"
                  : "chance does as well once in 10^" + sim::short_number(std::floor(-best.log10_false), 3) +
                        " searches, and 10^8 are asked for") +
             ". ";
  return words +
         "What would help: a --mask that leaves only sky, --signal higher where trees or noise give false "
         "points and lower where few stars are found, a picture in which stars are points and not trails, or "
         "a rough --camera with --time and --site.";
}

PictureStars recognise_picture(const sim::Image& linear, const StarFinderSettings& finder,
                               const std::vector<char>& usable, const RecognitionSettings& settings) {
  const int longest = std::max(linear.width, linear.height);
  const Frame frame{linear.width, linear.height, true};
  std::vector<int> scales;
  for (const int by : {1, 2, 3, 4, 6, 8})
    if (by == 1 || longest / by >= kMinSearched_px) scales.push_back(by);
  // First those at which the picture is of ordinary size.
  std::stable_sort(scales.begin(), scales.end(), [&](int a, int b) {
    return (longest / a > kWidestFirst_px) < (longest / b > kWidestFirst_px);
  });
  PictureStars best;
  bool first = true;
  // Crops off the centre take ten times as long: only when the plain ones have failed at all scales.
  for (const bool off_centre : {false, true}) {
    if (off_centre && !settings.off_centre) break;
    std::size_t tried = 0;
    for (const int by : scales) {
      if (++tried > (off_centre ? 1u : 3u)) break;
      RecognitionSettings one = settings;
      one.off_centre = off_centre;
      PictureStars now;
      now.smaller = by;
      now.found =
          find_stars(made_smaller(linear, by), finder, made_smaller(usable, linear.width, linear.height, by));
      for (FoundStar& star : now.found) {
        star.x_px *= by;
        star.y_px *= by;
        star.sigma_px *= by;
      }
      now.recognition = recognise_stars(now.found, frame, one);
      if (first || now.recognition.best.log10_false < best.recognition.best.log10_false) best = now;
      first = false;
      if (best.recognition.found) return best;
    }
  }
  return best;
}

}  // namespace vegard::fit
