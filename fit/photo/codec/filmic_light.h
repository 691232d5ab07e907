// Pictures that vegard has rendered with sensor.tone = "filmic" (sim/view/sensor/filmic_tone.h), which say so
// as "encoding=filmic, primaries srgb" in their description, or as the text "vegard:encoding" of a PNG. What
// declares light of its own in such a file (a PNG's sRGB) is of the numbers after the roll-off.
#pragma once

#include <string_view>

#include "fit/photo/codec/declared_light.h"

namespace vegard::fit {

/// Returns what stands behind "encoding=" in the lines of a description; empty if nothing does.
std::string_view filmic_words(std::string_view description);

/// Declares the light of a picture that says "filmic, primaries NAME", before all else; nothing for other
/// words.
void declare_filmic(std::string_view words, DeclaredLight& light);

}  // namespace vegard::fit
