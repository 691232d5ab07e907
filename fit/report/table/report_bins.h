// Plots of profiles whose bins are no rows and columns: across a loop, and away from the Sun's limb
// (fit/measure/bin_grid.h, BinAxis).
#pragma once

#include <string>

#include "fit/answer/fit_result.h"
#include "fit/report/plot/plot.h"

namespace vegard::fit {

/// What stands for light of a single channel, which is no colour.
constexpr Colour kGreyInk{33, 102, 172};

/// How a photograph's channel is called and drawn: "red"; of a grey sensor "photograph".
std::string channel_name(const sim::Scene& scene, int channel);
Colour channel_ink(const sim::Scene& scene, int channel);

/// Whether a photograph's profiles have such bins.
bool has_named_axes(const Profile& profile);

/// "distance across the loop (px)"
std::string axis_label(const BinAxis& axis);

/// "0–12.5 px"
std::string group_words(const BinAxis& axis, int group);

/// SVG: light over the positions, mean of all bands; what is left of it, in standard deviations; single
/// bands; and the bands' brightness (gain) over the groups' axis. Photograph and model; channels that were
/// not used are left out.
std::string bins_mean_svg(const FittedPhoto& fitted);
std::string bins_residual_svg(const FittedPhoto& fitted);
std::string bins_bands_svg(const FittedPhoto& fitted);
std::string bins_brightness_svg(const FittedPhoto& fitted);

}  // namespace vegard::fit
