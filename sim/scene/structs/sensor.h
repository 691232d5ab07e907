// [sensor]: how light becomes the numbers of a file.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace vegard::sim {

enum class Primaries { srgb, smpte_c, rec2020, acescg };

/// Whether a table of a colour response is per energy or per photon.
enum class ResponsePer { energy, photon };

enum class WhiteBalanceRule {
  given,
  daylight  ///< D65 becomes neutral
};

/// The matrix from a camera's channels to the primaries.
enum class MatrixRule {
  none,          ///< identity
  colorimetric,  ///< least squares
  given
};

/// The origin of the gain from light to numbers.
enum class ExposureRule {
  gain,   ///< Sensor::gain_per_kilorayleigh
  camera  ///< from lens, pixel, exposure time and ISO
};

/// Colour filters of the upper left two by two pixels, row by row; none: all colours in every pixel.
enum class MosaicPattern { rggb, bggr, grbg, gbrg, none };

enum class ToneKind {
  srgb,
  linear,
  gamma,
  file,
  filmic  ///< sRGB after a roll-off of bright light that keeps its hue (sim/view/sensor/filmic_tone.h)
};

/// How light becomes the numbers of a file (sim/view/sensor/sensor.h). The mosaic, bits, black_level, read
/// noise and dark current only affect renders with noise.
struct Sensor {
  Primaries primaries = Primaries::srgb;
  std::string response = "cie";  ///< the CIE 1931 observer, a built-in camera, or a table "FILE.csv"
  ResponsePer response_per = ResponsePer::energy;
  std::array<double, 3> white_balance{1.0, 1.0, 1.0};  ///< gains of a camera's raw channels
  WhiteBalanceRule white_balance_rule = WhiteBalanceRule::given;
  MatrixRule matrix_rule = MatrixRule::none;
  std::array<double, 9> matrix{1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};  ///< if given, row-major
  double gain_per_kilorayleigh =
      0.05;  ///< linear sensor value (white = 1) of the luminance of 1 kR of 557.7 nm
  ExposureRule exposure = ExposureRule::gain;
  // From here to the bits: ESTIMATED, a full-frame camera of about 2015 to a factor of two; data sheets by
  // EMVA 1288 give a camera's own.
  double f_number = 2.0;
  double lens_transmission = 0.85;
  double pixel_um = 6.0;             ///< edge of a square pixel
  double quantum_efficiency = 0.45;  ///< electrons per photon of 557.7 nm that reaches a green pixel
  double full_well_e = 50000.0;      ///< full well of a pixel; equals white at base_iso
  double iso = 1600.0;               ///< white is full_well_e base_iso / iso electrons
  double base_iso = 100.0;
  double read_noise_e = 3.0;  ///< standard deviation
  double dark_e_s = 0.1;      ///< dark current of a pixel
  double black_level = 0.03;  ///< number without light, fraction of the largest digital number
  int bits = 14;              ///< of the analogue-digital converter
  MosaicPattern mosaic = MosaicPattern::rggb;
  double vignetting_cos_power = 0.0;                ///< power of cos(angle off the axis); 4: simple lens
  std::array<double, 3> vignetting{0.0, 0.0, 0.0};  ///< terms of r^2, r^4, r^6, r = 1 in the corners
  ToneKind tone = ToneKind::srgb;
  double gamma = 2.2;
  std::string tone_file;              ///< CSV of linear and encoded values, relative to the scene's file
  std::string colour_table = "none";  ///< false colours of display files, by name or file
  double calibration_error = 0.0;     ///< relative error of the absolute scale; 0: not calibrated
};

enum class ResponseKind {
  cie,      ///< "cie", the CIE 1931 observer
  filters,  ///< "filters", a narrow filter per line
  grey,     ///< "grey", the same response to every photon
  measured  ///< anything else: a camera or a table
};
ResponseKind response_kind(const std::string& response);

/// Returns the names of the built-in cameras; each has a table data/cameras/NAME.csv.
const std::vector<std::string>& built_in_cameras();

}  // namespace vegard::sim
