// Numbers of mathematics, for all who need them.
#pragma once

#include <limits>

namespace vegard::sim {

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kTwoPi = 2.0 * kPi;
inline constexpr double kSqrtTwoPi = 2.5066282746310002;

/// What is no number, and says so of whatever is worked out with it.
inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

}  // namespace vegard::sim
