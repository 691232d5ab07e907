// The plots of a survey's pages. Many points are thinned or binned: a plot has a few hundred marks, whatever
// the number of frames.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "fit/report/plot/plot.h"
#include "fit/survey/report/night_digest.h"

namespace vegard::fit {

/// The span of time of all plots of a page, which are aligned below one another.
struct ShownSpan {
  double begin_s = 0.0, end_s = 1.0;
};

/// Width of the plots that show a night, inside their axes.
inline constexpr int kNightPanel_px = 900;

/// An axis of time with round moments (UTC).
Axis time_axis(const ShownSpan& span, const std::string& label);

/// Returns at most `most` points: from each of `most` equal intervals of time the frame with the median
/// value, with its own error.
std::vector<FollowedPoint> thinned(const std::vector<FollowedPoint>& points, const ShownSpan& span, int most);

/// Returns points with error bars, the good and the doubtful ones in different colours. `name` is for the
/// legend.
std::vector<Series> series_of(const FollowedSeries& series, const ShownSpan& span, const std::string& name,
                              Colour ink);

/// Plots a panel for each kind of number that the night has: energy, flux, distance, altitude, elevation. The
/// plot is empty if there is none.
Plot night_curves(const NightDigest& digest, const ShownSpan& span);

/// Plots energy against energy flux, one dot per frame; logarithmic. The plot is empty if there are none.
Plot energy_plot(const std::vector<EnergyAndFlux>& energies);

/// The same plot for many frames, which are counted in cells.
class EnergyCells {
 public:
  void add(const EnergyAndFlux& pair);
  int frames() const { return frames_; }
  Plot plot() const;

 private:
  std::map<std::pair<int, int>, int> cells_;
  int frames_ = 0;
};

/// Counts of curtains by hour (UTC) and latitude.
class LatitudeCells {
 public:
  void add(const LatitudeAtTime& place);
  int frames() const { return frames_; }
  /// Hours go to the right from `first_hour` on.
  Plot plot(int first_hour) const;

 private:
  std::map<std::pair<int, int>, int> cells_;  ///< by the half hour of the day and the half degree
  int frames_ = 0;
};

/// Returns the colour of a verdict; other words, such as the filter's classes, have colours too.
Colour verdict_ink(const std::string& verdict);

/// Returns an SVG of the shares of a work's verdicts, one bar per hour, with the number of frames above it.
/// Hours go to the right from `first_hour` on, from the first to the last that has frames.
std::string verdict_bars(const std::map<int, VerdictCounts>& verdicts_of_hour, SurveyWork work,
                         int first_hour);

/// A night minute by minute since its beginning, for a thumbnail.
struct NightMinutes {
  std::vector<int> frames, measured;  ///< number of frames; number of those with a border or a curtain
  std::vector<double> energy_kev;     ///< median; NaN where there is none
};
NightMinutes night_minutes(const std::vector<const NightDigest*>& cameras, double begin_s);

/// The common scales of all thumbnails of a list: minutes [first, end), limits of energy.
struct StripScales {
  int first_minute = 24 * 60, end_minute = 0;
  int most_filled = 0;  ///< minutes with frames, of the night that has most
  double min_kev = 1e9, max_kev = 0.0;
  void add(const NightMinutes& night);
};

/// Returns the thumbnail (SVG, without text): the share of frames with an answer, and the energy over it.
std::string night_strip(const NightMinutes& night, const StripScales& scales);

}  // namespace vegard::fit
