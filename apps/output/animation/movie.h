// Encodes frames on a disk as one movie file. The only part of the command that uses OpenCV.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

namespace vegard::apps {

/// Encodes 8-bit RGB pictures, all of the same even width and height, as an MP4: H.264 if OpenCV's FFmpeg has
/// it, else MPEG-4 part 2. Decodes the movie again to check that it is complete, then moves it durably to its
/// name; without `overwrite` it never replaces another file. Returns the name of the codec, or an empty text
/// if `stop` ended the work: nothing is left behind then. The same pictures give the same bytes in every run
/// on one machine; those of H.264 depend on the number of cores. `all_around`: the pictures are
/// equirectangular, and the movie is marked so (apps/output/animation/spherical_video.h). Throws
/// Error(existing_output), Error(unwritable_output), Error(unreadable_input) for a picture.
std::string write_movie(const std::string& path, const std::vector<std::string>& pictures,
                        double frames_per_second, bool overwrite,
                        const std::function<void(double)>& progress = {},
                        const std::atomic<bool>* stop = nullptr, bool all_around = false);

}  // namespace vegard::apps
