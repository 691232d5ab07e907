// The sRGB transfer curve, IEC 61966-2-1: linear light to the values of an 8-bit picture and back.
#pragma once

namespace vegard::sim {

/// Encoded value of linear light. 0 to 0, 1 to 1; beyond both ends the curve goes on, and odd about 0, so
/// that it has an inverse everywhere: srgb_decode(srgb_encode(x)) = x to 1e-7. NaN gives NaN. The power is
/// the C library's: between CPUs its last bit may differ, far below a step of 16 bits.
double srgb_encode(double linear);

/// Linear light of an encoded value.
double srgb_decode(double encoded);

// A family of curves about sRGB with two numbers, for pictures of which nobody knows how they were encoded.
//
// Light of an encoded value v:  L(v) = D(v)^p exp((q - p) k (v - 1)), with sRGB's decoding D and
// k = D'(1) = 2.4 / 1.055, so that L(1) = 1. Its slope against sRGB in logarithms,
//   d ln L / d ln D = p + (q - p) (v + 0.055) / 1.055   (above sRGB's knee; p below it, to a fortieth),
// is a straight line in v from p at black to q at white: L increases everywhere just if p and q are above 0.
// p = q is a power of sRGB's light, p = q = 1 sRGB itself. An exponent that depends linearly on the value is
// the simplest curve of Ng, Chang and Tsui's generalised gamma (CVPR 2007); that a few numbers are enough for
// the responses of real cameras and films is what Grossberg and Nayar (CVPR 2003, "What is the space of
// camera response functions?") found of two hundred of them.

/// Exponents over sRGB's light, above 0.
struct BentSrgb {
  double black = 1.0, white = 1.0;

  /// Linear light of an encoded value, 0 to 0 and 1 to 1, odd about 0.
  double decode(double encoded) const;

  /// Its inverse, to 1e-12 of the encoded value.
  double encode(double linear) const;

  /// d decode / d encoded, of an encoded value above 0.
  double slope(double encoded) const;
};

}  // namespace vegard::sim
