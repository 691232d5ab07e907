#include "fit/survey/survey.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "fit/photo/codec/picture_format.h"

namespace vegard::fit {

const char* survey_work_name(SurveyWork work) {
  static constexpr std::array names = {"filter", "border", "profile", "fit", "map"};
  return names[static_cast<std::size_t>(work)];
}

std::optional<SurveyWork> survey_work_of(const std::string& name) {
  for (const SurveyWork work : kSurveyWorks)
    if (name == survey_work_name(work)) return work;
  return std::nullopt;
}

std::string Survey::place(const std::string& name) const {
  return (std::filesystem::path(file).parent_path() / name).string();
}

const std::vector<std::string>& picture_endings() {
  static const std::vector<std::string> endings = [] {
    std::vector<std::string> all;
    for (const PictureFormat& format : picture_formats())
      all.insert(all.end(), format.endings.begin(), format.endings.end());
    return all;
  }();
  return endings;
}

FrameReference frame_reference(const std::string& text) {
  const std::size_t hash = text.rfind('#');
  constexpr std::size_t kMaxDigits = 6;
  if (hash == std::string::npos || hash == 0) return {text, std::nullopt};
  const std::string digits = text.substr(hash + 1);
  if (digits.empty() || digits.size() > kMaxDigits ||
      !std::all_of(digits.begin(), digits.end(), [](char c) { return c >= '0' && c <= '9'; }))
    return {text, std::nullopt};
  return {text.substr(0, hash), std::stoi(digits)};
}

bool is_plain_name(const std::string& name) {
  constexpr std::size_t kMaxLetters = 64;
  return !name.empty() && name.size() <= kMaxLetters && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
}

const char* frame_status_name(FrameStatus status) {
  static constexpr std::array names = {"done", "skipped", "missing", "unreadable", "filtered"};
  return names[static_cast<std::size_t>(status)];
}

std::optional<double> finite_or_none(double value) {
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

}  // namespace vegard::fit
