// The pages of a survey: HTML that needs nothing else, plots as inline SVG, no script.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "fit/survey/report/night_digest.h"
#include "fit/survey/report/night_plots.h"

namespace vegard::fit {

/// What all pages of a report say.
struct SurveyFacts {
  std::string name;                  ///< of the survey
  std::vector<std::string> origins;  ///< "plan night (sha256 …), vegard 0.1.0, …"
  int lacking = 0;                   ///< frames of the plan that are not there
  int first_hour = 0;                ///< of a night (UTC)
};

/// One camera's night as its page shows it.
struct ShownCamera {
  NightDigest digest;
  std::string keogram;       ///< SVG; empty: none
  std::string keogram_note;  ///< how many frames it has, or why there is none
};

struct ShownNight {
  std::string name, file;            ///< "2019-03-01", "night-2019-03-01.html"
  std::string before, after;         ///< names of the neighbours; empty: there is none
  std::vector<ShownCamera> cameras;  ///< by their names
};

/// A link to a frame's file, as the pages' folder has it; empty: none.
using FrameLink = std::function<std::string(const NamedFrame& frame)>;

/// The same night gives the same bytes.
std::string night_page(const SurveyFacts& facts, const ShownNight& night, const FrameLink& link);

/// A night in the list of all.
struct ListedNight {
  std::string name, file;
  std::string strip;  ///< SVG
  int frames = 0, done = 0;
  VerdictCounts verdicts;
  double energy_kev = 0.0, distance_km = 0.0;  ///< medians; NaN where there is none
};

/// All nights together, counted; grows night by night and never holds a frame.
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

/// "16 to 84 % of frames": a quantity's middle and spread, in words: "4.3 keV (16 to 84 %: 3.1 to 6.0)".
std::string spread_words(const std::vector<FollowedPoint>& points, const std::string& unit);

}  // namespace vegard::fit
