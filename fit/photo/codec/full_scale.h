// The number at which a camera's converter is full, where that is below the largest that a file's integers
// can hold: 4095 of twelve bits in a file of sixteen.
#pragma once

#include "fit/photo/codec/picture_codes.h"

namespace vegard::fit {

/// Marks pixels at the full scale of the converter as unusable, in a picture of more than eight bits, before
/// demosaicing. `bits`: of the converter, as the file declares them (FITS BITDEPTH, PNG sBIT); 0: it does
/// not. Its numbers may stand in the lower bits, or shifted up to the highest; declared bits that fit neither
/// count for nothing. Of an undeclared converter the picture itself shows the plateau: its largest number is
/// 2^n - 1, n from 10 on, or that shifted, and more pixels, two at least, have it than the number before.
///
/// For declared bits in the lower bits of `codes` of linear light, `codes.white` becomes the full scale.
void mark_full_scale(int bits, PictureCodes& codes);

}  // namespace vegard::fit
