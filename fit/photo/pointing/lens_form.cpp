#include "fit/photo/pointing/lens_form.h"

#include <algorithm>

#include "sim/scene/table/parameter_table.h"

namespace vegard::fit {

std::string words_of(const LensForm& form) {
  std::string words = sim::word_of(form.model);
  for (int i = 1; i <= form.radial; ++i) words += " k" + std::to_string(i);
  if (form.decentring) words += ", p1 p2";
  if (form.aspect) words += ", aspect";
  return words;
}

std::vector<LensForm> lens_forms() {
  using sim::LensModel;
  std::vector<LensForm> forms;
  for (const LensModel model : {LensModel::pinhole, LensModel::equidistant, LensModel::equisolid,
                                LensModel::stereographic, LensModel::orthographic, LensModel::polynomial}) {
    const bool has_terms = model == LensModel::pinhole || model == LensModel::polynomial;
    for (int radial = model == LensModel::polynomial ? 1 : 0; radial <= (has_terms ? 3 : 0); ++radial)
      for (const bool decentring : {false, true})
        for (const bool aspect : {false, true}) forms.push_back({model, radial, decentring, aspect});
  }
  std::stable_sort(forms.begin(), forms.end(), [](const LensForm& a, const LensForm& b) {
    return free_numbers(a, true).size() < free_numbers(b, true).size();
  });
  return forms;
}

std::optional<sim::LensModel> lens_model(const std::string& word) {
  for (const LensForm& form : lens_forms())
    if (word == sim::word_of(form.model)) return form.model;
  return {};
}

LensForm form_of(const SkyCamera& camera) {
  LensForm form;
  form.model = camera.model;
  for (int i = 0; i < 3; ++i)
    if (camera.numbers[radial_1_number + i] != 0.0) form.radial = i + 1;
  form.decentring = camera.numbers[decentring_1_number] != 0.0 || camera.numbers[decentring_2_number] != 0.0;
  form.aspect = camera.numbers[aspect_ratio_number] != 1.0;
  return form;
}

std::vector<LensNumber> free_numbers(const LensForm& form, bool centre_free) {
  std::vector<LensNumber> free = {turn_about_right, turn_about_down, turn_about_forward, focal_px_number};
  if (centre_free) {
    free.push_back(centre_x_number);
    free.push_back(centre_y_number);
  }
  if (form.aspect) free.push_back(aspect_ratio_number);
  for (int i = 0; i < form.radial; ++i) free.push_back(static_cast<LensNumber>(radial_1_number + i));
  if (form.decentring) {
    free.push_back(decentring_1_number);
    free.push_back(decentring_2_number);
  }
  return free;
}

}  // namespace vegard::fit
