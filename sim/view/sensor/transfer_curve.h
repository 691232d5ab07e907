// The sRGB transfer curve, IEC 61966-2-1: linear light to the values of an 8-bit picture and back.
#pragma once

namespace vegard::sim {

/// Encoded value of linear light. 0 to 0, 1 to 1; beyond both ends the curve goes on, and odd about 0, so
/// that it has an inverse everywhere: srgb_decode(srgb_encode(x)) = x to 1e-7. NaN gives NaN. The power is
/// the C library's: between CPUs its last bit may differ, far below a step of 16 bits.
double srgb_encode(double linear);

/// Linear light of an encoded value.
double srgb_decode(double encoded);

}  // namespace vegard::sim
