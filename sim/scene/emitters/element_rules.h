// Helpers of the checks of emitters, and of their complaints about inert parameters.
//
// For the files of this folder, and for kinds of emitters that a program adds.
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <typeinfo>
#include <vector>

#include "sim/scene/rows/complaint.h"
#include "sim/scene/rows/declaration.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Checks one element of a repeated table by its path ("loop.arcade"). The functions throw Error(scene).
class ElementCheck {
 public:
  ElementCheck(const Scene& scene, std::string path) : scene_(scene), path_(std::move(path)) {}

  /// Throws Error(scene) that names the key.
  [[noreturn]] void refuse(const Complaint& complaint, const std::string& key) const;

  void check_shown() const;  ///< throws unless sun.shown is true
  void check_lines(const std::vector<double>& list, bool may_be_empty, const char* key) const;
  void check_below(double low, const char* low_key, double high, const char* high_key) const;

 private:
  const Scene& scene_;
  std::string path_;
};

/// Returns the word of an enumerator, searched in these rows only (word_of() of
/// sim/scene/table/parameter_table.h searches all rows); empty if no row has it.
std::string word_in(const std::vector<Declaration>& rows, const std::type_info& kind, int number);

template <class Kind>
std::string word_in(const std::vector<Declaration>& rows, Kind kind) {
  return word_in(rows, typeid(Kind), static_cast<int>(kind));
}

bool is_one_of(const std::string& word, std::initializer_list<const char*> words);
bool all_zero(const std::vector<double>& list);

/// True if fit.free names this path or one of its components.
bool frees(const Scene& scene, const std::string& path);

/// Returns the complaint "WHAT, so KEY has no effect".
Complaint inert(const std::string& what, const std::string& key, const std::string& hint);

/// True if objects on the Sun rotate with it as the scene's clock runs.
bool turns_with_sun(const Scene& scene);

/// Returns a complaint if the temperature is 0 or no line of the scene responds to a temperature.
std::optional<Complaint> why_temperature_inert(const Scene& scene, double temperature_mk);

}  // namespace vegard::sim
