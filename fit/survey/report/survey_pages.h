// The HTML pages of a survey's report: self-contained, with plots as inline SVG and without scripts.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "fit/survey/report/night_digest.h"
#include "fit/survey/report/night_plots.h"

namespace vegard::fit {

/// What all pages of a report state.
struct SurveyFacts {
  std::string name;                  ///< of the survey
  std::vector<std::string> origins;  ///< "plan night (sha256 …), vegard 0.1.0, …"
  int lacking = 0;                   ///< frames of the plan that are not in the database
  int first_hour = 0;                ///< hour (UTC) at which a night begins
};

/// One camera's night as its page shows it.
struct ShownCamera {
  NightDigest digest;
  std::string keogram;       ///< SVG; empty: none
  std::string keogram_note;  ///< how many frames the keogram has, or why there is none
};

struct ShownNight {
  std::string name, file;                ///< "2019-03-01", "night-2019-03-01.html"
  std::string before, after;             ///< names of the neighbours; empty: there is none
  std::vector<ShownCamera> cameras;      ///< by their names
  std::optional<SharedPhysics> physics;  ///< of all cameras' fits together; none for fewer than two fits
  std::string physics_file;              ///< the table of their answers, beside the page
};

/// Returns the link to a frame's file, relative to the pages' folder; empty: none.
using FrameLink = std::function<std::string(const NamedFrame& frame)>;

/// Returns "night-2019-03-01.html".
std::string night_file_name(const std::string& night);

/// Returns the page of a night. The same night gives the same bytes.
std::string night_page(const SurveyFacts& facts, const ShownNight& night, const FrameLink& link);

/// A night in the list of all.
struct ListedNight {
  std::string name, file;
  std::string strip;  ///< SVG
  int frames = 0, done = 0;
  VerdictCounts verdicts;
  double energy_kev = 0.0, distance_km = 0.0;  ///< medians; NaN where there is none
};

/// Sums over all nights, to which nights are added one by one.
struct SurveySum {
  int frames = 0, done = 0, filtered = 0;
  double first_s = 0.0, last_s = 0.0;
  std::map<std::string, VerdictCounts> verdicts_of_camera;
  std::map<std::string, std::map<FrameStatus, int>> statuses_of_camera;
  std::map<int, VerdictCounts> verdicts_of_hour;
  VerdictCounts verdicts;
  EnergyCells energies;
  LatitudeCells latitudes;
  std::string why_no_flux;
  Failures failures;
  std::vector<ListedNight> nights;

  void add(const NightDigest& digest);
};

std::string survey_page(const SurveyFacts& facts, const SurveySum& sum, const FrameLink& link);

}  // namespace vegard::fit
