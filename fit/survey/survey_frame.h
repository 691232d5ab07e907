// The analysis of one frame of a survey.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "fit/photo/decoding.h"
#include "fit/photo/frames/picture_bytes.h"
#include "fit/search/fit_options.h"
#include "fit/survey/filter/frame_filter.h"
#include "fit/survey/survey.h"
#include "fit/survey/survey_plan.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

struct MapOptions;
struct Photo;

// The scene, mask, decoding and filter with which a camera's frames are analysed during one of its
// calibrations.

struct SurveyEye {
  sim::Scene scene;  ///< with the camera of the calibration
  Decoding decoding;
  std::string mask;                           ///< name with which the file can be opened; empty: none
  int channel = 1;                            ///< in which borders are traced
  std::shared_ptr<const FrameFilter> filter;  ///< null if the work does not include the filter
};

/// Returns the eye of a camera during one of its calibrations, by their indices in the plan.
using EyeOfPlan = std::function<SurveyEye(int camera, int calibration)>;

/// Keeps the eye that was asked for last, which is most often the next as well.
class LatestEye {
 public:
  explicit LatestEye(EyeOfPlan make) : make_(std::move(make)) {}

  /// Returns the eye, valid until the next call. Throws as EyeOfPlan does.
  const SurveyEye& of(int camera, int calibration);

 private:
  EyeOfPlan make_;
  std::optional<SurveyEye> eye_;
  std::pair<int, int> key_;
};

/// Checks that the work is possible, which does not depend on the frame: for instance that there is something
/// to fit. Throws sim::Error(scene) or (unreadable_input) if it is not.
void check_eye(const SurveyEye& eye, const std::vector<SurveyWork>& work);

/// Returns a hash of everything on which the answers depend: the contents of the scene and of its tables and
/// files, the mask, the curve of the decoding, the channel, and the filter's model. `decoding`: the word for
/// eye.decoding.
std::string eye_sha256(const SurveyEye& eye, const std::string& decoding);

struct FrameTask {
  const SurveyPlan* plan = nullptr;
  int block = 0, number = 0;  ///< the block, and the frame's number within it
  const WorkAnswer* before =
      nullptr;  ///< the latest fit of an earlier frame of the block; null if there is none
};

/// Reads the frames of a survey, one after another. For a file with many frames it keeps the hash and the
/// position in the file, so that the file is read once and not once for each frame.
class SurveyPictures {
 public:
  /// Reads a frame. Sets `sha256` to the hash of the file as stored, also if an error is thrown because the
  /// frame cannot be read. Throws as PictureSeries does.
  PictureBytes read(const std::string& name, std::string& sha256);

 private:
  PictureSeries series_;
  std::string hashed_, sha256_;
};

/// Reads the frame and does the plan's work with it. Errors of the frame are reported in the answer. None if
/// options.stop was set meanwhile. The answer depends only on the frame, `eye` and FrameTask::before, not on
/// the number of threads. `eye` may be null for a frame that is skipped.
std::optional<FrameAnswer> survey_frame(const FrameTask& task, const SurveyEye* eye,
                                        const FitOptions& options, SurveyPictures& pictures);

// The works that have a file of their own: profile_work.cpp and map_work.cpp.

/// Number of adjacent strips into which the scene's region is divided; their items are 1, 2, ... from the
/// left.
inline constexpr int kSurveyStrips = 5;

/// Measures each strip whose light is significant above its noise, in profiles smoothed by two pixels:
/// azimuth and elevation (deg) of the brightest point in a channel; its brightness and that of the strip's
/// darkest point (as fractions of white); the angles (deg) below and above the brightest point at which half
/// of the difference is reached; and the ratios of red and of blue to green for the light above the darkest
/// point. The error of a brightness is that of the pixels' noise; if a camera or JPEG has smoothed the noise,
/// the error is too small (extract_profile()). The verdict is "good", or "none" if no strip has such light.
/// Throws sim::Error(scene) if the frame's size is not the camera's.
WorkAnswer profile_answer(const Photo& photo, const sim::Scene& scene, int channel);

/// Number of perturbed solutions for error bars, half as many as `vegard map` uses. With eight, an error bar
/// is known to a quarter.
inline constexpr int kSurveyReplicates = 8;
/// Number of curtains, those with most energy, whose numbers are stored.
inline constexpr int kSurveyCurtains = 4;

/// Computes the map of a frame. The answer's item 0 is the map: power (MW), mean E0 (keV, weighted by energy
/// flux), share of the energy flux whose lower border is in view, chi2 per value, number of curtains. Items
/// 1, 2, ... are curtains: their length; and for the point nearest to the site whose lower border is in view,
/// its distance, azimuth, latitude (if the site has one), E0, energy flux and lower border. The verdict is
/// "good" if all verdicts of the map are (fit/map/curtains/map_verdicts.h), else "doubtful"; WorkAnswer::words has
/// their words. None if options.stop was set. The options' journal is not used. Throws as map_photos().
std::optional<WorkAnswer> map_answer(const Photo& photo, const sim::Scene& scene, const MapOptions& options);

}  // namespace vegard::fit
