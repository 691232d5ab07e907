// The lenses that a calibration chooses between: six models, each with more or fewer terms.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fit/photo/pointing/sky_camera.h"

namespace vegard::fit {

struct LensForm {
  sim::LensModel model = sim::LensModel::equidistant;
  int radial = 0;  ///< number of terms k1, k2, k3; only a pinhole and a polynomial (at least one) have any
  bool decentring = false;  ///< true for p1 and p2
  bool aspect = false;
};

/// Returns "polynomial k1 k2, p1 p2, aspect".
std::string words_of(const LensForm& form);

/// Returns all 44 forms, those with fewer numbers first.
std::vector<LensForm> lens_forms();

/// Returns the model with this word in scenes, "equidistant"; none if calibrations do not have it.
std::optional<sim::LensModel> lens_model(const std::string& word);

/// Returns the form of a camera's lens, with the terms that are not zero.
LensForm form_of(const SkyCamera& camera);

/// Returns the free numbers of this lens: the turns, focal_px, the centre if `centre_free`, and the terms.
std::vector<LensNumber> free_numbers(const LensForm& form, bool centre_free);

}  // namespace vegard::fit
