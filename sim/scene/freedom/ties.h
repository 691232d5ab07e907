// The numbers of a scene that follow from others (fit.tied), in an order in which they can be worked out.
#pragma once

#include <string>
#include <vector>

#include "sim/scene/freedom/expression.h"
#include "sim/scene/structs/scene.h"
#include "sim/scene/table/parameter_table.h"

namespace vegard::sim {

struct Tie {
  ParameterPath path;  ///< what follows
  Expression expression;

  /// One of the numbers that it uses: a parameter of the scene, free, tied or fixed, or else a number of
  /// fit.free by its name (`path.row` is null).
  struct Input {
    ParameterPath path;
    std::string name;
  };
  std::vector<Input> inputs;  ///< in the order of expression.names()
};

/// Whether what an expression gives lies between the limits of the parameter that it is for, to rounding (a
/// billionth of the limit).
bool is_within_limits(const ParameterPath& path, double value);

/// The ties that hold in one photograph (a name of fit.photos; empty: where there is only one), each after
/// those that it uses. Throws Error(scene) with the entry's line where a path or an expression cannot be
/// understood, or where ties go in a circle.
std::vector<Tie> ties_of(const Scene& scene, const std::string& photo = {});

}  // namespace vegard::sim
