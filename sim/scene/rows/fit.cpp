// [fit].
#include "sim/scene/rows/decoding_word.h"
#include "sim/scene/rows/row.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {
std::vector<Declaration> fit_rows() {
  // clang-format off
  std::vector<Declaration> rows = {
      Row("fit", "roi_px", &Scene::fit, &Fit::roi_px).of({"x", "y", "width", "height"}).in("px").within(0, 65535)
          .means("region of interest; all zero: the whole image"),
      Row("fit", "bands", &Scene::fit, &Fit::bands).within(1, 65535)
          .means("equal column strips of the region"),
      Row("fit", "average_rows", &Scene::fit, &Fit::average_rows).within(0, 65535)
          .means("to which larger photographs are averaged; 0: never"),
      Row("fit", "band_brightness", &Scene::fit, &Fit::band_brightness)
          .means("each band has its own brightness"),
      Row("fit", "white_balance_known", &Scene::fit, &Fit::white_balance_known)
          .means("false: each channel has its own gain"),
      Row("fit", "sky_terms", &Scene::fit, &Fit::sky_terms).within(1, 3)
          .means("terms of the sky per channel: 1 level, 2 gradient, 3 curvature"),
      Row("fit", "band_sky", &Scene::fit, &Fit::band_sky)
          .means("each band has its own sky"),
      Row("fit", "decoding", &Scene::fit, &Fit::decoding).of_all_photos("give the entry a decoding").rule(decoding_complaint).names_table()
          .means("auto, srgb, srgb:EXPONENT, linear, gamma:2.2, curve:FILE.csv, sensor, unknown or unknown:2 (docs/fitting.md)"),
      Row("fit", "model_error", &Scene::fit, &Fit::model_error).within(0, 1)
          .means("unmodelled structure, as a fraction of the local brightness"),
      Row("fit", "profile_smoothness", &Scene::fit, &Fit::profile_smoothness).of_all_photos().within(0, 1e4)
          .means("of second differences of ln(spline_rate), an inverse standard deviation; 0: most probable"),
      Row("fit", "ratio_spread", &Scene::fit, &Fit::ratio_spread).within(0, 10)
          .means("prior: standard deviation of ln(λ/(2w)) outside the paper's 5.2–31.4; 0: none"),
      Row("fit", "scan_points", &Scene::fit, &Fit::scan_points).of_all_photos().within(0, 1000000)
          .means("wavelengths tried before; 0: one descent from the start"),
      Row("fit", "scan_descents", &Scene::fit, &Fit::scan_descents).of_all_photos().within(0, 10000)
          .means("trials that are followed by a descent"),
      Row("fit", "overall_trials", &Scene::fit, &Fit::overall_trials).of_all_photos().within(0, 1000000)
          .means("trials of distance, energy and bearing before"),
      Row("fit", "polish_descents", &Scene::fit, &Fit::polish_descents).of_all_photos().within(1, 1000)
          .means("descents with all beams"),
      Row("fit", "search_beams", &Scene::fit, &Fit::search_beams).of_all_photos().within(0.01, 1)
          .means("share of the beams used by the search"),
      Row("fit", "search_smoothing", &Scene::fit, &Fit::search_smoothing).of_all_photos().within(0, 0.5)
          .means("smoothing of profiles in the search, relative to the region's height"),
      Row("fit", "model", &Scene::fit, &Fit::model).one_of<FitModel>({{"expected", FitModel::expected}, {"draws", FitModel::draws}})
          .means("the mean over random beams is compared, or one draw (as always with folds, curls, undulating borders)"),
  };
  for (const StatisticFacts& facts : kStatistics)
    rows.push_back(Row("fit", facts.name + std::string("_weight"),
                       [kind = facts.kind](Scene& scene) -> double& { return scene.fit.weight[kind]; })
                       .within(0, 100).means(facts.meaning));
  const std::vector<Declaration> others = {
      Row("fit", "profile_along", &Scene::fit, &Fit::profile_along).one_of<ProfileAlong>({{"columns", ProfileAlong::columns}, {"elevation", ProfileAlong::elevation}, {"field", ProfileAlong::field}, {"loop", ProfileAlong::loop}, {"limb", ProfileAlong::limb}})
          .means("of profiles: columns, elevation, field lines, across a loop, or away from the Sun's limb"),
      Row("fit", "guide_x_px", &Scene::fit, &Fit::guide_x_px).numbered().in("px").within(-1e5, 1e5)
          .means("for profiles across a loop: points along it, from the left edge"),
      Row("fit", "guide_y_px", &Scene::fit, &Fit::guide_y_px).numbered().in("px").within(-1e5, 1e5)
          .means("the same, from its top"),
      Row("fit", "guide_half_width_px", &Scene::fit, &Fit::guide_half_width_px).in("px").within(1, 1000)
          .means("reach of a profile across a loop to either side"),
      Row("fit", "guide_cell_px", &Scene::fit, &Fit::guide_cell_px).in("px").within(0.5, 100)
          .means("from position to position across a loop"),
      Row("fit", "limb_lowest", &Scene::fit, &Fit::limb_lowest).within(0, 1000)
          .means("start of profiles from the Sun's limb, in radii"),
      Row("fit", "limb_highest", &Scene::fit, &Fit::limb_highest).within(0, 1000).means("and where they end"),
      Row("fit", "limb_step", &Scene::fit, &Fit::limb_step).within(1e-4, 100).means("from position to position"),
      Row("fit", "horizontal_strips", &Scene::fit, &Fit::horizontal_strips).within(1, 1000)
          .means("strips of rows for horizontal profiles"),
      Row("fit", "image_cell_px", &Scene::fit, &Fit::image_cell_px).in("px").within(2, 1000)
          .means("of the picture of low resolution"),
      Row("fit", "photo_noise", &Scene::fit, &Fit::photo_noise).one_of<PhotoNoise>({{"estimated", PhotoNoise::estimated}, {"sensor", PhotoNoise::sensor}})
          .means("noise from the photograph, or from [sensor]"),
      Row("fit", "loss", &Scene::fit, &Fit::loss).one_of<ResidualLoss>({{"none", ResidualLoss::none}, {"huber", ResidualLoss::huber}, {"cauchy", ResidualLoss::cauchy}})
          .means("robust loss for residuals beyond loss_sigma"),
      Row("fit", "loss_sigma", &Scene::fit, &Fit::loss_sigma).within(0.1, 100)
          .means("standard deviations"),
  };
  // clang-format on
  rows.insert(rows.end(), others.begin(), others.end());
  return rows;
}

}  // namespace vegard::sim
