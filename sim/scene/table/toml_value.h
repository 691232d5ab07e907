// From a TOML value to a number, a text or a parameter, with a message that says what was found instead.
//
// For the files that read TOML only (bounded_toml.h).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <toml++/toml.h>

#include "sim/scene/rows/declaration.h"
#include "sim/scene/table/value_check.h"

namespace vegard::sim {

/// 1-based line of a node, 0 if it has none.
int line_of(const toml::node& node);

/// What was found, in words: "a text (\"wide\")", "an array of 3", "a table".
std::string found_text(const toml::node& node);

/// An integer counts as a number. Throws Error(scene) if it is neither, `expected` in its words.
double number_of(const toml::node& node, const Origin& origin, const std::string& expected);

/// Throws Error(scene) if the node is no text.
std::string text_of(const toml::node& node, const Origin& origin, const std::string& expected);

/// The numbers of an array of `count`, each a number; without a count, of any length.
std::vector<double> numbers_of(const toml::node& node, std::optional<std::size_t> count, const Origin& origin,
                               const std::string& expected);

/// Sets one component (0 for a scalar) after checking type, limits and rule.
void assign_component(Scene& scene, const Declaration& declaration, int sheet, int component,
                      const toml::node& node, const Origin& origin);

/// Sets the whole value of a key: a scalar from a scalar, a vector from an array.
void assign_key(Scene& scene, const Declaration& declaration, int sheet, const toml::node& node,
                const Origin& origin);

}  // namespace vegard::sim
