// What limits and choices of a single row cannot say.
//
// Each gives what is wrong, or nothing.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/scene/table/parameter_declarations.h"

namespace vegard::sim {

/// A nearly horizontal field would let beams run along the ground: at least 20 degrees.
std::optional<Complaint> inclination_complaint(double inclination_deg);

/// A time or length of which 0 says that there is none: else at least 0.001, or whoever asked for less would
/// only lose what it belongs to in the rounding of the places and instants.
std::optional<Complaint> none_or_some_complaint(double value);

/// A name of a repeated table's element must be able to stand inside a path and must not be such a table's
/// key, or "sheet.width_km" would mean two things.
std::optional<Complaint> element_name_complaint(const std::string& name);

/// Empty, or "2019-09-01", with a time "T05:00", "T05:00:00" or "T05:00:00.25" and "Z".
std::optional<Complaint> time_complaint(const std::string& time_utc);

/// A line must be one of the emission tables'.
std::optional<Complaint> line_complaint(double line_nm);

/// Between one and eight lines, none twice.
std::optional<Complaint> lines_complaint(const Scene& scene, const std::vector<double>& lines_nm);

/// One width per line.
std::optional<Complaint> blur_complaint(const Scene& scene, const std::vector<double>& width_deg);

}  // namespace vegard::sim
