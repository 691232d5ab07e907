#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include "apps/output/animation/movie_writer.h"
#include "sim/base/module.h"

namespace vegard::apps {
namespace {

struct Codec {
  const char* name;
  char tag[4];
};
constexpr Codec kCodecs[] = {{"H.264", {'a', 'v', 'c', '1'}}, {"MPEG-4 part 2", {'m', 'p', '4', 'v'}}};

class OpenCvMovie : public MovieWriter {
 public:
  MoviePicture open(const std::string& path, const std::string& first, double frames_per_second) override {
    // Both print of their own accord, about codecs that they do not have and files that they cannot read.
    cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
    ::setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", 0);  // FFmpeg's AV_LOG_QUIET
    path_ = path;
    frames_per_second_ = frames_per_second;
    size_ = cv::imread(first, cv::IMREAD_COLOR).size();
    if (size_.empty()) return MoviePicture::unreadable;
    for (const Codec& c : kCodecs) {
      const int tag = cv::VideoWriter::fourcc(c.tag[0], c.tag[1], c.tag[2], c.tag[3]);
      if (!writer_.open(path_, cv::CAP_FFMPEG, tag, frames_per_second_, size_)) continue;
      codec_ = c.name;
      break;
    }
    return MoviePicture::good;
  }

  std::string codec() const override { return codec_; }

  MoviePicture write(const std::string& picture) override {
    const cv::Mat frame = cv::imread(picture, cv::IMREAD_COLOR);
    if (frame.empty()) return MoviePicture::unreadable;
    if (frame.size() != size_) return MoviePicture::of_other_size;
    writer_.write(frame);
    return MoviePicture::good;
  }

  void finish() override { writer_.release(); }

  bool is_whole(std::size_t frames) const override {
    cv::VideoCapture movie;
    if (!movie.open(path_, cv::CAP_FFMPEG)) return false;
    if (static_cast<int>(movie.get(cv::CAP_PROP_FRAME_WIDTH)) != size_.width) return false;
    if (static_cast<int>(movie.get(cv::CAP_PROP_FRAME_HEIGHT)) != size_.height) return false;
    // A single frame has no rate to be read.
    if (frames > 1 && std::abs(movie.get(cv::CAP_PROP_FPS) - frames_per_second_) >
                          0.002 * std::max(frames_per_second_, 1.0))
      return false;
    std::size_t decoded = 0;
    while (movie.grab()) ++decoded;
    return decoded == frames;
  }

 private:
  std::string path_, codec_;
  double frames_per_second_ = 0.0;
  cv::Size size_;
  cv::VideoWriter writer_;
};

std::unique_ptr<MovieWriter> writer() { return std::make_unique<OpenCvMovie>(); }

constexpr MovieModule functions{writer};

}  // namespace
}  // namespace vegard::apps

VEGARD_MODULE(&vegard::apps::functions);
