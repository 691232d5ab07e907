#include "apps/output/animation/animation_frames.h"

#include <algorithm>
#include <charconv>
#include <filesystem>

#include "apps/options/refusals.h"

namespace vegard::apps {
namespace fs = std::filesystem;
namespace {

constexpr int kMaxDigits = 8;
constexpr int kLargestFrame = 99999999;

std::optional<int> number(const std::string& digits) {
  int value = 0;
  const char* end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, value);
  if (error != std::errc() || stop != end || value < 0 || value > kLargestFrame) return {};
  return value;
}

}  // namespace

FrameNames::FrameNames(const std::string& pattern) {
  const fs::path path(pattern);
  folder_ = path.has_parent_path() ? path.parent_path().string() : ".";
  const std::string name = path.filename().string();
  const std::size_t first = std::min(name.find('#'), name.size());
  const std::size_t end = std::min(name.find_first_not_of('#', first), name.size());
  digits_ = static_cast<int>(end - first);
  const std::string hint = "as in frames/####.exr, whose frame 7 is frames/0007.exr";
  if (digits_ == 0)
    throw usage_error("--output", "'" + pattern + "' does not say where the frame's number goes",
                      "a file name with one run of #, or a name that ends in .mp4", hint);
  if (name.find('#', end) != std::string::npos)
    throw usage_error("--output", "'" + pattern + "' has more than one run of # in its file name",
                      "one run of #", hint);
  if (digits_ > kMaxDigits)
    throw usage_error("--output", "'" + pattern + "' has more than " + std::to_string(kMaxDigits) + " #",
                      "fewer #", hint);
  before_ = name.substr(0, first);
  after_ = name.substr(end);
}

std::string FrameNames::file(int frame) const {
  const std::string plain = std::to_string(frame);
  const std::string zeros(std::max(0, digits_ - static_cast<int>(plain.size())), '0');
  const std::string name = before_ + zeros + plain + after_;
  return folder_ == "." ? name : folder_ + (folder_.back() == '/' ? "" : "/") + name;
}

std::optional<int> FrameNames::frame_of(const std::string& name) const {
  if (name.size() != before_.size() + digits_ + after_.size()) return {};
  if (name.compare(0, before_.size(), before_) != 0) return {};
  if (name.compare(before_.size() + digits_, std::string::npos, after_) != 0) return {};
  const std::string digits = name.substr(before_.size(), digits_);
  if (digits.find_first_not_of("0123456789") != std::string::npos) return {};
  return number(digits);
}

void FrameNames::check_room_for(int frame) const {
  if (static_cast<int>(std::to_string(frame).size()) > digits_)
    throw usage_error("--output", "there is no room for frame " + std::to_string(frame) + " in " + pattern(),
                      "more #");
}

std::string FrameNames::companion(const std::string& kind) const {
  std::string base = before_ + after_.substr(0, after_.rfind('.'));
  const std::size_t last = base.find_last_not_of("_-. ");
  base.resize(last == std::string::npos ? 0 : last + 1);
  const std::string name = (base.empty() ? "" : base + ".") + kind;
  return folder_ == "." ? name : folder_ + (folder_.back() == '/' ? "" : "/") + name;
}

std::vector<int> frames_from_words(const std::string& words) {
  const auto refuse = [&] {
    return usage_error("--frames", "'" + words + "' names no frames", "FIRST:LAST or FIRST:LAST:STEP",
                       "as in 0:59, the first second at 60 frames per second");
  };
  std::vector<int> parts;
  std::size_t begin = 0;
  while (begin <= words.size()) {
    const std::size_t end = std::min(words.find(':', begin), words.size());
    const std::optional<int> part = number(words.substr(begin, end - begin));
    if (!part) throw refuse();
    parts.push_back(*part);
    begin = end + 1;
  }
  if (parts.size() < 2 || parts.size() > 3) throw refuse();
  const int step = parts.size() == 3 ? parts[2] : 1;
  if (step < 1 || parts[1] < parts[0]) throw refuse();
  std::vector<int> frames;
  for (int frame = parts[0]; frame <= parts[1]; frame += step) frames.push_back(frame);
  return frames;
}

sim::Scene scene_of_frame(const sim::Scene& scene, int frame, double frames_per_second) {
  sim::Scene at = scene;
  at.time.start_s += frame / frames_per_second * scene.time.lapse;
  return at;
}

}  // namespace vegard::apps
