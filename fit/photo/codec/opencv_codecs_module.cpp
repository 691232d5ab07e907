#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "fit/photo/codec/opencv_codecs.h"
#include "sim/base/module.h"

namespace vegard::fit {
namespace {

cv::Mat decode(const cv::Mat& bytes, int flags) { return cv::imdecode(bytes, flags); }

constexpr OpenCvCodecs functions{decode};

}  // namespace
}  // namespace vegard::fit

VEGARD_MODULE(&vegard::fit::functions);
