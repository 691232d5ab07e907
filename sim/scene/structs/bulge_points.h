// How the bulge of a substorm divides the spline of a [[footprint]].
#pragma once

namespace vegard::sim {

/// A bulge moves new points of the spline: one after this many pieces of it, or after the length of its front
/// over kBulgePointsPerLength, of which no piece is longer.
inline constexpr int kBulgePiecesToPoint = 4;
inline constexpr double kBulgePointsPerLength = 8.0;

}  // namespace vegard::sim
