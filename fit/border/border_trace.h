// What the tracing of borders takes and gives: settings, points, traces (fit/border/border.h).
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace vegard::fit {

struct BorderSettings {
  int channel = 1;  ///< of Photo::linear; 1 is green, with oxygen's 557.7 nm (a grey picture has any)
  double azimuth_step_deg = 1.0;
  double lowest_elevation_deg = 1.0;    ///< of the light that is looked at: the sky beneath a border counts
  double lowest_measured_deg = 2.0;     ///< of a border
  double highest_elevation_deg = 75.0;  ///< above it an arc is seen from below and has no visible lower edge
  double min_signal = 8.0;              ///< of a peak above its foot, in standard deviations
  double min_contrast = 0.05;           ///< of a peak above its foot, of the brightness there
  double widest_fall_deg = 8.0;  ///< from 75 to 25 % of the peak; a wider fall is a diffuse glow, no border
  double max_jump_deg = 2.0;     ///< between neighbouring columns, off a straight line
  double longest_gap_deg = 4.0;
  double min_length_deg = 8.0;
  std::function<void(double share)> progress;  ///< told the share of the work that is done, from any thread
};

/// Why no border is given where there is a peak.
enum class BorderLimit {
  none,  ///< the border is given
  horizon,
  frame,   ///< it lies beyond the picture or the lens
  mask,    ///< it lies under the mask, or the picture is clipped there
  ground,  ///< the light ends at an edge as sharp as the picture allows, with less light below than any sky
           ///< has
};

/// "the horizon"
const char* border_limit_name(BorderLimit limit);

/// A trace is claimed to be a border of aurora from this probability on.
inline constexpr double kClaimedProbability = 0.9;

struct BorderPoint {
  double azimuth_deg = 0.0;    ///< 0 to 360
  double elevation_deg = 0.0;  ///< of the border, apparent; NaN if it is not given
  /// Combines noise, an error of the level by a tenth of the peak, what is not known of the air's dimming and
  /// refraction, and the scatter of the neighbours.
  double elevation_error_deg = 0.0;
  double peak_elevation_deg = 0.0;
  double brightness = 0.0;  ///< of the peak above the sky beneath, linear light, the file's white = 1
  double signal = 0.0;      ///< the brightness in standard deviations
  double fall_deg = 0.0;    ///< from 75 to 25 % of the peak; NaN if the border is not given
  BorderLimit limit = BorderLimit::none;

  bool measured() const { return limit == BorderLimit::none; }
};

/// Points of one border in the order of azimuth, which may pass through north: 358, 359, 0, 1.
struct BorderTrace {
  std::vector<BorderPoint> points;
  int measured = 0;                 ///< number of points with a measured border
  double aurora_probability = 1.0;  ///< that it is the border of aurora, and not of something else
  double cut_peaks = 0.0;           ///< share of the measured points whose peak is clipped or hidden
  std::string doubt;                ///< what else it may be, in a few words; empty where it is claimed

  double mean_brightness() const;
  bool is_claimed() const { return aurora_probability >= kClaimedProbability; }
};

}  // namespace vegard::fit
