// A minute of THEMIS as its cameras write it: 16-bit frames of 256 x 256 pixels with a camera's grain, three
// seconds apart, gzipped, in a file of its own that goes with the object. Its share of what gzip leaves is
// that of a moonlit night's, four fifths.
#pragma once

#include <fmt/core.h>
#include <unistd.h>
#include <zlib.h>

#include <filesystem>
#include <opencv2/core.hpp>
#include <string>

namespace vegard::bench {

class MinuteOfFrames {
 public:
  static constexpr int kSide = 256;

  /// `minute` of the hour, 0 to 59, is that of the frames' times and the seed of their grain.
  MinuteOfFrames(int minute, int count)
      : count_(count),
        path_(std::filesystem::temp_directory_path() /
              fmt::format("frames_{}_20140310_06{:02}_gill_themis19_full.pgm.gz", ::getpid(), minute)) {
    cv::RNG grain(static_cast<std::uint64_t>(minute) + 2);
    const gzFile file = gzopen(path_.c_str(), "wb6");
    for (int frame = 0; frame < count; ++frame) {
      std::string bytes = fmt::format(
          "P5\n#\"Exposure options\" WIDTH=512 HEIGHT=256 XBIN=2 YBIN=1 MSEC=999\n"
          "#\"Image request start\" 2014-03-10 06:{:02}:{:02}.031212 UTC\n256 256\n65535\n",
          minute, frame % 20 * 3);
      for (int pixel = 0; pixel < kSide * kSide; ++pixel) {
        const auto count_of = static_cast<int>(6000.0 + 8.0 * (pixel / kSide) + grain.gaussian(700.0));
        bytes += static_cast<char>(count_of >> 8);
        bytes += static_cast<char>(count_of & 0xff);
      }
      gzwrite(file, bytes.data(), static_cast<unsigned>(bytes.size()));
    }
    gzclose(file);
  }
  ~MinuteOfFrames() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  MinuteOfFrames(const MinuteOfFrames&) = delete;
  MinuteOfFrames& operator=(const MinuteOfFrames&) = delete;

  int count() const { return count_; }
  const std::string& path() const { return path_; }

 private:
  int count_;
  std::string path_;
};

}  // namespace vegard::bench
