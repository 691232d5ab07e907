#include "sim/render/volumes/thin_strands.h"

#include <algorithm>
#include <limits>

#include "sim/emit/sun/strand/flux_rope.h"
#include "sim/light/emitter.h"

namespace vegard::sim {
namespace {}  // namespace

ThinStrand thinnest_strand(const Scene& scene) {
  ThinStrand thinnest{"", std::numeric_limits<double>::infinity()};
  if (!scene.sun.shown) return thinnest;
  const auto hold_against = [&](const char* kind, const std::string& name, double radius) {
    if (radius < thinnest.radius) thinnest = {kind + (" '" + name + "'"), radius};
  };
  for (const Loop& loop : scene.loops) hold_against("loop", loop.name, loop.strand_radius);
  for (const Bundle& bundle : scene.bundles)
    hold_against("bundle", bundle.name, std::min(bundle.foot_radius, bundle.top_radius));
  for (const Ejection& ejection : scene.ejections) {
    if (ejection.kind != "rope") continue;
    Ejection one = ejection;  // strands of a rope are all as thick
    one.strands = 1;
    for (const Strand<double>& piece :
         rope_strands<double>(scene.sun, scene.time, one, NumberAs<double>(plain_number)).all)
      hold_against("ejection", ejection.name, std::max(piece.radius_first, piece.radius_last));
  }
  return thinnest;
}

}  // namespace vegard::sim
