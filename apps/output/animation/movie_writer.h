// FFmpeg's encoder and OpenCV's decoder of movies, which a module calls (sim/base/module.h).
#pragma once

#include <cstddef>
#include <memory>
#include <string>

namespace vegard::apps {

enum class MoviePicture { good, unreadable, of_other_size };

/// What a movie's file is: an MP4 of H.264 with 8 bits, for people who look at it; or QuickTime with ProRes
/// 422 HQ of 10 bits, each frame by itself, for programs that cut and grade.
enum class MovieKind { mp4, prores };

/// One movie.
class MovieWriter {
 public:
  virtual ~MovieWriter() = default;

  /// Begins a movie of the size of the picture in the file `first`. `rate_factor`: H.264's, which ProRes does
  /// not have.
  virtual MoviePicture open(const std::string& path, MovieKind kind, const std::string& first,
                            double frames_per_second, double rate_factor) = 0;
  /// Returns the codec's name, empty if there is none for such a movie.
  virtual std::string codec() const = 0;
  /// Adds the picture of a file.
  virtual MoviePicture write(const std::string& picture) = 0;
  virtual void finish() = 0;
  /// After finish(): true if the file decodes to so many frames of the size and rate. The writer does not
  /// report a full disk.
  virtual bool is_whole(std::size_t frames) const = 0;
};

struct MovieModule {
  static constexpr const char* module = "vegard_movie";

  std::unique_ptr<MovieWriter> (*writer)();
};

}  // namespace vegard::apps
