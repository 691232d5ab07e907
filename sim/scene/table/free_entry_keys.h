// The keys of the entries of fit.free, fit.tied, [[fit.photo]] and [[fit.radar]], each named once for the
// reader, the writer and the listings.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/scene/rows/declaration.h"
#include "sim/scene/structs/fit.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

inline const char* const free_table = "fit";
inline const char* const free_key = "free";
inline const char* const free_path_key = "path";
inline const char* const free_prior_key = "prior";
inline const char* const tied_key = "tied";

struct FreeNumberKey {
  std::string key, meaning;
  std::optional<double> FreeParameter::*place;
};
const std::vector<FreeNumberKey>& free_number_keys();

/// A key of an entry with a text as value, other than its path. `set` returns false for an unknown word;
/// `text` returns an empty text for the default.
struct FreeTextKey {
  std::string key, meaning, type;
  bool (*set)(FreeParameter& free, const std::string& text);
  std::string (*text)(const FreeParameter& free);
};
const std::vector<FreeTextKey>& free_text_keys();

struct FreePriorKey {
  std::string key, meaning;
  double Prior::*place;
};
const std::vector<FreePriorKey>& free_prior_keys();

inline const char* const prior_law_key = "law";
inline const char* const prior_law_type = "\"normal\", \"log-normal\" or \"uniform\"";
/// Returns nothing for an unknown word.
std::optional<PriorLaw> prior_law(const std::string& word);
std::string word_of_law(PriorLaw law);

struct TiedKey {
  std::string key, meaning, type;
  bool is_needed;
  std::string TiedParameter::*place;
};
const std::vector<TiedKey>& tied_keys();

/// Returns the scale on which a fit varies a parameter: that of the entry, else that of the parameter table;
/// linear for an entry without a path (`row` null).
ParameterScale scale_of(const FreeParameter& free, const ParameterRow* row);

inline const char* const photo_key = "photo";  ///< array of tables inside the table free_table: [[fit.photo]]
inline const char* const photo_set_key = "set";

struct PhotoTextKey {
  std::string key, meaning;
  std::string PhotoEntry::*place;
};
const std::vector<PhotoTextKey>& photo_text_keys();

inline const char* const radar_key = "radar";  ///< likewise: [[fit.radar]]

struct RadarTextKey {
  std::string key, meaning;
  std::string RadarEntry::*place;
};
const std::vector<RadarTextKey>& radar_text_keys();

struct RadarNumberKey {
  std::string key, unit, meaning;
  double min, max;
  std::optional<double> RadarEntry::*place;
};
const std::vector<RadarNumberKey>& radar_number_keys();

inline constexpr double kRadarLowestKm = 85.0, kRadarHighestKm = 150.0;  ///< by default

}  // namespace vegard::sim
