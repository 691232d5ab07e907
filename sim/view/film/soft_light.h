// Blurs of light on a film: a blur against grain, and glow.
#pragma once

namespace vegard::sim {

/// `count` planes of [rows][columns][channels], one after the other.
struct Planes {
  float* data = nullptr;
  int count = 0, rows = 0, columns = 0, channels = 1;
};

/// Blurs each plane by a Gaussian with these standard deviations in cells (sim/view/film/blur.h). Outside of
/// the plane there is no light; light that is blurred beyond the edges is lost.
void soften(const Planes& planes, double sigma_down, double sigma_across, int threads);

/// light = (1 - share) light + share x blurred light. The total is conserved, except beyond the edges.
void spread_glow(const Planes& planes, double share, double sigma_down, double sigma_across, int threads);

}  // namespace vegard::sim
