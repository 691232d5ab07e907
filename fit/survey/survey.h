// A survey: many frames of several cameras, and the analysis (work) of each.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace vegard::fit {

/// What can be done with a frame. Their order is that in which it is done.
/// If the filter finds no arc in a frame, the other work is not done.
enum class SurveyWork { filter, border, profile, fit, map };
inline constexpr std::array kSurveyWorks = {SurveyWork::filter, SurveyWork::border, SurveyWork::profile,
                                            SurveyWork::fit, SurveyWork::map};

/// Returns the name in survey files and results: "filter", "border", "profile", "fit", "map".
const char* survey_work_name(SurveyWork work);
std::optional<SurveyWork> survey_work_of(const std::string& name);

/// A period of time, in seconds since 1970 in UTC, without its end.
struct SurveyPeriod {
  double from_s = -std::numeric_limits<double>::infinity();
  double until_s = std::numeric_limits<double>::infinity();
  bool has(double time_s) const { return time_s >= from_s && time_s < until_s; }
};

/// The pointing of a camera during a period.
struct SurveyCalibration {
  SurveyPeriod period;
  std::string file;  ///< as vegard calibrate writes it; empty: the scene has the camera
  std::string mask;  ///< white = use; empty: none
};

struct SurveyCamera {
  std::string name;
  int line = 0;       ///< in the survey's file
  std::string scene;  ///< file of its frames' scene; empty: the calibration's file is the scene
  std::vector<std::string> changes;  ///< changes to the scene, "path=value" as in --set
  std::vector<std::string> frames;   ///< folders, lists (.txt) and single files
  std::optional<double> start_s;     ///< of its first frame, since 1970 in UTC, where it is given
  double step_s = 0.0;               ///< from one frame to the next; 0: as a film's clock says
  std::vector<std::string> endings;  ///< of the files in folders that are frames, lower case: ".png"
  std::string decoding;              ///< a word of --decoding; empty: the scene's
  int channel = 1;                   ///< in which borders are traced: 0, 1, 2 for red, green, blue
  std::string filter;                ///< file of a model (fit/sky_kind/sky_model.h); empty: the built-in one
  std::vector<SurveyCalibration> calibrations;
};

/// Frames that are not analysed.
struct SurveySkip {
  std::string camera;  ///< empty: of every camera
  SurveyPeriod period;
  std::string list;  ///< file with the names of the frames; empty: all frames of the period
  std::string reason;
};

/// All names of files are relative to the folder of the survey's file, or absolute.
struct Survey {
  std::string file;  ///< where it was read
  std::string sha256;
  std::string name;
  std::vector<SurveyWork> work;
  int block_frames = 50;  ///< largest number of frames of a block, whose fits start at the previous result
  double gap_s = 300.0;   ///< after a longer gap in time a new block begins
  double shard_minutes = 30.0;  ///< least computing time for one task (shard) of a cluster
  int max_shards = 1000;        ///< largest number of tasks of a job array
  std::array<double, kSurveyWorks.size()> cost_s{};  ///< [work] seconds per frame, to estimate a shard's time
  std::vector<SurveyCamera> cameras;
  std::vector<SurveySkip> skips;

  /// Returns a file's name with which it can be opened.
  std::string place(const std::string& name) const;
};

/// Defaults of Survey::cost_s: seconds per frame on one core of a machine of 2020, measured on pictures of
/// 720 x 480 pixels.
inline constexpr std::array<double, kSurveyWorks.size()> kSurveyCost_s = {0.02, 0.3, 0.1, 2.0, 120.0};

/// Defaults of SurveyCamera::endings.
const std::vector<std::string>& picture_endings();

/// A frame's name: a file, or one of several frames in a file, "night.pgm.gz#7", counted from 0.
struct FrameReference {
  std::string file;
  std::optional<int> number;
};
FrameReference frame_reference(const std::string& text);

/// True for a valid name of a survey or a camera: 1 to 64 letters, digits, _ and -. Names become parts of
/// columns, messages and scripts.
bool is_plain_name(const std::string& name);

// The results of a survey for one frame.

/// A number with its error and its trust.
struct SurveyQuantity {
  int item = 0;      ///< number from 1 among several of a kind (a border's traces); 0: there is only one
  std::string name;  ///< "lowest elevation", "sheet.main.energy_kev"
  std::string unit;
  std::optional<double> value;  ///< none if it is unconstrained
  std::optional<double> sigma;
  std::optional<std::string> trust;   ///< a name of fit/answer/trust.h; none if it was not assessed
  std::optional<std::string> reason;  ///< why there is no value, or why it is not trusted
};

struct WorkAnswer {
  SurveyWork work = SurveyWork::border;
  /// For a filter: the sky's class (fit/survey/filter/frame_filter.h). For a fit: "good", "doubtful",
  /// "failed". For a border and for profiles: "good", or "none" if nothing was found. For a map: "good",
  /// "doubtful". For any work: "refused" if it could not be done; `words` has the reason.
  std::string verdict;
  std::optional<std::string> words;
  std::optional<std::string> start;  ///< of a fit: "full" (a search) or "warm" (from the previous frame)
  std::optional<double> chi2_per_dof;
  std::optional<std::int64_t> seed;
  std::vector<double> free_values;  ///< of a fit, exact; the next frame's fit starts there
  /// Of a fit whose tables have an uncertainty: what it says of them, as JSON (fit/survey/survey_physics.h).
  std::optional<std::string> physics{};
  std::vector<SurveyQuantity> quantities;
};

/// `filtered`: the filter found no arc in the frame, so that no other work was done.
enum class FrameStatus { done, skipped, missing, unreadable, filtered };
inline constexpr std::array kFrameStatuses = {FrameStatus::done, FrameStatus::skipped, FrameStatus::missing,
                                              FrameStatus::unreadable, FrameStatus::filtered};
/// "done", "skipped", "missing", "unreadable", "filtered".
const char* frame_status_name(FrameStatus status);

struct FrameAnswer {
  int frame = 0, block = 0;  ///< numbers in the plan, from 0
  std::string camera;
  std::string file;  ///< as the plan has it
  double time_s = 0.0;
  FrameStatus status = FrameStatus::done;
  std::optional<std::string> reason;  ///< of a status other than done
  std::optional<std::string> sha256, decoding;
  std::vector<WorkAnswer> works;  ///< of a frame that is done, or filtered
};

/// Reads a survey from a TOML file, whose keys docs/surveys.md describes. Throws sim::Error(unreadable_input)
/// if the file does not exist, and (scene), with file, line, key, what was expected and a hint, if it is not
/// a valid survey. Files that the survey names are not opened.
Survey read_survey(const std::string& file);

/// Like read_survey(), for a text; `file` is its name in messages and for Survey::place().
Survey parse_survey(const std::string& text, const std::string& file);

/// Returns the number; none if it is not finite.
std::optional<double> finite_or_none(double value);

}  // namespace vegard::fit
