// What the kinds' checks, and their words for what is inert, have in common.
//
// For the files of this folder, and for kinds that a program adds.
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

/// Checks of one element, at its path ("loop.arcade").
class ElementCheck {
 public:
  ElementCheck(const Scene& scene, std::string path) : scene_(scene), path_(std::move(path)) {}

  /// Throws Error(scene) that names the key.
  [[noreturn]] void refuse(const Complaint& complaint, const std::string& key) const;

  void check_shown() const;  ///< that the Sun is in the scene
  void check_lines(const std::vector<double>& list, bool may_be_empty, const char* key) const;
  void check_below(double low, const char* low_key, double high, const char* high_key) const;

 private:
  const Scene& scene_;
  std::string path_;
};

/// The word of an enumerator, as one of the rows has it (word_of() of sim/scene/table/parameter_table.h asks
/// all rows there are).
std::string word_in(const std::vector<Declaration>& rows, const std::type_info& kind, int number);

template <class Kind>
std::string word_in(const std::vector<Declaration>& rows, Kind kind) {
  return word_in(rows, typeid(Kind), static_cast<int>(kind));
}

bool is_one_of(const std::string& word, std::initializer_list<const char*> words);
bool all_zero(const std::vector<double>& list);

/// Whether the scene frees a number, or one of its components.
bool frees(const Scene& scene, const std::string& path);

/// "WHAT, so KEY has no effect".
Complaint inert(const std::string& what, const std::string& key, const std::string& hint);

/// Whether what stands on the Sun turns with it as the scene's clock runs.
bool turns_with_sun(const Scene& scene);

/// Of a temperature by which no line of the scene shines; else none.
std::optional<Complaint> why_temperature_inert(const Scene& scene, double temperature_mk);

}  // namespace vegard::sim
