// From a photograph to an answer: the stages of `vegard measure`, one after the other.
//
// Every stage is a command of vegard's own, which is shown and kept: what a stage writes is what the command
// writes, and whoever wants something else at one stage goes on by hand from there. A stage that fails ends
// nothing: the measurement says what it lacked, and what can be had without it.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fit/answer/trust.h"
#include "fit/measurement/camera_calibration.h"
#include "fit/measurement/horizon_camera.h"
#include "fit/measurement/mask.h"
#include "fit/measurement/sky_light.h"
#include "fit/measurement/words.h"
#include "fit/photo/pointing/skyline_doubt.h"
#include "sim/view/sky/star_place.h"

namespace vegard::fit {

struct MeasureRequest {
  std::string photo;
  std::string out;                    ///< the folder to write; empty: the picture's name with _measured
  std::string time;                   ///< ISO 8601 in UTC or with a zone; empty: the picture's own
  std::optional<sim::Observer> site;  ///< none: the picture's own, or that of `camera`
  std::string camera, mask;         ///< files: a camera whose pointing is known, a mask of the sky; or empty
  std::string decoding;             ///< a word; empty: auto, and for light that of `camera`
  double line_nm = 557.7;           ///< of the map
  int threads = 0, replicates = 8;  ///< of the map
  bool no_map = false, overwrite = false;
  std::string command;  ///< by which the measurement was asked for
};

/// Who follows a measurement. Both parts may be empty.
struct MeasureFollower {
  Tell tell;
  std::function<void(MapOptions& options)> map_begins;  ///< sets progress and stop of the long stage
};

/// What is reported of one stage on the way from the photograph to the answer.
struct MeasureStage {
  std::string title;  ///< "Where the camera points"
  Trust trust = Trust::unconstrained;
  std::string found;               ///< a sentence or two
  std::string lacking;             ///< what is missing and what would help; may be empty
  std::string command;             ///< the command that does the same alone; empty if there is none
  std::string words;               ///< the output of that command
  int exit_code = 0;               ///< exit code of that command
  std::vector<std::string> files;  ///< files that it has written in the run directory
  std::string numbers;             ///< what it has found as JSON, as that command gives it; empty: nothing
};

struct Measurement {
  std::string photo;    ///< the file's name, without its folder
  std::string command;  ///< MeasureRequest::command
  std::string out;      ///< the folder that was written
  Trust trust = Trust::unconstrained;
  std::vector<std::string> answer;    ///< the answer in a few sentences
  std::vector<std::string> pictures;  ///< files of the run to show first
  std::vector<MeasureStage> stages;

  // What the stages have returned; none of those that were not gone through or failed.
  std::string time_utc;  ///< empty: not known
  std::optional<sim::Observer> site;
  std::string camera_file;            ///< given or found; empty: the camera is not known
  std::optional<sim::Camera> camera;  ///< of that file
  bool has_azimuth = false;           ///< the camera's directions are in the sky, not only above the horizon
  std::optional<Mask> sky;
  std::optional<CameraCalibration> stars;  ///< without the picture, as is `lens`
  std::optional<CameraCalibration> lens;   ///< of stars whose time or place is not known
  std::optional<HorizonCamera> horizon;
  std::optional<SkylineDoubt> skyline_doubt;
  std::optional<Border> border;
  std::optional<sim::Scene> border_scene;  ///< the camera and the site of the border
  std::optional<PhotoMap> map;
};

/// Writes the folder with its report and returns what is in it. Throws Error(usage) for a time that nobody
/// can read, Error(unreadable_input, scene) for a picture or a camera that is none, before anything is
/// written; Error(existing_output, unwritable_output).
Measurement measure(const MeasureRequest& request, const MeasureFollower& follower = {});

/// Returns the page, which shows pictures in its own folder. The same measurement gives the same bytes.
std::string measure_page(const Measurement& measurement);

/// The stages with their numbers, and the answer.
std::string measure_json(const Measurement& measurement);

}  // namespace vegard::fit
