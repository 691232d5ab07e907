// An hour of THEMIS, sixty gzipped files of twenty 16-bit frames, read frame by frame: frames a second, and
// how much memory that takes at most; and the same made into photographs of linear light. "tiny" makes two
// short files of it. Exit code 1 where a target is missed.
#include <fmt/core.h>
#include <malloc.h>
#include <time.h>

#include <algorithm>
#include <deque>
#include <string>

#include "fit/photo/frames/frame_file.h"
#include "fit/photo/frames/picture_bytes.h"
#include "fit/photo/photo.h"
#include "minute_of_frames.h"

namespace {

using namespace vegard;

constexpr double kFramesPerSecond = 500.0;
/// A frame's bytes, and what a stream of gzip holds whatever its frames are: zlib's window of 32 kB and
/// state, a block of packed bytes and one of those looked at, 64 kB each.
constexpr double kFrameBytes = 2.0 * bench::MinuteOfFrames::kSide * bench::MinuteOfFrames::kSide;
constexpr double kStreamBytes = 200e3, kMaxFramesHeld = 2.0;

/// Of this thread's processor, which the other users of the machine disturb less than the clock on the wall.
double processor_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// All that malloc has given out by now.
double held_bytes() {
  const struct mallinfo2 heap = mallinfo2();
  return static_cast<double>(heap.uordblks + heap.hblkhd);
}

struct Measured {
  int frames = 0;
  double seconds = 0.0, max_bytes = 0.0;
};

/// `use` is given each frame's bytes.
template <class Use>
Measured read_hour(const std::deque<bench::MinuteOfFrames>& hour, const Use& use) {
  Measured measured;
  const double before_bytes = held_bytes(), begin_s = processor_s();
  for (const bench::MinuteOfFrames& minute : hour) {
    fit::FrameReader reader(minute.path());
    while (reader.next()) {
      const std::string frame = reader.take();
      use(frame);
      measured.max_bytes = std::max(measured.max_bytes, held_bytes() - before_bytes);
      ++measured.frames;
    }
  }
  measured.seconds = processor_s() - begin_s;
  return measured;
}

}  // namespace

int main(int argc, char** argv) {
  const bool tiny = argc > 1 && std::string(argv[1]) == "tiny";
  std::deque<bench::MinuteOfFrames> hour;
  for (int minute = 0; minute < (tiny ? 2 : 60); ++minute) hour.emplace_back(minute, tiny ? 3 : 20);
  std::size_t bytes = 0;
  const Measured plain = read_hour(hour, [&](const std::string& frame) { bytes += frame.size(); });
  const Measured light = read_hour(hour, [&](const std::string& frame) {
    bytes += fit::read_photo_bytes(frame, "frame.pgm", fit::Decoding::automatic).linear.data.size();
  });
  const double frames_held = (plain.max_bytes - kStreamBytes) / kFrameBytes;
  const double rate = plain.frames / plain.seconds;
  fmt::print("{} files, {} frames of 256 x 256, {} bytes\n", hour.size(), plain.frames, bytes);
  fmt::print("  frames: {:.0f} a second (target >= {})\n", rate, kFramesPerSecond);
  fmt::print("  memory: {:.0f} bytes at most, the stream's {:.0f} and {:.2f} frames (target <= {})\n",
             plain.max_bytes, kStreamBytes, frames_held, kMaxFramesHeld);
  fmt::print("  photographs of them: {:.0f} a second\n", light.frames / light.seconds);
  return (tiny || rate >= kFramesPerSecond) && frames_held <= kMaxFramesHeld ? 0 : 1;
}
