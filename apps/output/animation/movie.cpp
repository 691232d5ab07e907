#include "apps/output/animation/movie.h"

#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include "sim/base/error.h"
#include "sim/base/file/whole_file.h"

namespace vegard::apps {
namespace {

struct Codec {
  const char* name;
  char tag[4];
};
constexpr Codec kCodecs[] = {{"H.264", {'a', 'v', 'c', '1'}}, {"MPEG-4 part 2", {'m', 'p', '4', 'v'}}};

sim::Error trouble(sim::ErrorKind kind, const std::string& file, const std::string& problem,
                   const std::string& hint = {}) {
  return sim::Error(kind, problem).file(file).hint(hint);
}

/// While there is one, memory comes from malloc with zeros in it. libx264 (core 164) reads memory that it has
/// not written where the processor has AVX-512, and what was there before would decide about the movie's
/// bytes.
class ZeroedMemory {
 public:
  ZeroedMemory() { fill(0xff); }  // filled with the complement of that
  ~ZeroedMemory() { fill(0); }    // nothing is filled any more
  ZeroedMemory(const ZeroedMemory&) = delete;
  ZeroedMemory& operator=(const ZeroedMemory&) = delete;

 private:
  static void fill([[maybe_unused]] int with) {
#ifdef M_PERTURB  // glibc's
    ::mallopt(M_PERTURB, with);
#endif
  }
};

cv::Mat picture(const std::string& file) {
  cv::Mat read = cv::imread(file, cv::IMREAD_COLOR);
  if (read.empty())
    throw trouble(sim::ErrorKind::unreadable_input, file, "cannot be read as a picture",
                  "remove it, and it will be made again");
  return read;
}

/// True if the file decodes to so many frames of that size and rate: OpenCV's writer does not report a full
/// disk.
bool is_whole(const std::string& file, std::size_t frames, cv::Size size, double frames_per_second) {
  cv::VideoCapture movie;
  if (!movie.open(file, cv::CAP_FFMPEG)) return false;
  if (static_cast<int>(movie.get(cv::CAP_PROP_FRAME_WIDTH)) != size.width) return false;
  if (static_cast<int>(movie.get(cv::CAP_PROP_FRAME_HEIGHT)) != size.height) return false;
  // A single frame has no rate to be read.
  if (frames > 1 &&
      std::abs(movie.get(cv::CAP_PROP_FPS) - frames_per_second) > 0.002 * std::max(frames_per_second, 1.0))
    return false;
  std::size_t decoded = 0;
  while (movie.grab()) ++decoded;
  return decoded == frames;
}

}  // namespace

std::string write_movie(const std::string& path, const std::vector<std::string>& pictures,
                        double frames_per_second, bool overwrite, const std::function<void(double)>& progress,
                        const std::atomic<bool>* stop, bool all_around) {
  // Both print of their own accord, about codecs that they do not have and files that they cannot read.
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  ::setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", 0);  // FFmpeg's AV_LOG_QUIET
  sim::WholeFile file(path, overwrite);
  const ZeroedMemory zeroed;
  const cv::Size size = picture(pictures.front()).size();
  cv::VideoWriter writer;
  std::string codec;
  for (const Codec& c : kCodecs) {
    const int tag = cv::VideoWriter::fourcc(c.tag[0], c.tag[1], c.tag[2], c.tag[3]);
    if (!writer.open(file.temporary(), cv::CAP_FFMPEG, tag, frames_per_second, size)) continue;
    codec = c.name;
    break;
  }
  if (codec.empty())
    throw trouble(sim::ErrorKind::unwritable_output, path,
                  "cannot be encoded: no codec of OpenCV takes such a movie",
                  "write frames, and encode them with another program");
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    if (stop != nullptr && stop->load()) return {};
    const cv::Mat frame = picture(pictures[i]);
    if (frame.size() != size)
      throw trouble(sim::ErrorKind::unreadable_input, pictures[i], "has another size than the first frame");
    writer.write(frame);
    if (progress) progress(static_cast<double>(i + 1) / static_cast<double>(pictures.size()));
  }
  writer.release();
  if (all_around) mark_as_spherical(file.temporary(), path);
  if (!is_whole(file.temporary(), pictures.size(), size, frames_per_second))
    throw trouble(sim::ErrorKind::unwritable_output, path,
                  "cannot be written: what was encoded cannot be read again",
                  "is the disk full? The frames are still there");
  file.commit();
  return codec;
}

}  // namespace vegard::apps
