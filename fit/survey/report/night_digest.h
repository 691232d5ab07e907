// The summary of one camera's night in a report: the survey's rows, counted and followed.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "fit/survey/followed_quantity.h"
#include "fit/survey/report/survey_nights.h"
#include "fit/survey/survey_results.h"
#include "sim/scene/structs/site.h"

namespace vegard::fit {

struct FollowedPoint {
  double time_s = 0.0, value = 0.0;
  double sigma = 0.0;    ///< NaN where none is given
  bool is_good = false;  ///< by the work's verdict; else it is doubtful
};

struct FollowedSeries {
  SurveyWork work = SurveyWork::border;
  FollowedKind kind = FollowedKind::border;
  std::string name, unit;
  std::vector<FollowedPoint> points;  ///< in the order of time
};

/// A frame as a page names it.
struct NamedFrame {
  int frame = 0;
  std::string file, time_utc;
};

/// Frames that could not be measured, for one reason.
struct FailedFrames {
  int frames = 0;
  std::vector<NamedFrame> some;  ///< the first of them
};

/// Why, in words; numbers in them are left out, so that like failures are counted together.
using Failures = std::map<std::string, FailedFrames>;

/// Verdicts of each work with their counts.
using VerdictCounts = std::map<SurveyWork, std::map<std::string, int>>;

/// Energy and energy flux of one frame.
struct EnergyAndFlux {
  double energy_kev = 0.0, flux_mw_m2 = 0.0;
  bool is_good = false;
};

/// The latitude at which a curtain stood.
struct LatitudeAtTime {
  double time_s = 0.0, latitude_deg = 0.0;
};

/// A number that does not belong to its track.
struct JumpedNumber {
  std::string name, kind;  ///< "distance of the main sheet"; "outlier", "break"
  double time_s = 0.0, value = 0.0;
};

struct NightDigest {
  std::string camera;
  int frames = 0;
  double first_s = 0.0, last_s = 0.0;
  std::map<FrameStatus, int> statuses;
  std::map<std::int64_t, int> frames_of_minute;  ///< by minutes since 1970
  VerdictCounts verdicts;
  std::map<int, VerdictCounts> verdicts_of_hour;  ///< by the hour of the day (UTC)
  std::vector<FollowedSeries> series;             ///< by kind, then by name
  std::vector<EnergyAndFlux> energies;
  std::string why_no_flux;  ///< what the fits say, where none has a flux
  std::vector<LatitudeAtTime> latitudes;
  Failures failures;
  std::vector<JumpedNumber> jumps;  ///< none where the survey was not smoothed
  bool is_smoothed = false;
};

/// Where a camera stood when it took a block's frames; null where that is not known.
using SiteOfBlock = std::function<const sim::Site*(int block)>;

/// Reads the camera's rows of a night, one frame at a time.
NightDigest digest_night(const SurveyReader& reader, const CameraNight& night, const SiteOfBlock& site);

/// Adds velocities of distances and jumps, where the database has them (fit/survey/survey_motion.h).
void add_motion(const SqliteFile& database, const CameraNight& night, NightDigest& digest);

/// Adds what another night has counted.
void add_verdicts(const VerdictCounts& more, VerdictCounts& counts);
void add_failures(const Failures& more, Failures& failures);

/// Points of the kind, of the first series that has any; empty if there is none.
std::vector<FollowedPoint> points_of(const NightDigest& digest, FollowedKind kind);

/// The value below which this share of the numbers lies, of sorted ones the nearest; NaN of none.
double share_of_numbers(std::vector<double> numbers, double share);

}  // namespace vegard::fit
