// The lenses that a calibration chooses between: six models, each with more or fewer terms.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fit/photo/pointing/sky_camera.h"

namespace vegard::fit {

struct LensForm {
  sim::LensModel model = sim::LensModel::equidistant;
  int radial = 0;  ///< how many of k1, k2, k3; only of a pinhole and a polynomial, which has at least one
  bool decentring = false;  ///< p1 and p2
  bool aspect = false;
};

/// "polynomial k1 k2, p1 p2, aspect".
std::string words_of(const LensForm& form);

/// All 44, those of fewer numbers first.
std::vector<LensForm> lens_forms();

/// The model that scenes call so, "equidistant"; none if a calibration knows no such.
std::optional<sim::LensModel> lens_model(const std::string& word);

/// The form that a camera has: the terms that are not zero.
LensForm form_of(const SkyCamera& camera);

/// The numbers that are free in this lens: the turns, focal_px, the centre if it is to be free, and the
/// terms.
std::vector<LensNumber> free_numbers(const LensForm& form, bool centre_free);

}  // namespace vegard::fit
