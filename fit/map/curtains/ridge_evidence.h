// Whether a ridge of a map is a curtain: pieces of one course joined, chance ridges told from real ones, and
// diffuse patches told from curtains. None of it knows of photographs.
#pragma once

#include <functional>
#include <vector>

#include "sim/base/number/vec3.h"

namespace vegard::fit {

using RidgeLine = std::vector<sim::EastNorth>;

/// Cuts lines at sharp corners, where they may have gone on into a branch, and joins those that go on in each
/// other's course: from the end of one to the end of the other it is at most `kJoinedGap` times the
/// resolution there (or a third of the shorter one's length, if that is more), and the directions of both
/// ends and of the way between agree. The nearest ends are joined first. Lines keep the order of the first of
/// their pieces.
inline constexpr double kJoinedGap = 3.0;
std::vector<RidgeLine> joined_lines(std::vector<RidgeLine> lines,
                                    const std::function<double(sim::EastNorth)>& resolution_km);

/// Cuts the ends that turn from the line's course towards the line of sight of the only camera, at the
/// origin, and follow it over less than the resolution in that direction: so little the picture does not
/// tell, and they are no evidence of a bend. A line that is nothing else has no points then.
RidgeLine without_ends_along_sight(const RidgeLine& line,
                                   const std::function<double(sim::EastNorth)>& along_sight_km);

/// Returns the probability that a ridge of this mean height is none that errors make. `null_heights` are the
/// heights along the same course in maps of errors alone, [map][point]; `pieces` is how many independent
/// pieces the course has, `places` how many such courses the map has room for, in each of which chance might
/// have made a ridge. It is exp(-places Q), where Q is the tail of Student's distribution. NaN without null
/// heights.
double ridge_probability(double mean_height, const std::vector<std::vector<double>>& null_heights,
                         double pieces, double places);

/// Whether a ridge as wide as this (full width at half of its height) is a diffuse patch: it is wide against
/// what the map resolves there, and not long against its width.
bool is_diffuse_patch(double width_km, double length_km, double resolution_km);

}  // namespace vegard::fit
