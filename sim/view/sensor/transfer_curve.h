// The sRGB transfer curve, IEC 61966-2-1, and a family of similar curves.
#pragma once

namespace vegard::sim {

/// Returns the encoded value of linear light; 0 maps to 0 and 1 to 1. The curve continues above 1 and is odd
/// about 0, so that it has an inverse everywhere: srgb_decode(srgb_encode(x)) = x to 1e-7. NaN gives NaN. It
/// uses pow() of the C library, whose last bit may differ between CPUs, far below a step of 16 bits.
double srgb_encode(double linear);

/// The inverse of srgb_encode().
double srgb_decode(double encoded);

// BentSrgb: a family of curves around sRGB with two parameters, for pictures with an unknown encoding.
//
// Light of an encoded value v:  L(v) = D(v)^p exp((q - p) k (v - 1)), with sRGB's decoding D and k = D'(1) =
// 2.4 / 1.055, so that L(1) = 1. Its slope against sRGB in logarithms,
//   d ln L / d ln D = p + (q - p) (v + 0.055) / 1.055   (above sRGB's knee; p below it, to a fortieth),
// is a straight line in v from p at black to q at white: L increases everywhere if and only if p and q are
// above 0. p = q is a power of sRGB's light, p = q = 1 is sRGB itself. An exponent that depends linearly on
// the value is the simplest case of the generalised gamma of Ng, Chang and Tsui (CVPR 2007). Grossberg and
// Nayar (CVPR 2003, "What is the space of camera response functions?") found for two hundred cameras and
// films that a few numbers are enough to describe their responses.

/// The exponents p (black) and q (white), above 0.
struct BentSrgb {
  double black = 1.0, white = 1.0;

  /// Returns the linear light of an encoded value; 0 maps to 0 and 1 to 1; odd about 0.
  double decode(double encoded) const;

  /// The inverse of decode(), to 1e-12 of the encoded value.
  double encode(double linear) const;

  /// Returns the derivative of decode() at an encoded value above 0.
  double slope(double encoded) const;
};

}  // namespace vegard::sim
