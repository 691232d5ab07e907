// A measurement under way: its request, its folder, and how a stage runs as the command that does the same.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "fit/measurement/measurement.h"
#include "fit/photo/photo_facts.h"
#include "sim/base/error.h"
#include "sim/base/shown_text.h"

namespace vegard::fit {

/// Exit codes of the stages' commands.
inline constexpr int kStageGood = 0, kStageDoubted = 5, kStageInterrupted = 130;

class MeasureRun {
 public:
  using Words = std::vector<std::string>;

  MeasureRun(const MeasureRequest& asked, const MeasureFollower& heard);

  const MeasureRequest& request;
  const MeasureFollower& follower;
  Measurement result;
  std::string sky_mask;   ///< file; empty if all of the picture may be sky
  std::string lens_file;  ///< a camera whose lens alone is known; empty: it is not
  double middle_after_s =
      0.0;  ///< from result.time_utc to the middle of the exposure, when the stars stood so

  /// Reads what is given of time, place and camera, and refuses before any stage what nobody can read.
  void read_given();
  /// Makes the folder, or takes one that holds a measurement.
  void claim_folder() const;

  std::string in_run(const std::string& name) const { return result.out + "/" + name; }
  MeasureStage& begin(const std::string& title);

  /// The work of a command: it is shown, what it tells is kept, and an error ends it alone.
  template <class Work>
  bool run_stage(MeasureStage& stage, const Words& words, const Work& work) const {
    show_command(stage, words);
    const Tell tell(
        [&](const std::string& line, Tell::Tone tone) {
          stage.words += sim::shown_text(line) + "\n";
          follower.tell(line, tone);
        },
        [&](const std::string& what, double share) { follower.tell.progress(what, share); });
    try {
      work(tell);
    } catch (const sim::Error& error) {
      end_with(stage, error, tell);
    }
    return stage.exit_code == kStageGood;
  }

  /// Words that the command of every stage with a picture takes.
  Words with_common(Words words) const;
  Words with_site(Words words) const;
  /// A scene as a command makes it ready that gets the place as changes.
  std::vector<PhotoFact> make_scene_ready(sim::Scene& scene, const Tell& tell) const;
  Decoding decoding() const;

  /// Writes a file of the run, but not over what the user gave.
  void write(const std::string& name, const std::string& bytes) const;
  void write(MeasureStage& stage, const std::string& name, const std::string& bytes, const Tell& tell) const;

  /// Returns a point for each column; none if no skyline was found.
  std::vector<PixelPoint> skyline() const;

 private:
  void show_command(MeasureStage& stage, const Words& words) const;
  static void end_with(MeasureStage& stage, const sim::Error& error, const Tell& tell);
  /// The place, as changes of a scene.
  std::vector<std::pair<std::string, std::string>> changes_of_site() const;
};

/// Whether the JSON file of a measurement says that it was interrupted; false for a file that nobody can
/// read.
bool is_interrupted_measurement(const std::string& json_file);

/// Removes the map of an earlier measurement from a folder, with its scene and its journal; but none of these
/// files that is an input now. Throws Error(existing_output) if `map` holds what vegard did not write, or the
/// journal is in use.
void remove_earlier_map(const std::string& folder, const std::vector<MeasureRequest>& requests);

/// Returns a number as a command has it that was shown it as text.
double as_written(const std::string& text);

/// One line; a file's name may hold bytes that are no UTF-8.
std::string json_line(const nlohmann::ordered_json& json);

/// "78.148,16.043,520", as --site takes it.
std::string site_text(const sim::Observer& site);

}  // namespace vegard::fit
