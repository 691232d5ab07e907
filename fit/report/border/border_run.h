// Traced borders as a directory: border.csv, border.json, border.svg, report.html.
#pragma once

#include <string>

#include "fit/border/border.h"
#include "fit/report/border/border_page.h"

namespace vegard::fit {

/// A row for each point; distances and places for each of kBorderAltitudesKm. Empty cells where nothing is
/// known: of places, too, where the scene does not say where the site is.
std::string border_csv(const Border& border, const sim::Scene& scene);

std::string border_json(const Border& border, const sim::Scene& scene, const BorderRunFacts& facts);

/// Throws as write_border_run() would, without writing: to be asked before the work.
void check_border_directory(const std::string& directory, bool overwrite);

/// Writes all of it; the directory appears whole or not at all. Throws sim::Error(existing_output,
/// unwritable_output).
void write_border_run(const std::string& directory, bool overwrite, const Border& border, const Photo& photo,
                      const sim::Scene& scene, const BorderRunFacts& facts);

}  // namespace vegard::fit
