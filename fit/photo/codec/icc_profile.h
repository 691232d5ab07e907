// ICC profiles, by LittleCMS: the curve and matrix of display profiles, the tables of others, and the matrix
// of any three primaries. The only interface to LittleCMS.
#pragma once

#include <optional>
#include <string_view>

#include "fit/photo/codec/declared_light.h"

namespace vegard::fit {

/// Largest profile that is read, in bytes.
constexpr std::size_t kMaxProfileBytes = std::size_t{1} << 24;

/// Takes what a profile of RGB or grey pictures says: curve and primaries, or a table. `is_grey`: of the
/// picture, of which a profile's curve alone counts. For a profile that cannot be applied, and for bytes that
/// are none, DeclaredLight::problem says why.
void declare_profile(std::string_view profile, bool is_grey, DeclaredLight& light);

/// Returns the matrix from these primaries to sRGB's, white to white, adapted by Bradford's method; none if
/// they span no triangle.
std::optional<ColourMatrix> matrix_to_srgb(const Chromaticities& chromaticities);

/// True for a matrix by which no code of 8 bits moves by more than half a step.
bool is_near_identity(const ColourMatrix& matrix);

}  // namespace vegard::fit
