// The report of a fit as one self-contained page: report.html.
#pragma once

#include <string>
#include <vector>

#include "fit/answer/fit_result.h"
#include "fit/photo/photo.h"
#include "fit/report/model_picture.h"
#include "fit/report/table/profile_csv.h"

namespace vegard::fit {

/// A photograph of the fit for the page; the objects behind its pointers must outlive the call.
struct ShownPhoto {
  const FittedPhoto* fitted = nullptr;
  const Photo* photo = nullptr;
  const ModelPicture* model = nullptr;
  ElevationOfPixel elevation_of_pixel;
};

/// Returns the whole page: pictures as data URIs, plots as inline SVG, no script. Each of several photographs
/// has its own sections. The same result gives the same bytes.
std::string report_html(const FitResult& result, const std::vector<ShownPhoto>& photos);

}  // namespace vegard::fit
