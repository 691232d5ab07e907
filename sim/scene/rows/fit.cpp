// [fit].
#include "sim/scene/rows/decoding_word.h"
#include "sim/scene/rows/row.h"
#include "sim/scene/rows/rows.h"

namespace vegard::sim {
namespace {

std::string name_by_point(const Scene&, int index) { return std::to_string(index); }

}  // namespace

std::vector<Declaration> fit_rows() {
  // clang-format off
  return {
      Row("fit", "roi_px", &Scene::fit, &Fit::roi_px).of({"x", "y", "width", "height"}).in("px").within(0, 65535)
          .means("region of interest; all zero: the whole image"),
      Row("fit", "bands", &Scene::fit, &Fit::bands).within(1, 65535)
          .means("number of equal column strips of the region of interest"),
      Row("fit", "average_rows", &Scene::fit, &Fit::average_rows).within(0, 65535)
          .means("a photograph with at least twice so many rows in the region of interest is averaged over square blocks of pixels, "
                 "which leave about so many or more; 0: never"),
      Row("fit", "band_brightness", &Scene::fit, &Fit::band_brightness)
          .means("whether each band has a brightness of its own (rays are uneven)"),
      Row("fit", "white_balance_known", &Scene::fit, &Fit::white_balance_known)
          .means("if false, each channel has a gain of its own and colour says nothing about the energy"),
      Row("fit", "sky_terms", &Scene::fit, &Fit::sky_terms).within(1, 3)
          .means("what is solved of the sky, per channel: 1 its level, 2 its gradient too, 3 its curvature too"),
      Row("fit", "band_sky", &Scene::fit, &Fit::band_sky)
          .means("whether each band has a sky of its own, whose terms run along its profile; else one sky has terms down the picture"),
      Row("fit", "decoding", &Scene::fit, &Fit::decoding).rule(decoding_complaint).names_table()
          .means("how the photograph's numbers become linear light: auto, srgb, srgb:EXPONENT, linear, gamma:2.2, "
                 "curve:FILE.csv, sensor (by sensor.tone and the vignetting), unknown or unknown:2 (found by the fit)"),
      Row("fit", "model_error", &Scene::fit, &Fit::model_error).within(0, 1)
          .means("unmodelled structure, as a fraction of the local brightness"),
      Row("fit", "profile_smoothness", &Scene::fit, &Fit::profile_smoothness).within(0, 1e4)
          .means("of a free-form profile: one over the standard deviation of the second differences of "
                 "ln(spline_rate) from knot to knot; 0: what makes the data most probable, line by line"),
      Row("fit", "ratio_spread", &Scene::fit, &Fit::ratio_spread).within(0, 10)
          .means("how far a sheet's wavelength over twice its amplitude may lie outside of the paper's 5.2 to 31.4: one standard "
                 "deviation of its logarithm, as a prior; 0: no such prior"),
      Row("fit", "scan_points", &Scene::fit, &Fit::scan_points).within(0, 1000000)
          .means("wavelengths tried before the descents where bands do not show a sheet's course; 0: no search, one descent from the start"),
      Row("fit", "scan_descents", &Scene::fit, &Fit::scan_descents).within(0, 10000)
          .means("how many of the trials are followed downhill"),
      Row("fit", "overall_trials", &Scene::fit, &Fit::overall_trials).within(0, 1000000)
          .means("distances, energies and bearings tried before that"),
      Row("fit", "polish_descents", &Scene::fit, &Fit::polish_descents).within(1, 1000)
          .means("how many ends of descents are polished with all beams, unless they explain the data far worse"),
      Row("fit", "search_beams", &Scene::fit, &Fit::search_beams).within(0.01, 1)
          .means("share of the beams with which the search works"),
      Row("fit", "search_smoothing", &Scene::fit, &Fit::search_smoothing).within(0, 0.5)
          .means("standard deviation by which the search smooths profiles, as a fraction of the region's height"),
      Row("fit", "model", &Scene::fit, &Fit::model).one_of<FitModel>({{"expected", FitModel::expected}, {"draws", FitModel::draws}})
          .means("which picture is compared: the mean over all draws of beams, or one draw with the sheets' numbers of beams. Folds, curls and undulating borders have draws alone"),
      Row("fit", "profile_weight", &Scene::fit, &Fit::profile_weight).within(0, 100)
          .means("of intensity profiles in chi2; 0: left out, as with the other weights"),
      Row("fit", "colour_weight", &Scene::fit, &Fit::colour_weight).within(0, 100)
          .means("of colour profiles: logarithms of red over green and of blue over green"),
      Row("fit", "horizontal_weight", &Scene::fit, &Fit::horizontal_weight).within(0, 100)
          .means("of intensity profiles across the picture"),
      Row("fit", "border_weight", &Scene::fit, &Fit::border_weight).within(0, 100)
          .means("of the lower border's course from band to band"),
      Row("fit", "image_weight", &Scene::fit, &Fit::image_weight).within(0, 100)
          .means("of a picture of low resolution"),
      Row("fit", "texture_weight", &Scene::fit, &Fit::texture_weight).within(0, 100)
          .means("of the autocovariance along the arc, which tells the rays' spacing wherever each of them stands"),
      Row("fit", "granulation_weight", &Scene::fit, &Fit::granulation_weight).within(0, 100)
          .means("of the angular power spectrum of the light on the Sun's disc, which tells the granules' size wherever each of them stands"),
      Row("fit", "profile_along", &Scene::fit, &Fit::profile_along).one_of<ProfileAlong>({{"columns", ProfileAlong::columns}, {"elevation", ProfileAlong::elevation}, {"field", ProfileAlong::field}, {"loop", ProfileAlong::loop}, {"limb", ProfileAlong::limb}})
          .means("what profiles run along: the picture's columns, the elevation, the field line in the picture, across a loop that is drawn by guide points, or away from the Sun's limb"),
      Row("fit", "guide_x_px", &Scene::fit, &Fit::guide_x_px).of({"<n>"}).named_by(name_by_point).in("px").within(-1e5, 1e5)
          .means("of profiles across a loop: points drawn along it, from the picture's left edge"),
      Row("fit", "guide_y_px", &Scene::fit, &Fit::guide_y_px).of({"<n>"}).named_by(name_by_point).in("px").within(-1e5, 1e5)
          .means("the same, from its top"),
      Row("fit", "guide_half_width_px", &Scene::fit, &Fit::guide_half_width_px).in("px").within(1, 1000)
          .means("how far a profile across a loop reaches to either side"),
      Row("fit", "guide_cell_px", &Scene::fit, &Fit::guide_cell_px).in("px").within(0.5, 100)
          .means("from position to position across a loop"),
      Row("fit", "limb_lowest", &Scene::fit, &Fit::limb_lowest).within(0, 1000)
          .means("where profiles away from the Sun's limb begin, in radii of its photosphere from its middle"),
      Row("fit", "limb_highest", &Scene::fit, &Fit::limb_highest).within(0, 1000).means("and where they end"),
      Row("fit", "limb_step", &Scene::fit, &Fit::limb_step).within(1e-4, 100).means("from position to position"),
      Row("fit", "horizontal_strips", &Scene::fit, &Fit::horizontal_strips).within(1, 1000)
          .means("strips of rows in which horizontal profiles are taken"),
      Row("fit", "image_cell_px", &Scene::fit, &Fit::image_cell_px).in("px").within(2, 1000)
          .means("of the picture of low resolution"),
      Row("fit", "photo_noise", &Scene::fit, &Fit::photo_noise).one_of<PhotoNoise>({{"estimated", PhotoNoise::estimated}, {"sensor", PhotoNoise::sensor}})
          .means("whether the photograph's noise is taken from the photograph or from [sensor]"),
      Row("fit", "loss", &Scene::fit, &Fit::loss).one_of<ResidualLoss>({{"none", ResidualLoss::none}, {"huber", ResidualLoss::huber}, {"cauchy", ResidualLoss::cauchy}})
          .means("how single residuals beyond loss_sigma are kept from ruling the fit"),
      Row("fit", "loss_sigma", &Scene::fit, &Fit::loss_sigma).within(0.1, 100)
          .means("from how many standard deviations on a residual counts less"),
  };
  // clang-format on
}

}  // namespace vegard::sim
