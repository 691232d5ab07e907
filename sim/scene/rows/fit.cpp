// [fit].
#include "sim/scene/rows/row.h"
#include "sim/scene/rows/rows.h"

namespace vegard::sim {
std::vector<Declaration> fit_rows() {
  // clang-format off
  return {
      Row("fit", "roi_px", &Scene::fit, &Fit::roi_px).of({"x", "y", "width", "height"}).in("px").within(0, 65535)
          .means("region of interest; all zero: the whole image"),
      Row("fit", "bands", &Scene::fit, &Fit::bands).within(1, 65535)
          .means("number of equal column strips of the region of interest"),
      Row("fit", "band_brightness", &Scene::fit, &Fit::band_brightness)
          .means("whether each band has a brightness of its own (rays are uneven)"),
      Row("fit", "white_balance_known", &Scene::fit, &Fit::white_balance_known)
          .means("if false, each channel has a gain of its own and colour says nothing about the energy"),
      Row("fit", "sky_terms", &Scene::fit, &Fit::sky_terms).within(1, 3)
          .means("what is solved of the sky, per channel: 1 its level, 2 its gradient too, 3 its curvature too"),
      Row("fit", "decoding", &Scene::fit, &Fit::decoding).one_of({"auto", "srgb", "linear", "sensor"})
          .means("how the photograph's numbers become linear light; sensor: by sensor.tone and the vignetting"),
      Row("fit", "model_error", &Scene::fit, &Fit::model_error).within(0, 1)
          .means("unmodelled structure, as a fraction of the local brightness"),
      Row("fit", "profile_smoothness", &Scene::fit, &Fit::profile_smoothness).within(0, 1e4)
          .means("of a free-form profile: one over the standard deviation of the second differences of "
                 "ln(spline_rate) from knot to knot; 0: what makes the data most probable, line by line"),
      Row("fit", "scan_points", &Scene::fit, &Fit::scan_points).within(0, 1000000)
          .means("wavelengths tried before the descents; 0: no search, one descent from the start"),
      Row("fit", "scan_descents", &Scene::fit, &Fit::scan_descents).within(0, 10000)
          .means("how many of the trials are followed downhill"),
  };
  // clang-format on
}

}  // namespace vegard::sim
