#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "fit/photo/codec/opencv_codecs.h"
#include "sim/base/module.h"

namespace vegard::fit {
namespace {

cv::Mat decode(const cv::Mat& bytes, int flags) { return cv::imdecode(bytes, flags); }

std::string encode_png(const cv::Mat& picture, int compression) {
  std::vector<unsigned char> file;
  std::vector<int> wishes;
  if (compression >= 0) wishes = {cv::IMWRITE_PNG_COMPRESSION, compression};
  cv::imencode(".png", picture, file, wishes);
  return {file.begin(), file.end()};
}

constexpr OpenCvCodecs functions{decode, encode_png};

}  // namespace
}  // namespace vegard::fit

VEGARD_MODULE(&vegard::fit::functions);
