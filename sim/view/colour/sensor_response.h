// What a sensor makes of light of one wavelength: the CIE 1931 observer, a camera's three channels, the
// channels of an imager behind narrow filters, or a grey one that counts photons of any wavelength alike.
//
// Sources: docs/optics.md, "Cameras". A camera's raw channels are scaled so that green is 1 for a
// kilorayleigh of 557.7 nm at unit gain, as the observer's luminance is. White balance and matrix lead from
// them to linear RGB; the matrix of the rule "colorimetric" is that which leads best, by least squares with
// white kept, from channels balanced to D65 to the primaries, for D65 light off 96 smooth reflectances:
// Gaussian bands around 400, 420 ... 700 nm with standard deviations of 15, 30 and 60 nm, and what they leave
// of white.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "sim/scene/structs/scene.h"
#include "sim/view/colour/matrix3.h"

namespace vegard::sim {

/// Red, green and blue response against wavelength, linear between the rows of a table and 0 outside.
struct ChannelTable {
  std::vector<double> wavelength_nm;            ///< increasing
  std::array<std::vector<double>, 3> response;  ///< per unit of energy

  Vector3 at(double nm) const;
};

class SensorResponse {
 public:
  /// Throws Error(unreadable_input) if the scene names a table with other columns than wavelength_nm, red,
  /// green, blue, with negative numbers, with wavelengths that do not increase, or without any green at 557.7
  /// nm, which sets the scale; Error(scene) if white balance and matrix together have no inverse.
  explicit SensorResponse(const Scene& scene);

  double first_nm() const { return first_nm_; }  ///< outside of these the response is 0
  double last_nm() const { return last_nm_; }

  /// Channels per unit of power: X, Y and Z, or raw red, green and blue on the scale of Y.
  Vector3 channels_of_power(double wavelength_nm) const;

  /// From those channels to the linear, signed RGB of the scene's pictures.
  const Matrix3& rgb_from_channels() const { return rgb_from_channels_; }

  /// White balance and matrix alone; the identity for the CIE observer and for grey.
  const Matrix3& rgb_from_raw() const { return rgb_from_raw_; }

  /// Linear, signed RGB of one kilorayleigh at a gain_per_kilorayleigh of 1.
  Vector3 rgb_per_kilorayleigh(double wavelength_nm) const;

 private:
  bool is_cie_, is_grey_;
  ChannelTable table_;  // of a camera
  double first_nm_ = 380.0, last_nm_ = 780.0;
  Matrix3 rgb_from_channels_, rgb_from_raw_ = kIdentity3;
};

/// Gains that make D65 light equal in all three channels, green kept as it is.
Vector3 daylight_balance(const ChannelTable& channels);

/// Linear RGB of the primaries from channels balanced to D65: the rule "colorimetric".
Matrix3 colorimetric_matrix(const ChannelTable& channels, Primaries primaries);

/// Whether the channels are those of an imager behind narrow filters, one per emission line:
/// sensor.response = "filters".
bool sees_through_filters(const Scene& scene);

/// Linear light per kilorayleigh of each of the scene's lines at a gain_per_kilorayleigh of 1: channel i has
/// 1 for line i and nothing for any other. Lines behind the third are seen by none.
std::vector<Vector3> filter_colours(const Scene& scene);

/// What the filters let through of other light: triangles around the lines' wavelengths, 5 nm wide at half
/// their height, which a spectrum in steps of 5 nm is summed under exactly. At the line itself a channel
/// gives 1 per kilorayleigh.
ChannelTable filter_channels(const Scene& scene);

}  // namespace vegard::sim
