// The plots of a survey's pages. Where there is much, it is thinned or binned: a plot has a few hundred
// marks, however many frames there are.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "fit/report/plot/plot.h"
#include "fit/survey/report/night_digest.h"

namespace vegard::fit {

/// Times that a page's plots begin and end at, all the same so that they stand below one another.
struct ShownSpan {
  double begin_s = 0.0, end_s = 1.0;
};

/// Width of the plots that show a night, inside their axes.
inline constexpr int kNightPanel_px = 900;

/// An axis of time with round moments (UTC).
Axis time_axis(const ShownSpan& span, const std::string& label);

/// At most so many points: of each of as many equal stretches of time the frame whose value is the median,
/// with its own error.
std::vector<FollowedPoint> thinned(const std::vector<FollowedPoint>& points, const ShownSpan& span, int most);

/// Points with error bars, the good and the doubtful in inks of their own. `name` is for the legend.
std::vector<Series> series_of(const FollowedSeries& series, const ShownSpan& span, const std::string& name,
                              Colour ink);

/// A panel for each kind of number that the night has: energy, flux, distance, altitude, elevation. An empty
/// plot if there is none.
Plot night_curves(const NightDigest& digest, const ShownSpan& span);

/// Energy against energy flux, a dot a frame; logarithmic. Empty without any.
Plot energy_plot(const std::vector<EnergyAndFlux>& energies);

/// The same of many, counted in cells.
class EnergyCells {
 public:
  void add(const EnergyAndFlux& pair);
  int frames() const { return frames_; }
  Plot plot() const;

 private:
  std::map<std::pair<int, int>, int> cells_;
  int frames_ = 0;
};

/// In which hour (UTC) curtains stood at which latitude.
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

/// The ink of a verdict, and of any other word in its place a colour of its own.
Colour verdict_ink(const std::string& verdict);

/// Shares of a work's verdicts by the hour, one bar each, with the number of frames above it: SVG. Hours go
/// to the right from `first_hour` on, from the first to the last that has frames.
std::string verdict_bars(const std::map<int, VerdictCounts>& verdicts_of_hour, SurveyWork work,
                         int first_hour);

/// A night minute by minute since its beginning, for a small picture of it.
struct NightInSmall {
  std::vector<int> frames, told;   ///< frames that there are; with a border, or else a curtain
  std::vector<double> energy_kev;  ///< median; NaN where there is none
};
NightInSmall night_in_small(const std::vector<const NightDigest*>& cameras, double begin_s);

/// What all nights of a list have in common: minutes [first, end), limits of energy.
struct StripScales {
  int first_minute = 24 * 60, end_minute = 0;
  int most_filled = 0;  ///< minutes with frames, of the night that has most
  double min_kev = 1e9, max_kev = 0.0;
  void add(const NightInSmall& night);
};

/// The small picture (SVG, without text): the share of frames with an answer, and the energy over it.
std::string night_strip(const NightInSmall& night, const StripScales& scales);

}  // namespace vegard::fit
