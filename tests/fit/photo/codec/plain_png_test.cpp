// PNGs of plots and masks against those of OpenCV, whose codecs they do without.
#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "fit/photo/codec/opencv_codecs.h"

namespace vegard::fit::plain_png_test {
namespace {

std::string by_opencv(const cv::Mat& picture, const std::vector<int>& wishes) {
  std::vector<unsigned char> file;
  cv::imencode(".png", picture, file, wishes);
  return {file.begin(), file.end()};
}

TEST(PlainPng, IsWhatOpenCvWrites) {
  for (const int type : {CV_8UC1, CV_8UC3}) {
    cv::Mat all(83, 131, type);
    cv::RNG(7).fill(all, cv::RNG::UNIFORM, 0, 256);
    all.rowRange(20, 60).setTo(cv::Scalar(90, 20, 200));
    for (const cv::Mat& picture : {all, all(cv::Rect(5, 7, 100, 60))}) {  // rows with and without a gap
      EXPECT_EQ(encoded_png(picture), by_opencv(picture, {}));
      EXPECT_EQ(encoded_png(picture, 4), by_opencv(picture, {cv::IMWRITE_PNG_COMPRESSION, 4}));
    }
  }
}

}  // namespace
}  // namespace vegard::fit::plain_png_test
