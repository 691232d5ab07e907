// What reading a photograph of 24 megapixels costs beside its decoding: averaged for a fit, and pixel by
// pixel; and what reading a minute of an imager's frames costs beside the unpacking of its bytes by zlib. Two
// threads at most. --tiny shrinks the work to a check that everything still runs.
#include <benchmark/benchmark.h>
#include <fmt/core.h>
#include <unistd.h>
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

/// A minute of THEMIS: 16-bit frames of 256 x 256 pixels with a camera's grain, gzipped, in a file of its
/// own. Its share of what is not packed is that of a moonlit night's, four fifths.
class MinuteOfFrames {
 public:
  explicit MinuteOfFrames(int count)
      : count_(count),
        path_(std::filesystem::temp_directory_path() /
              ("photo_bench_" + std::to_string(::getpid()) + ".pgm.gz")) {
    cv::RNG grain(2);
    constexpr int kSide = 256;
    const gzFile file = gzopen(path_.c_str(), "wb6");
    for (int frame = 0; frame < count; ++frame) {
      std::string bytes = fmt::format(
          "P5\n#\"Exposure options\" WIDTH=512 HEIGHT=256 XBIN=2 YBIN=1 MSEC=999\n"
          "#\"Image request start\" 2014-03-10 06:{:02}:{:02}.031212 UTC\n256 256\n65535\n",
          frame / 20, frame % 20 * 3);
      for (int pixel = 0; pixel < kSide * kSide; ++pixel) {
        const auto count_of = static_cast<int>(6000.0 + 8.0 * (pixel / kSide) + grain.gaussian(700.0));
        bytes += static_cast<char>(count_of >> 8);
        bytes += static_cast<char>(count_of & 0xff);
      }
      gzwrite(file, bytes.data(), static_cast<unsigned>(bytes.size()));
    }
    gzclose(file);
  }
  ~MinuteOfFrames() { std::filesystem::remove(path_); }
  MinuteOfFrames(const MinuteOfFrames&) = delete;
  MinuteOfFrames& operator=(const MinuteOfFrames&) = delete;

  int count() const { return count_; }
  const std::string& path() const { return path_; }

  void by_zlib() const {
    const gzFile file = gzopen(path_.c_str(), "rb");
    std::string block(1 << 16, '\0');
    while (gzread(file, block.data(), static_cast<unsigned>(block.size())) > 0)
      benchmark::DoNotOptimize(block.data());
    gzclose(file);
  }

  void by_reader() const {
    fit::FrameReader reader(path_);
    while (reader.next()) benchmark::DoNotOptimize(reader.take().data());
  }

 private:
  int count_;
  std::string path_;
};

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
  const MinuteOfFrames minute(tiny ? 2 : 20);
  add("frames_zlib", [&] { minute.by_zlib(); });
  add("frames", [&] { minute.by_reader(); });
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
