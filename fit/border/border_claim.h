// The probability that a trace is the lower border of aurora, and not of stars, cloud, lamps, twilight, the
// Moon, a roof or noise.
//
// Pieces of evidence are taken as independent: the logarithm of the odds is the sum of the logarithms of
// likelihood ratios, each bounded, so that no single piece decides against all others. What the light of a
// point is, is measured where its neighbours say that the border runs, never at its own peak: a peak is
// chosen for being bright, and noise would be taken for light of the channel that was traced.
//
// - Length and chance: aurora's borders are long; how many traces chance gives, and how long they are, is
//   measured in the same picture upside down, where what has no top and bottom gives as many.
// - Continuity: the share of the peaks' light that is where the neighbours say; of stars and noise little.
// - Colour, where the channels differ: the share of the traced channel's excess that no continuum gives. A
//   black body between 2000 and 20000 K, white at 6500 K, has no more green than the mean of red and blue in
//   linear sRGB; a camera without white balance has up to twice as much, and the sky beneath tells.
// - Contrast to the sky beneath, sharpness below against above, roughness of the line.
// - What is known to be there: the edge of a mask or roof, the air's dimming towards the horizon, the Milky
//   Way and the Moon (of a scene with time and site).
//
// The distributions' widths are ESTIMATED (docs/border.md); tests/reality holds the answer against real
// skies.
#pragma once

#include <vector>

#include "fit/border/border_trace.h"
#include "fit/border/sky_cells.h"
#include "fit/photo/photo.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// What is measured of a trace. NaN where it cannot be.
struct BorderEvidence {
  int points = 0;            ///< measured, with enough neighbours
  double length_deg = 0.0;   ///< on the sky
  double continuity = 0.0;   ///< of 1
  bool is_coloured = false;  ///< the picture's channels differ
  double excess[3] = {};     ///< of the light at the peak over that at the foot, in red, green and blue
  double line_share = 0.0;   ///< of the traced channel's excess
  double line_share_error = 0.0;
  double contrast = 0.0;       ///< of the excess, to the sky beneath
  double sharper_below = 0.0;  ///< 0 of a symmetric ridge, 1 of an edge, negative of one upside down
  double roughness_deg = 0.0;  ///< across the line
  double steepness_deg = 0.0;  ///< of the line against the horizontal
  bool is_seam = false, is_circle = false;  ///< along the pixels; about the zenith
  double beside_edge = 0.0;       ///< share of the points close above what is masked, along its course
  double left_without_air = 1.0;  ///< of the fall, if the air's dimming is taken off all light
  double in_milky_way = 0.0, near_moon = 0.0;  ///< shares of the points
};

/// Traces that chance gives.
struct BorderChance {
  int traces = 0;
  double mean_length_deg = 0.0;
};

/// The traced channel's light of the sky to the mean of the others': the median over the sky.
double colour_of_sky(const SkyCells& cells, const Photo& photo, const sim::Scene& scene,
                     const BorderSettings& settings);

/// Cuts a trace where light of lines goes over into a continuum's: an arc into a cloud beside it. The trace
/// itself in a grey picture.
std::vector<BorderTrace> parted_by_colour(const BorderTrace& trace, const SkyCells& cells, const Photo& photo,
                                          const sim::Scene& scene, const BorderSettings& settings,
                                          double sky_colour);

BorderEvidence border_evidence(const BorderTrace& trace, const SkyCells& cells, const Photo& photo,
                               const sim::Scene& scene, const BorderSettings& settings, double sky_colour);

/// Sets the trace's probability and its doubt.
void judge_border(BorderTrace& trace, const BorderEvidence& evidence, const BorderChance& chance,
                  const BorderSettings& settings);

}  // namespace vegard::fit
