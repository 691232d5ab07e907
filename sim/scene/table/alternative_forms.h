// The keys of a scene file that are no rows of the parameter table: other ways to say the same, fit.free and
// fit.tied.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim/scene/rows/declaration.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// A key that only a scene file knows.
struct FileKey {
  std::string table, key, unit, meaning;
  std::string type;  ///< in words: "two numbers (east, north)"
};

/// A key, or two that come always together, that stand for some rows of the same table.
struct AlternativeForm {
  std::vector<FileKey> keys;
  std::vector<std::string> components;  ///< of each key's value; empty: each is one number
  double min = 0.0, max = 0.0;          ///< hard limits of every number, inclusive
  std::vector<std::string> replaces;    ///< keys of the same table

  /// Writes what the form says into the scene, one vector of numbers per key; a complaint if it says nothing
  /// usable.
  std::function<std::optional<Complaint>(Scene&, int sheet, const std::vector<std::vector<double>>&)> convert;

  /// "center_km, bearing_deg, length_km"
  std::string replaces_text() const;

  /// "start_km and end_km stand for center_km, bearing_deg, length_km"
  std::string words() const;
};

const std::vector<AlternativeForm>& alternative_forms();

/// The form that has this key, or null.
const AlternativeForm* find_alternative_form(const std::string& key);

/// Keys of a sheet that say where the points of its curve stand in a file; they go into the rows when the
/// scene's file is read.
inline const char* const curve_file_key = "curve_file";
inline const char* const curve_number_key = "curve";

/// Every key of a scene file that is no row: the forms', fit.free and fit.tied, and what their
/// entries hold. For listings.
std::vector<FileKey> all_file_keys();

}  // namespace vegard::sim
