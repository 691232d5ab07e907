#include "apps/output/plot_file.h"

#include <filesystem>

#include "apps/options/refusals.h"

namespace vegard::apps {

PlotFormat plot_format(const std::string& file, const std::string& key) {
  if (file.empty()) return PlotFormat::none;
  std::string extension = std::filesystem::path(file).extension().string();
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  if (extension == ".svg") return PlotFormat::svg;
  if (extension == ".png") return PlotFormat::png;
  throw usage_error(key, "'" + file + "' names no kind of picture", "a name that ends in .svg or .png");
}

std::string plot_bytes(const fit::Plot& plot, PlotFormat format) {
  if (format == PlotFormat::none) return {};
  return format == PlotFormat::svg ? fit::plot_svg(plot) : fit::plot_png(plot);
}

}  // namespace vegard::apps
