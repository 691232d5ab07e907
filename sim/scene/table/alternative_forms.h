// The keys of a scene file that are not rows of the parameter table: alternative forms of some rows, fit.free
// and fit.tied.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim/scene/rows/declaration.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// A key of a scene file that is not a row.
struct FileKey {
  std::string table, key, unit, meaning;
  std::string type;  ///< in words: "two numbers (east, north)"
};

/// A key, or two keys that are always used together, in place of some rows of the same table.
struct AlternativeForm {
  std::vector<FileKey> keys;
  std::vector<std::string> components;  ///< components of each key's value; empty: one number
  double min = 0.0, max = 0.0;          ///< hard limits of every number, inclusive
  std::vector<std::string> replaces;    ///< keys of the same table that the form replaces

  /// Sets the replaced rows in the scene from the values of the form, one vector of numbers per key. Returns
  /// a complaint if the values are not usable.
  std::function<std::optional<Complaint>(Scene&, int sheet, const std::vector<std::vector<double>>&)> convert;

  /// "center_km, bearing_deg, length_km"
  std::string replaces_text() const;

  /// "start_km and end_km stand for center_km, bearing_deg, length_km"
  std::string words() const;
};

const std::vector<AlternativeForm>& alternative_forms();

/// Returns the form that has this key, or null.
const AlternativeForm* find_alternative_form(const std::string& key);

/// Keys of a sheet that name a file with the points of its curve, and the curve in it. The rows of the points
/// are set from them when the scene's file is read.
inline const char* const curve_file_key = "curve_file";
inline const char* const curve_number_key = "curve";

/// Returns every key of a scene file that is not a row: those of the forms, fit.free and fit.tied, and the
/// keys of their entries. For listings.
std::vector<FileKey> all_file_keys();

}  // namespace vegard::sim
