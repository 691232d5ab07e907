// A plot on its way to a file whose name says its format.
#pragma once

#include <string>

#include "fit/report/plot/plot.h"

namespace vegard::apps {

enum class PlotFormat { none, svg, png };

/// By the name's ending, in capitals or not; none for an empty name. Throws Error(usage) that names the
/// option `key` for any other ending.
PlotFormat plot_format(const std::string& file, const std::string& key);

/// The bytes of such a file; empty for none.
std::string plot_bytes(const fit::Plot& plot, PlotFormat format);

}  // namespace vegard::apps
