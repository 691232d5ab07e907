// The directory of traced borders: border.csv, border.json, border.svg, report.html.
#pragma once

#include <string>

#include "fit/border/border.h"
#include "fit/report/border/border_page.h"

namespace vegard::fit {

/// Returns a table with a row for each point, with distances and places for each of kBorderAltitudesKm.
/// Unknown values are empty cells; so are places if the scene does not give the site's position.
std::string border_csv(const Border& border, const sim::Scene& scene);

std::string border_json(const Border& border, const sim::Scene& scene, const BorderRunFacts& facts);

/// Throws as write_border_run() would, without writing; to be called before the work.
void check_border_directory(const std::string& directory, bool overwrite);

/// Writes the directory, completely or not at all. Throws sim::Error(existing_output, unwritable_output).
void write_border_run(const std::string& directory, bool overwrite, const Border& border, const Photo& photo,
                      const sim::Scene& scene, const BorderRunFacts& facts);

}  // namespace vegard::fit
