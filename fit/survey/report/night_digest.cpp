#include "fit/survey/report/night_digest.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "fit/border/border_distance.h"
#include "fit/survey/survey_physics.h"
#include "sim/base/error.h"
#include "sim/base/number/constants.h"
#include "sim/base/number/quantile.h"
#include "sim/base/utc_time.h"

namespace vegard::fit {
namespace {

constexpr std::size_t kNamedFrames = 5, kMaxReasons = 60;
constexpr double kHour_s = 3600.0, kMinute_s = 60.0;
constexpr const char* kOtherReasons = "other reasons";

/// Returns the words without their numbers: that of "the file ends after 3000 bytes" is another in every
/// frame.
std::string without_numbers(const std::string& words) {
  std::string text;
  bool in_number = false;
  for (const char c : words) {
    const bool is_digit = c >= '0' && c <= '9';
    const bool goes_on = is_digit || (in_number && (c == '.' || c == 'e'));
    if (!goes_on) text += c;
    if (is_digit && !in_number) text += "\u2026";
    in_number = goes_on;
  }
  return text;
}

/// Returns the entry of a reason; beyond kMaxReasons of them, the common entry of all others.
FailedFrames& failures_of(const std::string& reason, Failures& failures) {
  const bool is_new = failures.count(reason) == 0;
  return failures[is_new && failures.size() >= kMaxReasons ? kOtherReasons : reason];
}

void add_failure(const std::string& reason, const FrameAnswer& answer, Failures& failures) {
  FailedFrames& failed = failures_of(reason, failures);
  ++failed.frames;
  if (failed.some.size() < kNamedFrames)
    failed.some.push_back({answer.frame, answer.file, sim::utc_text(answer.time_s)});
}

bool is_believed(const WorkAnswer& work) { return work.verdict == "good" || work.verdict == "doubtful"; }

/// Returns the brightest trace; none if one of its angles is missing.
std::optional<BorderAtTime> border_of(double time_s, const WorkAnswer& work) {
  BorderAtTime border;
  border.time_s = time_s;
  border.sigma_deg = sim::kNaN;
  border.is_good = work.verdict == "good";
  const std::array<std::pair<const char*, double*>, 5> angles = {
      {{"from azimuth", &border.from_azimuth_deg},
       {"to azimuth", &border.to_azimuth_deg},
       {"nearest azimuth", &border.highest_azimuth_deg},
       {"lowest elevation", &border.lowest_deg},
       {"highest elevation", &border.highest_deg}}};
  std::size_t known = 0;
  for (const SurveyQuantity& q : work.quantities)
    for (const auto& [name, angle] : angles) {
      if (q.item != 1 || q.name != name || !q.value) continue;
      *angle = *q.value;
      if (angle == &border.highest_deg) border.sigma_deg = q.sigma.value_or(sim::kNaN);
      ++known;
    }
  return known == angles.size() ? std::optional(border) : std::nullopt;
}

class NightReading {
 public:
  NightReading(NightDigest& digest, const SiteOfBlock& site, const std::string& database)
      : digest_(digest), site_(site), database_(database) {}

  void take(const FrameAnswer& answer) {
    if (digest_.frames == 0) digest_.first_s = digest_.last_s = answer.time_s;
    digest_.first_s = std::min(digest_.first_s, answer.time_s);
    digest_.last_s = std::max(digest_.last_s, answer.time_s);
    ++digest_.frames;
    ++digest_.statuses[answer.status];
    ++digest_.frames_of_minute[static_cast<std::int64_t>(std::floor(answer.time_s / kMinute_s))];
    if (answer.status != FrameStatus::done)
      add_failure(std::string(frame_status_name(answer.status)) + ": " +
                      without_numbers(answer.reason.value_or("no reason is given")),
                  answer, digest_.failures);
    const int hour = static_cast<int>(std::floor(answer.time_s / kHour_s)) % 24;
    for (const WorkAnswer& work : answer.works) {
      ++digest_.verdicts[work.work][work.verdict];
      ++digest_.verdicts_of_hour[hour < 0 ? hour + 24 : hour][work.work][work.verdict];
      if (work.verdict == "refused" || work.verdict == "failed")
        add_failure(std::string(survey_work_name(work.work)) + " " + work.verdict + ": " +
                        without_numbers(work.words.value_or("no reason is given")),
                    answer, digest_.failures);
      if (work.physics) digest_.fits.push_back({answer.file, answer.time_s, frame_of_night(work, database_)});
      if (is_believed(work)) follow(answer, work);
    }
  }

  void finish() {
    for (auto& [key, series] : series_) digest_.series.push_back(std::move(series));
    if (!digest_.energies.empty()) digest_.why_no_flux.clear();
  }

 private:
  void follow(const FrameAnswer& answer, const WorkAnswer& work) {
    const bool is_good = work.verdict == "good";
    if (work.work == SurveyWork::border)
      if (const std::optional<BorderAtTime> border = border_of(answer.time_s, work))
        digest_.borders.push_back(*border);
    std::map<std::string, EnergyAndFlux> by_owner;
    std::map<FollowedKind, double> first;
    for (const SurveyQuantity& q : work.quantities) {
      const std::optional<FollowedKind> kind = followed_kind(work.work, q);
      if (!kind) continue;
      if (*kind == FollowedKind::flux && !q.value && q.reason) digest_.why_no_flux = *q.reason;
      if (!q.value) continue;
      first.emplace(*kind, *q.value);
      if (*kind == FollowedKind::energy) by_owner[owner_of_quantity(q.name)].energy_kev = *q.value;
      if (*kind == FollowedKind::flux) by_owner[owner_of_quantity(q.name)].flux_mw_m2 = *q.value;
      FollowedSeries& series = series_[{*kind, q.name, q.unit}];
      series.work = work.work;
      series.kind = *kind;
      series.name = q.name;
      series.unit = q.unit;
      series.points.push_back({answer.time_s, *q.value, q.sigma.value_or(sim::kNaN), is_good});
    }
    for (const auto& [owner, pair] : by_owner)
      if (pair.energy_kev > 0.0 && pair.flux_mw_m2 > 0.0)
        digest_.energies.push_back({pair.energy_kev, pair.flux_mw_m2, is_good});
    const auto azimuth = first.find(work.work == SurveyWork::border ? FollowedKind::border_azimuth
                                                                    : FollowedKind::sheet_azimuth);
    const auto distance = first.find(FollowedKind::distance);
    const sim::Site* site = site_ ? site_(answer.block) : nullptr;
    // One latitude a frame: the border's goes first, as its work does.
    if (site != nullptr && azimuth != first.end() && distance != first.end() &&
        (digest_.latitudes.empty() || digest_.latitudes.back().time_s != answer.time_s))
      digest_.latitudes.push_back(
          {answer.time_s, latitude_of_place_deg(*site, azimuth->second, distance->second)});
  }

  NightDigest& digest_;
  const SiteOfBlock& site_;
  const std::string& database_;
  std::map<std::tuple<FollowedKind, std::string, std::string>, FollowedSeries> series_;
};

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

NightDigest digest_night(const SurveyReader& reader, const CameraNight& night, const SiteOfBlock& site) {
  NightDigest digest;
  digest.camera = night.camera;
  NightReading reading(digest, site, reader.name());
  for (const FrameRange& range : night.ranges)
    reader.frames(range.first, range.end, [&](const FrameAnswer& answer) { reading.take(answer); });
  reading.finish();
  return digest;
}

void add_motion(const SqliteFile& database, const CameraNight& night, NightDigest& digest) {
  if (!has_motion(database)) return;
  digest.is_smoothed = true;
  std::map<std::string, FollowedSeries> series;
  SqliteStatement rows(
      database,
      "SELECT time_s, v.work, v.item, v.name, velocity, velocity_sigma, velocity_unit, verdict "
      "FROM velocity v JOIN frame USING (frame) JOIN result r ON r.frame = v.frame AND r.work = "
      "v.work WHERE v.frame >= ? AND v.frame < ? ORDER BY v.frame, v.work, v.item, v.name");
  SqliteStatement jumps(
      database,
      "SELECT f.name, kind, time_s, value FROM flag f JOIN frame USING (frame) JOIN quantity q "
      "ON q.frame = f.frame AND q.work = f.work AND q.item = f.item AND q.name = f.name WHERE "
      "f.frame >= ? AND f.frame < ? ORDER BY f.frame, f.work, f.item, f.name");
  for (const FrameRange& range : night.ranges) {
    rows.bind_all(range.first, range.end);
    while (rows.step()) {
      const std::optional<SurveyWork> work = survey_work_of(rows.text(1));
      SurveyQuantity quantity;
      quantity.item = static_cast<int>(rows.integer(2));
      quantity.name = rows.text(3);
      if (!work || followed_kind(*work, quantity) != FollowedKind::distance) continue;
      FollowedSeries& followed = series[quantity.name];
      followed.work = *work;
      followed.kind = FollowedKind::velocity;
      followed.name = quantity.name;
      followed.unit = rows.text(6);
      followed.points.push_back({rows.number(0), rows.number(4), rows.number(5), rows.text(7) == "good"});
    }
    jumps.bind_all(range.first, range.end);
    while (jumps.step())
      digest.jumps.push_back({jumps.text(0), jumps.text(1), jumps.number(2), jumps.number(3)});
  }
  for (auto& [name, of] : series) digest.series.push_back(std::move(of));
}

void add_verdicts(const VerdictCounts& more, VerdictCounts& counts) {
  for (const auto& [work, verdicts] : more)
    for (const auto& [verdict, count] : verdicts) counts[work][verdict] += count;
}

void add_failures(const Failures& more, Failures& failures) {
  for (const auto& [reason, failed] : more) {
    FailedFrames& sum = failures_of(reason, failures);
    sum.frames += failed.frames;
    for (const NamedFrame& frame : failed.some)
      if (sum.some.size() < kNamedFrames) sum.some.push_back(frame);
  }
}

std::vector<FollowedPoint> points_of(const NightDigest& digest, FollowedKind kind) {
  for (const FollowedSeries& series : digest.series)
    if (series.kind == kind) return series.points;
  return {};
}

double share_of_numbers(std::vector<double> numbers, double share) {
  if (numbers.empty()) return sim::kNaN;
  const long place = std::lround(share * static_cast<double>(numbers.size() - 1));
  return sim::nth_value(numbers, static_cast<std::size_t>(place));
}

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
      throw sim::unreadable(database.name(), "has a frame of no time")
          .expected("a database of vegard survey");
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
