#include "fit/measurement/calibration_words.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include "fit/photo/pointing/calibration_tables.h"
#include "fit/photo/pointing/held_out.h"
#include "sim/base/file/number_text.h"

namespace vegard::fit {
namespace {

constexpr int kLensesShown = 8;

}  // namespace

std::string recognised_table(const CameraCalibration& found) {
  if (!found.blind || !found.blind->place) return {};
  return found.calibration ? stars_csv(*found.calibration) : stars_csv(found.blind->picture.recognition);
}

std::string lens_line(const Calibration& calibration) {
  return "lens: " + words_of(calibration.form) + (calibration.camera.mirrored ? ", mirrored" : "");
}

std::string rms_line(const Calibration& calibration) {
  if (calibration.maps)
    return fmt::format("rms: {} px over {} of {} points of the maps",
                       sim::short_number(calibration.rms_px, 3), calibration.used(),
                       calibration.stars.size());
  return fmt::format("rms: {:.3f} px over {} of {} stars; each star by a fit without it: {:.3f} px",
                     calibration.rms_px, calibration.used(), calibration.stars.size(),
                     calibration.without_rms_px);
}

std::string axis_line(const Calibration& calibration) {
  return fmt::format("the axis is known to {} deg, the turn about it to {} deg",
                     sim::short_number(calibration.line_of_sight_sigma_deg, 2),
                     sim::short_number(calibration.twist_sigma_deg, 2));
}

void tell_calibration(const CameraCalibration& found, const Tell& tell) {
  const Calibration& calibration = *found.calibration;
  if (calibration.candidates.size() > 1) tell.lines(candidates_text(calibration, kLensesShown));
  tell(lens_line(calibration));
  tell(rms_line(calibration));
  if (calibration.maps) tell(words_of(*calibration.maps));
  if (!calibration.maps) tell(held_out_line(calibration));
  if (const std::string points = explained_line(calibration); !points.empty()) tell(points);
  for (const CameraEstimate& estimate : calibration.estimates)
    if (estimate.free)
      tell("camera." + estimate.key() + ": " + sim::number_with_error(estimate.value, estimate.sigma) + " " +
           estimate.unit());
  tell(axis_line(calibration));
  if (calibration.maps && calibration.used() < static_cast<int>(calibration.stars.size()))
    tell(fmt::format("left out: {} points, farther off than the others' scatter explains",
                     static_cast<int>(calibration.stars.size()) - calibration.used()));
  for (std::size_t i = 0; !calibration.maps && i < calibration.stars.size(); ++i) {
    const StarResidual& one = calibration.residuals[i];
    if (one.used) continue;
    const StarSighting& star = calibration.stars[i];
    tell(fmt::format("left out: {}{} at ({:.1f}, {:.1f}), {:.2f} px off",
                     star.name.empty() ? "the star" : star.name,
                     star.line > 0 ? " of line " + std::to_string(star.line) : "", star.x_px, star.y_px,
                     std::hypot(one.dx_px, one.dy_px)));
  }
  for (const std::string& warning : calibration.warnings) tell("note: " + warning);
  if (!found.frame.known) tell("note: the picture's size was guessed from its stars: set --size or --image");
}

nlohmann::ordered_json answer_json(const CameraCalibration& found) {
  if (found.calibration)
    return nlohmann::ordered_json::parse(calibration_json(*found.calibration, found.origin));
  if (!found.blind) return {{"found", false}, {"words", found.chance}};
  const StarRecognition& recognition = found.blind->picture.recognition;
  nlohmann::ordered_json json = {{"found", recognition.found}, {"words", words_of(recognition)}};
  if (found.blind->place) json["place"] = words_of(*found.blind->place, recognition.best);
  return json;
}

}  // namespace vegard::fit
