// Calibrates a camera by stars, or by points of maps that count as stars: chooses and fits its lens, with
// error bars and the residuals of every star.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "fit/photo/pointing/lens_choice.h"
#include "fit/photo/pointing/sky_camera.h"
#include "sim/scene/table/parameter_table.h"

namespace vegard::fit {

/// A number in a scene's [camera] and its standard deviation by least squares, with the noise that the
/// residuals show.
struct CameraEstimate {
  sim::ParameterId id;  ///< which of the camera's numbers
  double value = 0.0;
  double sigma = 0.0;
  bool free = false;  ///< false: it was held fixed, and sigma is meaningless

  const std::string& key() const { return id.row->key; }  ///< "azimuth_deg"
  const std::string& unit() const { return id.row->unit; }
};

struct StarResidual {
  double dx_px = 0.0, dy_px = 0.0;                  ///< observed minus computed
  double without_dx_px = 0.0, without_dy_px = 0.0;  ///< the residual of a fit without this star
  /// The same without all stars of its ninth of the picture ; NaN: the others are too few.
  double without_region_dx_px = 0.0, without_region_dy_px = 0.0;
  double off_axis_deg = 0.0;
  double from_centre_px = 0.0;
  bool used = false;
};

/// What the stars of a calibration are.
enum class CalibrationEvidence { stars, maps };

/// Returns "stars" or "points of the maps".
const char* words_of(CalibrationEvidence evidence);

/// How well a camera agrees with all pixels of maps.
struct MapAgreement {
  int pixels = 0;         ///< number of pixels with a direction of which the lens has an image
  int without_image = 0;  ///< number of pixels with another direction
  double rms_px = 0.0;    ///< sqrt(sum (dx^2 + dy^2) / pixels)
  double largest_px = 0.0;
  int largest_x = 0, largest_y = 0;  ///< the pixel of the largest distance, columns and rows from 0
};

/// Returns "all 3000 pixels: rms 0.01 px, the largest 0.04 px at (12, 300)".
std::string words_of(const MapAgreement& agreement);

/// How many of a picture's points of light are stars.
struct ExplainedPoints {
  int points = 0, stars = 0;
  double by_chance = 0.0;  ///< expected number of those stars that are none
  double faintest = 0.0;   ///< limiting magnitude of the catalogue
};

struct Calibration {
  SkyCamera camera;
  Frame frame;
  LensForm form;
  std::vector<LensCandidate> candidates;
  int chosen = 0;
  std::vector<StarSighting> stars;
  std::vector<StarResidual> residuals;  ///< of every star
  double rms_px = 0.0;                  ///< sqrt(sum (dx^2 + dy^2) / N) over the stars in use
  /// The same of the residuals of fits without each star; for maps, for which these are not made, rms_px.
  double without_rms_px = 0.0;
  double sigma_px = 0.0;  ///< standard deviation of one coordinate: sqrt(sum / (2 N - k))
  CalibrationEvidence evidence = CalibrationEvidence::stars;
  std::optional<MapAgreement> maps;          ///< for a calibration by maps
  std::optional<ExplainedPoints> explained;  ///< if the picture is known, with time and site
  Pointing pointing;
  std::vector<CameraEstimate> estimates;
  Eigen::MatrixXd correlation;           ///< correlations of the free estimates, in their order
  double line_of_sight_sigma_deg = 0.0;  ///< standard deviation of the axis's direction along the larger of
                                         ///< its error ellipse's axes; 0 if it was held fixed
  double twist_sigma_deg = 0.0;          ///< standard deviation of the turn about the axis
  double horizon_elevation_deg = 0.0;    ///< of the observer, above which the sky is
  std::array<bool, lens_numbers> is_free{};  ///< by LensNumber: it was fitted
  Eigen::MatrixXd number_roots;              ///< R with a row for each LensNumber: their covariance is R R'
  std::vector<std::string> warnings;         ///< numbers that the stars hardly distinguish, and the like

  int used() const;
};

/// Sets what follows from the camera, the stars and those of them that are used: the pointing, the residuals
/// (those of fits without stars likewise, until they are made) and their rms.
void set_residuals(Calibration& calibration, const StarSet& used);

/// Returns R with (J' J)^-1 = R R', for a Jacobian J whose columns are independent.
Eigen::MatrixXd root_of_inverse(const Eigen::MatrixXd& jacobian);

/// Sets the numbers of the scene with error bars and correlations, by sigma_px and by `unit_roots`
/// (number_roots of residuals of 1 px); `free`: the numbers that were fitted.
void set_errors(Calibration& calibration, const Eigen::MatrixXd& unit_roots,
                const std::vector<LensNumber>& free);

/// Appends the warnings that follow from the numbers.
void set_warnings(Calibration& calibration);

/// Calibrates a camera. For maps, no fits without each point are made. Throws sim::Error(unreadable_input)
/// about the file `name` if there are too few stars, if all are in one point or on one line of the picture or
/// of the sky, or if no lens maps them to where they were seen.
Calibration calibrate(const LensSettings& settings, const std::vector<StarSighting>& stars,
                      const Frame& frame, const std::string& name,
                      CalibrationEvidence evidence = CalibrationEvidence::stars);

/// Adds the error of the time at which the stars stood in these directions: it turns the camera by `turn_deg`
/// about the celestial pole, whose altitude is the latitude. All standard errors and correlations contain it
/// then. Nothing changes if the rotation was held fixed.
void add_time_error(Calibration& calibration, double latitude_deg, double turn_deg);

}  // namespace vegard::fit
