// What is known of a scene's brightness, gathered, as text and as JSON.
#pragma once

#include <string>
#include <vector>

#include "sim/emit/aurora/sheet_brightness.h"
#include "sim/render/render.h"
#include "sim/scene/scene.h"
#include "sim/view/brightest_spot.h"
#include "sim/view/eye.h"

namespace vegard::apps {

struct BrightnessReport {
  std::vector<double> lines_nm;
  std::vector<sim::SheetBrightness> sheets;
  std::vector<int> layers;                 ///< of every sheet
  std::vector<sim::BrightSpot> brightest;  ///< of the aurora in the picture, per line
  sim::BrightSpot most_luminous;           ///< of the same; its value is cd m^-2
  double exposure_s = 0.0;
};

/// Of a scene and its picture.
BrightnessReport brightness_report(const sim::Scene& scene, const sim::Rendering& rendering);

/// For people: aligned, with a new line at the end.
std::string brightness_text(const BrightnessReport& report);

/// For programs: docs/file_formats.md, "Brightness (JSON)".
std::string brightness_json(const BrightnessReport& report);

}  // namespace vegard::apps
