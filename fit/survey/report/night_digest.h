// The summary of one camera's night for a report: counts of the survey's results, and series of numbers.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "fit/shared_physics.h"
#include "fit/survey/sqlite_file.h"
#include "fit/survey/survey_motion.h"
#include "fit/survey/survey_results.h"
#include "sim/scene/structs/site.h"

namespace vegard::fit {

// Divides the frames of a survey into nights.

/// Frames of a database, by their numbers: [first, end).
struct FrameRange {
  int first = 0, end = 0;
};

/// The frames of one camera in one night.
struct CameraNight {
  std::string camera;
  std::vector<FrameRange> ranges;  ///< one, unless several plans were merged
};

struct SurveyNight {
  std::string name;                  ///< the date (UTC) of its middle: "2019-03-01"
  double begin_s = 0.0;              ///< since 1970 in UTC; a night lasts for 24 hours
  std::vector<CameraNight> cameras;  ///< by their names
};

struct SurveyNights {
  int begins_at_s = 0;              ///< second of the day (UTC) at which nights begin and end
  std::vector<SurveyNight> nights;  ///< those that have frames, in their order
};

/// Divides the frames into nights; reads only the frames' times. Nights end in the middle of the longest
/// period of the day (UTC, in steps of ten minutes) without any frame, or, if there is none, in the ten
/// minutes with fewest frames. So a night is not cut in two, wherever the cameras are.
SurveyNights survey_nights(const SqliteFile& database);

/// Returns the second of the day (UTC) at which nights end, from the number of frames in each step of ten
/// minutes.
int night_boundary_s(const std::vector<int>& frames_of_step);

struct FollowedPoint {
  double time_s = 0.0, value = 0.0;
  double sigma = 0.0;    ///< NaN if unknown
  bool is_good = false;  ///< the work's verdict is good; else it is doubtful
};

struct FollowedSeries {
  SurveyWork work = SurveyWork::border;
  FollowedKind kind = FollowedKind::border;
  std::string name, unit;
  std::vector<FollowedPoint> points;  ///< in the order of time
};

/// A frame as it is named on a page.
struct NamedFrame {
  int frame = 0;
  std::string file, time_utc;
};

/// Frames that could not be measured, for one reason.
struct FailedFrames {
  int frames = 0;
  std::vector<NamedFrame> some;  ///< the first of them
};

/// Failed frames by reason. Numbers are removed from the reasons, so that similar failures are counted
/// together.
using Failures = std::map<std::string, FailedFrames>;

/// Verdicts of each work with their counts.
using VerdictCounts = std::map<SurveyWork, std::map<std::string, int>>;

/// Energy and energy flux of one frame.
struct EnergyAndFlux {
  double energy_kev = 0.0, flux_mw_m2 = 0.0;
  bool is_good = false;
};

/// The brightest trace of a border at a time: between two azimuths, eastwards from the first, and where it is
/// highest.
struct BorderAtTime {
  double time_s = 0.0;
  double from_azimuth_deg = 0.0, to_azimuth_deg = 0.0, highest_azimuth_deg = 0.0;
  double lowest_deg = 0.0, highest_deg = 0.0;
  double sigma_deg = 0.0;  ///< of the highest elevation; NaN if unknown
  bool is_good = false;    ///< the work's verdict is good; else it is doubtful
};

/// The latitude of a curtain at a time.
struct LatitudeAtTime {
  double time_s = 0.0, latitude_deg = 0.0;
};

/// A number that was flagged as inconsistent with its track.
struct JumpedNumber {
  std::string name, kind;  ///< "distance of the main sheet"; "outlier", "break"
  double time_s = 0.0, value = 0.0;
};

/// A fit that says something of the emission tables.
struct FitOfNight {
  std::string file;
  double time_s = 0.0;
  FrameOfNight answer;
};

struct NightDigest {
  std::string camera;
  int frames = 0;
  double first_s = 0.0, last_s = 0.0;
  std::map<FrameStatus, int> statuses;
  std::map<std::int64_t, int> frames_of_minute;  ///< counts, by minutes since 1970
  VerdictCounts verdicts;
  std::map<int, VerdictCounts> verdicts_of_hour;  ///< by the hour of the day (UTC)
  std::vector<FollowedSeries> series;             ///< by kind, then by name
  std::vector<EnergyAndFlux> energies;
  std::string why_no_flux;  ///< the fits' reason, if none has a flux
  std::vector<LatitudeAtTime> latitudes;
  std::vector<BorderAtTime> borders;  ///< those of which all angles are known, in the order of time
  std::vector<FitOfNight> fits;
  Failures failures;
  std::vector<JumpedNumber> jumps;  ///< empty if the survey was not smoothed
  bool is_smoothed = false;
};

/// Returns the site of the camera for a block; null if it is unknown.
using SiteOfBlock = std::function<const sim::Site*(int block)>;

/// Summarises a camera's night; reads one frame at a time.
NightDigest digest_night(const SurveyReader& reader, const CameraNight& night, const SiteOfBlock& site);

/// Adds velocities of distances and jumps, if the database has them (fit/survey/survey_motion.h).
void add_motion(const SqliteFile& database, const CameraNight& night, NightDigest& digest);

/// Add the counts of another night.
void add_verdicts(const VerdictCounts& more, VerdictCounts& counts);
void add_failures(const Failures& more, Failures& failures);

/// Returns the points of the first series of this kind that has any; empty if there is none.
std::vector<FollowedPoint> points_of(const NightDigest& digest, FollowedKind kind);

/// Returns the quantile at `share` (0 to 1) of the numbers, without interpolation; NaN if there are none.
double share_of_numbers(std::vector<double> numbers, double share);

}  // namespace vegard::fit
