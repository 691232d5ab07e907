// What a picture's file declares about its light: the transfer curve of its numbers and the primaries of its
// colours. One reader for all formats; fit/photo/photo.cpp applies what it finds.
//
// Sources: ICC.1:2022 profiles in JPEG (annex B.4), PNG (iCCP), TIFF (tag 34675) and HEIF (colr); PNG third
// edition, 11.3.2 (cICP before iCCP before sRGB before gAMA and cHRM); ITU-T H.273 for the numbers of cICP
// and colr; TIFF 6.0, section 20 (TransferFunction, WhitePoint, PrimaryChromaticities); EXIF 2.32 with
// DCF 2.0 (Adobe RGB as the interoperability index R03); the OpenEXR attribute chromaticities; FITS keywords
// of cameras (fit/photo/codec/sensor_mosaic.h).
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/view/sensor/tone_curve.h"

namespace vegard::fit {

/// CIE x and y of three primaries and of white.
struct Chromaticities {
  std::array<double, 2> red{}, green{}, blue{}, white{};
};

/// Linear red, green and blue of sRGB's primaries: row times the file's linear red, green and blue.
using ColourMatrix = std::array<std::array<double, 3>, 3>;

/// A profile of tables instead of a curve and a matrix: from encoded red, green and blue, white = 1, to
/// linear light of sRGB's primaries. May be used by several threads.
class LightTable {
 public:
  virtual ~LightTable() = default;
  virtual void to_light(const float* encoded, float* light, std::size_t pixels) const = 0;
  /// Light above which the file's steps are too coarse to measure: such pixels count as white.
  virtual float brightest() const { return std::numeric_limits<float>::infinity(); }
};

struct LightCurve {
  bool is_linear = false;
  std::shared_ptr<const sim::ToneCurve> tone;  ///< null: sRGB, or linear light
  std::string name;                            ///< "sRGB", "linear", "gamma 1.8"
};

struct DeclaredLight {
  std::vector<std::string> words;   ///< every declaration, for people: "PNG gAMA 0.45455"
  std::string source;               ///< the one that counts, "its PNG gAMA"; empty: none
  std::string problem;              ///< why it cannot be applied; empty: it can
  std::optional<LightCurve> curve;  ///< none: the format's usual one
  std::string primaries;            ///< their name, where they are not sRGB's
  std::optional<ColourMatrix> to_srgb;
  /// In place of curve and matrix. A curve beside it is of grey alone, and says how wide the file's steps
  /// are.
  std::shared_ptr<const LightTable> table;
  int converter_bits = 0;  ///< of the camera's converter, by FITS BITDEPTH or PNG sBIT; 0: not declared

  bool counts() const { return curve || to_srgb || table || !problem.empty(); }
};

}  // namespace vegard::fit
