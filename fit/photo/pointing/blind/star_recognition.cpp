#include "fit/photo/pointing/blind/star_recognition.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "fit/photo/pointing/blind/assumed_lens.h"
#include "fit/photo/pointing/blind/asterisms.h"
#include "fit/photo/pointing/blind/figure_hits.h"
#include "fit/photo/pointing/blind/narrow_search.h"
#include "fit/photo/pointing/blind/pair_search.h"
#include "fit/photo/pointing/catalogue_sky.h"
#include "sim/base/file/number_text.h"
#include "sim/base/parallel.h"
#include "sim/view/sky/bright_stars.h"

namespace vegard::fit {
namespace {

constexpr int kPictureNeighbours = 7;
constexpr int kGrownPerLevel = 16, kGrownOffCentre = 6;
constexpr std::size_t kGrownPairs = 48;
constexpr std::size_t kOffCentrePoints = 40;
constexpr int kNarrowestStars = 8;  // that chance does not explain after so long a search

/// Points that stand in a crowd of brighter ones are put behind the others, and whole crowds of about the
/// same brightness farther still: trees, houses, the aurora's folds and letters give many, the sky few.
std::vector<FoundStar> spread_out(const std::vector<FoundStar>& points, const Frame& frame, int most) {
  const double reach = 0.05 * std::max(frame.width_px, frame.height_px);
  constexpr int kCrowd = 4, kLikes = 5, kBehind = 3;
  constexpr double kAlike = 0.3;  // of the flux, 1.3 magnitudes
  std::vector<std::pair<int, int>> order;
  for (std::size_t i = 0; i < points.size(); ++i) {
    int brighter = 0, alike = 0;
    for (std::size_t j = 0; j < points.size() && points[j].flux > kAlike * points[i].flux; ++j) {
      if (j == i || std::hypot(points[i].x_px - points[j].x_px, points[i].y_px - points[j].y_px) >= reach)
        continue;
      brighter += j < i;
      alike += points[j].flux * kAlike < points[i].flux;
    }
    order.emplace_back(brighter / kCrowd + (alike >= kLikes ? kBehind : 0), static_cast<int>(i));
  }
  std::stable_sort(order.begin(), order.end());
  std::vector<FoundStar> spread;
  for (const auto& one : order)
    if (static_cast<int>(spread.size()) < most) spread.push_back(points[one.second]);
  return spread;
}

/// The catalogue's stars. Those that are not above the horizon have no direction: no camera has an image of
/// them, and their indices stay what they are.
std::vector<StarSighting> sky_above(const Eigen::Vector3d& zenith) {
  constexpr double kLowest = -0.01;  // refraction lifts the horizon by half a degree
  std::vector<StarSighting> sky = equatorial_sky();
  for (StarSighting& star : sky)
    if (Eigen::Vector3d(star.enu[0], star.enu[1], star.enu[2]).dot(zenith) < kLowest)
      star.enu.fill(std::numeric_limits<double>::quiet_NaN());
  return sky;
}

namespace star_recognition {

class Search {
 public:
  /// `has_best`: the answer has a best camera already, of an earlier search.
  Search(const std::vector<FoundStar>& points, const Frame& frame, const RecognitionSettings& settings,
         bool has_best)
      : points_(points),
        frame_(frame),
        pixels_(settings.pixels),
        zenith_(settings.zenith),
        progress_(settings.progress),
        cells_(points, frame, points.size()),
        sky_{points, frame, stars_, bright_star_asterisms(), std::nullopt, wide_limits()},
        has_best_(has_best) {
    for (const StarSighting& star : equatorial_sky())
      stars_.emplace_back(star.enu[0], star.enu[1], star.enu[2]);
    for (const FoundStar& point : points) places_.emplace_back(point.x_px, point.y_px, 0.0);
  }

  /// True if a camera was found that cannot be chance.
  bool run(double centre_x, double centre_y, std::size_t max_points, int most_grown,
           StarRecognition& answer) {
    std::vector<AsterismMembers> before;
    std::size_t last = 0;
    // What a level takes grows with the square of its points.
    constexpr double kMostPoints = 135.0;
    for (const std::size_t first : {8u, 12u, 18u, 27u, 40u, 60u, 90u, 135u}) {
      const double share = static_cast<double>(last) / kMostPoints;
      if (progress_) progress_(share * share);
      const std::size_t n = std::min({first, points_.size(), max_points});
      if (n == last) break;
      last = n;
      const std::vector<AsterismMembers> fresh = fresh_sets(
          places_, static_cast<int>(n), n <= 20 ? kPictureNeighbours + 1 : kPictureNeighbours, before);
      answer.figures += static_cast<int>(fresh.size());
      // The counts of stars around a hit: of the points to about the figures' own faintness.
      const PointCells near(points_, frame_, n + n / 2 + 4);
      const double near_count = static_cast<double>(std::min(n + n / 2 + 4, points_.size()));
      // A lens is a task, and their hits are joined in the order of the lenses.
      const std::vector<AssumedLens>& lenses = assumed_lenses();
      std::vector<FigureHits> by_lens(2 * lenses.size());
      sim::parallel_for(by_lens.size(), 0, [&](std::size_t i, int) {
        by_lens[i] =
            look_up_figures(sky_, assumed_camera(lenses[i / 2], i % 2 == 1, frame_, centre_x, centre_y), n,
                            fresh, near, near_count);
      });
      const std::vector<CameraHit> hits =
          best_hits(std::move(by_lens), static_cast<std::size_t>(most_grown), answer.cameras);
      if (grow(hits, equatorial_sky(), answer)) return true;
      grown_hits_.insert(grown_hits_.end(), hits.begin(), hits.end());
    }
    return false;
  }

  /// The same under a sky that is known: by the hits that were grown under the whole sky, and by pairs.
  bool run_known_sky(StarRecognition& answer) {
    if (!zenith_) return false;
    const std::vector<StarSighting> sky = sky_above(*zenith_);
    // A figure of stars of which one is below the horizon is none.
    grown_hits_.erase(std::remove_if(grown_hits_.begin(), grown_hits_.end(),
                                     [&](const CameraHit& hit) {
                                       return std::any_of(hit.seed.begin(), hit.seed.end(),
                                                          [&](const StarMatch& one) {
                                                            return !std::isfinite(sky[one.star].enu[0]);
                                                          });
                                     }),
                      grown_hits_.end());
    if (grow(grown_hits_, sky, answer)) return true;
    for (const int first : {16, 32}) {
      const PairSearch pairs = search_pairs(points_, frame_, sky, *zenith_, first, kGrownPairs);
      answer.cameras += pairs.cameras;
      if (grow(pairs.hits, sky, answer)) return true;
      if (static_cast<std::size_t>(first) >= points_.size()) break;
    }
    return false;
  }

 private:
  static FigureLimits wide_limits() {
    FigureLimits limits;
    limits.code_tolerance = 0.03;
    limits.size_factor = 1.35;
    limits.around = 2.2;
    limits.most_around_rad = 1.7;
    limits.near_px = 2.0;
    limits.near_share = 0.035;
    limits.grown_share = 1.1;
    limits.least_score = 3.0;
    limits.alone_points = 6;
    return limits;
  }

  /// Grows the hits to cameras; true as soon as one cannot be chance.
  bool grow(const std::vector<CameraHit>& hits, const std::vector<StarSighting>& sky,
            StarRecognition& answer) {
    const double trials = std::max(1.0, answer.cameras);
    return grow_until_certain(
        hits,
        [&](const CameraHit& hit) {
          return grow_camera(hit.camera, frame_, sky, points_, cells_, hit.seed, hit.reach_px, trials,
                             pixels_);
        },
        has_best_, answer.best);
  }

  const std::vector<FoundStar>& points_;
  const Frame& frame_;
  const SkyPixels& pixels_;
  const std::optional<Eigen::Vector3d>& zenith_;
  const std::function<void(double)>& progress_;
  PointCells cells_;
  std::vector<CameraHit> grown_hits_;
  std::vector<Eigen::Vector3d> stars_, places_;
  FigureSky sky_;
  bool has_best_;
};

}  // namespace star_recognition

constexpr int kMinSearched_px = 300, kWidestFirst_px = 1600;

sim::Image made_smaller(const sim::Image& picture, int by) {
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
  if (usable.empty()) return usable;
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
  for (const StarMatch& one : best.agreement.matches) {
    all.push_back(equatorial_star(one.star));
    all.back().x_px = points[one.point].x_px;
    all.back().y_px = points[one.point].y_px;
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const StarSighting& a, const StarSighting& b) { return a.magnitude < b.magnitude; });
  return all;
}

namespace {

StarRecognition empty_answer(const std::vector<FoundStar>& points, const Frame& frame,
                             const RecognitionSettings& settings) {
  constexpr double kSkySquareDegrees = 41253.0;
  StarRecognition answer;
  answer.points = spread_out(points, frame, settings.max_points);
  const double longer = std::max(frame.width_px, frame.height_px),
               shorter = std::min(frame.width_px, frame.height_px);
  answer.narrowest_deg = std::sqrt(kNarrowestStars * kSkySquareDegrees /
                                   static_cast<double>(sim::kDeepStars) * longer / shorter);
  return answer;
}

/// Among all stars of the catalogue, as a narrow field shows them.
bool search_as_narrow(const Frame& frame, const RecognitionSettings& settings, StarRecognition& answer) {
  const NarrowSearch narrow = search_narrow(answer.points, frame, settings.pixels, settings.zenith);
  answer.cameras += narrow.cameras;
  answer.figures += narrow.figures;
  if (narrow.has_best && (answer.best.agreement.matches.empty() ||
                          narrow.best.agreement.log10_false < answer.best.agreement.log10_false))
    answer.best = narrow.best;
  return narrow.found;
}

/// With the lens's centre off the middle; `answer` is that of the middle, whose cameras count as tried.
void search_off_centre(const Frame& frame, const RecognitionSettings& settings, StarRecognition& answer) {
  if (answer.found || answer.points.size() < 5) return;
  RecognitionSettings quiet = settings;
  quiet.progress = {};
  star_recognition::Search search(answer.points, frame, quiet, true);
  const double w = frame.width_px, h = frame.height_px;
  constexpr double kPlaces = 8.0;
  double places = 0.0;
  for (const double right : {-0.35, 0.0, 0.35})
    for (const double down : {-0.35, 0.0, 0.35}) {
      if (answer.found || (right == 0.0 && down == 0.0)) continue;
      if (settings.progress) settings.progress(places++ / kPlaces);
      answer.found =
          search.run((0.5 + right) * w, (0.5 + down) * h, kOffCentrePoints, kGrownOffCentre, answer);
    }
}

}  // namespace

StarRecognition recognise_stars(const std::vector<FoundStar>& points, const Frame& frame,
                                const RecognitionSettings& settings) {
  StarRecognition answer = empty_answer(points, frame, settings);
  if (answer.points.size() < 5) return answer;
  star_recognition::Search search(answer.points, frame, settings, false);
  answer.found =
      search.run(0.5 * frame.width_px, 0.5 * frame.height_px, answer.points.size(), kGrownPerLevel, answer) ||
      search_as_narrow(frame, settings, answer) || search.run_known_sky(answer);
  if (settings.off_centre) search_off_centre(frame, settings, answer);
  return answer;
}

std::string words_of(const StarRecognition& recognition) {
  const GrownCamera& best = recognition.best;
  std::string words = std::to_string(recognition.points.size()) + " points of light were looked at";
  if (recognition.points.size() < 5)
    return words +
           ", and five at least are needed: a longer exposure, --signal lower, or no --mask over the sky.";
  const std::string counts = words_of(best.agreement);
  if (recognition.found)
    return words + ". Recognised: " + counts + "; searches like this one are wrong once in 10^" +
           sim::short_number(std::floor(-best.agreement.log10_false), 3) + ".";
  words += " and no camera explains them. ";
  if (!best.agreement.matches.empty())
    words += "The best of " + sim::short_number(recognition.cameras, 2) + " that were tried: " + counts +
             "; " +
             (best.agreement.log10_false > 0.0
                  ? "that many are to be expected of so long a search"
                  : "chance does as well once in 10^" +
                        sim::short_number(std::floor(-best.agreement.log10_false), 3) +
                        " searches, and 10^8 are asked for") +
             ". ";
  return words +
         "What would help: a --mask that leaves only sky, --signal higher where trees or noise give false "
         "points and lower where few stars are found, a picture in which stars are points and not trails, or "
         "a rough --camera with --time and --site. A picture of less than " +
         sim::short_number(recognition.narrowest_deg, 2) + " degrees across shows fewer than " +
         std::to_string(kNarrowestStars) + " of the " + std::to_string(sim::kDeepStars) +
         " stars that are known: such a field needs Astrometry.net's solution (--wcs FIELD.wcs).";
}

std::vector<FoundStar> points_of_smaller(const sim::Image& linear, const StarFinderSettings& finder,
                                         const std::vector<char>& usable, int smaller) {
  if (smaller == 1) return find_stars(linear, finder, usable);
  std::vector<FoundStar> found = find_stars(made_smaller(linear, smaller), finder,
                                            made_smaller(usable, linear.width, linear.height, smaller));
  for (FoundStar& star : found) {
    star.x_px *= smaller;
    star.y_px *= smaller;
    star.sigma_px *= smaller;
  }
  return found;
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
  constexpr double kAtMiddle = 0.6;  // of the whole search's time
  RecognitionSettings one = settings;
  one.progress = {};
  one.off_centre = false;
  if (!usable.empty()) one.pixels = SkyPixels(usable);
  PictureStars best, at_first_scale;
  for (std::size_t i = 0; i < std::min<std::size_t>(3, scales.size()); ++i) {
    PictureStars now;
    now.smaller = scales[i];
    now.found = points_of_smaller(linear, finder, usable, scales[i]);
    const std::size_t searches = std::min<std::size_t>(3, scales.size());
    if (settings.progress)
      one.progress = [&](double share) {
        settings.progress(kAtMiddle * (static_cast<double>(i) + share) / static_cast<double>(searches));
      };
    now.recognition = recognise_stars(now.found, frame, one);
    if (i == 0) at_first_scale = now;
    if (i == 0 || now.recognition.best.agreement.log10_false < best.recognition.best.agreement.log10_false)
      best = now;
    if (best.recognition.found) return best;
  }
  // Crops off the centre take long: only when the plain ones have failed at all scales, and at the first.
  if (!settings.off_centre) return best;
  if (settings.progress)
    one.progress = [&](double share) { settings.progress(kAtMiddle + (1.0 - kAtMiddle) * share); };
  search_off_centre(frame, one, at_first_scale.recognition);
  const bool is_better =
      at_first_scale.recognition.best.agreement.log10_false < best.recognition.best.agreement.log10_false;
  return at_first_scale.recognition.found || is_better ? at_first_scale : best;
}

}  // namespace vegard::fit
