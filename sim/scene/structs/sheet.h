// [[sheet]]: where electrons fall and with what light.
#pragma once

#include <string>
#include <vector>

#include "sim/base/number/vec3.h"
#include "sim/scene/structs/sheet_kinds.h"

namespace vegard::sim {

/// One sheet of precipitating electrons, or several equal ones side by side (rows B1-B17, B28-B29 of
/// docs/physics.md).
struct Sheet {
  std::string name = "main";
  std::string form = "custom";      ///< the preset that its defaults come from
  EastNorth center_km{0.0, 200.0};  ///< middle of the line from start to end, at 110 km altitude
  double bearing_deg = 90.0;        ///< from start to end, clockwise from north
  double length_km = 400.0;         ///< from start to end (D)
  double thickness_km = 3.0;        ///< the amplitude w of the sine, as in the paper
  double wavelength_km = 60.0;      ///< of the sine
  double phase_rad = 0.0;           ///< of the first layer's sine at the start
  double phase_shift_rad = 0.5;     ///< between the first and the last layer
  SheetCourse course = SheetCourse::sine;
  std::vector<double> east_km, north_km;  ///< points of a curve in order, feet at 110 km
  std::vector<double> point_brightness;   ///< at the points, times energy_flux_mw_m2; empty: 1
  std::vector<double> point_energy_kev;   ///< at the points, in place of energy_kev; empty: energy_kev
  std::vector<double> point_width_km;     ///< at the points, in place of width_km; empty: width_km
  int layers = 3;
  double width_km = 1.5;                   ///< standard deviation of a layer's Gaussian cross-section
  int beams = 2000;                        ///< per layer
  double energy_kev = 3.0;                 ///< E0 of a Maxwellian, else the central energy
  double energy_flux_mw_m2 = 5.0;          ///< Q, maximum of a layer's cross-section
  double path_spread = 0.0;                ///< random variation of the depth, fraction of the path (ΔL)
  double loss_cone_deg = 2.5;              ///< pitch angle at the lower end of the path (α_D)
  double pitch_step_rad = 0.015;           ///< reduction of the pitch angle along the path (Δα)
  PitchLaw pitch_law = PitchLaw::reduced;  ///< interpretation of the paper's equation (4)
  double path_step = 1.0 / 300.0;          ///< largest step between deflections, fraction of the path (d_t)
  double top_km = 500.0;                   ///< altitude at which a beam starts
  double spacing_jitter = 0.5;             ///< of the beams along the arc, fraction of their spacing (j)
  SpacingRule spacing_rule = SpacingRule::stratified;
  double beams_per_km = 0.0;  ///< if not 0, the number of beams follows from the length, not from `beams`
  PathStepRule step_rule = PathStepRule::given;
  PathRule path_rule = PathRule::even;
  double points_per_px =
      0.0;  ///< render() adds beams where a layer has fewer deflection points per pixel; 0: never

  int arcs = 1;                  ///< number of equal sheets side by side
  double arc_spacing_km = 30.0;  ///< between them

  double brightness_kilorayleigh = 0.0;  ///< if not 0: of 557.7 nm along the field, replaces Q
  ProfileKind profile = ProfileKind::maxwellian;
  double energy_spread = 0.2;      ///< of a Gaussian spectrum: standard deviation over energy_kev
  std::string profile_file;        ///< CSV of a height profile, relative to the scene's file
  double peak_km = 110.0;          ///< altitude of the maximum of a form's light, or that of "line"
  double lower_km = 4.0;           ///< distance below the peak at which a form's light has fallen to a tenth
  double upper_km = 20.0;          ///< distance above the peak at which a form's light has fallen to a tenth
  double line_nm = 557.7;          ///< the only line of the profile "line"; of "proton" one of theirs
  double line_kilorayleigh = 1.0;  ///< its brightness along the field, at the peak of a layer; replaces Q
  double spline_bottom_km = 80.0;  ///< lower end of a free-form profile, where it is 0
  double spline_top_km = 500.0;    ///< upper end of a free-form profile, where it is 0
  int spline_knots = 36;           ///< coefficients of a free-form profile per line
  /// Coefficients of a free-form profile, photons cm^-3 s^-1 per mW m^-2, [line][knot]
  /// (sim/scene/rows/spline_rates.h); empty for other profiles.
  std::vector<double> spline_rate;

  double fold_spacing_km = 0.0;      ///< mean distance of folds; 0: none
  double fold_spacing_jitter = 0.5;  ///< random shift of the folds, fraction of the spacing
  double fold_length_km = 8.0;       ///< length of the part of the sine that a fold replaces
  double fold_stage = 0.5;           ///< 0: ripple; 0.5: overhang; 1: horseshoe bend
  double fold_stage_spread = 0.5;    ///< largest random reduction of the stage, fraction of it
  double fold_speed_km_s = 0.0;
  double fold_lifetime_s = 0.0;  ///< 0: they last

  double curl_spacing_km = 0.0;  ///< mean distance of curls; 0: none
  double curl_radius_km = 1.0;
  double curl_turn_rad = 3.0;  ///< angle by which a curl has turned its centre
  double curl_gather = 0.5;    ///< relative spacing of the beams at the centre is 1 - curl_gather
  double curl_speed_km_s = 0.0;
  double curl_lifetime_s = 0.0;  ///< 0: they last

  double spiral_spacing_km = 0.0;  ///< mean distance of spirals; 0: none
  double spiral_radius_km = 25.0;
  double spiral_turn_rad = 6.0;  ///< angle by which a spiral has turned its centre
  double spiral_speed_km_s = 0.0;
  double spiral_lifetime_s = 0.0;  ///< 0: they last

  double ray_contrast = 0.0;         ///< standard deviation of ln(light) along the sheet
  double ray_width_km = 0.5;         ///< full width at half maximum of a ray
  double ray_length_contrast = 0.0;  ///< standard deviation of ln(height above the peak) of rays
  double ray_speed_km_s = 0.0;
  double ray_lifetime_s = 0.0;  ///< 0: they last

  double patch_size_km = 0.0;     ///< 0: no patches
  double patch_contrast = 1.0;    ///< standard deviation of ln(light)
  double patch_lifetime_s = 0.0;  ///< 0: they last

  double border_amplitude_km = 0.0;  ///< of the undulation of the lower border
  double border_scale_km = 20.0;     ///< length of the undulation's largest waves
  int border_octaves = 3;
  double border_lifetime_s = 0.0;  ///< 0: it lasts
  BorderRule border_rule = BorderRule::light;

  EastNorth drift_km_s{0.0, 0.0};  ///< of the whole sheet
  double sine_speed_km_s = 0.0;    ///< of the sine, from start to end
};

}  // namespace vegard::sim
