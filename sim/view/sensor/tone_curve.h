// Conversion of linear light to the values of a display file and back, by the scene's sensor.tone or the
// curve that is given for a photograph.
//
// "srgb" is IEC 61966-2-1, "gamma" a power, "file" a measured curve: a CSV with the columns linear, from 0 to
// 1, and encoded, within 0 to 1, both increasing; linear between its rows. "bent" is the family of curves
// BentSrgb.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "sim/base/image.h"

namespace vegard::sim {

struct Scene;

/// Returns the encoded value of linear light by the sRGB transfer curve, IEC 61966-2-1; 0 maps to 0 and 1
/// to 1. The curve continues above 1 and is odd about 0, so that it has an inverse everywhere:
/// srgb_decode(srgb_encode(x)) = x to 1e-7. NaN gives NaN. It uses pow() of the C library, whose last bit may
/// differ between CPUs, far below a step of 16 bits.
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

class ToneCurve {
 public:
  /// The curve of a valid scene. Throws Error(unreadable_input), with file and line, for an invalid table.
  explicit ToneCurve(const Scene& scene);

  /// Encoded values are linear light to the power of 1 / gamma; gamma must be above 0.
  static ToneCurve of_gamma(double gamma);
  /// A measured curve from the text of a table; messages name `file`. Throws as the constructor.
  static ToneCurve of_table(const std::string& text, const std::string& file);
  static ToneCurve of_bent(const BentSrgb& bent);
  /// Of grey by the tone "filmic", which mixes the channels of colours (sim/view/sensor/filmic_tone.h). Light
  /// of 1 is not yet white.
  static ToneCurve filmic();

  /// Returns the encoded value of linear light, both 0 to 1; "file" clamps its input. An increasing function.
  double encode(double linear) const;

  /// The inverse of encode(). Values beyond the ends of a measured curve are clamped to the ends.
  double decode(double encoded) const;

  /// "sRGB", "linear", "gamma 2.2", "my_camera.csv", "sRGB^1.3", "sRGB^1.3 to 0.8", "filmic".
  const std::string& name() const { return name_; }

 private:
  ToneCurve() = default;
  void be_gamma(double gamma);
  void be_table(const std::string& text, const std::string& file);

  enum class Kind { srgb, linear, gamma, file, bent, filmic } kind_ = Kind::linear;
  double gamma_ = 1.0;
  BentSrgb bent_;
  std::vector<double> linear_, encoded_;
  std::string name_;
};

/// A lookup table for a tone curve: converts linear light to the value of an 8-bit picture, encoded by the
/// curve, clamped to 0 to 1 and rounded to the nearest step, without a pow() per pixel.
class DisplayTable {
 public:
  explicit DisplayTable(const ToneCurve& tone);

  std::uint8_t operator()(float light) const {
    if (!(light > 0.0f)) return least_[0];
    if (light >= 1.0f) return white_;
    int number = least_[static_cast<int>(light * kCells)];
    while (light >= first_[number + 1]) ++number;
    return static_cast<std::uint8_t>(number);
  }

  /// Returns the values of an image, [row][column][channel].
  std::vector<std::uint8_t> bytes(const Image& light, int threads) const;

 private:
  static constexpr int kCells = 4096;
  std::array<float, 257> first_;            ///< the smallest light with at least this value
  std::array<std::uint8_t, kCells> least_;  ///< value at the lower end of each interval of 1 / kCells
  std::uint8_t white_;
};

}  // namespace vegard::sim
