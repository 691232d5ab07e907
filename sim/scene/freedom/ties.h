// The parameters of a scene that are computed from others (fit.tied), in an order of evaluation.
#pragma once

#include <string>
#include <vector>

#include "sim/scene/freedom/expression.h"
#include "sim/scene/structs/scene.h"
#include "sim/scene/table/parameter_table.h"

namespace vegard::sim {

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
