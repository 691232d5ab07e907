// What limits and choices of a single row cannot say.
//
// Each gives what is wrong, or nothing.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/scene/rows/complaint.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// A nearly horizontal field would let beams run along the ground: at least 20 degrees.
std::optional<Complaint> inclination_complaint(double inclination_deg);

/// A time or length of which 0 says that there is none: else at least 0.001, or whoever asked for less would
/// only lose what it belongs to in the rounding of the places and instants.
std::optional<Complaint> none_or_some_complaint(double value);

/// A layer's scale height: 0, or at least 0.5 km, below which it is thinner than the steps of altitude.
std::optional<Complaint> layer_complaint(double scale_height_km);

/// True for a text that names a table in a file; others are empty or names of what is built in.
bool is_table_file(const std::string& value);

/// Empty, or "2019-09-01", with a time "T05:00", "T05:00:00" or "T05:00:00.25" and "Z".
std::optional<Complaint> time_complaint(const std::string& time_utc);

/// The name of built-in emission tables or of a folder: not empty.
std::optional<Complaint> emission_tables_complaint(const std::string& name);

/// Between one and eight lines of the program's list or the scene's own, none twice.
std::optional<Complaint> lines_complaint(const Scene& scene, const std::vector<double>& lines_nm);

/// One width per line.
std::optional<Complaint> blur_complaint(const Scene& scene, const std::vector<double>& width_deg);

}  // namespace vegard::sim
