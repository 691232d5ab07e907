// A sequence as files: a table, a plot over time, and a frame's row to go on from.
#pragma once

#include <string>
#include <vector>

#include "fit/report/plot/plot.h"
#include "fit/sequence.h"

namespace vegard::fit {

/// A line a frame: its time and verdict, then every number with its sigma. What is unknown is empty.
std::string sequence_csv(const std::vector<SequenceRow>& rows);

/// A panel for each energy, energy flux, distance and lower border against time. Shaded: one sigma. Frames
/// whose verdict is not good are grey; failed and interrupted ones are left out.
Plot sequence_plot(const std::vector<SequenceRow>& rows);

/// A row as JSON with every number exact, and back. Throws sim::Error(unreadable_input) that names `file` for
/// what is no row.
std::string sequence_row_json(const SequenceRow& row);
SequenceRow sequence_row_of(const std::string& json, const std::string& file);

}  // namespace vegard::fit
