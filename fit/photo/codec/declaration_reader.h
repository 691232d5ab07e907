// Reads what a file declares about its light (declared_light.h) out of its bytes.
#pragma once

#include <optional>
#include <string_view>

#include "fit/photo/codec/declared_light.h"

namespace vegard::fit {

/// Reads the declarations of a picture's file of any format from its bytes, or from their beginning, as far
/// as it reaches. Does not look at pixels. Not for camera raw files, whose directories
/// are of other pictures. Never throws.
DeclaredLight declared_light(std::string_view bytes);

/// Returns the primaries of a number of ITU-T H.273, table 2; none for one that is unspecified or reserved.
std::optional<Chromaticities> primaries_of_h273(int primaries);

/// Sets primaries and matrix, unless the primaries are sRGB's to a thousandth. Sets `problem` where they span
/// no triangle.
void declare_primaries(const Chromaticities& chromaticities, DeclaredLight& light);

}  // namespace vegard::fit
