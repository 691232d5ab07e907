// The pictures of a report, each a PNG as a data URI.
#pragma once

#include <string>

#include "fit/answer/fit_result.h"
#include "fit/photo/photo.h"
#include "fit/report/model_picture.h"

namespace vegard::fit {

struct ReportPictures {
  std::string photo;  ///< with the region of interest and its bands drawn; if these are not columns, the
                      ///< first and the last are numbered; unused parts are dimmed
  std::string model;
  std::string residual;  ///< mid-grey is zero
  std::string misfit;  ///< residual / sigma, rows downwards, bands to the right, the three channels (one of a
                       ///< grey sensor) side by side; empty if there is none
  double brightness = 1.0;      ///< factor on photograph and model for display
  double residual_scale = 1.0;  ///< linear light at which the picture of the residual is black or white
};

ReportPictures report_pictures(const FittedPhoto& fitted, const Photo& photo, const ModelPicture& model);

}  // namespace vegard::fit
