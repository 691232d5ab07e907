#include "sim/base/version.h"

#include <Eigen/Core>

namespace vegard::sim {

std::string version() { return VEGARD_VERSION; }

std::string eigen_version() {
  return std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) + "." +
         std::to_string(EIGEN_MINOR_VERSION);
}

}  // namespace vegard::sim
