// The files of a sequence: a table, a plot over time, and a row of each frame from which the sequence can be
// continued.
#pragma once

#include <string>
#include <vector>

#include "fit/report/plot/plot.h"
#include "fit/sequence.h"

namespace vegard::fit {

/// The number of this name in a row; null if it has none.
const SequenceNumber* find_number(const SequenceRow& row, const std::string& name);

/// Whether a number is one of those that one wants to see of a frame at a glance: of an energy, energy flux,
/// distance or lower border.
bool is_main_number(const std::string& name);

/// The numbers of all rows, each once, in the order of their first appearance: a frame that failed may lack
/// some.
std::vector<SequenceNumber> sequence_numbers(const std::vector<SequenceRow>& rows);

/// Returns a table with a line per frame: its time and verdict, then every number with its sigma. Unknown
/// values are empty.
std::string sequence_csv(const std::vector<SequenceRow>& rows);

/// Returns a plot with a panel for each energy, energy flux, distance and lower border against time. Shaded:
/// one sigma. Frames whose verdict is not good are grey; failed and interrupted ones are left out.
Plot sequence_plot(const std::vector<SequenceRow>& rows);

/// Converts a row to JSON with exact numbers, and back. Throws sim::Error(unreadable_input) that names `file`
/// if the text is not such a row.
std::string sequence_row_json(const SequenceRow& row);
SequenceRow sequence_row_of(const std::string& json, const std::string& file);

}  // namespace vegard::fit
