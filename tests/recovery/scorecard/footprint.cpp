#include "tests/recovery/scorecard/footprint.h"

#include <cassert>
#include <cmath>

#include "sim/emit/aurora/beam_light.h"
#include "sim/emit/aurora/sheet.h"

namespace vegard::scorecard {
namespace {

constexpr double kStepAlongKm = 0.05;
constexpr double kStepsPerSigma = 10.0, kReachSigmas = 4.5;
constexpr double kTwoPi = 6.283185307179586;

}  // namespace

Footprint::Footprint(const sim::Scene& scene, int index) {
  const sim::Sheet& sheet = scene.sheets[index];
  assert(sheet.arcs == 1 && sheet.curl_spacing_km == 0.0 && sheet.patch_size_km == 0.0 &&
         sheet.border_amplitude_km == 0.0);
  half_length_km_ = 0.5 * sheet.length_km;
  const double folds_reach = sheet.fold_spacing_km > 0.0 ? 2.0 * sheet.fold_length_km : 0.0;
  half_width_km_ = sheet.thickness_km + kReachSigmas * sheet.width_km + folds_reach + 1.0;
  columns_ = static_cast<int>(2.0 * half_length_km_ / kCellKm) + 2;
  rows_ = static_cast<int>(2.0 * half_width_km_ / kCellKm) + 2;
  flux_.assign(static_cast<std::size_t>(columns_) * rows_, 0.0f);

  const sim::StretchOfSheet stretch = sim::stretch_of(sheet, scene.time.start_s);
  const std::uint32_t arc = sim::layer_address(index, 0, 0);
  const sim::LayerStructure structure{
      sim::Folds(sheet, arc, scene.seed, scene.time.start_s, stretch.drifted_km),
      sim::Curls(sheet, arc, scene.seed, scene.time.start_s, stretch.drifted_km)};
  sim::ArcLight light(sheet, arc, scene.seed, scene.time.start_s, stretch.drifted_km);
  light.remember(stretch.center_km - half_length_km_, stretch.center_km + half_length_km_);

  // Sharing out among four corners, and reading between them, each widen a cross-section by a sixth of a
  // cell squared.
  const double width = std::sqrt(sheet.width_km * sheet.width_km - kCellKm * kCellKm / 3.0);
  const int steps = static_cast<int>(std::lround(sheet.length_km / kStepAlongKm));
  const double step = sheet.length_km / steps;
  const int half = static_cast<int>(kReachSigmas * kStepsPerSigma);
  for (int layer = 0; layer < sheet.layers; ++layer) {
    const double share = sheet.layers > 1 ? static_cast<double>(layer) / (sheet.layers - 1) : 0.0;
    for (int k = 0; k < steps; ++k) {
      const double from_start = (k + 0.5) * step, along = stretch.along_km(from_start / sheet.length_km);
      const sim::LayerSine<double> sine{
          sheet.thickness_km, kTwoPi / sheet.wavelength_km,
          kTwoPi * from_start / sheet.wavelength_km + sheet.phase_rad + sheet.phase_shift_rad * share};
      const double flux = sheet.energy_flux_mw_m2 * light.at(along, sine.aside(0.0)).factor;
      for (int c = -half; c <= half; ++c) {
        const double sigmas = c / kStepsPerSigma;
        // A Gaussian of height 1 at width_km, whatever the width it is drawn with.
        const double weight =
            flux * std::exp(-0.5 * sigmas * sigmas) * sheet.width_km / kStepsPerSigma * step;
        const sim::PlanePoint<double> point =
            sim::structured_point(sine, structure, sheet.fold_stage, along, width * sigmas);
        const double x = (from_start + point.x_km) / kCellKm, y = (point.aside_km + half_width_km_) / kCellKm;
        const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
        if (i < 0 || j < 0 || i + 1 >= columns_ || j + 1 >= rows_) continue;
        const double fx = x - i, fy = y - j, density = weight / (kCellKm * kCellKm);
        float* const near = &flux_[static_cast<std::size_t>(i) * rows_ + j];
        near[0] += static_cast<float>(density * (1.0 - fx) * (1.0 - fy));
        near[1] += static_cast<float>(density * (1.0 - fx) * fy);
        near[rows_] += static_cast<float>(density * fx * (1.0 - fy));
        near[rows_ + 1] += static_cast<float>(density * fx * fy);
      }
    }
  }
}

}  // namespace vegard::scorecard
