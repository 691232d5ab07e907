// A movie read back: as many frames, of that size and rate, and they look like what was rendered.
#include "apps/output/animation/movie.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>
#include <set>

#include "apps/output/animation/animation_frames.h"
#include "fit/photo/frames/frame_store.h"
#include "fit/photo/frames/picture_bytes.h"
#include "sim/base/picture/image_io.h"
#include "sim/render/render.h"
#include "tests/support/expect_error.h"
#include "tests/support/small_scene.h"
#include "tests/support/temporary_folder.h"

namespace vegard::apps::movie_test {
namespace {

using tests::TemporaryFolder;

constexpr int kFrames = 12;
constexpr double kFramesPerSecond = 30.0;

std::vector<std::string> rendered_frames(const TemporaryFolder& folder) {
  sim::Scene scene = tests::small_scene();
  scene.sensor.gain_per_kilorayleigh = 0.2;
  scene.sheets[0].drift_km_s = {0.0, 100.0};
  scene.emission.lag = sim::EmissionLag::none;  // red trails are all grain, which H.264 smooths
  std::vector<std::string> files;
  for (int frame = 0; frame < kFrames; ++frame) {
    const sim::Scene now = scene_of_frame(scene, frame, kFramesPerSecond);
    files.push_back(folder / (std::to_string(frame) + ".png"));
    sim::write_display(files.back(), sim::display_picture(now, sim::render(now)), 8, 92, {});
  }
  return files;
}

double psnr_db(const cv::Mat& a, const cv::Mat& b) {
  const double error = cv::norm(a, b, cv::NORM_L2SQR) / (static_cast<double>(a.total()) * a.channels());
  return 10.0 * std::log10(255.0 * 255.0 / error);
}

TEST(Movie, ReadBackIsWhatWasRendered) {
  const TemporaryFolder folder;
  const std::vector<std::string> frames = rendered_frames(folder);
  const std::string movie = folder / "movie.mp4";
  double share = 0.0;
  const std::string codec =
      write_movie(movie, frames, kFramesPerSecond, false, [&](double so_far) { share = so_far; });
  EXPECT_FALSE(codec.empty());
  EXPECT_EQ(share, 1.0);
  cv::VideoCapture capture(movie, cv::CAP_FFMPEG);
  ASSERT_TRUE(capture.isOpened());
  EXPECT_EQ(capture.get(cv::CAP_PROP_FRAME_WIDTH), 160);
  EXPECT_EQ(capture.get(cv::CAP_PROP_FRAME_HEIGHT), 120);
  EXPECT_NEAR(capture.get(cv::CAP_PROP_FPS), kFramesPerSecond, 1e-3);
  EXPECT_EQ(capture.get(cv::CAP_PROP_FRAME_COUNT), kFrames);
  std::vector<cv::Mat> rendered;
  for (const std::string& file : frames) rendered.push_back(cv::imread(file));
  cv::Mat read;
  int count = 0;
  for (; capture.read(read); ++count) {
    ASSERT_LT(count, kFrames);
    // H.264 halves the colours' resolution and smooths some grain: measured, 40 dB.
    const double own = psnr_db(read, rendered[count]);
    EXPECT_GT(own, 37.0) << count;
    if (count > 0) {
      EXPECT_GT(own, psnr_db(read, rendered[count - 1]) + 2.0) << "the frame before?";
    }
  }
  EXPECT_EQ(count, kFrames);
}

/// Mean change of green from pixel to pixel over two columns: the rays' contrast.
double contrast(const cv::Mat& picture) {
  double sum = 0.0;
  for (int y = 0; y < picture.rows; ++y)
    for (int x = 1; x + 1 < picture.cols; ++x)
      sum += std::abs(2.0 * picture.at<cv::Vec3b>(y, x)[1] - picture.at<cv::Vec3b>(y, x - 1)[1] -
                      picture.at<cv::Vec3b>(y, x + 1)[1]);
  return sum / (picture.rows * (picture.cols - 2));
}

TEST(Movie, KeepsTheRaysAtItsUsualQuality) {
  const TemporaryFolder folder;
  const std::vector<std::string> frames = rendered_frames(folder);
  double kept[2];
  for (const int rough : {0, 1}) {
    const std::string movie = folder / (std::to_string(rough) + ".mp4");
    write_movie(movie, frames, kFramesPerSecond, false, {}, nullptr, false, rough == 1 ? 40 : kMovieQuality);
    cv::VideoCapture capture(movie, cv::CAP_FFMPEG);
    cv::Mat read;
    double of_movie = 0.0, of_frames = 0.0;
    for (const std::string& file : frames) {
      ASSERT_TRUE(capture.read(read));
      of_movie += contrast(read);
      of_frames += contrast(cv::imread(file));
    }
    kept[rough] = of_movie / of_frames;
  }
  EXPECT_GT(kept[0], 0.9);
  EXPECT_LT(kept[1], 0.8);  // what a rate factor of 30 does, or this says nothing
}

/// Leaves its mark on memory that is free.
void mark_free_memory(int mark) {
  std::vector<std::vector<char>> blocks;
  for (std::size_t i = 0; i < 3000; ++i)
    blocks.emplace_back(16 + i * 7919 % 3000 * (i % 10 == 0 ? 30 : 1), mark);
}

TEST(Movie, DoesNotDependOnWhatMemoryHeldBefore) {
  // Where libx264 reads what it has not written, it does so in small pictures before all.
  constexpr int kSide = 32;
  const TemporaryFolder folder;
  std::vector<std::string> frames;
  for (int frame = 0; frame < kFrames; ++frame) {
    cv::Mat picture(kSide, kSide, CV_8UC3);
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x)
        for (int c = 0; c < 3; ++c)
          picture.at<cv::Vec3b>(y, x)[c] = static_cast<unsigned char>(
              128.0 + 100.0 * std::sin(0.1 * x * (c + 1) + 0.05 * y + 0.3 * frame));
    frames.push_back(folder / (std::to_string(frame) + ".png"));
    ASSERT_TRUE(cv::imwrite(frames.back(), picture));
  }
  std::string first;
  for (const int mark : {0, 85, 170, 255}) {
    mark_free_memory(mark);
    write_movie(folder / "movie.mp4", frames, kFramesPerSecond, true);
    const std::string bytes = tests::bytes_of(folder / "movie.mp4");
    if (first.empty()) first = bytes;
    EXPECT_TRUE(bytes == first) << "other bytes after " << mark;
  }
}

// A slow ramp has as many steps as its bits: 17 codes of 8 bits, 55 of 10 in limited range.
TEST(Movie, OfProResHasTenBits) {
  constexpr int kWidth = 256, kHeight = 32, kDark = 20000, kStep = 16;
  const TemporaryFolder folder;
  cv::Mat picture(kHeight, kWidth, CV_16UC3);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const auto grey = static_cast<std::uint16_t>(kDark + kStep * x);
      picture.at<cv::Vec3w>(y, x) = {grey, grey, grey};
    }
  std::vector<std::string> frames;
  for (int frame = 0; frame < 3; ++frame) {
    frames.push_back(folder / (std::to_string(frame) + ".png"));
    ASSERT_TRUE(cv::imwrite(frames.back(), picture));
  }
  const std::string movie = folder / "film.mov";
  EXPECT_EQ(write_movie(movie, frames, 25.0, false), "ProRes 422 HQ");
  write_movie(folder / "again.mov", frames, 25.0, false);
  EXPECT_TRUE(tests::bytes_of(movie) == tests::bytes_of(folder / "again.mov"));
  fit::PictureSeries series;
  const std::string bytes = series.read(fit::name_of_frame(movie, 2)).bytes;
  const cv::Mat read = cv::imdecode(std::vector<unsigned char>(bytes.begin(), bytes.end()),
                                    cv::IMREAD_COLOR | cv::IMREAD_ANYDEPTH);
  ASSERT_EQ(read.size(), picture.size());
  ASSERT_EQ(read.depth(), CV_16U);
  std::set<int> greens;
  for (int x = 0; x < kWidth; ++x) {
    const int green = read.at<cv::Vec3w>(kHeight / 2, x)[1];
    EXPECT_NEAR(green, kDark + kStep * x, 200) << x;  // a code of 8 bits is 257
    greens.insert(green);
  }
  EXPECT_GT(greens.size(), 40u);
}

TEST(Movie, HasTheSameBytesOnEveryRun) {
  const TemporaryFolder folder;
  const std::vector<std::string> frames = rendered_frames(folder);
  write_movie(folder / "one.mp4", frames, kFramesPerSecond, false);
  write_movie(folder / "two.mp4", frames, kFramesPerSecond, false);
  EXPECT_EQ(tests::bytes_of(folder / "one.mp4"), tests::bytes_of(folder / "two.mp4"));
}

TEST(Movie, AppearsWholeOrNotAtAll) {
  const TemporaryFolder folder;
  std::vector<std::string> frames = rendered_frames(folder);
  const std::string movie = folder / "movie.mp4";
  const std::atomic<bool> stop{true};
  EXPECT_EQ(write_movie(movie, frames, kFramesPerSecond, false, {}, &stop), "");
  EXPECT_EQ(folder.entries(), kFrames);
  {
    const tests::FullDisk full(2000);
    tests::expect_words(sim::ErrorKind::unwritable_output, {movie},
                        [&] { write_movie(movie, frames, kFramesPerSecond, false); });
  }
  EXPECT_EQ(folder.entries(), kFrames);
  tests::put(movie, "precious");
  tests::expect_words(sim::ErrorKind::existing_output, {movie},
                      [&] { write_movie(movie, frames, kFramesPerSecond, false); });
  EXPECT_EQ(tests::bytes_of(movie), "precious");
  tests::put(frames[5], "no picture");
  tests::expect_words(sim::ErrorKind::unreadable_input, {frames[5]},
                      [&] { write_movie(movie, frames, kFramesPerSecond, true); });
  EXPECT_EQ(tests::bytes_of(movie), "precious");
}

}  // namespace
}  // namespace vegard::apps::movie_test
