// The aurora as a cloud of points that emit light, for other rendering programs: every deflection point of
// every beam, whether the camera would see it or not.
//
// A point that emits epsilon photons per second at a distance of r km adds 1e-16 epsilon / (r^2 Omega)
// rayleighs to a pixel of solid angle Omega: 1 R is 1e6 photons per second, cm^2 and 4 pi steradians
// (docs/physics.md).
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>

#include "sim/render/beams/kernel_types.h"

namespace vegard::sim {

struct Scene;

struct PointOptions {
  /// Must be odd. Of `every` neighbouring beams of a layer the middle one is kept (of a layer with fewer
  /// beams, its middle one); the light of the kept beams is multiplied by one factor, so that they represent
  /// all beams of the layer. (The places of beams across a layer follow van der Corput's sequence, which
  /// stays evenly distributed under an odd stride but not under an even one.)
  int every = 1;
  int threads = 0;                          ///< 0: all cores. The points do not depend on it.
  std::function<void(double)> progress;     ///< called with the finished share
  const std::atomic<bool>* stop = nullptr;  ///< ends the work early
};

/// Passes the points that emit light to `sink`, some thousands at a time, in the order sheet, arc, stretch of
/// the arc, layer, beam, path; calls come from the calling thread. The time is the scene's first instant; the
/// lag of the light is neglected. The same scene gives the same points on every run. Memory does not grow
/// with their number. Returns the number of points.
std::uint64_t stream_points(const Scene& scene, const PointOptions& options,
                            const std::function<void(const EmissionPoints&)>& sink);

/// Returns a value of `every` with which stream_points() gives at most `most` points, while `every` - 2 gives
/// more (or is below 1). It is found by bisection; as the number of points of a beam is random, a still
/// smaller value may by chance be enough. 0 if one beam of each layer has more points already, or if `stop`
/// ended the work.
int thinning_for(const Scene& scene, std::uint64_t most, int threads,
                 const std::atomic<bool>* stop = nullptr);

}  // namespace vegard::sim
