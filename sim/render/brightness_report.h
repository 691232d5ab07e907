// Report on a scene's brightness: its sheets, its brightest spots, the eye, the sensor and the ground.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/emit/aurora/sheet_brightness.h"
#include "sim/render/lit_ground.h"
#include "sim/render/render.h"
#include "sim/scene/structs/scene.h"
#include "sim/view/film/brightest_spot.h"
#include "sim/view/sensor/expected_counts.h"

namespace vegard::sim {

/// How the eye perceives the most luminous spot. docs/optics.md, "What the eye sees".
struct EyeReport {
  std::string vision;            ///< "scotopic", "mesopic" or "photopic" (CIE 191:2010)
  double cone_share = 0.0;       ///< share of the cones (colour vision), 0 to 1
  bool above_eye_limit = false;  ///< as luminous as 1 kR of 557.7 nm or more
};

/// What a pixel on the optical axis records of light like that of the most luminous spot.
struct SpotCounts {
  Vector3 electrons{};  ///< raw red, green, blue; at most what a pixel can hold
  Vector3 dn{};         ///< above black
  Vector3 signal_to_noise{};
  bool saturated = false;
};

struct BrightnessReport {
  std::vector<double> lines_nm;
  double exposure_s = 0.0;
  std::vector<SheetBrightness> sheets;
  std::vector<int> layers;            ///< number of layers of every sheet
  std::vector<BrightSpot> brightest;  ///< of the aurora in the picture, per line
  BrightSpot most_luminous;           ///< of the aurora in the picture; its value is in cd m^-2
  EyeReport eye;
  std::string sensor_exposure;  ///< what determines the scale: sensor.exposure
  ExpectedCounts counts;
  SpotCounts spot_counts;
  std::optional<GroundIllumination> ground;  ///< on a level surface at the observer's place, if there is one
};

/// Makes the report of a scene and its picture. `ground` is left empty; the caller may fill it
/// (sim/render/lit_ground.h).
BrightnessReport brightness_report(const Scene& scene, const Rendering& rendering);

}  // namespace vegard::sim
