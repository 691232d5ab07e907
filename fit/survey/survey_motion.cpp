#include "fit/survey/survey_motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "fit/survey/survey_results.h"
#include "fit/survey/track_smoother.h"
#include "sim/base/error.h"
#include "sim/base/file/whole_file.h"
#include "sim/base/text.h"

namespace vegard::fit {
namespace {

struct VelocityUnit {
  std::string words;
  double factor = 1.0;
};
VelocityUnit velocity_unit(const std::string& unit) {
  if (unit == "km") return {"m/s", 1000.0};
  return {(unit.empty() ? "1" : unit) + "/s", 1.0};
}

/// A number of a camera's frames that is followed in time.
struct FollowedNumber {
  std::string camera;
  SurveyWork work = SurveyWork::border;
  int item = 0;
  std::string name, unit;
  bool operator<(const FollowedNumber& o) const {
    return std::tie(camera, work, item, name, unit) < std::tie(o.camera, o.work, o.item, o.name, o.unit);
  }
};

struct OpenTrack {
  std::vector<int> frames;
  std::vector<TrackPoint> points;
};

class MotionWriter {
 public:
  MotionWriter(const SqliteFile& file, const SurveyMotionOptions& options)
      : options_(options),
        track_(file, "INSERT INTO track VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)"),
        velocity_(file, "INSERT INTO velocity VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)"),
        flag_(file, "INSERT INTO flag VALUES (?, ?, ?, ?, ?, ?, ?, ?)") {}

  void take(const FrameAnswer& answer) {
    for (const WorkAnswer& work : answer.works) {
      if (work.verdict != "good" && work.verdict != "doubtful") continue;
      for (const SurveyQuantity& q : work.quantities)
        if (q.value && q.sigma && *q.sigma > 0.0 && is_followed(work.work, q))
          add({answer.camera, work.work, q.item, q.name, q.unit}, answer,
              {answer.time_s, *q.value, *q.sigma});
    }
  }
  void finish() {
    for (auto& [number, track] : open_) write(number, track);
    open_.clear();
  }
  const SurveyMotion& motion() const { return motion_; }

 private:
  bool is_followed(SurveyWork work, const SurveyQuantity& q) const {
    if (q.item > 1) return false;
    const std::optional<FollowedKind> kind = followed_kind(work, q);
    return kind == FollowedKind::distance || kind == FollowedKind::altitude ||
           std::count(options_.quantities.begin(), options_.quantities.end(), q.name) > 0;
  }

  void add(const FollowedNumber& number, const FrameAnswer& answer, const TrackPoint& point) {
    OpenTrack& track = open_[number];
    if (!track.points.empty()) {
      const double since_s = point.time_s - track.points.back().time_s;
      if (!(since_s > 0.0) || since_s > options_.gap_s) {
        write(number, track);
        track = {};
      }
    }
    track.frames.push_back(answer.frame);
    track.points.push_back(point);
  }

  void write(const FollowedNumber& number, const OpenTrack& track) {
    const SmoothedTrack smoothed = smooth_track(track.points, options_.false_alarms);
    const char* work = survey_work_name(number.work);
    const VelocityUnit unit = velocity_unit(number.unit);
    const int id = ++motion_.tracks;
    track_
        .bind_all(id, number.camera, work, number.item, number.name, number.unit, track.frames.front(),
                  track.frames.back(), smoothed.used, smoothed.outliers, smoothed.breaks,
                  smoothed.process_noise > 0.0 ? std::optional(smoothed.process_noise) : std::nullopt,
                  "(" + (number.unit.empty() ? "1" : number.unit) + ")^2 s^-3",
                  finite_or_none(smoothed.innovation_chi2))
        .run();
    for (std::size_t i = 0; i < track.frames.size(); ++i) {
      const SmoothedPoint& point = smoothed.points[i];
      const auto add_row = [&](SqliteStatement& row, const auto&... values) {
        row.bind_all(track.frames[i], work, number.item, number.name, id, values...).run();
      };
      if (std::isfinite(point.velocity))
        add_row(velocity_, point.position, point.position_sigma, number.unit, unit.factor * point.velocity,
                unit.factor * point.velocity_sigma, unit.words);
      if (point.flag != TrackFlag::none)
        add_row(flag_, track_flag_name(point.flag), finite_or_none(point.chi2),
                jump_limit(options_.false_alarms));
    }
    motion_.used += smoothed.used;
    motion_.outliers += smoothed.outliers;
    motion_.breaks += smoothed.breaks;
  }

  const SurveyMotionOptions& options_;
  SqliteStatement track_, velocity_, flag_;
  std::map<FollowedNumber, OpenTrack> open_;
  SurveyMotion motion_;
};

void require_in_range(bool is_in, const char* key, const char* expected) {
  if (!is_in) throw sim::Error(sim::ErrorKind::usage, "is out of range").key(key).expected(expected);
}

std::string in_sql_quotes(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? "''" : std::string(1, c);
  return quoted + "'";
}

struct FollowedWords {
  SurveyWork work;
  const char* beginning;
  FollowedKind kind;
};
constexpr std::array<FollowedWords, 12> kFollowed = {{
    {SurveyWork::border, "highest elevation", FollowedKind::border},
    {SurveyWork::border, "nearest azimuth", FollowedKind::border_azimuth},
    {SurveyWork::border, "distance if 105 km high", FollowedKind::distance},
    {SurveyWork::fit, "mean electron energy of the ", FollowedKind::energy},
    {SurveyWork::fit, "energy flux Q of the ", FollowedKind::flux},
    {SurveyWork::fit, "distance of the ", FollowedKind::distance},
    {SurveyWork::fit, "lower border of ", FollowedKind::altitude},
    {SurveyWork::fit, "azimuth of the nearest point of the ", FollowedKind::sheet_azimuth},
    {SurveyWork::map, "characteristic energy E0", FollowedKind::characteristic},
    {SurveyWork::map, "energy flux", FollowedKind::flux},
    {SurveyWork::map, "distance of the nearest point", FollowedKind::distance},
    {SurveyWork::map, "lower border", FollowedKind::altitude},
}};

}  // namespace

SurveyMotion smooth_survey(const std::string& database, const std::string& output,
                           const SurveyMotionOptions& options, bool overwrite) {
  require_in_range(options.gap_s > 0.0, "--gap-s", "more than 0");
  require_in_range(options.false_alarms > 0.0 && options.false_alarms < 0.5, "--false-alarms",
                   "between 0 and 0.5");
  SqliteFile from(database, SqliteFile::Opening::read);
  const SurveyReader reader(from);
  sim::WholeFile whole(output, overwrite);
  // As new: of a database, the bytes tell how often it was written to, of this copy they do not.
  from.run("VACUUM INTO " + in_sql_quotes(whole.temporary()));
  SurveyMotion motion;
  {
    SqliteFile to(whole.temporary(), SqliteFile::Opening::make);
    if (has_motion(to)) {
      drop_motion_tables(to);
      to.run("VACUUM");
    }
    to.transaction([&] {
      make_motion_tables(to);
      MotionWriter writer(to, options);
      std::string camera;
      reader.frames(0, std::numeric_limits<int>::max(), [&](const FrameAnswer& answer) {
        // A camera's frames stand together: of the one before nothing more will come.
        if (answer.camera != camera) writer.finish();
        camera = answer.camera;
        writer.take(answer);
      });
      writer.finish();
      motion = writer.motion();
    });
  }
  whole.commit();
  return motion;
}

std::optional<FollowedKind> followed_kind(SurveyWork work, const SurveyQuantity& quantity) {
  if (quantity.item > 1) return std::nullopt;
  for (const FollowedWords& words : kFollowed)
    if (words.work == work && sim::starts_with(quantity.name, words.beginning)) return words.kind;
  return std::nullopt;
}

std::string owner_of_quantity(const std::string& name) {
  const std::string owner_words = " of the ";
  const std::size_t begin = name.rfind(owner_words);
  if (begin == std::string::npos) return {};
  const std::size_t from = begin + owner_words.size(), end = name.rfind(' ');
  return end == std::string::npos || end <= from ? name.substr(from) : name.substr(from, end - from);
}

}  // namespace vegard::fit
