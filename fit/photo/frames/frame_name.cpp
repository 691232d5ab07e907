#include "fit/photo/frames/frame_name.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "sim/base/error.h"
#include "sim/base/number/quantile.h"
#include "sim/base/utc_time.h"

namespace vegard::fit {
namespace {

constexpr char kMark = '#';

/// Returns the largest difference between a time and the beginning of the frame that it chooses.
double reach_s(const std::vector<const FrameHead*>& timed) {
  std::vector<double> apart;
  for (std::size_t i = 1; i < timed.size(); ++i)
    apart.push_back(timed[i]->time->seconds - timed[i - 1]->time->seconds);
  constexpr double kOfOne_s = 1.0;
  if (apart.empty()) return std::max(kOfOne_s, timed.front()->exposure_s.value_or(0.0));
  return std::max(kOfOne_s, sim::median(apart));
}

}  // namespace

FrameName frame_name(const std::string& name) {
  const std::size_t mark = name.rfind(kMark);
  std::error_code ignored;
  if (mark == std::string::npos || mark == 0 || std::filesystem::exists(name, ignored)) return {name, {}, {}};
  const std::string which = name.substr(mark + 1);
  FrameName frame{name.substr(0, mark), {}, {}};
  constexpr std::size_t kMaxDigits = 9;
  if (!which.empty() && which.size() <= kMaxDigits &&
      which.find_first_not_of("0123456789") == std::string::npos)
    frame.number = std::stoi(which);
  else
    frame.utc_s = sim::utc_seconds(which);
  return frame.is_chosen() ? frame : FrameName{name, {}, {}};
}

std::string file_of_frame(const std::string& name) { return frame_name(name).file; }

std::string name_of_frame(const std::string& file, int number) {
  return file + kMark + std::to_string(number);
}

std::string stem_of_picture(const std::string& name) {
  const FrameName frame = frame_name(name);
  std::filesystem::path file = std::filesystem::path(frame.file).filename();
  if (file.extension() == ".gz" || file.extension() == ".tar") file = file.stem();
  std::string stem = file.stem().string();
  if (frame.number) stem += fmt::format("_{:04}", *frame.number);
  return stem;
}

int frame_at(const std::vector<FrameHead>& frames, double utc_s, const std::string& file) {
  std::vector<const FrameHead*> timed;
  for (const FrameHead& frame : frames)
    if (frame.time) timed.push_back(&frame);
  if (timed.empty())
    throw sim::unreadable(file, "no frame of it says when it was taken")
        .hint("choose one by its number: " + file + "#0");
  const auto distance = [&](const FrameHead* frame) { return std::abs(frame->time->seconds - utc_s); };
  const FrameHead* nearest = *std::min_element(
      timed.begin(), timed.end(), [&](const auto* a, const auto* b) { return distance(a) < distance(b); });
  if (distance(nearest) > reach_s(timed))
    throw sim::unreadable(file, "no frame of it was taken at " + sim::utc_text(utc_s))
        .expected(frames_text(frames));
  return nearest->number;
}

std::string frames_text(const std::vector<FrameHead>& frames) {
  std::string text = std::to_string(frames.size()) + (frames.size() == 1 ? " frame" : " frames");
  const auto has_time = [](const FrameHead& frame) { return frame.time.has_value(); };
  const auto first = std::find_if(frames.begin(), frames.end(), has_time);
  if (first == frames.end()) return text + ", of unknown times";
  const auto last = std::find_if(frames.rbegin(), frames.rend(), has_time);
  text += ", " + first->time->utc;
  return last->number == first->number ? text : text + " to " + last->time->utc;
}

std::string numbers_text(std::size_t frames) {
  return frames == 1 ? "#0" : "#0 to #" + std::to_string(frames - 1);
}

sim::Error no_frame_chosen(const std::vector<FrameHead>& frames, const std::string& file) {
  return sim::Error(sim::ErrorKind::usage, "there is more than one picture in it: " + frames_text(frames))
      .file(file)
      .expected(numbers_text(frames.size()) + " behind its name")
      .hint("or the time behind it, or --at; vegard describe lists them");
}

}  // namespace vegard::fit
