// The entries of fit.free and fit.tied: the parameters that their paths name, and the ties between them.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sim/scene/freedom/expression.h"
#include "sim/scene/structs/scene.h"
#include "sim/scene/table/parameter_table.h"

namespace vegard::sim {

/// Calls what(). An Error that it throws gets the scene's file, the line and, if it has none, the key.
void with_origin(const Scene& scene, int line, const std::string& key, const std::function<void()>& what);

/// Return the parameters that an entry names; none for an entry with a name but no path. Throw Error(scene)
/// with the entry's line.
std::vector<ParameterPath> paths_of(const Scene& scene, const FreeParameter& free);
std::vector<ParameterPath> paths_of(const Scene& scene, const TiedParameter& tied);

/// True if entries for these photographs apply to a common one; an empty name stands for all photographs.
bool meet(const std::string& photo, const std::string& other_photo);

struct Tie {
  ParameterPath path;  ///< the tied parameter
  Expression expression;

  /// An input of the expression: a parameter of the scene, free, tied or fixed; or, if `path.row` is null,
  /// the entry of fit.free with this name.
  struct Input {
    ParameterPath path;
    std::string name;
  };
  std::vector<Input> inputs;  ///< in the order of expression.names()
};

/// True if the value of an expression is within the limits of its parameter, with a tolerance of 1e-9 of the
/// limit for rounding.
bool is_within_limits(const ParameterPath& path, double value);

/// Returns the ties of one photograph (a name of fit.photos; empty: the only one), each after those that it
/// uses. Throws Error(scene) with the entry's line for an invalid path or expression, or for circular ties.
std::vector<Tie> ties_of(const Scene& scene, const std::string& photo = {});

}  // namespace vegard::sim
