#include "fit/photo/pointing/blind/narrow_search.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

#include "fit/photo/pointing/blind/assumed_lens.h"
#include "fit/photo/pointing/blind/asterisms.h"
#include "fit/photo/pointing/blind/figure_hits.h"
#include "fit/photo/pointing/catalogue_sky.h"
#include "sim/base/number/constants.h"
#include "sim/base/parallel.h"

namespace vegard::fit {
namespace {

constexpr int kNarrowNeighbours = 7;
constexpr double kWidestCone_deg = 18.5;
constexpr std::size_t kNarrowGrown = 64;
constexpr double kSearches = 2.0;         // this one and that of wide pictures: each has its own trials
constexpr double kNothing_log10 = 300.0;  // of a camera that is not one
constexpr double kBelowHorizon = -0.01;   // refraction lifts the horizon by half a degree

class NarrowFields {
 public:
  NarrowFields(const std::vector<FoundStar>& points, const Frame& frame, const SkyPixels& pixels,
               const std::optional<Eigen::Vector3d>& zenith)
      : points_(points),
        frame_(frame),
        pixels_(pixels),
        zenith_(zenith),
        cells_(points, frame, points.size()),
        sky_{points, frame, stars_, deep_star_asterisms(), zenith, narrow_limits()} {
    for (const StarSighting& star : deep_equatorial_sky())
      stars_.emplace_back(star.enu[0], star.enu[1], star.enu[2]);
    for (const FoundStar& point : points) places_.emplace_back(point.x_px, point.y_px, 0.0);
  }

  NarrowSearch run() {
    std::vector<AsterismMembers> before;
    std::size_t last = 0;
    for (const std::size_t first : {8u, 12u, 18u, 27u, 40u, 60u, 90u}) {
      const std::size_t n = std::min(first, points_.size());
      if (n == last) break;
      last = n;
      const std::vector<AsterismMembers> fresh =
          fresh_sets(places_, static_cast<int>(n), kNarrowNeighbours, before);
      answer_.figures += static_cast<int>(fresh.size());
      near_count_ = static_cast<double>(std::min(n + n / 2 + 4, points_.size()));
      const PointCells near(points_, frame_, static_cast<std::size_t>(near_count_));
      if (grow(hits_of(fresh, n, near))) return answer_;
    }
    return answer_;
  }

 private:
  static FigureLimits narrow_limits() {
    FigureLimits limits;
    limits.code_tolerance = 0.015;
    limits.size_factor = 1.9;  // half of a step between the assumed lenses
    limits.around = 3.0;
    limits.most_around_rad = 0.5;
    limits.near_px = 1.5;
    limits.near_share = 0.015;
    limits.grown_share = 1.3;
    limits.least_score = 1.0;
    return limits;
  }

  std::vector<CameraHit> hits_of(const std::vector<AsterismMembers>& sets, std::size_t n,
                                 const PointCells& near) {
    constexpr double kHalfWidths_deg[] = {3.0, 10.0};
    constexpr std::size_t kCameras = 4;  // both as they are and mirrored
    std::vector<FigureHits> all(kCameras);
    sim::parallel_for(kCameras, 0, [&](std::size_t i, int) {
      const AssumedLens lens = {sim::LensModel::pinhole, kHalfWidths_deg[i / 2]};
      all[i] = look_up_figures(
          sky_, assumed_camera(lens, i % 2 == 1, frame_, 0.5 * frame_.width_px, 0.5 * frame_.height_px), n,
          sets, near, near_count_);
    });
    return best_hits(std::move(all), kNarrowGrown, answer_.cameras);
  }

  /// Grows the hits to cameras; true as soon as one cannot be chance.
  bool grow(const std::vector<CameraHit>& hits) {
    const double trials = std::max(1.0, kSearches * answer_.cameras);
    answer_.found = grow_until_certain(
        hits, [&](const CameraHit& hit) { return grown_of(hit, trials); }, answer_.has_best, answer_.best);
    return answer_.found;
  }

  /// Among the stars in and around the frame alone.
  GrownCamera grown_of(const CameraHit& hit, double trials) const {
    constexpr double kBeyond = 1.5;
    const std::vector<StarSighting>& sky = deep_equatorial_sky();
    const std::optional<FieldCone> cone = field_cone(hit.camera, frame_);
    if (!cone || cone->radius_rad > kWidestCone_deg * sim::kRadiansPerDegree) {
      GrownCamera none;
      none.agreement.log10_false = kNothing_log10;
      return none;
    }
    const double least = std::cos(std::min(kBeyond * cone->radius_rad, M_PI));
    std::vector<int> indices;
    std::vector<StarSighting> around;
    std::vector<StarMatch> seed;
    for (std::size_t i = 0; i < sky.size(); ++i) {
      if (stars_[i].dot(cone->middle) < least || (zenith_ && stars_[i].dot(*zenith_) < kBelowHorizon))
        continue;
      for (const StarMatch& one : hit.seed)
        if (one.star == static_cast<int>(i)) seed.push_back({static_cast<int>(around.size()), one.point});
      indices.push_back(static_cast<int>(i));
      around.push_back(sky[i]);
    }
    GrownCamera grown =
        grow_camera(hit.camera, frame_, around, points_, cells_, seed, hit.reach_px, trials, pixels_, true);
    for (StarMatch& one : grown.agreement.matches) one.star = indices[static_cast<std::size_t>(one.star)];
    return grown;
  }

  const std::vector<FoundStar>& points_;
  const Frame& frame_;
  const SkyPixels& pixels_;
  const std::optional<Eigen::Vector3d>& zenith_;
  PointCells cells_;
  std::vector<Eigen::Vector3d> stars_, places_;
  FigureSky sky_;
  double near_count_ = 0.0;
  NarrowSearch answer_;
};

}  // namespace

NarrowSearch search_narrow(const std::vector<FoundStar>& points, const Frame& frame, const SkyPixels& pixels,
                           const std::optional<Eigen::Vector3d>& zenith) {
  return NarrowFields(points, frame, pixels, zenith).run();
}

}  // namespace vegard::fit
