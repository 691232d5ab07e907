// The response of a sensor to light of one wavelength: the CIE 1931 observer, a camera's three channels, an
// imager with narrow filters, or a grey sensor that counts photons of any wavelength equally.
//
// Sources: docs/optics.md, "Cameras". A camera's raw channels are scaled so that green is 1 for a
// kilorayleigh of 557.7 nm at unit gain, as the observer's luminance is. White balance and matrix convert
// them to linear RGB. The matrix of the rule "colorimetric" is the least-squares fit, with white preserved,
// from channels balanced to D65 to the primaries, for D65 light reflected by 96 smooth reflectances: Gaussian
// bands around 400, 420 ... 700 nm with standard deviations of 15, 30 and 60 nm, and their complements to
// white.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "sim/scene/structs/sensor.h"
#include "sim/view/colour/matrix3.h"

namespace vegard::sim {

struct Scene;

/// Red, green and blue response as a function of wavelength, linear between the rows of a table and 0
/// outside.
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

  double first_nm() const { return first_nm_; }  ///< the response is 0 below first_nm() and above last_nm()
  double last_nm() const { return last_nm_; }

  /// Returns the channels per unit of power: X, Y and Z, or raw red, green and blue on the scale of Y.
  Vector3 channels_of_power(double wavelength_nm) const;

  /// Returns the matrix from those channels to the linear, signed RGB of the scene's pictures.
  const Matrix3& rgb_from_channels() const { return rgb_from_channels_; }

  /// Returns white balance and matrix alone; the identity for the CIE observer and for grey.
  const Matrix3& rgb_from_raw() const { return rgb_from_raw_; }

  /// Returns linear, signed RGB of one kilorayleigh at a gain_per_kilorayleigh of 1.
  Vector3 rgb_per_kilorayleigh(double wavelength_nm) const;

 private:
  bool is_cie_, is_grey_;
  ChannelTable table_;  // of a camera
  double first_nm_ = 380.0, last_nm_ = 780.0;
  Matrix3 rgb_from_channels_, rgb_from_raw_ = kIdentity3;
};

/// Returns the gains that make D65 light equal in all three channels; the gain of green is 1.
Vector3 daylight_balance(const ChannelTable& channels);

/// Returns the matrix of the rule "colorimetric", from channels balanced to D65 to linear RGB of the
/// primaries.
Matrix3 colorimetric_matrix(const ChannelTable& channels, Primaries primaries);

/// True if the channels are those of an imager with narrow filters, one per emission line:
/// sensor.response = "filters".
bool sees_through_filters(const Scene& scene);

/// Returns linear light per kilorayleigh of each of the scene's lines at a gain_per_kilorayleigh of 1:
/// channel i has 1 for line i and 0 for any other. Lines after the third are in no channel.
std::vector<Vector3> filter_colours(const Scene& scene);

/// Returns the response of the filters to other light: triangles around the lines' wavelengths with a full
/// width at half maximum of 5 nm, for which the sum of a spectrum in steps of 5 nm is exact. At its line, a
/// channel has 1 per kilorayleigh.
ChannelTable filter_channels(const Scene& scene);

// The spectral resolution of three broad channels: the narrowest window around a wavelength that a weighted
// sum of the channels can make.
//
// Sources: Backus and Gilbert 1970, doi:10.1098/rsta.1970.0005: the weights that minimise the spread 12
// integral (l - l0)^2 K(l)^2 dl of a kernel K = sum of weights times responses with the integral 1 (a box of
// width w around l0 has the spread w). Jackel et al. 2014, doi:10.5194/gi-3-71-2014, did this for colour
// CCDs.

struct ResolvingKernel {
  Vector3 weights{};       ///< of the channels, each scaled to an integral of 1 nm over wavelength, nm^-1
  double spread_nm = 0.0;  ///< spread of Backus and Gilbert
  double peak_nm = 0.0;    ///< wavelength of the kernel's maximum
  double fwhm_nm = 0.0;    ///< full width at half maximum
};

/// Returns the kernel for channels that count photons: response per photon, on a grid of 1 nm.
ResolvingKernel resolving_kernel(const SensorResponse& response, double wavelength_nm);

}  // namespace vegard::sim
