// Plots of profiles whose bins are not rows and columns but lie across a loop, or away from the Sun's limb
// (fit/measure/bin_grid.h, BinAxis).
#pragma once

#include <string>

#include "fit/answer/fit_result.h"
#include "fit/report/plot/plot.h"

namespace vegard::fit {

/// The colour for light of a single channel.
constexpr Colour kGreyInk{33, 102, 172};

/// Name and colour of a photograph's channel: "red"; of a grey sensor "photograph".
std::string channel_name(const sim::Scene& scene, int channel);
Colour channel_ink(const sim::Scene& scene, int channel);

/// Whether a photograph's profiles have such bins.
bool has_named_axes(const Profile& profile);

/// "distance across the loop (px)"
std::string axis_label(const BinAxis& axis);

/// "0–12.5 px"
std::string group_words(const BinAxis& axis, int group);

/// Plots of photograph and model as SVG: light over the positions, mean of all bands; its residuals in
/// standard deviations; single bands; and the bands' brightness (gain) along the groups' axis. Unused
/// channels are left out.
std::string bins_mean_svg(const FittedPhoto& fitted);
std::string bins_residual_svg(const FittedPhoto& fitted);
std::string bins_bands_svg(const FittedPhoto& fitted);
std::string bins_brightness_svg(const FittedPhoto& fitted);

}  // namespace vegard::fit
