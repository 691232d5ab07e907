// Cameras by figures of four points: what the searches of wide and of narrow fields have in common.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

#include "fit/photo/pointing/blind/assumed_lens.h"
#include "fit/photo/pointing/blind/asterisms.h"
#include "fit/photo/pointing/blind/growing_camera.h"

namespace vegard::fit {

/// How a figure is looked up, and how its camera is judged by the stars around it.
struct FigureLimits {
  double code_tolerance = 0.0, size_factor = 0.0;  ///< as AsterismIndex::find() takes them
  double around = 0.0, most_around_rad = 0.0;      ///< how far stars count: in reaches of the figure, at most
  double near_px = 0.0;          ///< how far a point may be from its star, for each 1500 px of the picture,
  double near_share = 0.0;       ///< and of its distance from the figure besides
  double grown_share = 0.0;      ///< CameraHit::reach_px, of the figure's size
  double least_score = 0.0;      ///< natural log of the odds, four stars of the figure not counted
  std::size_t alone_points = 0;  ///< of so few points the figure alone is a hit
};

/// What is the same for all figures of a picture.
struct FigureSky {
  const std::vector<FoundStar>& points;
  const Frame& frame;
  const std::vector<Eigen::Vector3d>& stars;  ///< those of `index`, the brightest first
  const AsterismIndex& index;
  std::optional<Eigen::Vector3d> zenith;  ///< figures with stars below its horizon are left out
  FigureLimits limits;
};

struct FigureHits {
  std::vector<CameraHit> hits;
  double tried = 0.0;  ///< number of cameras
};

/// Returns the sets of neighbour_sets() that are not in `before`, and puts them there.
std::vector<AsterismMembers> fresh_sets(const std::vector<Eigen::Vector3d>& places, int first, int neighbours,
                                        std::vector<AsterismMembers>& before);

/// Returns the cameras by figures `sets` of the first `n` points under an assumed lens. `near`: the cells of
/// `near_count` points, by which the stars around are counted.
FigureHits look_up_figures(const FigureSky& sky, const SkyCamera& assumed, std::size_t n,
                           const std::vector<AsterismMembers>& sets, const PointCells& near,
                           double near_count);

/// Returns the `most` best of all, those of equal score in their order, and adds to `tried`.
std::vector<CameraHit> best_hits(std::vector<FigureHits> all, std::size_t most, double& tried);

/// Grows the hits to cameras and keeps the best, of which there is one already if `has_best`. Returns true as
/// soon as one is certain.
bool grow_until_certain(const std::vector<CameraHit>& hits,
                        const std::function<GrownCamera(const CameraHit&)>& grown_of, bool& has_best,
                        GrownCamera& best);

}  // namespace vegard::fit
