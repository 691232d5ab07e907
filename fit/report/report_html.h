// A fit as one page that needs nothing else: report.html.
#pragma once

#include <string>
#include <vector>

#include "fit/answer/fit_result.h"
#include "fit/photo/photo.h"
#include "fit/report/model_picture.h"
#include "fit/report/table/profile_csv.h"

namespace vegard::fit {

/// A photograph of the fit as the page shows it; what it points to must outlive the call.
struct ShownPhoto {
  const FittedPhoto* fitted = nullptr;
  const Photo* photo = nullptr;
  const ModelPicture* model = nullptr;
  ElevationOfPixel elevation_of_pixel;
};

/// The whole page: pictures as data URIs, plots as inline SVG, no script. Of several photographs each has its
/// own sections. The same result gives the same bytes.
std::string report_html(const FitResult& result, const std::vector<ShownPhoto>& photos);

}  // namespace vegard::fit
