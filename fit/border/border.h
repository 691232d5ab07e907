// Traces the lower border of the light along azimuth in a photograph of any lens, without a model of
// electrons.
//
// The picture is averaged over cells of azimuth and elevation. A smooth lower envelope is taken as the sky.
// In each column of equal azimuth, every local maximum of light that exceeds noise and sky gives a peak. Its
// border is the elevation below it at which the light, above the sky just beneath, has fallen to half of the
// peak: the convention of `lower_border_km` (docs/map.md). These points are linked from column to column.
// Directions are those of the camera's pixels: apparent ones, with refraction, if the camera was calibrated
// with stars. Blurring and averaging are symmetric about an edge, so they do not shift it.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "fit/photo/photo.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

struct BorderSettings {
  int channel = 1;  ///< of Photo::linear; 1 is green, with oxygen's 557.7 nm (a grey picture has any)
  double azimuth_step_deg = 1.0;
  double lowest_elevation_deg = 2.0;
  /// Below this elevation the air dims a bright sky so fast that this looks like a border.
  double lowest_measured_deg = 6.0;
  double highest_elevation_deg = 75.0;  ///< above it an arc is seen from below and has no visible lower edge
  double min_signal = 8.0;              ///< of a peak above its foot, in standard deviations
  double min_contrast = 0.05;           ///< of a peak above its foot, of the brightness there
  double widest_fall_deg = 8.0;  ///< from 75 to 25 % of the peak; a wider fall is a diffuse glow, no border
  double max_jump_deg = 2.0;     ///< between neighbouring columns, off a straight line
  double longest_gap_deg = 4.0;
  double min_length_deg = 8.0;
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

struct BorderPoint {
  double azimuth_deg = 0.0;          ///< 0 to 360
  double elevation_deg = 0.0;        ///< of the border, apparent; NaN if it is not given
  double elevation_error_deg = 0.0;  ///< combines noise, an error of the level by a tenth of the peak, and
                                     ///< the scatter of the neighbours
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
  int measured = 0;  ///< number of points with a measured border

  double mean_brightness() const;
};

/// Means of the picture over azimuth and elevation.
struct SkyCells {
  int columns = 0, rows = 0;  ///< columns by azimuth from north, rows upwards
  double azimuth_step_deg = 1.0, lowest_deg = 0.0, elevation_step_deg = 1.0;
  std::vector<double> light;       ///< [column * rows + row]; NaN where nothing usable is
  std::vector<BorderLimit> limit;  ///< the reason; BorderLimit::none where there is light

  std::size_t index(int column, int row) const { return static_cast<std::size_t>(column) * rows + row; }
  double azimuth_deg(int column) const { return column * azimuth_step_deg; }
  double elevation_deg(double row) const { return lowest_deg + (row + 0.5) * elevation_step_deg; }
};

struct Border {
  std::vector<BorderTrace> traces;  ///< long ones first, both kinds by brightness
  int measured = 0;                 ///< how many of the traces have a border over min_length_deg
  std::vector<std::string> notes;   ///< sentences about the answer
  SkyCells cells;
};

/// Averages the picture over cells of azimuth and elevation.
SkyCells sky_cells(const Photo& photo, const sim::Camera& camera, const BorderSettings& settings);

/// Traces the borders. The scene's camera and site must be those of the photograph. Throws sim::Error(scene)
/// if the picture has another size than the camera, or the observer is not below the light. If there is no
/// light or no border, this is not an error: `measured` is 0 and the notes tell why. The same input gives the
/// same answer.
Border trace_border(const Photo& photo, const sim::Scene& scene, const BorderSettings& settings = {});

}  // namespace vegard::fit
