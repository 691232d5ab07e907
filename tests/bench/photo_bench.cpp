// What reading a photograph of 24 megapixels costs beside its decoding: averaged for a fit, and pixel by
// pixel. Two threads at most. --tiny shrinks the work to a check that everything still runs.
#include <benchmark/benchmark.h>
#include <fmt/core.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "fit/photo/photo.h"
#include "interleaved.h"

namespace {

using namespace vegard;

/// An arc in a dark sky with a camera's grain, as a JPEG of high quality.
std::string jpeg_of(int width, int height) {
  cv::Mat picture(height, width, CV_8UC3);
  cv::RNG grain(1);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double from_arc = 8.0 * (static_cast<double>(y) / height - 0.5 - 0.1 * std::sin(6.0 * x / width));
      const double light = 30.0 + 150.0 * std::exp(-from_arc * from_arc);
      picture.at<cv::Vec3b>(y, x) = {cv::saturate_cast<uchar>(0.5 * light + grain.gaussian(6.0)),
                                     cv::saturate_cast<uchar>(light + grain.gaussian(6.0)),
                                     cv::saturate_cast<uchar>(0.4 * light + grain.gaussian(6.0))};
    }
  std::vector<uchar> bytes;
  cv::imencode(".jpg", picture, bytes, {cv::IMWRITE_JPEG_QUALITY, 95});
  return {bytes.begin(), bytes.end()};
}

/// Of the decoding's time, everything that comes on top of it.
constexpr double kTarget = 1.2;

}  // namespace

int main(int argc, char** argv) {
  const bool tiny = bench::take_flag(argc, argv, "--tiny");
  const sim::PictureSize size = tiny ? sim::PictureSize{240, 160} : sim::PictureSize{6000, 4000};
  const std::string bytes = jpeg_of(size.width, size.height);
  const auto add = [](const char* name, const auto& work) {
    benchmark::RegisterBenchmark(name,
                                 [work](benchmark::State& state) {
                                   for (auto _ : state) work();
                                 })
        ->UseRealTime()
        ->Unit(benchmark::kMillisecond);
  };
  add("decode", [&] {
    const cv::Mat buffer(1, static_cast<int>(bytes.size()), CV_8U, const_cast<char*>(bytes.data()));
    benchmark::DoNotOptimize(cv::imdecode(buffer, cv::IMREAD_COLOR).data);
  });
  const auto read = [&](const fit::Averaging& averaging) {
    benchmark::DoNotOptimize(
        fit::read_photo_bytes(bytes, "made.jpg", fit::Decoding::automatic, nullptr, averaging)
            .linear.data.data());
  };
  add("averaged", [&] { read({size, {size.width / 8, size.height / 8}}); });
  add("pixels", [&] { read({}); });
  const bench::Timings timings = bench::run_interleaved(argc, argv).wall;
  fmt::print("\n{} x {}, {} bytes of JPEG\n", size.width, size.height, bytes.size());
  for (const char* name : {"decode", "averaged", "pixels"})
    if (timings.has(name)) fmt::print("  {}: {}\n", name, timings.words(name));
  if (timings.has("averaged") && timings.has("decode"))
    fmt::print("  averaged / decode (target <= {}): {}\n", kTarget, timings.ratio("averaged", "decode"));
  return 0;
}
