// The pictures of a report, each a PNG as a data URI.
#pragma once

#include <string>

#include "fit/answer/fit_result.h"
#include "fit/photo/photo.h"
#include "fit/report/model_picture.h"

namespace vegard::fit {

struct ReportPictures {
  std::string photo;  ///< with the region of interest and its bands drawn in, of which the first and the
                      ///< last have their numbers where they are no columns; what is not used is dimmed
  std::string model;
  std::string residual;  ///< mid-grey is zero
  std::string misfit;    ///< residual / sigma, rows down, bands across, the three channels (of a grey sensor
                         ///< one) side by side; empty if none
  double brightness = 1.0;      ///< what photograph and model were multiplied by to be seen
  double residual_scale = 1.0;  ///< linear light at which the residual's picture is black or white
};

ReportPictures report_pictures(const FittedPhoto& fitted, const Photo& photo, const ModelPicture& model);

}  // namespace vegard::fit
