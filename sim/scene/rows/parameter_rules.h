// Checks of values beyond the limits and choices of a row.
//
// Each function returns a complaint, or nothing if the value is valid.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/scene/rows/complaint.h"
#include "sim/scene/structs/body.h"

namespace vegard::sim {

struct Scene;

/// At least 20 degrees: beams in a nearly horizontal field would run along the ground.
std::optional<Complaint> inclination_complaint(double inclination_deg);

/// A time or length that is 0 (none) or at least 0.001: smaller values are lost in the rounding of positions
/// and times.
std::optional<Complaint> none_or_some_complaint(double value);

/// A layer's scale height: 0, or at least kThinnestLayer_km.
std::optional<Complaint> layer_complaint(double scale_height_km);

/// True if the text names a table in a file; other texts are empty or names of built-in tables.
bool is_table_file(const std::string& value);

/// Empty, or "2019-09-01", with a time "T05:00", "T05:00:00" or "T05:00:00.25" and "Z".
std::optional<Complaint> time_complaint(const std::string& time_utc);

/// The name of built-in emission tables or of a folder: not empty.
std::optional<Complaint> emission_tables_complaint(const std::string& name);

/// Between one and eight different lines, of emission_lines() or the scene's own.
std::optional<Complaint> lines_complaint(const Scene& scene, const std::vector<double>& lines_nm);

/// One width per line.
std::optional<Complaint> blur_complaint(const Scene& scene, const std::vector<double>& width_deg);

inline constexpr double kFirstIgrfYear = 1900.0, kLastIgrfYear = 2030.0;

/// Returns the decimal year of the site's time. Throws Error(scene), which names field.model, if the site has
/// no time or it is outside of these years.
double igrf_year(const Scene& scene);

}  // namespace vegard::sim
