// What reading a photograph of 24 megapixels costs beside its decoding: averaged for a fit, and pixel by
// pixel; and what reading a minute of an imager's frames costs beside the unpacking of its bytes by zlib. Two
// threads at most. --tiny shrinks the work to a check that everything still runs.
#include <benchmark/benchmark.h>
#include <fmt/core.h>
#include <zlib.h>

#include <cmath>
#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "fit/photo/frames/frame_file.h"
#include "fit/photo/photo.h"
#include "interleaved.h"
#include "minute_of_frames.h"

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
constexpr double kFramesPerSecond = 500.0, kFilesPerSecond = 60.0;

/// What reading a minute of frames is compared with.
void unpack_by_zlib(const std::string& path) {
  const gzFile file = gzopen(path.c_str(), "rb");
  std::string block(1 << 16, '\0');
  while (gzread(file, block.data(), static_cast<unsigned>(block.size())) > 0)
    benchmark::DoNotOptimize(block.data());
  gzclose(file);
}

void read_frames(const std::string& path) {
  fit::FrameReader reader(path);
  while (reader.next()) benchmark::DoNotOptimize(reader.take().data());
}

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
  const bench::MinuteOfFrames minute(0, tiny ? 2 : 20);
  add("frames_zlib", [&] { unpack_by_zlib(minute.path()); });
  add("frames", [&] { read_frames(minute.path()); });
  add("frame_index", [&] { benchmark::DoNotOptimize(fit::frame_index(minute.path()).frames.data()); });
  const bench::TimingsByClock clocks = bench::run_interleaved(argc, argv);
  const bench::Timings& timings = clocks.wall;
  fmt::print("\n{} x {}, {} bytes of JPEG\n", size.width, size.height, bytes.size());
  for (const char* name : {"decode", "averaged", "pixels"})
    if (timings.has(name)) fmt::print("  {}: {}\n", name, timings.words(name));
  if (timings.has("averaged") && timings.has("decode"))
    fmt::print("  averaged / decode (target <= {}): {}\n", kTarget, timings.ratio("averaged", "decode"));
  // One thread does it all: its own clock.
  const bench::Timings& own = clocks.processor;
  fmt::print("\n{} frames of 256 x 256, gzipped to {} bytes\n", minute.count(),
             std::filesystem::file_size(minute.path()));
  for (const char* name : {"frames_zlib", "frames", "frame_index"})
    if (own.has(name)) fmt::print("  {}: {}\n", name, own.words(name));
  if (own.has("frames") && own.has("frames_zlib"))
    fmt::print("  frames / zlib: {}; {:.0f} frames a second (target >= {})\n",
               own.ratio("frames", "frames_zlib"), minute.count() / own.median("frames"), kFramesPerSecond);
  if (own.has("frame_index"))
    fmt::print("  indexes: {:.0f} files a second (target >= {})\n", 1.0 / own.median("frame_index"),
               kFilesPerSecond);
  return 0;
}
