// OpenCV's decoders, which a module calls (sim/base/module.h): GDAL and a hundred more libraries are behind
// them. OpenCV's other parts are linked; its pictures are written by libpng.
#pragma once

#include <string>

#include "sim/base/module.h"

namespace cv {
class Mat;
}

namespace vegard::fit {

struct OpenCvCodecs {
  static constexpr const char* module = "vegard_opencv_codecs";

  /// cv::imdecode().
  cv::Mat (*decode)(const cv::Mat& bytes, int flags);
};

/// Returns the file of a picture of 8 bits, grey or with blue first (sim::encode_plain_png()).
std::string encoded_png(const cv::Mat& picture, int zlib_level = 0);

}  // namespace vegard::fit
