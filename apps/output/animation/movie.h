// Frames on a disk as one movie file. The only part of the command that knows of OpenCV.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

namespace vegard::apps {

/// Encodes 8-bit RGB pictures, all of one even width and height, as an MP4: H.264 if OpenCV's FFmpeg has it,
/// else MPEG-4 part 2. Decodes it once more to see that it is whole, then makes it durable under its name;
/// without `overwrite` never in the place of another file. Returns the name of the codec, empty if `stop`
/// ended the work: nothing is left behind then. The same pictures give the same bytes on every run on one
/// machine; H.264's depend on how many cores it has.
/// `all_around`: they are equirectangular, and the movie says so (apps/output/animation/spherical_video.h).
/// Throws Error(existing_output), Error(unwritable_output), Error(unreadable_input) for a picture.
std::string write_movie(const std::string& path, const std::vector<std::string>& pictures,
                        double frames_per_second, bool overwrite,
                        const std::function<void(double)>& progress = {},
                        const std::atomic<bool>* stop = nullptr, bool all_around = false);

}  // namespace vegard::apps
