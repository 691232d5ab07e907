// Converts TOML values to numbers, texts and parameters. Errors say what was found and what was expected.
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

struct Scene;

/// Returns the 1-based line of a node, 0 if it has none.
int line_of(const toml::node& node);

/// Returns what was found, in words: "a text (\"wide\")", "an array of 3", "a table".
std::string found_text(const toml::node& node);

/// Returns a number, real or integer. Throws Error(scene) with `expected` for any other node.
double number_of(const toml::node& node, const Origin& origin, const std::string& expected);

/// Returns a text. Throws Error(scene) with `expected` for any other node.
std::string text_of(const toml::node& node, const Origin& origin, const std::string& expected);

/// Returns the numbers of an array with `count` elements, or with any number of elements without a count.
std::vector<double> numbers_of(const toml::node& node, std::optional<std::size_t> count, const Origin& origin,
                               const std::string& expected);

/// Sets one component (0 for a scalar) after checking type, limits and rule.
void assign_component(Scene& scene, const Declaration& declaration, int sheet, int component,
                      const toml::node& node, const Origin& origin);

/// Sets the whole value of a key: a scalar from a scalar, a vector from an array.
void assign_key(Scene& scene, const Declaration& declaration, int sheet, const toml::node& node,
                const Origin& origin);

}  // namespace vegard::sim
