// The photograph with the traces of borders: those that are claimed in colours, the others in grey.
#pragma once

#include <string>

#include "fit/border/border.h"
#include "fit/photo/photo.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// As many claimed traces have a colour of their own, and are named beside the picture.
inline constexpr std::size_t kNamedTraces = 6;

/// The colour in CSS of a claimed trace, by its place among the claimed ones with a measured border; those
/// after the named ones share one.
std::string trace_colour(std::size_t claimed);
/// The colour of traces that are not claimed.
std::string unclaimed_colour();

/// An SVG of the photograph alone, with numbers at the claimed traces, as wide as a page. The same border
/// gives the same bytes.
std::string traces_svg(const Border& border, const Photo& photo, const sim::Scene& scene);

}  // namespace vegard::fit
