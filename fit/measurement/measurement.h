// What a measurement is asked for, and what its stages have found.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fit/answer/trust.h"
#include "fit/measurement/camera_calibration.h"
#include "fit/measurement/horizon_camera.h"
#include "fit/measurement/main_border.h"
#include "fit/measurement/main_curtain.h"
#include "fit/measurement/mask.h"
#include "fit/measurement/sky_light.h"
#include "fit/measurement/stars_over_horizon.h"
#include "fit/measurement/words.h"
#include "fit/photo/pointing/skyline_doubt.h"
#include "fit/sky_kind/sky_kind.h"
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
  bool reference_field = false;  ///< of the map: IGRF where the time is known, not the dipole
  bool resume = false;  ///< of an interrupted measurement: the finished steps of its map are taken
  bool keep_journal = false;  ///< of its map, for a longer measurement that may be interrupted later
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

/// A part of the answer: "direction", "distance", "the map as a whole", "energy".
struct AnswerPart {
  std::string name;
  Trust trust = Trust::good;
  std::vector<std::string> reasons;  ///< of a trust that is not good
};

struct Measurement {
  std::string photo;    ///< the file's name, without its folder
  std::string command;  ///< MeasureRequest::command
  std::string out;      ///< the folder that was written
  Trust trust = Trust::unconstrained;
  std::string word;                    ///< of the trust, for people: "Measured", "With care", "None found"
  std::vector<std::string> answer;     ///< the answer in a few sentences
  std::vector<AnswerPart> parts;       ///< each with a trust of its own
  std::vector<std::string> not_known;  ///< what the picture does not tell, and what would
  std::vector<std::string> pictures;   ///< files of the run to show first
  std::vector<MeasureStage> stages;

  // What the stages have returned; none of those that were not gone through or failed.
  std::string time_utc;                  ///< empty: not known
  bool is_time_of_camera = false;        ///< time_utc is that of the camera's file, not of this picture
  std::optional<double> middle_after_s;  ///< of the exposure, from time_utc; none: not known
  bool has_field_of_view = false;        ///< the picture's file tells it
  std::optional<sim::Observer> site;
  std::string camera_file;            ///< given or found; empty: the camera is not known
  std::optional<sim::Camera> camera;  ///< of that file
  bool has_azimuth = false;           ///< the camera's directions are in the sky, not only above the horizon
  double pointing_error_deg =
      0.0;                  ///< standard error of all elevations, where a skyline stands for the horizon
  std::optional<Mask> sky;  ///< without its sets of pixels, which are in sky.png
  std::optional<SkyFinding> sky_kind;      ///< what the picture looks like as a whole
  std::optional<CameraCalibration> stars;  ///< without the picture, as is `lens`
  std::optional<CameraCalibration> lens;   ///< of stars whose time or place is not known
  std::optional<HorizonCamera> horizon;
  std::optional<StarsOverHorizon> over_horizon;  ///< recognised stars with `horizon`
  std::optional<SkylineDoubt> skyline_doubt;
  bool is_skyline_open = false;  ///< whether it is ground or the light's own border is not decided
  std::optional<Border> border;
  std::optional<sim::Scene> border_scene;  ///< the camera and the site of the border
  std::optional<PhotoMap> map;
  bool is_map_interrupted = false;
  std::optional<MainBorder> main_border;    ///< of which the answer speaks; none if none is claimed
  std::optional<MainCurtain> main_curtain;  ///< of the map; none without `main_border`
};

}  // namespace vegard::fit
