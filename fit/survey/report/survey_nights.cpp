#include "fit/survey/report/survey_nights.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "sim/base/error.h"
#include "sim/base/utc_time.h"

namespace vegard::fit {
namespace {

constexpr int kNightStep_s = 600, kNightDay_s = 86400, kNightSteps = kNightDay_s / kNightStep_s;

constexpr double kNoTime_s = 1e12;  ///< beyond all calendars, as SurveyReader has it

double second_of_day(double time_s) { return time_s - kNightDay_s * std::floor(time_s / kNightDay_s); }

void add_to_ranges(int frame, std::vector<FrameRange>& ranges) {
  if (!ranges.empty() && ranges.back().end == frame)
    ++ranges.back().end;
  else
    ranges.push_back({frame, frame + 1});
}

}  // namespace

int night_boundary_s(const std::vector<int>& frames_of_step) {
  const int steps = static_cast<int>(frames_of_step.size());
  const int least = *std::min_element(frames_of_step.begin(), frames_of_step.end());
  int best = 0, best_end = steps, run = 0;
  // Twice around: a stretch may go over midnight.
  for (int i = 0; i < 2 * steps; ++i) {
    run = frames_of_step[static_cast<std::size_t>(i % steps)] == least ? run + 1 : 0;
    if (run > best && run <= steps) best = run, best_end = i + 1;
  }
  const double middle = best_end - 0.5 * best;
  return static_cast<int>(middle * (kNightDay_s / steps)) % kNightDay_s;
}

SurveyNights survey_nights(const SqliteFile& database) {
  std::vector<int> frames_of_step(kNightSteps, 0);
  SqliteStatement times(database, "SELECT time_s FROM frame");
  while (times.step()) {
    const double time_s = times.number(0);
    if (!(std::abs(time_s) < kNoTime_s))
      sim::refuse_file(sim::ErrorKind::unreadable_input, database.name(), "has a frame of no time",
                       "a database of vegard survey");
    const double second = second_of_day(time_s);
    ++frames_of_step[static_cast<std::size_t>(
        std::clamp(static_cast<int>(second / kNightStep_s), 0, kNightSteps - 1))];
  }
  SurveyNights found;
  found.begins_at_s = night_boundary_s(frames_of_step);
  std::map<std::int64_t, std::map<std::string, std::vector<FrameRange>>> nights;
  SqliteStatement frames(database, "SELECT frame, camera, time_s FROM frame ORDER BY frame");
  while (frames.step()) {
    const double night = std::floor((frames.number(2) - found.begins_at_s) / kNightDay_s);
    add_to_ranges(static_cast<int>(frames.integer(0)),
                  nights[static_cast<std::int64_t>(night)][frames.text(1)]);
  }
  for (auto& [number, cameras] : nights) {
    SurveyNight night;
    night.begin_s = static_cast<double>(number) * kNightDay_s + found.begins_at_s;
    night.name = sim::utc_text(night.begin_s + kNightDay_s / 2.0).substr(0, 10);
    for (auto& [camera, ranges] : cameras) night.cameras.push_back({camera, std::move(ranges)});
    found.nights.push_back(std::move(night));
  }
  return found;
}

}  // namespace vegard::fit
