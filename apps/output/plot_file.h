// Encodes a plot in the format given by its file name.
#pragma once

#include <string>

#include "fit/report/plot/plot.h"

namespace vegard::apps {

enum class PlotFormat { none, svg, png };

/// Returns the format by the name's ending, in upper or lower case; none for an empty name. Throws
/// Error(usage) about the option `key` for any other ending.
PlotFormat plot_format(const std::string& file, const std::string& key);

/// The bytes of the file; empty for none.
std::string plot_bytes(const fit::Plot& plot, PlotFormat format);

}  // namespace vegard::apps
