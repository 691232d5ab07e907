// Helpers of the checks of emitters, and of their complaints about inert parameters.
//
// For the files of this folder, and for kinds of emitters that a program adds.
#pragma once

#include <optional>
#include <string>
#include <typeinfo>
#include <vector>

#include "sim/scene/rows/complaint.h"
#include "sim/scene/rows/row.h"

namespace vegard::sim {

/// Checks one element of a repeated table by its path ("loop.arcade"). The functions throw Error(scene).
class ElementCheck {
 public:
  ElementCheck(const Scene& scene, std::string path) : scene_(scene), path_(std::move(path)) {}

  /// Returns Error(scene) that names the key.
  Error error_at(const Complaint& complaint, const std::string& key) const;

  void check_shown() const;  ///< throws unless sun.shown is true
  void check_lines(const std::vector<double>& list, bool may_be_empty, const char* key) const;
  void check_below(double low, const char* low_key, double high, const char* high_key) const;

 private:
  const Scene& scene_;
  std::string path_;
};

/// Checks every element of a repeated table: EmitterKind::check.
template <auto in, auto check>
void check_each(const Scene& scene) {
  for (const auto& element : scene.*in) check(scene, element);
}

/// Returns the word of an enumerator, searched in these rows only (word_of() of
/// sim/scene/table/parameter_table.h searches all rows); empty if no row has it.
std::string word_in(const std::vector<Declaration>& rows, const std::type_info& kind, int number);

template <class Kind>
std::string word_in(const std::vector<Declaration>& rows, Kind kind) {
  return word_in(rows, typeid(Kind), static_cast<int>(kind));
}

bool all_zero(const std::vector<double>& list);

/// True if fit.free names this path or one of its components.
bool frees(const Scene& scene, const std::string& path);

/// True if a line of the scene has a response to temperature.
bool any_line_responds(const Scene& scene);

/// True if objects on the Sun rotate with it as the scene's clock runs.
bool turns_with_sun(const Scene& scene);

/// Gives a row `temperature_mk` the rule that the temperature is above 0 and a line of the scene responds to
/// it.
template <class Owner>
Row<Owner> responding(Row<Owner> row) {
  return row
      .inert_if([](const Owner& owner) { return owner.temperature_mk == 0.0; },
                "the light is that of any temperature", "set it above 0")
      .inert_if([](const Owner&, const Scene& scene) { return !any_line_responds(scene); },
                "no emission line has a response to the temperature",
                "name a line of the corona in emission.lines");
}

}  // namespace vegard::sim
