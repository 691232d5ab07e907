// Numbers of a scene as dual numbers, for tests of what is made of them.
#pragma once

#include <vector>

#include "sim/light/emitter.h"

namespace vegard::tests {

inline double plain_double(const double& number) { return number; }

/// Tangent i is that by *free[i].
inline sim::NumberAs<sim::FreeDual> seeded(const std::vector<const double*>& free) {
  return [free](const double& number) {
    sim::FreeDual x(number);
    for (std::size_t i = 0; i < free.size(); ++i)
      if (free[i] == &number) x.d.t[i] = 1.0;
    return x;
  };
}

}  // namespace vegard::tests
