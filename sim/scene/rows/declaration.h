// The description of a parameter: ParameterRow, the public part, and Declaration, which also knows the
// parameter's place inside a Scene. sim/scene/table/parameter_table.h lists all rows.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <typeinfo>
#include <utility>
#include <variant>
#include <vector>

#include "sim/scene/rows/complaint.h"

namespace vegard::sim {

struct Scene;

enum class ParameterKind { real, integer, boolean, text };

/// How a real parameter is stepped and transformed when it is free. An angle is periodic: its limits are
/// several turns apart and only exclude nonsense.
enum class ParameterScale { linear, logarithmic, angle };

/// A mark by which code finds the row of a particular parameter. Most rows have none; each other role belongs
/// to exactly one key.
enum class ParameterRole {
  none,
  // of a sheet
  centre,  ///< component 0 to the east, 1 to the north
  bearing,
  length,
  amplitude,  ///< of its sine
  wavelength,
  phase,
  drift,  ///< component 0 to the east, 1 to the north
  energy,
  energy_spread,
  energy_flux,
  loss_cone,
  pitch_step,
  form_peak,
  form_lower,
  form_upper,
  line_brightness,      ///< of the profiles "line" and "proton"
  profile_coefficient,  ///< of a free-form profile
  curve_east,           ///< of a point of its curve
  curve_north,
  curve_brightness,
  // of the magnetic field
  inclination,
  declination,
  // of the camera
  camera_azimuth,
  camera_elevation,
  camera_roll,
  field_of_view,  ///< of a pinhole
  focal_length,   ///< of every other lens
  principal_x,
  principal_y,
  lens_aspect,
  lens_k1,
  lens_k2,
  lens_k3,
  lens_p1,
  lens_p2,
  oxygen_factor,  ///< of the emission tables
  light_mode,     ///< of their uncertainty
  blur_width,
  // of the air and the night sky
  aerosol_depth,
  angstrom_exponent,
  green_airglow,
  red_airglow,
  sodium_airglow,
  town_light,
  // of a footprint
  footprint_centre,  ///< component 0 to the east, 1 to the north
  footprint_east,    ///< of a point of its curve, from the centre
  footprint_north,
  footprint_energy,
  footprint_energy_flux,
  // of the Sun and what stands on it
  sun_azimuth,
  sun_elevation,
  granule_size,
  granule_shift,
  roles  ///< number of roles
};

/// One row: a scalar, or one component of a vector ("sheet", "center_km", "east"). A vector whose length
/// depends on the scene (emission.lines, blur.width_deg) is one row for all its components, with a
/// placeholder such as "<line>" as component.
struct ParameterRow {
  std::string table;      ///< "sheet"; empty for a key of the file itself ("seed")
  std::string key;        ///< "center_km"
  std::string component;  ///< "east", or empty for a scalar
  ParameterKind kind = ParameterKind::real;
  std::string unit;                  ///< "km"; empty if it has none
  std::string default_text;          ///< in TOML; of a vector of variable length: the whole vector
  double min = 0.0, max = 0.0;       ///< hard limits, inclusive; +-infinity: none
  std::vector<std::string> choices;  ///< allowed texts; empty: any
  ParameterScale scale = ParameterScale::linear;
  bool can_be_free = false;  ///< continuous, and the simulator has its derivative
  std::string meaning;       ///< one line
  std::string noun;          ///< its name in a sentence: "amplitude"
  ParameterRole role = ParameterRole::none;
};

inline const char* const sheet_table = "sheet";

/// The identity of one number. In a list by emission line a number is identified by its line, not by its
/// index: the scenes of several photographs may have different lines, or another order.
struct ParameterId {
  const ParameterRow* row = nullptr;  ///< of parameter_table(); null: no parameter
  int element = -1;                   ///< which of a repeated table's elements, -1 for other tables
  int line = 0;       ///< line_in_angstrom() for a list by emission line, 0 for everything else
  int component = 0;  ///< index within its vector, or among the numbers of its line

  bool any() const { return row != nullptr; }
  ParameterRole role() const { return row == nullptr ? ParameterRole::none : row->role; }
  /// Index into Scene::sheets, -1 for a number of anything else.
  int sheet() const { return row != nullptr && row->table == sheet_table ? element : -1; }
};
inline bool operator==(const ParameterId& a, const ParameterId& b) {
  return a.row == b.row && a.element == b.element && a.line == b.line && a.component == b.component;
}
inline bool operator!=(const ParameterId& a, const ParameterId& b) { return !(a == b); }

/// A number of one scene: its identity and its path.
struct ParameterPath {
  const ParameterRow* row = nullptr;
  int element = -1;   ///< which of a repeated table's elements, -1 for other tables
  int component = 0;  ///< index of the component inside its vector
  std::string text;   ///< "sheet.main.center_km.east"
  ParameterId id;

  /// Index into Scene::sheets, -1 for a number of anything else.
  int sheet() const { return id.sheet(); }
};

/// A table that a scene may contain several times, such as [[sheet]]. Its elements have names, which appear
/// in paths.
struct RepeatedTable {
  std::string table;
  std::function<std::size_t(const Scene&)> count;
  std::function<const std::string&(const Scene&, int element)> name;
  std::function<void(Scene&)> append;  ///< appends an element with defaults
  /// Removes all elements except those for whose name the function returns true.
  std::function<void(Scene&, const std::function<bool(const std::string& name)>&)> keep;
};

/// A reference to a member of any enumeration type, read and set by its number. The row has the words for the
/// numbers.
class KindRef {
 public:
  template <class Kind>
  explicit KindRef(Kind* place)
      : place_(place),
        get_([](const void* at) { return static_cast<int>(*static_cast<const Kind*>(at)); }),
        set_([](void* at, int number) { *static_cast<Kind*>(at) = static_cast<Kind>(number); }) {}

  int number() const { return get_(place_); }
  void set(int number) const { set_(place_, number); }

 private:
  void* place_;
  int (*get_)(const void*);
  void (*set_)(void*, int);
};

/// A reference to a parameter inside a Scene. Its alternative determines the row's kind.
using ValueRef = std::variant<double*, int*, std::uint64_t*, bool*, std::string*, KindRef>;

/// A key and its value as TOML text.
using KeyAndText = std::pair<std::string, std::string>;

/// Who hears that a number has no effect with the scene's other settings.
enum class InertUse {
  always,         ///< nothing depends on it: who sets it, and who frees it
  if_free,        ///< it cannot be fitted: its derivative is not known, or another number replaces it
  if_free_alone,  ///< the same of every number of its element; who sets it is told nothing
  if_set          ///< who sets it in a file
};

/// A reason for which a number has no effect. In the complaint's texts "{key}" stands for the row's key,
/// "{element}" for its element's name, and any other key of the same table in braces for that key's value.
struct InertRule {
  InertUse use = InertUse::always;
  std::function<std::optional<Complaint>(const Scene&, const ParameterPath&)> complaint;
};

/// One key of one table: a scalar or a whole vector.
struct Declaration {
  std::string table, key, unit, meaning;
  std::vector<std::string> components;  ///< names of a vector's components, empty for a scalar
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  std::vector<std::string> choices;
  std::vector<int> numbers;                   ///< of an enumeration: the number of each choice
  const std::type_info* kind_type = nullptr;  ///< of an enumeration: its type
  ParameterScale scale = ParameterScale::linear;
  bool can_be_free = false;
  ParameterRole role = ParameterRole::none;
  std::string noun;  ///< empty: the key without its unit

  /// Returns the reference to a component; `element` is only used for repeated tables.
  std::function<ValueRef(Scene&, int element, int component)> at;

  /// Only for a vector whose length depends on the scene; `components` then has one placeholder.
  std::function<const std::vector<double>&(const Scene&, int element)> list;
  std::function<void(Scene&, int element, const std::vector<double>&)> set_list;
  std::function<std::optional<Complaint>(const Scene&, const std::vector<double>&)>
      list_rule;  ///< may be empty
  std::function<std::string(const Scene&, int element, int component)> list_component;
  /// Of a list by emission line: how many numbers there are per line. Lines are in the order of
  /// emission.lines.
  std::function<int(const Scene&, int element)> numbers_per_line;

  std::vector<InertRule> inert_rules;  ///< the first that applies is told

  /// Further checks of a value, beyond limits and choices.
  std::function<std::optional<Complaint>(double)> number_rule;
  std::function<std::optional<Complaint>(const std::string&)> text_rule;

  /// True for a text that may name a table (sim/scene/table/table_files.h), or a picture or grid
  /// (sim/scene/file/named_files.h).
  bool names_table = false, names_file = false;
  /// Of what steers the search as a whole, and so is no matter of a single photograph: what to do instead.
  std::string of_all_photos;
  /// Why no key may move it; empty: one may (sim/scene/freedom/keyframes.h).
  std::string stands_still;

  /// True for a text that may name a folder of emission tables (sim/scene/table/emission_folder.h).
  bool names_folder = false;

  /// Called after a new value of a scalar in a repeated table has been set, to adapt other values.
  void (*then)(Scene&, int element) = nullptr;

  /// Returns other keys of the same element that a new value of this text sets. May be null.
  const std::vector<KeyAndText>& (*presets)(const std::string& value) = nullptr;
};

}  // namespace vegard::sim
