// A camera from stars: its lens chosen and fitted, with error bars and the residuals of every star.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "fit/star_calibration/lens_choice.h"
#include "fit/star_calibration/pointing.h"

namespace vegard::fit {

/// A number in a scene's [camera] and its standard deviation: least squares with the noise that the residuals
/// show.
struct CameraEstimate {
  std::string key;  ///< "azimuth_deg"
  std::string unit;
  double value = 0.0;
  double sigma = 0.0;
  bool free = false;  ///< else it was held and sigma means nothing
};

struct StarResidual {
  double dx_px = 0.0, dy_px = 0.0;                  ///< seen minus computed
  double without_dx_px = 0.0, without_dy_px = 0.0;  ///< the same by a fit without this star
  double off_axis_deg = 0.0;
  double from_centre_px = 0.0;
  bool used = false;
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
  double without_rms_px = 0.0;          ///< the same of the residuals of fits without each star
  double sigma_px = 0.0;                ///< of one coordinate: sqrt(sum / (2 N - k))
  Pointing pointing;
  std::vector<CameraEstimate> estimates;
  Eigen::MatrixXd correlation;           ///< of the free estimates, in their order
  double line_of_sight_sigma_deg = 0.0;  ///< of the axis's direction, the larger of two; 0 if it was held
  double twist_sigma_deg = 0.0;          ///< about the axis
  std::vector<std::string> warnings;     ///< numbers that the stars hardly tell apart, and the like

  int used() const;
};

/// Throws sim::Error(unreadable_input), about the file `name`, if there are too few stars, all in one point
/// or on one line of the picture or of the sky, or if no lens brings them together.
Calibration calibrate(const LensSettings& settings, const std::vector<StarSighting>& stars,
                      const Frame& frame, const std::string& name);

}  // namespace vegard::fit
