// A fit as one page that needs nothing else: report.html.
#pragma once

#include <string>

#include "fit/fit_result.h"
#include "fit/model_picture.h"
#include "fit/photo.h"
#include "fit/profile_csv.h"

namespace vegard::fit {

/// The whole page: pictures as data URIs, plots as inline SVG, no script. The same result gives the same
/// bytes.
std::string report_html(const FitResult& result, const Photo& photo, const ModelPicture& model,
                        const ElevationOfPixel& elevation_of_pixel);

}  // namespace vegard::fit
