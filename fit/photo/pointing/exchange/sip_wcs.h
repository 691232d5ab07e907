// Reads and writes Astrometry.net's solution of a picture (`.wcs`): a tangent plane on the sky with SIP
// polynomials (M. R. Calabretta and E. W. Greisen, Astronomy and Astrophysics 395, 1077, 2002: TAN; D. L.
// Shupe et al., "The SIP convention for representing distortion in FITS image headers", ASP Conf. Ser. 347,
// 491, 2005).
//
// With (u, v), the pixel less CRPIX, the plane's coordinates in degrees are CD (u + A(u, v), v + B(u, v)),
// where A and B are sums of A_p_q u^p v^q; AP and BP are for the inverse. Pixels are those of a JPEG or PNG:
// rows from the top, the centre of the first at (1, 1) in the file and (0.5, 0.5) here.
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "sim/view/camera/direction_map.h"
#include "sim/view/sky/star_place.h"

namespace vegard::fit {

/// A polynomial of two variables; without terms it is 0.
struct SipPolynomial {
  int order = 0;
  std::vector<double> terms;  ///< coefficient of u^p v^q at [p * (order + 1) + q]; 0 if p + q > order

  double at(double u, double v) const;
};

struct SipWcs {
  int width_px = 0, height_px = 0;                               ///< the picture's size; 0: unknown
  Eigen::Vector2d reference_px = Eigen::Vector2d::Zero();        ///< CRPIX as in the file
  sim::Equatorial reference;                                     ///< CRVAL, J2000
  Eigen::Matrix2d degrees_per_px = Eigen::Matrix2d::Identity();  ///< CD
  SipPolynomial a, b, ap, bp;
};

/// Returns the direction (J2000) of a place in the picture as a vector of length 1: x to the vernal equinox,
/// z to the north pole.
Eigen::Vector3d sky_of_pixel(const SipWcs& wcs, double x_px, double y_px);

/// Reads a header. Throws sim::Error(unreadable_input) for another projection, a header without a CD matrix,
/// orders above 9, or another equinox than 2000.
SipWcs read_sip_wcs(std::string_view bytes, const std::string& file);

/// Returns a header without an image, as solve-field writes it, with `words` in the keyword VEGARD.
std::string encode_sip_wcs(const SipWcs& wcs, const std::string& words, const std::string& name = {});

/// Returns azimuth and elevation, as seen, of the picture's pixels from a place at a time; none below the
/// horizon (sim::horizon_elevation_deg()). The size must be known.
sim::DirectionMap directions_of_wcs(const SipWcs& wcs, const sim::Observer& observer, double julian_date);

/// Returns the catalogue's direction (J2000) of what is seen in a direction: the inverse of
/// sim::direction_of_star() for stars without proper motion, to 1e-10. `enu`: of length 1, above the horizon.
Eigen::Vector3d j2000_of_direction(const Eigen::Vector3d& enu, const sim::Observer& observer,
                                   double julian_date);

/// The approximation of a camera by such a solution.
struct SipFit {
  SipWcs wcs;
  int points = 0;                         ///< number of the points of a grid to which it was fitted
  double rms_px = 0.0, largest_px = 0.0;  ///< distances between the camera's and the solution's directions
  double share = 0.0;  ///< share of the picture's pixels within reach and above the horizon
};

/// Fits a solution to the places of the picture that look above the horizon and at most `reach_deg` away from
/// its middle, with the lowest order of SIP up to 9 that has at most 0.02 px rms, or that with the smallest
/// residuals. Throws sim::Error(scene) if the picture's middle has no direction or looks below the horizon,
/// or if too little is within reach.
SipFit sip_of_camera(const sim::Camera& camera, const sim::Observer& observer, double julian_date,
                     double reach_deg);

}  // namespace vegard::fit
