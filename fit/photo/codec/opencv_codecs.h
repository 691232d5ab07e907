// OpenCV's decoders and its encoder of PNG, which a module calls (sim/base/module.h): GDAL and a hundred more
// libraries are behind them. OpenCV's other parts are linked.
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
  /// cv::imencode(); compression: 0 to 9, or -1 for what OpenCV finds fastest.
  std::string (*encode_png)(const cv::Mat& picture, int compression);
};

/// Returns the file of a picture of 8 bits, grey or with blue first. Throws sim::MissingModule.
inline std::string encoded_png(const cv::Mat& picture, int compression = -1) {
  return sim::module_functions<OpenCvCodecs>().encode_png(picture, compression);
}

}  // namespace vegard::fit
