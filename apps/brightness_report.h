// What is known of a scene's brightness, gathered, as text and as JSON.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/emit/aurora/sheet_brightness.h"
#include "sim/render/render.h"
#include "sim/scene/structs/scene.h"
#include "sim/view/film/brightest_spot.h"
#include "sim/view/sensor/expected_counts.h"

namespace vegard::apps {

/// What the eye makes of the most luminous spot. docs/physics.md, "What the eye sees".
struct EyeReport {
  std::string vision;            ///< "scotopic", "mesopic" or "photopic" (CIE 191:2010)
  double cone_share = 0.0;       ///< of colour, 0 to 1
  bool above_eye_limit = false;  ///< as luminous as 1 kR of 557.7 nm or more
};

/// What a pixel on the axis records of light like that of the most luminous spot.
struct SpotCounts {
  sim::Vector3 electrons{};  ///< raw red, green, blue; what a pixel holds at most
  sim::Vector3 dn{};         ///< above black
  sim::Vector3 signal_to_noise{};
  bool saturated = false;
};

struct BrightnessReport {
  std::vector<double> lines_nm;
  double exposure_s = 0.0;
  std::vector<sim::SheetBrightness> sheets;
  std::vector<int> layers;                 ///< of every sheet
  std::vector<sim::BrightSpot> brightest;  ///< of the aurora in the picture, per line
  sim::BrightSpot most_luminous;           ///< of the same; its value is cd m^-2
  EyeReport eye;
  std::string sensor_exposure;  ///< what the scale rests on: sensor.exposure
  sim::ExpectedCounts counts;
  SpotCounts spot_counts;
};

/// Of a scene and its picture.
BrightnessReport brightness_report(const sim::Scene& scene, const sim::Rendering& rendering);

/// For people: aligned, with a new line at the end.
std::string brightness_text(const BrightnessReport& report);

/// For programs: docs/file_formats.md, "Brightness (JSON)".
std::string brightness_json(const BrightnessReport& report);

}  // namespace vegard::apps
