// Light that is spread over a film: the blur that hides grain, and glow.
#pragma once

namespace vegard::sim {

/// Planes of [rows][columns][channels], side by side.
struct Planes {
  float* data = nullptr;
  int count = 0, rows = 0, columns = 0, channels = 1;
};

/// Blurs each by a Gaussian of so many cells' standard deviation down and across (sim/view/film/blur.h).
/// Outside of the plane there is no light; what would fall there is lost.
void soften(const Planes& planes, double sigma_down, double sigma_across, int threads);

/// light = (1 - share) light + share blurred light: as bright in all, but for what falls past the edges.
void spread_glow(const Planes& planes, double share, double sigma_down, double sigma_across, int threads);

}  // namespace vegard::sim
