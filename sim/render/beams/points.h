// The aurora as a cloud of points that give off light, for programs that render in their own way: every
// deflection point of every beam, whether a camera would see it or not.
//
// A point that gives off epsilon photons per second at a distance of r km adds 1e-16 epsilon / (r^2 Omega)
// rayleighs to a pixel of solid angle Omega: 1 R is 1e6 photons per second, cm^2 and 4 pi steradians
// (docs/physics.md).
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>

#include "sim/render/beams/emission_points.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

struct PointOptions {
  /// Odd: of so many neighbouring beams of a layer the middle one is kept (of a layer with fewer, its middle
  /// one), and the light of those kept is multiplied alike so that they stand for all of the layer's beams.
  /// (Van der Corput's sequence, by which beams stand across a layer, stays even under an odd stride and does
  /// not under an even one.)
  int every = 1;
  int threads = 0;                          ///< 0: all cores. The points do not depend on it.
  std::function<void(double)> progress;     ///< called with the finished share
  const std::atomic<bool>* stop = nullptr;  ///< ends the work early
};

/// Hands the points that give off light to `sink`, some thousands at a time, in the order sheet, arc, stretch
/// of the arc, layer, beam, path; from the calling thread. The time is the scene's first instant, at which
/// electrons fall: the light has no lag. The same
/// scene gives the same points on every run. Memory does not grow with their number. Returns how many.
std::uint64_t stream_points(const Scene& scene, const PointOptions& options,
                            const std::function<void(const EmissionPoints&)>& sink);

/// An `every` with which stream_points gives no more than `most` points while `every` - 2 gives more (or is
/// below 1): by bisection, the smallest, save that the number of points of a beam is random, so that a
/// smaller one may by chance be just enough. 0 if one beam of each layer has more points already, or if
/// `stop` ended the work.
int thinning_for(const Scene& scene, std::uint64_t most, int threads,
                 const std::atomic<bool>* stop = nullptr);

}  // namespace vegard::sim
