// The pictures that another program made, and what is true of them.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "sim/scene/structs/scene.h"
#include "tests/support/source_folder.h"

namespace vegard::fit {

inline nlohmann::json read_json(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return nlohmann::json::parse(stream);
}

/// The sheet that the picture was made from.
inline sim::Sheet true_sheet(const nlohmann::json& truth) {
  constexpr double kDegreesPerRadian = 57.29577951308232;
  const nlohmann::json& from = truth.at("sheets").at(0);
  const auto end = [&](const char* key) {
    return sim::EastNorth{from.at(key).at(0).get<double>(), from.at(key).at(1).get<double>()};
  };
  const sim::EastNorth a = end("start_km"), b = end("end_km");
  sim::Sheet sheet;
  sheet.center_km = {0.5 * (a.east + b.east), 0.5 * (a.north + b.north)};
  sheet.length_km = std::hypot(b.east - a.east, b.north - a.north);
  sheet.bearing_deg = std::atan2(b.east - a.east, b.north - a.north) * kDegreesPerRadian;
  sheet.thickness_km = from.at("thickness_km");
  sheet.wavelength_km = from.at("wavelength_km");
  sheet.phase_rad = from.at("phase_rad");
  sheet.phase_shift_rad = from.at("phase_shift_rad");
  sheet.layers = from.at("layers");
  sheet.width_km = from.at("width_km");
  sheet.energy_kev = from.at("E0_keV");
  sheet.energy_flux_mw_m2 = from.at("Q");
  return sheet;
}

/// Camera, field, lens and sheet as they are.
inline sim::Scene known_scene(const nlohmann::json& truth) {
  sim::Scene scene;
  scene.emission.tables = "glow";  // those of the program that made the pictures, as is
  scene.emission.flux_law = sim::FluxLaw::linear;
  scene.site.latitude_deg = truth.at("site").at("latitude_deg");
  scene.field.inclination_deg = truth.at("field").at("inclination_deg");
  scene.field.declination_deg = truth.at("field").at("declination_deg");
  const nlohmann::json& camera = truth.at("camera");
  scene.camera.width = camera.at("width");
  scene.camera.height = camera.at("height");
  scene.camera.hfov_deg = camera.at("hfov_deg");
  scene.camera.azimuth_deg = camera.at("azimuth_deg");
  scene.camera.elevation_deg = camera.at("elevation_deg");
  scene.camera.roll_deg = camera.at("roll_deg");
  scene.sheets = {true_sheet(truth)};
  scene.sheets[0].beams = 2000;
  const nlohmann::json& blur_px = truth.at("photo").at("blur_px");
  for (std::size_t line = 0; line < scene.blur.width_deg.size(); ++line)
    scene.blur.width_deg[line] = blur_px.at(line).get<double>() * scene.camera.hfov_deg / scene.camera.width;
  scene.fit.bands = 24;
  return scene;
}

/// Where the other photographs lie, if they do: they are too large to ship.
inline std::optional<std::filesystem::path> photographs() {
  const char* const named = std::getenv("VEGARD_PHOTOS");
  const std::filesystem::path folder =
      named != nullptr ? std::filesystem::path(named)
                       : std::filesystem::path(tests::source_folder()) / "../shared/photos/independent";
  if (!std::filesystem::is_directory(folder)) return {};
  return folder;
}

}  // namespace vegard::fit
