#include "fit/photo/pointing/blind/narrow_search.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "fit/photo/pointing/blind/assumed_lens.h"
#include "fit/photo/pointing/blind/asterisms.h"
#include "fit/photo/pointing/catalogue_sky.h"
#include "sim/base/number/constants.h"
#include "sim/base/parallel.h"

namespace vegard::fit {
namespace {

constexpr double kNarrowTolerance = 0.015;  // of a code
constexpr double kNarrowSizes = 1.9;        // half of a step between the assumed lenses
constexpr int kNarrowNeighbours = 7;
constexpr double kNarrowScore = 1.0, kWidestCone_deg = 18.5;
constexpr std::size_t kNarrowGrown = 64;
constexpr double kSearches = 2.0;         // this one and that of wide pictures: each has its own trials
constexpr double kNothing_log10 = 300.0;  // of a camera that is not one
constexpr double kBelowHorizon = -0.01;   // refraction lifts the horizon by half a degree

/// Three axes of two directions: the middle, across towards the second, and the third.
Eigen::Matrix3d narrow_axes(const Eigen::Vector3d& middle, const Eigen::Vector3d& from,
                            const Eigen::Vector3d& to) {
  Eigen::Matrix3d axes;
  axes.col(0) = middle;
  axes.col(1) = ((to - from) - middle * middle.dot(to - from)).normalized();
  axes.col(2) = middle.cross(axes.col(1));
  return axes;
}

class NarrowFields {
 public:
  NarrowFields(const std::vector<FoundStar>& points, const Frame& frame, const SkyPixels& pixels,
               const std::optional<Eigen::Vector3d>& zenith)
      : points_(points),
        frame_(frame),
        pixels_(pixels),
        zenith_(zenith),
        cells_(points, frame, points.size()),
        index_(deep_star_asterisms()) {
    for (const StarSighting& star : deep_equatorial_sky())
      stars_.emplace_back(star.enu[0], star.enu[1], star.enu[2]);
    for (const FoundStar& point : points) places_.emplace_back(point.x_px, point.y_px, 0.0);
    unit_ = std::max(1.0, std::max(frame.width_px, frame.height_px) / 1500.0);
  }

  NarrowSearch run() {
    std::vector<AsterismMembers> before;
    std::size_t last = 0;
    for (const std::size_t first : {8u, 12u, 18u, 27u, 40u, 60u, 90u}) {
      const std::size_t n = std::min(first, points_.size());
      if (n == last) break;
      last = n;
      const std::vector<AsterismMembers> sets =
          neighbour_sets(places_, static_cast<int>(n), kNarrowNeighbours);
      std::vector<AsterismMembers> fresh;
      std::set_difference(sets.begin(), sets.end(), before.begin(), before.end(), std::back_inserter(fresh));
      before.insert(before.end(), fresh.begin(), fresh.end());
      std::sort(before.begin(), before.end());
      answer_.figures += static_cast<int>(fresh.size());
      near_count_ = static_cast<double>(std::min(n + n / 2 + 4, points_.size()));
      const PointCells near(points_, frame_, static_cast<std::size_t>(near_count_));
      if (grow(hits_of(fresh, n, near))) return answer_;
    }
    return answer_;
  }

 private:
  struct LensHits {
    std::vector<CameraHit> hits;
    double tried = 0.0;
  };

  std::vector<CameraHit> hits_of(const std::vector<AsterismMembers>& sets, std::size_t n,
                                 const PointCells& near) {
    constexpr double kHalfWidths_deg[] = {3.0, 10.0};
    constexpr std::size_t kCameras = 4;  // both as they are and mirrored
    std::vector<LensHits> all(kCameras);
    sim::parallel_for(kCameras, 0, [&](std::size_t i, int) {
      const AssumedLens lens = {sim::LensModel::pinhole, kHalfWidths_deg[i / 2]};
      look_up(assumed_camera(lens, i % 2 == 1, frame_, 0.5 * frame_.width_px, 0.5 * frame_.height_px), n,
              sets, near, all[i]);
    });
    std::vector<CameraHit> hits;
    for (LensHits& one : all) {
      answer_.cameras += one.tried;
      for (CameraHit& hit : one.hits) hits.push_back(std::move(hit));
    }
    std::stable_sort(hits.begin(), hits.end(),
                     [](const CameraHit& a, const CameraHit& b) { return a.score > b.score; });
    if (hits.size() > kNarrowGrown) hits.resize(kNarrowGrown);
    return hits;
  }

  void look_up(const SkyCamera& camera, std::size_t n, const std::vector<AsterismMembers>& sets,
               const PointCells& near, LensHits& found_hits) const {
    const sim::Lens<double> lens = true_lens(camera);
    std::vector<Eigen::Vector3d> directions(n);
    for (std::size_t i = 0; i < n; ++i) {
      double v[3];
      if (!sim::unproject(lens, points_[i].x_px, points_[i].y_px, v)) return;
      directions[i] = {v[0], v[1], v[2]};
    }
    std::vector<const Asterism*> found;
    for (const AsterismMembers& set : sets) {
      Asterism one;
      if (!make_asterism(directions, set, one)) continue;
      for (const Asterism& order : orders_of(one, kNarrowTolerance)) {
        found.clear();
        index_.find(order, kNarrowTolerance, kNarrowSizes, found);
        for (const Asterism* sky : found) score(camera, order, *sky, near, found_hits);
      }
    }
  }

  /// Rotation and scale by the figure, then the stars around it.
  void score(const SkyCamera& assumed, const Asterism& picture, const Asterism& sky, const PointCells& near,
             LensHits& found_hits) const {
    Eigen::Vector3d sky_middle = Eigen::Vector3d::Zero();
    for (const int m : sky.members) {
      if (zenith_ && stars_[m].dot(*zenith_) < kBelowHorizon) return;
      sky_middle += stars_[m];
    }
    sky_middle.normalize();
    found_hits.tried += 1.0;
    SkyCamera camera = assumed;
    camera.numbers[focal_px_number] *= picture.size_rad / sky.size_rad;
    const sim::Lens<double> lens = lens_of(camera, camera.numbers.data());
    Eigen::Vector3d seen[4], middle = Eigen::Vector3d::Zero();
    double middle_x = 0.0, middle_y = 0.0, size_px = 0.0, reach_angle = 0.0;
    for (int i = 0; i < 4; ++i) {
      const FoundStar& point = points_[picture.members[i]];
      double v[3];
      if (!sim::unproject(lens, point.x_px, point.y_px, v)) return;
      seen[i] = {v[0], v[1], v[2]};
      middle += seen[i];
      middle_x += 0.25 * point.x_px;
      middle_y += 0.25 * point.y_px;
    }
    middle.normalize();
    int faintest = 0;
    for (int i = 0; i < 4; ++i) {
      const FoundStar& point = points_[picture.members[i]];
      size_px = std::max(size_px, std::hypot(point.x_px - middle_x, point.y_px - middle_y));
      const Eigen::Vector3d& star = stars_[sky.members[i]];
      reach_angle = std::max(reach_angle, std::atan2(star.cross(sky_middle).norm(), star.dot(sky_middle)));
      faintest = std::max(faintest, sky.members[i]);
    }
    camera.camera_from_enu =
        narrow_axes(middle, seen[0], seen[1]) *
        narrow_axes(sky_middle, stars_[sky.members[0]], stars_[sky.members[1]]).transpose();
    const double least = std::cos(std::min(3.0 * reach_angle, 0.5));
    const double density = 1.5 * near_count_ / (static_cast<double>(frame_.width_px) * frame_.height_px);
    CameraHit hit{0.0, camera, {}, 1.3 * size_px};
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
      const double tolerance = 1.5 * unit_ + 0.015 * std::max(from, size_px);
      const int p = near.nearest(x, y, tolerance, distance);
      if (p < 0 || std::find(taken.begin(), taken.end(), p) != taken.end() ||
          std::find(picture.members.begin(), picture.members.end(), p) != picture.members.end()) {
        hit.count_missing(i <= faintest);
      } else {
        hit.count_seen(i <= faintest, density, tolerance);
        taken.push_back(p);
      }
    }
    if (!taken.empty() && hit.score > kNarrowScore) found_hits.hits.push_back(std::move(hit));
  }

  /// Grows the hits to cameras; true as soon as one cannot be chance.
  bool grow(const std::vector<CameraHit>& hits) {
    constexpr std::size_t kTogether = 4;
    const double trials = std::max(1.0, kSearches * answer_.cameras);
    // A few at a time, and the first one that is certain counts: the same for any number of threads.
    for (std::size_t begin = 0; begin < hits.size(); begin += kTogether) {
      std::vector<GrownCamera> grown(std::min(kTogether, hits.size() - begin));
      sim::parallel_for(grown.size(), 0,
                        [&](std::size_t i, int) { grown[i] = grown_of(hits[begin + i], trials); });
      for (const GrownCamera& one : grown) {
        if (!answer_.has_best || one.agreement.log10_false < answer_.best.agreement.log10_false)
          answer_.best = one;
        answer_.has_best = true;
        answer_.found = is_certain(answer_.best);
        if (answer_.found) return true;
      }
    }
    return false;
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
  const AsterismIndex& index_;
  std::vector<Eigen::Vector3d> stars_, places_;
  double unit_ = 1.0, near_count_ = 0.0;
  NarrowSearch answer_;
};

}  // namespace

NarrowSearch search_narrow(const std::vector<FoundStar>& points, const Frame& frame, const SkyPixels& pixels,
                           const std::optional<Eigen::Vector3d>& zenith) {
  return NarrowFields(points, frame, pixels, zenith).run();
}

}  // namespace vegard::fit
