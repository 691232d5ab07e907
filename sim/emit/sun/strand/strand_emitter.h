// The light of strands along rays.
//
// Light is the integral of the density along the ray (strand.h), times rayleighs per unit of path. Strands
// are cut into straight segments (strand.h), which rays find by a hierarchy of boxes and whose
// integrals are exact or nearly so (segment_light.h). The search uses doubles; for T = FreeDual only the
// segments that a ray meets are computed with derivatives. Where a strand comes within its radius of itself,
// the densities of both parts are added.
//
// Strands narrower than about a pixel are widened to it without changing their light, to the radius at which
// the Fourier component of the projected strand with the period of a pixel is nearly 0, so that rays one
// pixel apart add up to its light wherever they fall.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/emit/sun/strand/segment_light.h"
#include "sim/emit/sun/strand/strand.h"
#include "sim/emit/sun/sun_frame.h"
#include "sim/light/emitter.h"
#include "sim/light/segment_tree.h"

namespace vegard::sim {

template <class T>
class StrandEmitter : public Emitter<T> {
 public:
  /// `light`: per line, for density 1 and a unit of path (line_light.h); empty: dark.
  StrandEmitter(const Strands<T>& strands, const Sun& sun, const SunFrame<T>& frame, std::vector<T> light);

  void march(const RayBundle<T>& rays, const BundleLight<T>& out) const override;
  bool is_mixed() const override { return true; }

  std::size_t segments() const { return segments_.size(); }

 private:
  void march_ray(const T enu[3], const T& end_km, double blur, std::size_t ray, std::size_t rays,
                 const BundleLight<T>& out) const;
  /// Returns the factors per line of a segment's strand; only if strands have factors.
  const T* gains_of(std::uint32_t segment) const {
    return gain_.data() + strand_of_[segment] * light_.size();
  }

  SunFrame<T> frame_;
  double radius_;  ///< of the photosphere
  RadialFalloff falloff_;
  std::vector<T> light_;
  std::vector<PlacedJoint<double>> plain_;  ///< without derivatives
  std::vector<PlacedJoint<T>> joints_;      ///< empty if T is double
  std::vector<std::uint32_t> segments_;     ///< first joint of each segment; its second is the next one
  // For strands with factors per line, else empty:
  std::vector<T> gain_;                   ///< [strand][line]
  std::vector<std::uint32_t> strand_of_;  ///< [segment]
  SegmentTree tree_;
};

extern template class StrandEmitter<double>;
extern template class StrandEmitter<FreeDual>;

}  // namespace vegard::sim
