#include "fit/version.h"

#include <ceres/version.h>
#include <opencv2/core/version.hpp>

namespace vegard::fit {

std::string ceres_version() { return CERES_VERSION_STRING; }

std::string opencv_version() { return CV_VERSION; }

}  // namespace vegard::fit
