// A survey: many frames of several cameras, and what is to be done with each.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace vegard::fit {

/// What can be done with a frame. Their order is that in which it is done.
/// What the filter lets pass is done the rest with.
enum class SurveyWork { filter, border, profile, fit, map };
inline constexpr std::array kSurveyWorks = {SurveyWork::filter, SurveyWork::border, SurveyWork::profile,
                                            SurveyWork::fit, SurveyWork::map};

/// "filter", "border", "profile", "fit", "map", as surveys and results have it.
const char* survey_work_name(SurveyWork work);
std::optional<SurveyWork> survey_work_of(const std::string& name);

/// Seconds since 1970 in UTC; the end is no part of it.
struct SurveyPeriod {
  double from_s = -std::numeric_limits<double>::infinity();
  double until_s = std::numeric_limits<double>::infinity();
  bool has(double time_s) const { return time_s >= from_s && time_s < until_s; }
};

/// Where a camera pointed during some time.
struct SurveyCalibration {
  SurveyPeriod period;
  std::string file;  ///< as vegard calibrate writes it; empty: the scene has the camera
  std::string mask;  ///< white = use; empty: none
};

struct SurveyCamera {
  std::string name;
  int line = 0;                      ///< in the survey's file
  std::string scene;                 ///< of its frames; empty: the calibration's file is the scene
  std::vector<std::string> changes;  ///< "path=value", as --set takes them
  std::vector<std::string> frames;   ///< folders, lists (.txt) and single files
  std::vector<std::string> endings;  ///< of the files in folders that are frames, lower case: ".png"
  std::string decoding;              ///< a word of --decoding; empty: the scene's
  int channel = 1;                   ///< that a border is traced in: 0, 1, 2 for red, green, blue
  std::string filter;                ///< trees of its own (fit/survey/filter); empty: those built in
  std::vector<SurveyCalibration> calibrations;
};

/// Frames that are left out.
struct SurveySkip {
  std::string camera;  ///< empty: of every camera
  SurveyPeriod period;
  std::string list;  ///< names them one by one; empty: all of the period
  std::string reason;
};

/// All names of files are relative to the survey's folder, and may be absolute.
struct Survey {
  std::string file;  ///< where it was read
  std::string sha256;
  std::string name;
  std::vector<SurveyWork> work;
  int block_frames = 50;        ///< at most, in a row of frames of which each starts where the last ended
  double gap_s = 300.0;         ///< after a longer one a frame starts by itself
  double shard_minutes = 30.0;  ///< of work, at least, for one task of a cluster
  int max_shards = 1000;        ///< tasks of an array
  std::array<double, kSurveyWorks.size()> cost_s{};  ///< of a frame, by work: what shards are sized by
  std::vector<SurveyCamera> cameras;
  std::vector<SurveySkip> skips;

  /// A file's name as it may be opened.
  std::string place(const std::string& name) const;
};

/// Seconds that a frame takes on one core of a machine of 2020, where a survey does not say it: measured on
/// pictures of 720 x 480 pixels.
inline constexpr std::array<double, kSurveyWorks.size()> kSurveyCost_s = {0.02, 0.3, 0.1, 2.0, 120.0};

/// Endings of files that are taken for frames, where a survey does not say it.
const std::vector<std::string>& picture_endings();

/// A frame's name: a file, or one of several frames in a file, "night.pgm.gz#7", counted from 0.
struct FrameReference {
  std::string file;
  std::optional<int> number;
};
FrameReference frame_reference(const std::string& text);

/// Whether it may be the name of a survey or of a camera: 1 to 64 letters, digits, _ and -. Names become
/// parts of columns, messages and scripts.
bool is_plain_name(const std::string& name);

}  // namespace vegard::fit
